// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import type { Mode, Session } from '../model/Session';
import { byId, onClick } from './dom';

/** The frame of the page: tabs, the panel that folds, undo and redo, dark and light. */
export function frame(session: Session): void {
  tabs(session);
  theme();

  const toggle = byId('panel-toggle');
  toggle.addEventListener('click', () => {
    const isOpen = toggle.ariaExpanded !== 'true';
    toggle.ariaExpanded = String(isOpen);
    byId('panel').classList.toggle('is-folded', !isOpen);
  });

  onClick('undo', () => session.seeds.undo());
  onClick('redo', () => session.seeds.redo());
  effect(() => {
    const isSeeds = session.mode.value === 'seeds';
    byId<HTMLButtonElement>('undo').disabled = !isSeeds || !session.seeds.canUndo.value;
    byId<HTMLButtonElement>('redo').disabled = !isSeeds || !session.seeds.canRedo.value;
  });
}

const modes: readonly Mode[] = ['seeds', 'automatic'];

function tabs(session: Session): void {
  for (const mode of modes) {
    const tab = byId(`tab-${mode}`);
    tab.addEventListener('click', () => (session.mode.value = mode));
    tab.addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
      session.mode.value = modes[1 - modes.indexOf(mode)];
      byId(`tab-${session.mode.value}`).focus();
    });
  }
  effect(() => {
    for (const mode of modes) {
      const isChosen = session.mode.value === mode;
      byId(`tab-${mode}`).ariaSelected = String(isChosen);
      byId(`tab-${mode}`).tabIndex = isChosen ? 0 : -1;
      byId(`${mode}-panel`).hidden = !isChosen;
    }
  });
}

/** The look that the user has chosen is kept where the browser lets a page keep something. */
function theme(): void {
  const root = document.documentElement;
  try {
    root.dataset.theme = localStorage.getItem('theme') ?? '';
  } catch {
    // Pages from disk may keep nothing.
  }
  onClick('theme', () => {
    const former = root.dataset.theme || (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
    root.dataset.theme = former === 'dark' ? 'light' : 'dark';
    try {
      localStorage.setItem('theme', root.dataset.theme);
    } catch {
      // as above
    }
  });
}
