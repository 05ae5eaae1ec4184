// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import type { Session, Tool } from '../model/Session';
import type { PointerTools } from '../view/PointerTools';
import type { Stage } from '../view/Stage';
import { byId, onClick, onSlide } from './dom';

/** The tools, what they do, and the buttons for the view. */
export function toolsPanel(session: Session, stage: Stage, pointerTools: PointerTools): void {
  const tools = document.querySelectorAll<HTMLInputElement>('input[name=tool]');
  for (const tool of tools) tool.addEventListener('change', () => (session.tool.value = tool.value as Tool));
  onSlide('brush', (radius) => (pointerTools.brush = radius));
  effect(() => {
    const tool = session.tool.value;
    for (const input of tools) input.checked = input.value === tool;
    byId('tools').hidden = session.mode.value !== 'seeds';
    byId('brush-row').hidden = session.mode.value !== 'seeds' || (tool !== 'paint' && tool !== 'erase');
    byId('hint').textContent = hint(session);
  });

  onClick('fit', () => stage.fit());
  onClick('up', () => stage.turnUp());
  onClick('boundaries', () => toggleBoundaries(session));
  effect(() => {
    byId('boundaries').ariaPressed = String(session.appearance.boundaries.value);
  });
}

export function toggleBoundaries({ appearance }: Session): void {
  appearance.boundaries.value = !appearance.boundaries.peek();
}

function hint({ mesh, mode, tool, seeds }: Session): string {
  if (!mesh.value) return 'Drop a mesh here, or choose a model';
  if (mode.value !== 'seeds') return '';
  const name = seeds.labels.value.find((label) => label.id === seeds.currentLabel.value)?.name ?? '';
  const hints: Record<Tool, string> = {
    view: 'Drag to turn',
    seed: `Click the mesh to place a seed of “${name}”`,
    paint: `Drag over the mesh to paint seeds of “${name}”`,
    erase: 'Drag over seeds to erase them',
  };
  return hints[tool.value];
}
