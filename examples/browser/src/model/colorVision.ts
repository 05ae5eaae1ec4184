// SPDX-License-Identifier: MIT

/** Red, green and blue, each from 0 to 255. */
export type Color = readonly [number, number, number];
type Triple = readonly [number, number, number];
type Matrix = readonly [Triple, Triple, Triple];

export function hexadecimal(color: Color): string {
  return '#' + color.map((channel) => channel.toString(16).padStart(2, '0')).join('');
}

/** @param text as `<input type="color">` gives it: #rrggbb */
export function colorOf(text: string): Color {
  const channel = (i: number) => parseInt(text.slice(2 * i + 1, 2 * i + 3), 16);
  return [channel(0), channel(1), channel(2)];
}

function product(matrix: Matrix, vector: Triple): Triple {
  const row = (r: Triple) => r[0] * vector[0] + r[1] * vector[1] + r[2] * vector[2];
  return [row(matrix[0]), row(matrix[1]), row(matrix[2])];
}

/** Red, green and blue as amounts of light in [0, 1]. */
function light(color: Color): Triple {
  const linear = (channel: number) => {
    const c = channel / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  };
  return [linear(color[0]), linear(color[1]), linear(color[2])];
}

const lightToCones: Matrix = [
  [0.4122214708, 0.5363325363, 0.0514459929],
  [0.2119034982, 0.6806995451, 0.1073969566],
  [0.0883024619, 0.2817188376, 0.6299787005],
];
const conesToLab: Matrix = [
  [0.2104542553, 0.793617785, -0.0040720468],
  [1.9779984951, -2.428592205, 0.4505937099],
  [0.0259040371, 0.7827717662, -0.808675766],
];

/** A point of the colour space OKLab (Ottosson 2020), in which distances are about as large as they look. */
function oklab(amounts: Triple): Triple {
  const cones = product(lightToCones, amounts);
  return product(conesToLab, [Math.cbrt(cones[0]), Math.cbrt(cones[1]), Math.cbrt(cones[2])]);
}

/** People with all cones, and without the ones for red, green or blue (Machado, Oliveira and Fernandes 2009). */
const visions: readonly Matrix[] = [
  [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
];

/** A colour as people with each of the visions see it. */
export function appearances(color: Color): Triple[] {
  const clamp = (amount: number) => Math.min(Math.max(amount, 0), 1);
  return visions.map((vision) => {
    const seen = product(vision, light(color));
    return oklab([clamp(seen[0]), clamp(seen[1]), clamp(seen[2])]);
  });
}

/**
 * How far apart two colours, given by their appearances, look to those who can tell them apart least. Black and white
 * are at a distance of 1, and 0.02 can just be seen.
 */
export function apparentDistance(a: readonly Triple[], b: readonly Triple[]): number {
  return Math.min(...a.map((seen, i) => Math.hypot(seen[0] - b[i][0], seen[1] - b[i][1], seen[2] - b[i][2])));
}
