// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import type { Label } from '../model/labels';
import type { Session } from '../model/Session';
import { byId, element, icon, onClick, onSlide, rows, type Row } from './dom';

interface LabelRow extends Label {
  seeds: number;
  isCurrent: boolean;
  isProbability: boolean;
  isOnly: boolean;
}

/** Labels with their names, colours and seeds, and the parameters of the walk. */
export function labelsPanel(session: Session): void {
  const { seeds } = session;
  const show = rows<LabelRow>(
    byId('labels'),
    (label) => label.id,
    (id) => labelRow(session, id),
  );
  effect(() => {
    const { labels, seeds: places } = seeds.annotation.value;
    const counts = new Map<number, number>();
    for (const label of places.values()) counts.set(label, (counts.get(label) ?? 0) + 1);
    show(
      labels.map((label) => ({
        ...label,
        seeds: counts.get(label.id) ?? 0,
        isCurrent: seeds.currentLabel.value === label.id,
        isProbability: seeds.probableLabel.value === label.id,
        isOnly: labels.length === 1,
      })),
    );
    byId<HTMLButtonElement>('clear-seeds').disabled = places.size === 0;
  });
  onClick('add-label', () => seeds.addLabel());
  onClick('clear-seeds', () => seeds.eraseAll());
  parameters(session);
}

function labelRow({ seeds }: Session, id: number): Row<LabelRow> {
  const current = element('input', {
    type: 'radio',
    name: 'current-label',
    onchange: () => (seeds.currentLabel.value = id),
  });
  const color = element('input', { type: 'color', onchange: () => seeds.changeLabel(id, { color: color.value }) });
  const name = element('input', {
    type: 'text',
    className: 'name',
    maxLength: 60,
    onfocus: () => (seeds.currentLabel.value = id),
    onchange: () => seeds.changeLabel(id, { name: name.value.trim() || `Part ${id + 1}` }),
  });
  let knownName = ''; // what is being typed stays when something else changes
  const count = element('span', { className: 'count' });
  const heat = element(
    'button',
    {
      className: 'button icon-only plain',
      title: 'Probability',
      onclick: () => seeds.showProbability(seeds.probableLabel.peek() === id ? null : id),
    },
    icon('heat'),
  );
  const remove = element(
    'button',
    { className: 'button icon-only plain', title: 'Remove', onclick: () => seeds.removeLabel(id) },
    icon('remove'),
  );
  return {
    element: element('li', { className: 'row label-row' }, current, color, name, count, heat, remove),
    update(label) {
      current.checked = label.isCurrent;
      current.ariaLabel = `New seeds get the label ${label.name}`;
      color.value = label.color;
      color.ariaLabel = `Colour of ${label.name}`;
      if (label.name !== knownName || name.value.trim() === '') name.value = knownName = label.name;
      name.ariaLabel = `Name of label ${id + 1}`;
      count.textContent = label.seeds === 1 ? '1 seed' : `${label.seeds} seeds`;
      heat.ariaLabel = `Probability of ${label.name}`;
      heat.ariaPressed = String(label.isProbability);
      heat.disabled = label.seeds === 0;
      remove.ariaLabel = `Remove ${label.name}`;
      remove.disabled = label.isOnly;
    },
  };
}

/** Sliders; that of sigma is logarithmic. */
function parameters(session: Session): void {
  const convexWeight = byId<HTMLInputElement>('convex-weight');
  const sigma = byId<HTMLInputElement>('sigma');
  effect(() => {
    const values = session.parameters.value;
    convexWeight.value = String(values.convexWeight);
    sigma.value = String(Math.log10(values.sigma));
    byId('convex-weight-value').textContent = values.convexWeight.toFixed(2);
    byId('sigma-value').textContent = values.sigma.toPrecision(2);
    sigma.ariaValueText = values.sigma.toPrecision(2);
  });
  onSlide('convex-weight', (value) => session.setParameters({ convexWeight: value }));
  onSlide('sigma', (exponent) => session.setParameters({ sigma: 10 ** exponent }));
  onClick('reset-parameters', () => session.resetParameters());
}
