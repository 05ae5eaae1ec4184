// SPDX-License-Identifier: MIT

import { batch, signal } from '@preact/signals-core';

/** How segments are shown. */
export class Appearance {
  /** Labels of the segments that are not shown. */
  readonly hidden = signal<ReadonlySet<number>>(new Set());
  /** How far segments are moved apart: 0 leaves them in place. */
  readonly explosion = signal(0);
  readonly boundaries = signal(true);

  toggle(label: number): void {
    const hidden = new Set(this.hidden.peek());
    if (!hidden.delete(label)) hidden.add(label);
    this.hidden.value = hidden;
  }

  /** Shows one segment alone, or all if it is already alone. */
  isolate(label: number, labels: readonly number[]): void {
    const others = labels.filter((other) => other !== label);
    const alone = !this.hidden.peek().has(label) && others.every((other) => this.hidden.peek().has(other));
    this.hidden.value = new Set(alone ? [] : others);
  }

  showAll(): void {
    this.hidden.value = new Set();
  }

  reset(): void {
    batch(() => {
      this.showAll();
      this.explosion.value = 0;
    });
  }
}
