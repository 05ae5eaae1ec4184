// SPDX-License-Identifier: MIT

import { apparentDistance, appearances, type Color } from './colorVision';

/** Eight hues that suit people with a colour-vision deficiency (Okabe and Ito 2008, grey in the place of black). */
const hues: readonly Color[] = [
  [0, 114, 178],
  [230, 159, 0],
  [0, 158, 115],
  [204, 121, 167],
  [86, 180, 233],
  [213, 94, 0],
  [240, 228, 66],
  [153, 153, 153],
];

/** A lighter (odd) or darker (even) shade of a hue. */
function shaded(hue: Color, shade: number): Color {
  const end = shade % 2 === 1 ? 255 : 0;
  const share = 1 - 0.6 ** Math.floor((shade + 1) / 2);
  const mix = (channel: number) => Math.round(channel + share * (end - channel));
  return [mix(hue[0]), mix(hue[1]), mix(hue[2])];
}

const shades = 7; // more are too close to white or black

/** A sequence of distinct colours. */
export const palette: readonly Color[] = Array.from({ length: shades * hues.length }, (_, i) =>
  shaded(hues[i % hues.length], Math.floor(i / hues.length)),
);

const paletteAppearances = palette.map(appearances);

/** How far apart two colours of the palette look. */
export const paletteDistance: readonly (readonly number[])[] = paletteAppearances.map((a) =>
  paletteAppearances.map((b) => apparentDistance(a, b)),
);

/** The colour of the palette that looks least like any of some colours; where they have all of it, the least used one. */
export function farthestColor(taken: readonly Color[]): Color {
  const key = ([red, green, blue]: Color) => (red << 16) | (green << 8) | blue;
  const uses = new Map<number, number>();
  for (const color of taken) uses.set(key(color), (uses.get(key(color)) ?? 0) + 1);
  const usesOf = (color: Color) => uses.get(key(color)) ?? 0;
  if (palette.every((color) => usesOf(color) > 0))
    return palette.reduce((best, color) => (usesOf(color) < usesOf(best) ? color : best));
  const others = taken.map(appearances);
  const distances = paletteAppearances.map((color) =>
    Math.min(distinct, ...others.map((other) => apparentDistance(color, other))),
  );
  return palette[distances.indexOf(Math.max(...distances))];
}

/** Where neighbouring segments are given colours at least so far apart. */
export const distinct = 0.1;
