// SPDX-License-Identifier: MIT

import { effect, signal } from '@preact/signals-core';
import { hexadecimal } from '../model/colorVision';
import type { Session, ShownSegment } from '../model/Session';
import { numbersOf, short, sizeOf, snapText, surfaceTypes } from '../model/surfaceNumbers';
import { sortedSurfaces, type SurfaceColumn, type SurfaceOrder, type SurfaceSegment } from '../model/surfaceTable';
import type { Surface, SurfaceType } from '../worker/EngineModule';
import { byId, element, rows, type Row } from './dom';

interface SurfaceRow extends ShownSegment, SurfaceSegment {
  /** In the mesh's unit, squared. */
  surfaceArea: number;
  isGreyed: boolean;
}

/** Longer tables are of no use to look at, and slow. */
const mostRows = 300;

/** The surfaces of a machine part: a table, a filter by type, what is made regular, and the one under the pointer. */
export function surfacesPanel(session: Session): void {
  const { surfaces } = session;
  effect(() => {
    byId('surfaces-section').hidden = session.surfaceSegments.value === null;
    byId('finding-surfaces').hidden = surfaces.found.value !== null;
    byId('surfaces').hidden = surfaces.found.value === null;
  });
  table(session);
  typeFilter(session);
  regularity(session);
  pointedSurface(session);
}

function table(session: Session): void {
  const { surfaces } = session;
  const order = signal<SurfaceOrder>({ column: 'label', isDescending: false });
  for (const heading of byId('surface-table').querySelectorAll<HTMLElement>('th[data-column]')) {
    const column = heading.dataset.column as SurfaceColumn;
    heading.querySelector('button')!.addEventListener('click', () => (order.value = nextOrder(order.peek(), column)));
    effect(() => {
      const isSorted = order.value.column === column;
      heading.ariaSort = isSorted ? (order.value.isDescending ? 'descending' : 'ascending') : 'none';
    });
  }
  const show = rows<SurfaceRow>(
    byId('surface-rows'),
    (row) => row.label,
    (label) => surfaceRow(session, label),
  );
  effect(() => {
    const listed = sortedSurfaces(surfaceRows(session), order.value);
    show(listed.slice(0, mostRows));
    byId('surfaces-unlisted').hidden = listed.length <= mostRows;
    byId('surfaces-unlisted').textContent = `The first ${mostRows} are listed.`;
  });
  effect(() => {
    const [pointed, chosen] = [surfaces.pointed.value, surfaces.chosen.value];
    surfaces.found.value; // other rows
    order.value;
    for (const row of byId('surface-rows').children as HTMLCollectionOf<HTMLElement>) {
      const label = Number(row.dataset.label);
      row.classList.toggle('is-pointed', label === pointed);
      row.classList.toggle('is-chosen', label === chosen);
      row.querySelector('button')!.ariaPressed = String(label === chosen);
      if (label === pointed) scrollTo(row, byId('surface-box'));
    }
  });
}

/** The other way round if it is sorted by that column already. Sizes are looked through from the largest. */
function nextOrder(order: SurfaceOrder, column: SurfaceColumn): SurfaceOrder {
  const isDescending = order.column === column ? !order.isDescending : column !== 'label' && column !== 'type';
  return { column, isDescending };
}

function surfaceRows({ surfaces, segments, mesh }: Session): SurfaceRow[] {
  const found = surfaces.found.value;
  if (!found || !mesh.value) return [];
  const wholeArea = mesh.value.faceAreas.reduce((sum, area) => sum + area, 0);
  return segments.value.flatMap((segment) => {
    const surface = found.surfaces[segment.label];
    if (!surface) return [];
    const isGreyed = surfaces.greyed.value.has(surface.type);
    return [{ ...segment, surface, surfaceArea: wholeArea * segment.area, isGreyed }];
  });
}

function surfaceRow({ surfaces }: Session, label: number): Row<SurfaceRow> {
  const swatch = element('span', { className: 'swatch' });
  const name = element('button', { className: 'link', ariaPressed: 'false' });
  const type = element('td');
  const size = element('td', { className: 'number' });
  const area = element('td', { className: 'number' });
  const faces = element('td', { className: 'number' });
  const row = element('tr', {}, element('td', {}, swatch, name), type, size, area, faces);
  row.dataset.label = String(label);
  row.addEventListener('click', () => surfaces.choose(label));
  return {
    element: row,
    update(segment) {
      row.classList.toggle('is-greyed', segment.isGreyed);
      row.title = inWords(segment.surface);
      swatch.style.background = hexadecimal(segment.color);
      name.textContent = String(segment.label + 1);
      name.ariaLabel = `${segment.name}, ${inWords(segment.surface)}`;
      type.textContent = segment.surface.type;
      size.textContent = sizeOf(segment.surface);
      area.textContent = short(segment.surfaceArea, 4);
      faces.textContent = segment.faces.toLocaleString('en');
    },
  };
}

function inWords(surface: Surface): string {
  return [surface.type, ...numbersOf(surface).map(({ name, value }) => `${name} ${value}`)].join(', ');
}

/** Scrolls the box alone, not what it is in. */
function scrollTo(row: HTMLElement, box: HTMLElement): void {
  const [inner, outer] = [row.getBoundingClientRect(), box.getBoundingClientRect()];
  if (inner.top < outer.top || inner.bottom > outer.bottom)
    box.scrollTop += (inner.top + inner.bottom - outer.top - outer.bottom) / 2;
}

function typeFilter({ surfaces }: Session): void {
  const choices = surfaceTypes.map((type) => typeChoice(type, () => surfaces.toggleType(type)));
  byId('surface-types').append(...choices.map(({ label }) => label));
  effect(() => {
    const found = surfaces.found.value?.surfaces ?? [];
    for (const { type, label, input, count } of choices) {
      const number = found.filter((surface) => surface.type === type).length;
      label.hidden = number === 0;
      input.checked = !surfaces.greyed.value.has(type);
      count.textContent = String(number);
    }
  });
}

function typeChoice(type: SurfaceType, toggle: () => void) {
  const input = element('input', { type: 'checkbox', value: type, onchange: toggle });
  const count = element('span', { className: 'count' });
  return { type, input, count, label: element('label', {}, input, `${type} `, count) };
}

function regularity({ surfaces }: Session): void {
  const isRegular = byId<HTMLInputElement>('regular');
  const length = byId<HTMLInputElement>('regular-length');
  const angle = byId<HTMLInputElement>('regular-angle');
  const number = (input: HTMLInputElement) => (input.value === '' ? null : input.valueAsNumber);
  const take = () => {
    length.disabled = angle.disabled = !isRegular.checked; // what is disabled is never invalid
    if (![length, angle].every((input) => input.reportValidity())) return;
    surfaces.regularity.value = isRegular.checked ? { length: number(length), angle: number(angle) } : null;
  };
  for (const input of [isRegular, length, angle]) input.addEventListener('change', take);
  effect(() => {
    const chosen = surfaces.regularity.value;
    isRegular.checked = chosen !== null;
    length.disabled = angle.disabled = chosen === null;
    if (!chosen) return;
    length.value = chosen.length === null ? '' : String(chosen.length);
    angle.value = chosen.angle === null ? '' : String(chosen.angle);
  });
  effect(() => {
    const snaps = surfaces.found.value?.regular ?? [];
    const isAsked = surfaces.regularity.value !== null && surfaces.found.value !== null;
    byId('snaps').replaceChildren(
      ...snaps.slice(0, mostRows).map((snap) => element('li', { textContent: snapText(snap) })),
    );
    const count = snaps.length > mostRows ? `${snaps.length} snaps, of which the first ${mostRows} are listed.` : '';
    byId('snap-remark').textContent = isAsked && snaps.length === 0 ? 'Nothing was to be made regular.' : count;
  });
}

function pointedSurface(session: Session): void {
  const { surfaces, segments } = session;
  effect(() => {
    const label = surfaces.pointed.value;
    const surface = label === null ? undefined : surfaces.found.value?.surfaces[label];
    byId('pointed-surface').hidden = !surface;
    if (!surface) return;
    const name = segments.value.find((segment) => segment.label === label)?.name ?? '';
    byId('pointed-surface-title').textContent = `${name}: ${surface.type}`;
    const numbers = numbersOf(surface).flatMap(({ name, value }) => [
      element('dt', { textContent: name }),
      element('dd', { textContent: value }),
    ]);
    byId('pointed-surface-numbers').replaceChildren(...numbers);
  });
}
