// SPDX-License-Identifier: MIT

import type { Color } from './colorVision';

/** The colour map viridis (van der Walt and Smith 2015) at eight equidistant values. */
const viridis: readonly Color[] = [
  [68, 1, 84],
  [70, 50, 126],
  [54, 92, 141],
  [39, 127, 142],
  [31, 161, 135],
  [74, 193, 109],
  [160, 218, 57],
  [253, 231, 37],
];

/** The colour of a number in [0, 1]. */
export function heat(value: number): Color {
  const place = Math.min(Math.max(value, 0), 1) * (viridis.length - 1);
  const below = Math.min(Math.floor(place), viridis.length - 2);
  const mix = (i: 0 | 1 | 2) =>
    Math.round(viridis[below][i] + (place - below) * (viridis[below + 1][i] - viridis[below][i]));
  return [mix(0), mix(1), mix(2)];
}

/** The colour map as a CSS gradient, from 0 to 1. */
export const heatGradient = `linear-gradient(to right, ${viridis.map((color) => `rgb(${color.join(' ')})`).join(', ')})`;
