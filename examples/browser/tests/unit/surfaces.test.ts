// SPDX-License-Identifier: MIT

import { expect, test } from '@playwright/test';
import { measured, numbersOf, rounded, sizeOf, snapText } from '../../src/model/surfaceNumbers';
import { sortedSurfaces, type SurfaceSegment } from '../../src/model/surfaceTable';
import type { FoundSurfaces, Surface } from '../../src/worker/EngineModule';
import { answer, engineWith } from '../browser/fixture';
import { offFile, shaft } from '../meshes';

const torus: Surface = {
  type: 'torus',
  centre: [1, 2, 3],
  axis: [0, 0, 1],
  radius: 5.00123,
  tube_radius: 1.25,
  residual: 0.001,
  errors: { centre: 0.002, axis: 0.05, radius: 0.0021, tube_radius: null },
};

test('numbers are told to the second digit of their errors', () => {
  expect(measured(5.00123456, 0.0021)).toBe('5.0012 ± 0.0021');
  expect(measured(12345.678, 130)).toBe('12346 ± 130');
  expect(measured(30, 0.25, '°')).toBe('30.00 ± 0.25°');
  expect(measured(2, 0)).toBe('2.0000 ± 0');
  expect(measured(2, null)).toBe('2.0000 ± ?');
});

test('no number has more digits than are of use, nor a negative zero', () => {
  expect(measured(5, 1e-15)).toBe('5.000000 ± 1e-15');
  expect(rounded(1.23456789e-9)).toBe('1.2346e-9');
  expect(rounded(-1e-9, 0.1)).toBe('0.00');
});

test('a torus has all its numbers, with their errors where there are any', () => {
  expect(numbersOf(torus)).toEqual([
    { name: 'radius', value: '5.0012 ± 0.0021' },
    { name: 'tube radius', value: '1.2500 ± ?' },
    { name: 'axis', value: '(0, 0, 1) ± 0.05°' },
    { name: 'centre', value: '(1, 2, 3) ± 0.002' },
    { name: 'residual', value: '0.0010000' },
  ]);
  expect(numbersOf({ ...torus, centre: [1e-17, -4, 0.5] })[3].value).toBe('(0, -4, 0.5) ± 0.002');
  expect(numbersOf({ type: 'free form' })).toEqual([]);
  expect(sizeOf(torus)).toBe('R 5.001, r 1.25');
  expect(sizeOf({ type: 'cone', half_angle: 15 })).toBe('15°');
  expect(sizeOf({ type: 'plane' })).toBe('');
});

test('snaps of directions are told in degrees', () => {
  expect(snapText({ regularity: 'parallel', labels: [0, 4], difference: 0.02 })).toBe(
    'Parts 1 and 5: parallel, before off by 0.02°',
  );
  expect(snapText({ regularity: 'coaxial', labels: [1, 2], difference: 0.0123 })).toBe(
    'Parts 2 and 3: coaxial, before off by 0.012',
  );
});

test('surfaces without a radius are behind the others, whichever way sizes are sorted', () => {
  const row = (label: number, surface: Surface, area: number): SurfaceSegment => ({ label, surface, area, faces: 1 });
  const rows = [
    row(0, { type: 'plane' }, 0.4),
    row(1, { type: 'cylinder', radius: 2 }, 0.1),
    row(2, { type: 'cone', half_angle: 80 }, 0.2),
    row(3, { type: 'sphere', radius: 1 }, 0.2),
    row(4, { type: 'free form' }, 0.1),
  ];
  const order = (column: 'size' | 'area' | 'type', isDescending: boolean) =>
    sortedSurfaces(rows, { column, isDescending }).map(({ label }) => label);
  expect(order('size', false)).toEqual([3, 1, 2, 0, 4]);
  expect(order('size', true)).toEqual([1, 3, 2, 0, 4]);
  expect(order('area', false)).toEqual([1, 4, 2, 3, 0]);
  expect(order('type', false)).toEqual([0, 1, 2, 3, 4]);
});

test('the engine tells the surfaces of a shaft, and makes them regular when asked', async () => {
  const { points, faces } = shaft([2, 2.01]);
  const labels = Uint32Array.from(faces, (face) => {
    const heights = face.map((vertex) => points[vertex][2]);
    const top = Math.max(...heights);
    if (top - Math.min(...heights) > 1e-9) return top < 2.1 ? 3 : 4;
    return top < 1 ? 0 : top < 3 ? 1 : 2;
  });
  const engine = await engineWith('shaft.off', offFile(points, faces));
  const fitted = JSON.parse(answer(engine.surfaces(labels, null))) as FoundSurfaces;
  expect(fitted.surfaces.map(({ type }) => type)).toEqual(['plane', 'plane', 'plane', 'cylinder', 'cylinder']);
  expect(fitted.surfaces[3].radius).toBeCloseTo(2, 9);
  expect(fitted.surfaces[4].radius).toBeCloseTo(2.01, 9);
  expect(fitted.regular).toEqual([]);
  const regular = JSON.parse(answer(engine.surfaces(labels, { length: 0.05, angle: null }))) as FoundSurfaces;
  expect(regular.surfaces[3].radius).toBe(regular.surfaces[4].radius);
  expect(regular.regular.find(({ regularity }) => regularity === 'equal radius')).toMatchObject({ labels: [3, 4] });
  expect(() => answer(engine.surfaces(labels.slice(1), null))).toThrow('a label for each face is needed');
  expect(() => answer(engine.surfaces(labels, { length: -1, angle: null }))).toThrow();
});
