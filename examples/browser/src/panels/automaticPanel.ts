// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import type { AutomaticSegmentation } from '../model/AutomaticSegmentation';
import type { Session } from '../model/Session';
import type { HierarchyKind, Policies } from '../worker/EngineModule';
import { byId, onSlide } from './dom';

const remarks: Record<HierarchyKind, string> = {
  graphical: 'Cuts animals, people and things along concave creases, as people do.',
  engineering: 'Cuts machine parts into planes, cylinders, cones and other surfaces.',
};

/** The slider has no more steps than that: more parts are of no use to look at. */
const mostParts = 200;

/** Segments without seeds, and the slider over their hierarchy. */
export function automaticPanel({ automatic, mesh, opening }: Session): void {
  const kinds = document.querySelectorAll<HTMLInputElement>('input[name=kind]');
  for (const kind of kinds) kind.addEventListener('change', () => (automatic.kind.value = kind.value as HierarchyKind));
  effect(() => {
    for (const kind of kinds) kind.checked = kind.value === automatic.kind.value;
    byId('kind-remark').textContent = remarks[automatic.kind.value];
    byId('policies').hidden = automatic.kind.value === 'engineering';
  });
  policies(automatic);

  const compute = byId<HTMLButtonElement>('compute');
  const cancel = byId<HTMLButtonElement>('cancel');
  const parts = byId<HTMLInputElement>('parts');
  compute.addEventListener('click', () => void automatic.compute());
  cancel.addEventListener('click', () => automatic.cancel());
  effect(() => {
    const progress = automatic.progress.value;
    const focused = document.activeElement; // what is hidden hands the focus on to what takes its place
    compute.hidden = progress !== null || automatic.level.value !== null;
    compute.disabled = !mesh.value || opening.value !== null; // parts of the mesh before would be thrown away
    byId('progress').hidden = progress === null;
    byId<HTMLProgressElement>('progress-bar').value = progress ?? 0;
    if (focused === compute && progress !== null) cancel.focus();
    if (focused === cancel && progress === null) (compute.hidden ? parts : compute).focus();
  });

  onSlide('parts', (value) => automatic.setParts(value));
  effect(() => {
    const level = automatic.level.value;
    byId('level').hidden = level === null;
    if (!level) return;
    const { fewest, fragments, suggested, levels } = level.hierarchy;
    parts.min = String(fewest);
    parts.max = String(Math.min(fragments, Math.max(mostParts, suggested, fewest, level.parts)));
    parts.value = String(level.parts);
    byId('parts-value').textContent = String(level.parts);
    byId('levels').replaceChildren(...Array.from(levels, (parts) => new Option('', String(parts))));
    byId('level-remark').textContent =
      `${suggestion(suggested, levels)} ` +
      (level.milliseconds === undefined ? '' : `Found in ${seconds(level.milliseconds)}.`);
  });
}

/** A list for each policy, whose options have the names that the engine knows, and their numbers. */
function policies(automatic: AutomaticSegmentation): void {
  const lists: [keyof Policies, HTMLSelectElement][] = [
    ['difference', byId<HTMLSelectElement>('difference')],
    ['seeding', byId<HTMLSelectElement>('seeding')],
    ['mergeCost', byId<HTMLSelectElement>('merge-cost')],
  ];
  for (const [policy, list] of lists)
    list.addEventListener('change', () => automatic.setPolicies({ [policy]: list.value } as Partial<Policies>));
  effect(() => {
    for (const [policy, list] of lists) list.value = String(automatic.policies.value[policy]);
  });

  const radius = byId<HTMLInputElement>('radius');
  onSlide('radius', (lengths) => automatic.setPolicies({ radius: lengths }));
  effect(() => {
    const { difference, radius: lengths } = automatic.policies.value;
    byId('radius-row').hidden = difference !== 'curvature';
    radius.value = String(lengths);
    byId('radius-value').textContent = radius.ariaValueText = `${lengths} edges`;
  });
}

function suggestion(suggested: number, levels: ArrayLike<number>): string {
  const others = Array.from(levels).filter((parts) => parts !== suggested);
  return others.length === 0
    ? `The shape suggests ${suggested}.`
    : `The shape suggests ${suggested}; people may prefer ${others.join(' or ')}.`;
}

function seconds(milliseconds: number): string {
  return milliseconds < 1000 ? `${Math.round(milliseconds)} ms` : `${(milliseconds / 1000).toFixed(1)} s`;
}
