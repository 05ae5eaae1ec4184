// SPDX-License-Identifier: MIT

import { colorOf, hexadecimal } from './colorVision';
import { farthestColor } from './palette';
import { withoutLabel, type Seeds } from './seeds';

/** What the user calls a segment. */
export interface Label {
  readonly id: number;
  readonly name: string;
  /** #rrggbb */
  readonly color: string;
}

/** What the user has said about a mesh. */
export interface Annotation {
  readonly labels: readonly Label[];
  readonly seeds: Seeds;
}

export const newAnnotation: Annotation = withNewLabel(withNewLabel({ labels: [], seeds: new Map() }));

/** With one label more, which has the lowest free number and a colour unlike the others. */
export function withNewLabel(annotation: Annotation): Annotation {
  const taken = new Set(annotation.labels.map((label) => label.id));
  let id = 0;
  while (taken.has(id)) ++id;
  const color = hexadecimal(farthestColor(annotation.labels.map((label) => colorOf(label.color))));
  const labels = [...annotation.labels, { id, name: `Part ${id + 1}`, color }];
  return { ...annotation, labels: labels.sort((a, b) => a.id - b.id) };
}

export function withChangedLabel(annotation: Annotation, id: number, change: Partial<Omit<Label, 'id'>>): Annotation {
  return {
    ...annotation,
    labels: annotation.labels.map((label) => (label.id === id ? { ...label, ...change } : label)),
  };
}

/** Without a label and its seeds. */
export function withoutLabelAndSeeds(annotation: Annotation, id: number): Annotation {
  return {
    labels: annotation.labels.filter((label) => label.id !== id),
    seeds: withoutLabel(annotation.seeds, id),
  };
}
