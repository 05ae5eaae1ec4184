// SPDX-License-Identifier: MIT

import { expect, test } from '@playwright/test';
import { amend, beginHistory, record, redo, undo } from '../../src/model/History';
import { newAnnotation, withNewLabel, withoutLabelAndSeeds } from '../../src/model/labels';
import { latest } from '../../src/model/latest';
import { palette } from '../../src/model/palette';
import { segmentOfFragments, segmentsAtLevel } from '../../src/model/mergeTree';
import { seedEdit, withoutSeeds, withSeeds } from '../../src/model/seeds';
import { neighboursOf, segmentsOf } from '../../src/model/segments';
import { adjacentFaces } from '../../src/worker/adjacentFaces';

test('undo and redo walk through what was recorded, and a new edit forgets the redone', () => {
  let history = record(record(beginHistory('a'), 'b'), 'c');
  history = undo(history);
  expect(history.present).toBe('b');
  expect(undo(undo(undo(history))).present).toBe('a');
  expect(redo(redo(redo(history))).present).toBe('c');
  expect(redo(record(history, 'd')).present).toBe('d');
});

test('an amended step is undone as a whole', () => {
  const history = amend(amend(record(beginHistory(0), 1), 2), 3);
  expect(undo(history).present).toBe(0);
  expect(redo(undo(history)).present).toBe(3);
});

test('applying an edit to one set of seeds makes the other', () => {
  const from = withSeeds(withSeeds(new Map(), [1, 2, 3], 0), [7], 1);
  const to = withSeeds(withoutSeeds(from, [2, 7]), [3, 9], 4);
  const { removed, added } = seedEdit(from, to);
  const applied = new Map(from);
  for (const face of removed) expect(applied.delete(face)).toBe(true);
  for (const [face, label] of added) applied.set(face, label);
  expect(applied).toEqual(to);
  expect(seedEdit(to, to)).toEqual({ removed: [], added: [] });
});

test('new labels have new numbers and colours, and take a free number again', () => {
  let annotation = newAnnotation;
  for (let i = 0; i < 20; ++i) annotation = withNewLabel(annotation);
  expect(new Set(annotation.labels.map((label) => label.id)).size).toBe(22);
  expect(new Set(annotation.labels.map((label) => label.color)).size).toBe(22);
  const less = withoutLabelAndSeeds(
    {
      ...annotation,
      seeds: new Map([
        [5, 3],
        [6, 4],
      ]),
    },
    3,
  );
  expect([...less.seeds]).toEqual([[6, 4]]);
  expect(withNewLabel(less).labels.map((label) => label.id)).toContain(3);
});

test('with more labels than colours, each colour is used as often as the others', () => {
  let annotation = newAnnotation;
  while (annotation.labels.length < 2 * palette.length) annotation = withNewLabel(annotation);
  const uses = new Map<string, number>();
  for (const { color } of annotation.labels) uses.set(color, (uses.get(color) ?? 0) + 1);
  expect([...uses.values()]).toEqual(palette.map(() => 2));
});

test('a thousand labels are made at once', () => {
  let annotation = newAnnotation;
  const start = performance.now();
  while (annotation.labels.length < 1000) annotation = withNewLabel(annotation);
  expect(performance.now() - start).toBeLessThan(8000);
});

/** Four fragments in a row: 1 and 2 merge, then 0 with them, then 3. */
const tree = { merges: Uint32Array.of(1, 2, 0, 4, 3, 5), fragments: 4, fewest: 1 };

test('levels of a hierarchy have the number of segments asked for, in the order of their lowest fragments', () => {
  expect([...segmentOfFragments(tree, 4)]).toEqual([0, 1, 2, 3]);
  expect([...segmentOfFragments(tree, 3)]).toEqual([0, 1, 1, 2]);
  expect([...segmentOfFragments(tree, 2)]).toEqual([0, 0, 0, 1]);
  expect([...segmentOfFragments(tree, 1)]).toEqual([0, 0, 0, 0]);
  expect([...segmentsAtLevel({ ...tree, fragmentOfFace: Uint32Array.of(3, 3, 0, 2) }, 2)]).toEqual([1, 1, 0, 0]);
});

test('levels that a hierarchy does not have are refused', () => {
  for (const segments of [0, 5, NaN]) expect(() => segmentOfFragments(tree, segments)).toThrow('between 1 and 4');
});

test('levels of random hierarchies are nested', () => {
  const fragments = 60;
  const merges: number[] = [];
  const roots = Array.from({ length: fragments }, (_, i) => i);
  let state = 1;
  const take = () => roots.splice((state = (state * 48271) % 2147483647) % roots.length, 1)[0];
  for (let region = fragments; roots.length > 3; ++region) {
    const [a, b] = [take(), take()];
    merges.push(Math.min(a, b), Math.max(a, b));
    roots.push(region);
  }
  const random = { merges: Uint32Array.from(merges), fragments, fewest: 3 };
  for (let segments = 3; segments < fragments; ++segments) {
    const coarse = segmentOfFragments(random, segments);
    const fine = segmentOfFragments(random, segments + 1);
    expect(new Set(coarse).size).toBe(segments);
    const pairs = new Set(fine.map((segment, i) => segment * fragments + coarse[i]));
    expect(pairs.size).toBe(segments + 1);
  }
});

test('areas of segments add up to the whole', () => {
  const segments = segmentsOf(Uint32Array.of(4, 2, 4, 9), Float64Array.of(1, 2, 3, 4));
  expect(segments).toEqual([
    { label: 2, faces: 1, area: 0.2 },
    { label: 4, faces: 2, area: 0.4 },
    { label: 9, faces: 1, area: 0.4 },
  ]);
});

test('faces that share an edge are neighbours, whatever their orientation', () => {
  const triangles = Uint32Array.of(0, 1, 2, 1, 2, 3, 3, 2, 4, 5, 6, 7);
  const pairs = adjacentFaces(triangles, Uint32Array.of(0, 1, 2, 3));
  expect([...pairs]).toEqual([0, 1, 1, 2]);
  const labels = Uint32Array.of(5, 5, 8, 6);
  const segments = segmentsOf(labels, new Float64Array(4).fill(1));
  expect(neighboursOf(segments, labels, pairs)).toEqual([[2], [], [0]]);
});

test('edges between the triangles of one polygon are no neighbourhoods', () => {
  const fan = Uint32Array.of(0, 1, 2, 0, 2, 3, 1, 4, 2);
  expect([...adjacentFaces(fan, Uint32Array.of(0, 0, 1))]).toEqual([0, 1]);
});

test('jobs that are asked for while one runs are run once, after it', async () => {
  let asked = 0;
  const answered: number[] = [];
  const run = latest(async () => {
    const edit = asked;
    await new Promise((resolve) => setTimeout(resolve, 5));
    answered.push(edit);
  });
  const ends = [1, 2, 3, 4].map((edit) => {
    asked = edit;
    return run();
  });
  await Promise.all(ends);
  expect(answered).toEqual([1, 4]);
});
