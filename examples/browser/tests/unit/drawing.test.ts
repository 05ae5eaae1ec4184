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
