// SPDX-License-Identifier: MIT

import { expect, test } from '@playwright/test';
import { noWalls } from '../../src/worker/calls';
import { answer, engineWith } from '../browser/fixture';
import { cube, offFile, triangulated } from '../meshes';

test('a mesh far from the origin is drawn as one at it, with its walls and boundaries', async () => {
  const { points, faces } = triangulated(cube(4));
  const drawn = async (offset: number) => {
    const moved = points.map((point) => point.map((x) => x + offset));
    const engine = await engineWith('cube.off', offFile(moved, faces));
    const labels = Uint32Array.from(faces, (_, face) => (face < faces.length / 2 ? 0 : 1));
    return [
      answer(engine.mesh()).positions,
      answer(engine.setWalls({ ...noWalls, angle: 45 })).points,
      answer(engine.smoothBoundaries(labels)).points,
    ];
  };
  const [near, far] = [await drawn(0), await drawn(5e6)];
  for (const [i, coordinates] of near.entries()) {
    expect(far[i]).toHaveLength(coordinates.length);
    expect(coordinates.length).toBeGreaterThan(0);
    coordinates.forEach((x, j) => expect(far[i][j]).toBeCloseTo(x, 5));
  }
});

test('a polygon is drawn as triangles that lie in it', async () => {
  const outline = [
    [0, 0],
    [3, 0],
    [3, 1],
    [1, 1],
    [1, 3],
    [0, 3],
  ];
  const points = [0, 1].flatMap((z) => outline.map(([x, y]) => [x, y, z]));
  const sides = outline.map((_, i) => [i, (i + 1) % 6, ((i + 1) % 6) + 6, i + 6]);
  const faces = [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11], ...sides];
  const engine = await engineWith('l.off', offFile(points, faces));
  const { positions, triangles, faceOfTriangle, faceAreas } = answer(engine.mesh());
  const areas = new Float64Array(faces.length);
  faceOfTriangle.forEach((face, triangle) => {
    const [a, b, c] = [0, 1, 2].map((i) =>
      positions.subarray(3 * triangles[3 * triangle + i], 3 * triangles[3 * triangle + i] + 3),
    );
    const [u, v] = [b, c].map((corner) => corner.map((x, axis) => x - a[axis]));
    areas[face] += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  });
  expect([...areas]).toEqual([...faceAreas]);
  expect([...faceOfTriangle]).toEqual([...faceOfTriangle].sort((a, b) => a - b));
});
