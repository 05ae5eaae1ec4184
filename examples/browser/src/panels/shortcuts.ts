// SPDX-License-Identifier: MIT

import type { Session, Tool } from '../model/Session';
import type { PointerTools } from '../view/PointerTools';
import type { Stage } from '../view/Stage';
import type { Viewer } from '../view/Viewer';
import { byId, element } from './dom';
import { toggleBoundaries } from './toolsPanel';

interface Shortcut {
  keys: string[];
  what: string;
  action: (key: string) => void;
}

/** Keys for the whole page, the keys on the mesh, and the dialogue that lists them. */
export function shortcuts(session: Session, stage: Stage, pointerTools: PointerTools): void {
  const { seeds } = session;
  const dialog = byId<HTMLDialogElement>('help-dialog');
  const tool = (key: string, value: Tool, what: string): Shortcut => ({
    keys: [key],
    what,
    action: () => (session.tool.value = value),
  });
  const list: Shortcut[] = [
    { keys: ['Ctrl+Z'], what: 'undo', action: () => byId('undo').click() },
    { keys: ['Ctrl+Y', 'Ctrl+Shift+Z'], what: 'redo', action: () => byId('redo').click() },
    {
      keys: ['1', '2', '3', '4', '5', '6', '7', '8', '9'],
      what: 'choose a label',
      action: (key) => {
        const label = seeds.annotation.peek().labels[Number(key) - 1];
        if (label) seeds.currentLabel.value = label.id;
      },
    },
    { keys: ['N'], what: 'another label', action: () => session.mode.peek() === 'seeds' && seeds.addLabel() },
    tool('V', 'view', 'look only'),
    tool('S', 'seed', 'place seeds'),
    tool('P', 'paint', 'paint seeds'),
    tool('E', 'erase', 'erase seeds'),
    { keys: ['F'], what: 'see all of the mesh', action: () => stage.fit() },
    { keys: ['U'], what: 'other axis up', action: () => stage.turnUp() },
    { keys: ['B'], what: 'smooth boundaries', action: () => toggleBoundaries(session) },
    {
      keys: ['H'],
      what: 'probability of the label',
      action: () => {
        const label = seeds.currentLabel.peek();
        const isShown = seeds.probableLabel.peek() === label;
        const hasSeeds = [...seeds.annotation.peek().seeds.values()].includes(label);
        if (session.mode.peek() === 'seeds' && (isShown || hasSeeds)) seeds.showProbability(isShown ? null : label);
      },
    },
    { keys: ['O'], what: 'open a mesh', action: () => byId('open').click() },
    { keys: ['?'], what: 'this help', action: () => dialog.showModal() },
  ];
  listShortcuts(list);
  byId('help').addEventListener('click', () => dialog.showModal());

  window.addEventListener('keydown', (event) => {
    if (dialog.open || isTyping(event)) return;
    const key = keyOf(event);
    const shortcut = list.find(({ keys }) => keys.includes(key));
    if (!shortcut) return;
    event.preventDefault();
    shortcut.action(key);
  });
  keysOnMesh(stage.viewer, pointerTools);
}

/** The key with Control, or Command, and Shift, as the list has it. */
function keyOf(event: KeyboardEvent): string {
  if (event.altKey) return '';
  const key = event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const control = event.ctrlKey || event.metaKey;
  return (control ? 'Ctrl+' : '') + (control && event.shiftKey ? 'Shift+' : '') + key;
}

function isTyping({ target, ctrlKey, metaKey }: KeyboardEvent): boolean {
  if (target instanceof HTMLSelectElement) return !(ctrlKey || metaKey);
  return target instanceof HTMLInputElement && ['text', 'number'].includes(target.type);
}

function listShortcuts(list: readonly Shortcut[]): void {
  for (const { keys, what } of list) {
    const shown = keys.length > 2 ? [keys[0], '…', keys[keys.length - 1]] : keys;
    const term = element('dt');
    shown.forEach((key) => term.append(key === '…' ? '… ' : element('kbd', { textContent: key }), ' '));
    byId('shortcuts').append(element('div', {}, term, element('dd', { textContent: what })));
  }
}

function keysOnMesh(viewer: Viewer, pointerTools: PointerTools): void {
  const { canvas } = viewer;
  const step = Math.PI / 24;
  const actions: Record<string, () => void> = {
    ArrowLeft: () => viewer.orbit(-step, 0),
    ArrowRight: () => viewer.orbit(step, 0),
    ArrowUp: () => viewer.orbit(0, step),
    ArrowDown: () => viewer.orbit(0, -step),
    '+': () => viewer.zoom(0.9),
    '=': () => viewer.zoom(0.9),
    '-': () => viewer.zoom(1 / 0.9),
    Enter: () => {
      const box = canvas.getBoundingClientRect();
      pointerTools.useAt(box.left + box.width / 2, box.top + box.height / 2);
    },
  };
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in actions)) return;
    event.preventDefault();
    canvas.classList.add('by-keyboard');
    actions[event.key]();
  });
  canvas.addEventListener('focus', () => canvas.classList.toggle('by-keyboard', canvas.matches(':focus-visible')));
  canvas.addEventListener('pointerdown', () => canvas.classList.remove('by-keyboard'));
}
