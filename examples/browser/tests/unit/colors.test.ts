// SPDX-License-Identifier: MIT

import { expect, test } from '@playwright/test';
import { apparentDistance, appearances, colorOf, hexadecimal, type Color } from '../../src/model/colorVision';
import { heat } from '../../src/model/heatMap';
import { distinct, farthestColor, palette, paletteDistance } from '../../src/model/palette';
import { segmentColors } from '../../src/model/segmentColors';

const distance = (a: Color, b: Color) => apparentDistance(appearances(a), appearances(b));

test('black and white are at a distance of 1, red and green are close to those who confuse them', () => {
  expect(distance([0, 0, 0], [255, 255, 255])).toBeCloseTo(1, 3);
  expect(distance([170, 90, 0], [110, 120, 0])).toBeLessThan(0.05);
});

test('colours are written and read', () => {
  for (const color of palette) expect(colorOf(hexadecimal(color))).toEqual(color);
});

/** The neighbours on a grid of hexagons, which have six each. */
function hexagons(width: number): number[][] {
  const at = (x: number, y: number) => (x >= 0 && y >= 0 && x < width && y < width ? [y * width + x] : []);
  return Array.from({ length: width * width }, (_, i) => {
    const [x, y] = [i % width, Math.floor(i / width)];
    return [at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1), at(x - 1, y + 1), at(x + 1, y - 1)].flat();
  });
}

test('neighbouring segments never look alike, also with a colour-vision deficiency', () => {
  const neighbours = hexagons(12);
  const colors = segmentColors(neighbours);
  neighbours.forEach((list, segment) => {
    for (const other of list) expect(paletteDistance[colors[segment]][colors[other]]).toBeGreaterThanOrEqual(distinct);
  });
});

test('segments keep the colours that they had where neighbours differ, and only there', () => {
  const neighbours = hexagons(5);
  const former = segmentColors(neighbours);
  expect(
    segmentColors(
      neighbours.slice(0, 6).map((list) => list.filter((i) => i < 6)),
      former,
    ),
  ).toEqual(former.slice(0, 6));
  const [a, b] = segmentColors([[1], [0]], [3, 3]);
  expect(paletteDistance[a][b]).toBeGreaterThanOrEqual(distinct);
});

test('a new label looks unlike the others', () => {
  const taken: Color[] = [];
  for (let i = 0; i < 8; ++i) {
    const next = farthestColor(taken);
    for (const color of taken) expect(distance(color, next)).toBeGreaterThan(0.06);
    taken.push(next);
  }
});

test('the heat map becomes lighter with the probability', () => {
  const lightness = Array.from({ length: 101 }, (_, i) => appearances(heat(i / 100))[0][0]);
  for (let i = 1; i < lightness.length; ++i) expect(lightness[i]).toBeGreaterThan(lightness[i - 1]);
  expect(heat(-1)).toEqual(heat(0));
  expect(heat(2)).toEqual(heat(1));
});
