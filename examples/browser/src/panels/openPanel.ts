// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import { openedEndings } from '../files/formats';
import { readSeeds } from '../files/seeds';
import { modelName, type Session } from '../model/Session';
import { byId, element, onClick } from './dom';

/** Opens meshes and seeds: from a dialogue, dropped on the page, or built in. */
export function openPanel(session: Session): void {
  const input = byId<HTMLInputElement>('file');
  input.accept = openedEndings.join();
  onClick('open', () => input.click());
  onClick('load-seeds', () => input.click());
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    input.value = ''; // so that the same file can be chosen again
    if (file) void openFile(session, file);
  });
  acceptDrops(session);
  void offerModels(session);
  effect(() => {
    const name = session.opening.value;
    byId('opening').hidden = name === null;
    if (name !== null) byId('opening').textContent = `Opening ${name} …`;
  });
}

/** @returns whether it was opened */
async function openFile(session: Session, file: File): Promise<boolean> {
  if (!/\.json$/i.test(file.name)) return session.openFile(file);
  try {
    const text = await file.text();
    await session.whenOpened();
    const mesh = session.mesh.peek();
    if (!mesh) throw new Error('Open the mesh first.');
    session.seeds.replace(readSeeds(text, mesh.faces));
    session.mode.value = 'seeds';
    session.message.value = null;
    return true;
  } catch (error) {
    session.report(error, `${file.name} was not loaded. `);
    return false;
  }
}

function acceptDrops(session: Session): void {
  const hint = byId('drop');
  let depth = 0; // of the element under the pointer: each enters before the one around it is left
  const enter = (change: number) => {
    depth = Math.max(0, depth + change);
    hint.hidden = depth === 0;
  };
  window.addEventListener('dragenter', () => enter(1));
  window.addEventListener('dragleave', () => enter(-1));
  window.addEventListener('dragover', (event) => event.preventDefault());
  window.addEventListener('drop', (event) => {
    event.preventDefault();
    enter(-depth);
    void openTogether(session, [...(event.dataTransfer?.files ?? [])]);
  });
}

/** A mesh, seeds, or both. Materials beside an OBJ file tell nothing. */
async function openTogether(session: Session, files: File[]): Promise<void> {
  const isSeeds = (file: File) => /\.json$/i.test(file.name);
  const seeds = files.filter(isSeeds);
  const others = files.filter((file) => !isSeeds(file));
  const hasObj = others.some((file) => /\.obj$/i.test(file.name));
  const meshes = others.filter((file) => !(hasObj && /\.mtl$/i.test(file.name)));
  if (meshes.length > 1 || seeds.length > 1) {
    const error = new Error('A mesh and its seeds are opened together, but no more files.');
    return session.report(error, `None of the ${files.length} files was opened. `);
  }
  for (const file of [...meshes, ...seeds]) if (!(await openFile(session, file))) return;
}

async function offerModels(session: Session): Promise<void> {
  const select = byId<HTMLSelectElement>('model');
  select.addEventListener('change', () => {
    if (select.value) void session.openModel(select.value);
  });
  // Arrow keys go on from the model that they have opened; afterwards the same one can be chosen again.
  const reset = () => (select.selectedIndex = 0);
  select.addEventListener('blur', reset);
  effect(() => {
    const name = session.opening.value;
    if (name !== null && name !== select.selectedOptions[0]?.textContent) reset();
  });
  try {
    for (const model of await session.engine.models()) {
      select.append(element('option', { value: model, textContent: modelName(model) }));
    }
  } catch (error) {
    session.report(error);
  }
}
