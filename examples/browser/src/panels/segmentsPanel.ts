// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import { hexadecimal } from '../model/colorVision';
import type { Session, ShownSegment } from '../model/Session';
import { byId, element, icon, onClick, onSlide, rows, setIcon, type Row } from './dom';

interface SegmentRow extends ShownSegment {
  isHidden: boolean;
}

/** Longer lists are of no use to look at, and slow. */
const mostRows = 300;

/** The segments with their sizes, what of them is shown, and how far apart. */
export function segmentsPanel(session: Session): void {
  const { appearance, segments } = session;
  const show = rows<SegmentRow>(
    byId('segments'),
    (segment) => segment.label,
    (label) => segmentRow(session, label),
  );
  effect(() => {
    const listed = segments.value.slice(0, mostRows);
    show(listed.map((segment) => ({ ...segment, isHidden: appearance.hidden.value.has(segment.label) })));
    const unlisted = segments.value.length - listed.length;
    byId('segment-count').textContent = listed.length > 0 ? String(segments.value.length) : '';
    const remark = byId('no-segments');
    remark.hidden = listed.length > 0 && unlisted === 0;
    remark.textContent = listed.length === 0 ? emptyRemark(session) : `The first ${mostRows} are listed.`;
    byId('show-all').hidden = appearance.hidden.value.size === 0;
    byId('explosion-row').hidden = listed.length < 2;
  });
  onClick('show-all', () => appearance.showAll());
  onSlide('explosion', (value) => (appearance.explosion.value = value));
  effect(() => {
    const value = appearance.explosion.value;
    byId<HTMLInputElement>('explosion').value = String(value);
    byId('explosion-value').textContent = `${Math.round(100 * value)} %`;
  });
}

function emptyRemark({ mesh, mode }: Session): string {
  if (!mesh.value) return 'Open a mesh first.';
  return mode.value === 'seeds' ? 'None yet: place the first seed.' : 'None yet: let the page find parts.';
}

function segmentRow({ appearance, segments }: Session, label: number): Row<SegmentRow> {
  const swatch = element('span', { className: 'swatch' });
  const name = element('span', { className: 'name' });
  const faces = element('span', { className: 'count' });
  const area = element('span', { className: 'area' });
  const eye = icon('eye');
  const hide = element('button', { className: 'button icon-only plain', onclick: () => appearance.toggle(label) }, eye);
  const isolate = element(
    'button',
    {
      className: 'button icon-only plain',
      title: 'Alone',
      onclick: () =>
        appearance.isolate(
          label,
          segments.peek().map((segment) => segment.label),
        ),
    },
    icon('isolate'),
  );
  const row = element('li', { className: 'row segment-row' }, swatch, name, faces, area, hide, isolate);
  return {
    element: row,
    update(segment) {
      row.classList.toggle('is-hidden', segment.isHidden);
      swatch.style.background = hexadecimal(segment.color);
      name.textContent = segment.name;
      faces.textContent = `${segment.faces.toLocaleString('en')} faces`;
      area.textContent = `${(100 * segment.area).toFixed(1)} %`;
      setIcon(eye, segment.isHidden ? 'hidden' : 'eye');
      hide.title = segment.isHidden ? 'Show' : 'Hide';
      hide.ariaLabel = `${hide.title} ${segment.name}`;
      isolate.ariaLabel = `${segment.name} alone`;
    },
  };
}
