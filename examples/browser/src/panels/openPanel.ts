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

async function openFile(session: Session, file: File): Promise<void> {
  if (!/\.json$/i.test(file.name)) return void (await session.openFile(file));
  const mesh = session.mesh.peek();
  try {
    if (!mesh) throw new Error('Open the mesh first.');
    session.seeds.replace(readSeeds(await file.text(), mesh.faces));
    session.mode.value = 'seeds';
    session.message.value = null;
  } catch (error) {
    session.report(error, `${file.name} was not loaded. `);
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
    const file = event.dataTransfer?.files[0];
    if (file) void openFile(session, file);
  });
}

async function offerModels(session: Session): Promise<void> {
  const select = byId<HTMLSelectElement>('model');
  select.addEventListener('change', () => {
    if (select.value) void session.openModel(select.value);
    select.selectedIndex = 0;
  });
  try {
    for (const model of await session.engine.models()) {
      select.append(element('option', { value: model, textContent: modelName(model) }));
    }
  } catch (error) {
    session.report(error);
  }
}
