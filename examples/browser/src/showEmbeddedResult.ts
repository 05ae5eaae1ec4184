// SPDX-License-Identifier: MIT

import { readEmbeddedResult, type EmbeddedResult } from './files/embeddedResult';
import { withNewLabel, type Annotation } from './model/labels';
import type { Session } from './model/Session';
import { defaultPolicies } from './worker/calls';

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
    session.parameters.value = { ...session.parameters.peek(), ...result.parameters };
    const opened = await session.open(result.name, () => ({ fileName: 'embedded.ply', bytes: result.mesh }), walls);
    if (opened) show(session, result);
  } catch (error) {
    session.report(error, 'The result in this page is damaged. ');
  }
  return true;
}

function show(session: Session, result: EmbeddedResult): void {
  if (result.segmentOfFace.length !== session.mesh.peek()?.faces)
    throw new Error(`It has ${result.segmentOfFace.length} labels for ${session.mesh.peek()?.faces ?? 0} faces.`);
  if (result.mode === 'seeds') {
    session.seeds.reset(annotationOf(result), result.segmentOfFace);
    session.mode.value = 'seeds';
  } else {
    session.givenLabels.value = result.segmentOfFace;
    const method = { kind: result.mode, ...defaultPolicies, ...result.policies };
    session.automatic.kind.value = result.mode;
    if (result.hierarchy) {
      const { hierarchy, segments: parts, segmentOfFace } = result;
      session.automatic.take(method, session.walls.peek(), { hierarchy, parts, given: { parts, segmentOfFace } });
    }
    if (result.surfaces) {
      const { regularity, ...found } = result.surfaces;
      session.surfaces.take({ segmentOfFace: result.segmentOfFace, regularity, found });
    }
    session.mode.value = 'automatic';
  }
}

/** The seeds, and labels for them. */
function annotationOf({ seeds }: EmbeddedResult): Annotation {
  const ids = [...new Set(seeds.map((seed) => seed.label))].sort((a, b) => a - b);
  let annotation: Annotation = { labels: [], seeds: new Map() };
  for (const _ of ids) annotation = withNewLabel(annotation);
  const labels = annotation.labels.map((label, i) => ({ ...label, id: ids[i], name: `Part ${ids[i] + 1}` }));
  return { labels, seeds: new Map(seeds.map(({ face, label }) => [face, label])) };
}
