// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import type { Session } from '../model/Session';
import { byId, onClick, onSlide } from './dom';

/** The angle of the slider that no edge is sharper than. */
const noAngle = 180;

/** Edges that no segment crosses: those sharper than an angle, and those of a file. */
export function wallsPanel(session: Session): void {
  const angle = byId<HTMLInputElement>('wall-angle');
  onSlide('wall-angle', (degrees) => session.setWalls({ angle: degrees === noAngle ? null : degrees }));
  const input = byId<HTMLInputElement>('wall-file');
  onClick('open-walls', () => input.click());
  onClick('remove-walls', () => session.setWalls({ file: null }));
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    input.value = ''; // so that the same file can be chosen again
    if (file) void take(session, file);
  });
  effect(() => {
    const walls = session.walls.value;
    const degrees = walls.angle === null ? 'none' : `${walls.angle}°`;
    angle.value = String(walls.angle ?? noAngle);
    angle.ariaValueText = degrees;
    byId('wall-angle-value').textContent = degrees;
    byId('wall-file-row').hidden = walls.file === null;
    byId('wall-file-name').textContent = walls.file?.name ?? '';
  });
  effect(() => {
    const edges = (session.wallEdges.value?.starts.length ?? 1) - 1;
    byId('wall-count').textContent = edges === 0 ? '' : edges === 1 ? '1 edge' : `${edges.toLocaleString('en')} edges`;
    byId<HTMLButtonElement>('open-walls').disabled = !session.mesh.value;
  });
}

async function take(session: Session, file: File): Promise<void> {
  try {
    const text = await file.text();
    await session.whenOpened(); // the edges are those of the mesh that comes
    session.setWalls({ file: { name: file.name, text } });
  } catch (error) {
    session.report(error, `${file.name} was not loaded. `);
  }
}
