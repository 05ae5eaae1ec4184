// SPDX-License-Identifier: MIT

import { batch } from '@preact/signals-core';
import { readEmbeddedResult, type EmbeddedResult } from './files/embeddedResult';
import { withNewLabel, type Annotation } from './model/labels';
import type { Session } from './model/Session';
import { defaultPolicies, noWalls } from './worker/calls';
import type { Walls } from './worker/EngineModule';

/**
 * Shows the result that `segment_mesh --html` has put into the page.
 *
 * @returns whether there is one
 */
export async function showEmbeddedResult(session: Session): Promise<boolean> {
  const text = document.getElementById('embedded-result')?.textContent ?? 'null';
  try {
    const result = readEmbeddedResult(text);
    if (!result) return false;
    const walls = result.walls ? { name: `Walls of ${result.name}`, text: result.walls } : null;
    choose(session, result); // before the mesh is there, so that what the user chooses meanwhile stays chosen
    const opened = await session.open(result.name, () => ({ fileName: 'embedded.ply', bytes: result.mesh }), walls);
    if (opened) show(session, result, { ...noWalls, file: walls });
  } catch (error) {
    session.report(error, 'The result in this page is damaged. ');
  }
  return true;
}

/** Chooses on the page what the result was made by. */
function choose(session: Session, result: EmbeddedResult): void {
  session.parameters.value = { ...session.parameters.peek(), ...result.parameters };
  session.mode.value = result.mode === 'seeds' ? 'seeds' : 'automatic';
  if (result.mode === 'seeds') return;
  session.automatic.kind.value = result.mode;
  session.automatic.setPolicies({ ...result.policies });
}

function show(session: Session, result: EmbeddedResult, walls: Walls): void {
  const { hierarchy, segments: parts, segmentOfFace } = result;
  if (segmentOfFace.length !== session.mesh.peek()?.faces)
    throw new Error(`It has ${segmentOfFace.length} labels for ${session.mesh.peek()?.faces ?? 0} faces.`);
  if (result.mode === 'seeds') return session.seeds.reset(annotationOf(result), segmentOfFace);
  const method = { kind: result.mode, ...defaultPolicies, ...result.policies };
  batch(() => {
    session.givenLabels.value = segmentOfFace;
    if (hierarchy) session.automatic.keep(method, walls, { hierarchy, parts, given: { parts, segmentOfFace } });
    if (result.surfaces) {
      const { regularity, ...found } = result.surfaces;
      session.surfaces.take({ segmentOfFace, regularity, found });
    }
  });
}

/** The seeds, and labels for them. */
function annotationOf({ seeds }: EmbeddedResult): Annotation {
  const ids = [...new Set(seeds.map((seed) => seed.label))].sort((a, b) => a - b);
  let annotation: Annotation = { labels: [], seeds: new Map() };
  for (const _ of ids) annotation = withNewLabel(annotation);
  const labels = annotation.labels.map((label, i) => ({ ...label, id: ids[i], name: `Part ${ids[i] + 1}` }));
  return { labels, seeds: new Map(seeds.map(({ face, label }) => [face, label])) };
}
