// SPDX-License-Identifier: MIT

import type { Annotation, Label } from '../model/labels';

/** Tells seeds from other JSON files. */
const format = 'RW_segmentation seeds';

/** Labels and seeds as JSON. */
export function seedsFile({ labels, seeds }: Annotation, mesh: string, faces: number): string {
  const places = [...seeds].map(([face, label]) => ({ face, label }));
  return JSON.stringify({ format, mesh, faces, labels, seeds: places }, null, 2) + '\n';
}

/**
 * Reads what `seedsFile()` writes.
 *
 * @param faces the number of faces of the mesh that the seeds are for
 * @throws Error that says what is wrong with the file
 */
export function readSeeds(text: string, faces: number): Annotation {
  const content = object(parsed(text), 'The file');
  if (content.format !== format) throw new Error('The file has no seeds: it does not say "format": "' + format + '".');
  if (content.faces !== faces)
    throw new Error(`The seeds are for a mesh of ${String(content.faces)} faces; this one has ${faces}.`);
  const labels = list(content.labels, '"labels"').map((item, i) => readLabel(item, `Label ${i + 1}`));
  const ids = new Set(labels.map((label) => label.id));
  if (labels.length === 0) throw new Error('The file has no labels.');
  if (ids.size < labels.length) throw new Error('Two labels have the same "id".');
  const seeds = list(content.seeds, '"seeds"').map((item, i): [number, number] => {
    const seed = object(item, `Seed ${i + 1}`);
    const face = index(seed.face, `"face" of seed ${i + 1}`);
    const label = index(seed.label, `"label" of seed ${i + 1}`);
    if (face >= faces) throw new Error(`Seed ${i + 1} is on face ${face}, but the mesh has faces 0 to ${faces - 1}.`);
    if (!ids.has(label)) throw new Error(`Seed ${i + 1} has the label ${label}, which the file does not define.`);
    return [face, label];
  });
  return { labels, seeds: new Map(seeds) };
}

function readLabel(item: unknown, what: string): Label {
  const { id, name, color } = object(item, what);
  if (typeof name !== 'string') throw new Error(`${what} has no "name".`);
  if (typeof color !== 'string' || !/^#[0-9a-f]{6}$/i.test(color))
    throw new Error(`${what} has no "color" such as "#e69f00".`);
  return { id: index(id, `"id" of ${what.toLowerCase()}`), name: name.slice(0, 60), color };
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Error(`The file is no JSON: ${(error as Error).message}`);
  }
}

function object(value: unknown, what: string): Record<string, unknown> {
  if (typeof value !== 'object' || value === null || Array.isArray(value))
    throw new Error(`${what} is no JSON object.`);
  return value as Record<string, unknown>;
}

function list(value: unknown, what: string): unknown[] {
  if (!Array.isArray(value)) throw new Error(`${what} is no list.`);
  return value;
}

/** Numbers that labels and faces can have. */
function index(value: unknown, what: string): number {
  if (typeof value !== 'number' || !Number.isInteger(value) || value < 0 || value >= 2 ** 31)
    throw new Error(`${what} is no whole number from 0 on.`);
  return value;
}
