import { effect } from '@preact/signals-core';
import { materialsFile, objFile } from '../files/obj';
import { plyFile } from '../files/ply';
import { save, stem } from '../files/save';
import { seedsFile } from '../files/seeds';
import { segFile } from '../files/seg';
import type { Session } from '../model/Session';
import type { Viewer } from '../view/Viewer';
import { byId, onClick } from './dom';

/** Files of what has been made. */
export function savePanel(session: Session, viewer: Viewer): void {
  const name = () => stem(session.name.peek());

  /** Does something with a mesh and its segments, if there are any. */
  const withSegments = (action: (result: NonNullable<ReturnType<typeof resultOf>>) => void) => () => {
    const result = resultOf(session);
    if (result) action(result);
  };
  onClick(
    'save-ply',
    withSegments(({ mesh, segmentOfFace, colors }) =>
      save(`${name()}_segments.ply`, plyFile(mesh, segmentOfFace, colors) as BlobPart),
    ),
  );
  onClick(
    'save-obj',
    withSegments(({ mesh, segmentOfFace, colors }) => {
      const materials = `${name()}_segments.mtl`;
      save(`${name()}_segments.obj`, objFile(mesh, segmentOfFace, materials));
      save(materials, materialsFile(colors));
    }),
  );
  onClick(
    'save-seg',
    withSegments(({ segmentOfFace }) => save(`${name()}.seg`, segFile(segmentOfFace))),
  );
  onClick('save-picture', () => {
    viewer.picture().then(
      (picture) => save(`${name()}.png`, picture),
      (error) => session.report(error),
    );
  });
  onClick('save-seeds', () => {
    const faces = session.mesh.peek()?.faces ?? 0;
    save(`${name()}_seeds.json`, seedsFile(session.seeds.annotation.peek(), session.name.peek(), faces));
  });

  effect(() => {
    const enable = (id: string, isPossible: boolean) => (byId<HTMLButtonElement>(id).disabled = !isPossible);
    const hasMesh = session.mesh.value !== null;
    for (const id of ['save-ply', 'save-obj', 'save-seg']) enable(id, session.segments.value.length > 0);
    for (const id of ['save-picture', 'load-seeds']) enable(id, hasMesh);
    enable('save-seeds', hasMesh && session.seeds.annotation.value.seeds.size > 0);
  });
}

function resultOf(session: Session) {
  const mesh = session.mesh.peek();
  const segmentOfFace = session.segmentOfFace.peek();
  const colors = new Map(session.segments.peek().map(({ label, color }) => [label, color]));
  return mesh && segmentOfFace && { mesh, segmentOfFace, colors };
}
