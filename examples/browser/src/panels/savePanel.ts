// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import { labelFormats, meshFormats, type SavedFormat } from '../files/formats';
import { reportFile } from '../files/report';
import { save, stem } from '../files/save';
import { seedsFile } from '../files/seeds';
import type { Session } from '../model/Session';
import type { Viewer } from '../view/Viewer';
import type { FileFormat } from '../worker/EngineModule';
import { byId, element, onClick } from './dom';

/** Files of what has been made. */
export function savePanel(session: Session, viewer: Viewer): void {
  const name = () => stem(session.name.peek());

  const formats = byId<HTMLSelectElement>('save-format');
  for (const [label, group] of [
    ['Mesh with segments', meshFormats],
    ['Segment of each face', labelFormats],
  ] as const)
    formats.append(element('optgroup', { label }, ...group.map(optionOf)));
  onClick('save-segments', () => {
    const chosen = [...meshFormats, ...labelFormats].find(({ format }) => format === formats.value)!;
    saveSegments(session, name(), chosen).catch((error) => session.report(error));
  });
  onClick('save-picture', () => {
    viewer.picture().then(
      (picture) => save(`${name()}.png`, picture),
      (error) => session.report(error),
    );
  });
  onClick('save-report', () => {
    const mesh = session.mesh.peek();
    if (!mesh) return;
    const report = reportFile(session.name.peek(), mesh, session.segments.peek(), session.surfaces.found.peek());
    save(`${name()}_report.json`, report);
  });
  onClick('save-seeds', () => {
    const faces = session.mesh.peek()?.faces ?? 0;
    save(`${name()}_seeds.json`, seedsFile(session.seeds.annotation.peek(), session.name.peek(), faces));
  });

  effect(() => {
    const enable = (id: string, isPossible: boolean) => (byId<HTMLButtonElement>(id).disabled = !isPossible);
    const hasMesh = session.mesh.value !== null;
    // The engine may have the next mesh already.
    enable('save-segments', session.segments.value.length > 0 && session.opening.value === null);
    const isFinding = session.surfaceSegments.value !== null && session.surfaces.found.value === null;
    enable('save-report', session.segments.value.length > 0 && !isFinding);
    for (const id of ['save-picture', 'load-seeds']) enable(id, hasMesh);
    enable('save-seeds', hasMesh && session.seeds.annotation.value.seeds.size > 0);
  });
}

function optionOf({ format, title }: SavedFormat): HTMLOptionElement {
  return element('option', { value: format, textContent: title });
}

/** Saves the segments that are shown, if there are any; OBJ files with another one that has their materials. */
async function saveSegments(session: Session, mesh: string, { format, ending }: SavedFormat): Promise<void> {
  const labels = session.segmentOfFace.peek();
  if (!labels) return;
  const colors = Uint32Array.from(session.segments.peek().flatMap(({ label, color }) => [label, ...color]));
  const materials = `${mesh}_segments.mtl`;
  const write = (format: FileFormat, name: string) => session.engine.file(format, name, materials, labels, colors);
  const fileName = mesh + ending;
  const [file, library] = await Promise.all([write(format, fileName), format === 'obj' && write('mtl', materials)]);
  save(fileName, file as BlobPart);
  if (library) save(materials, library as BlobPart);
}
