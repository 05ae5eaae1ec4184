// SPDX-License-Identifier: MIT

import { effect } from '@preact/signals-core';
import { heatGradient } from '../model/heatMap';
import type { Session } from '../model/Session';
import { byId, onClick } from './dom';

/** What the page tells: messages, the mesh and the segments, and the legend of the heat map. */
export function statusPanel(session: Session): void {
  const { seeds } = session;
  onClick('message-close', () => (session.message.value = null));
  effect(() => {
    const message = session.message.value;
    byId('message').hidden = message === null;
    byId('message').dataset.kind = message?.kind;
    byId('message-text').textContent = message?.text ?? '';
  });

  effect(() => {
    const mesh = session.mesh.value;
    byId('mesh-name').textContent = session.name.value;
    const parts = session.segments.value.length;
    const time = session.mode.value === 'seeds' ? seeds.milliseconds.value : null;
    byId('status').textContent = [
      mesh && `${mesh.faces.toLocaleString('en')} faces`,
      parts > 0 && (parts === 1 ? '1 segment' : `${parts} segments`),
      time !== null && `${Math.round(time)} ms`,
    ]
      .filter(Boolean)
      .join(' · ');
  });

  byId('legend-scale').style.background = heatGradient;
  onClick('legend-close', () => seeds.showProbability(null));
  effect(() => {
    const label = seeds.labels.value.find(({ id }) => id === seeds.probableLabel.value);
    byId('legend').hidden = !label || session.mode.value !== 'seeds';
    byId('legend-title').textContent = label ? `Probability of “${label.name}”` : '';
  });
}
