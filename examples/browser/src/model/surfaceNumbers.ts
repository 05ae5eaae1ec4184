// SPDX-License-Identifier: MIT

import type { Surface, SurfaceSnap, SurfaceType } from '../worker/EngineModule';

/** The types that a segment's surface can have, as they are listed. */
export const surfaceTypes: readonly SurfaceType[] = ['plane', 'cylinder', 'cone', 'sphere', 'torus', 'free form'];

/** No number is told with more significant digits, however small its error. */
const mostDigits = 7;

/** Without an error to go by. */
const usualDigits = 5;

/** What double precision leaves of differences between coordinates, and more. */
const rounding = 1e-9;

/** A number of a surface, and what it is called. */
export interface SurfaceNumber {
  name: string;
  value: string;
}

/**
 * A number to the second digit of its standard error, and the error.
 *
 * @param error null where the vertices do not tell the number; undefined if it has none
 */
export function measured(value: number, error: number | null | undefined, unit = ''): string {
  if (error === undefined) return rounded(value) + unit;
  if (error === null) return `${rounded(value)}${unit} ± ?`;
  const spread = error === 0 ? '0' : short(error);
  return `${rounded(value, error)} ± ${spread}${unit}`;
}

/** A number to as many digits as are of use. */
export function rounded(value: number, error = 0): string {
  const magnitude = Math.abs(value) > 0 ? Math.floor(Math.log10(Math.abs(value))) : 0;
  const most = (error > 0 ? mostDigits : usualDigits) - 1 - magnitude;
  const told = error > 0 ? Math.min(most, 1 - Math.floor(Math.log10(error))) : most;
  if (told > 12) return value.toExponential(Math.max(0, told - most + usualDigits - 1));
  const text = value.toFixed(Math.max(0, told));
  return Number(text) === 0 ? text.replace('-', '') : text;
}

/** The numbers that tell where a surface is and how large, with their standard errors. */
export function numbersOf(surface: Surface): SurfaceNumber[] {
  const { errors = {} } = surface;
  const numbers: SurfaceNumber[] = [];
  const length = (name: string, value: number | undefined, error: number | null | undefined) => {
    if (value !== undefined) numbers.push({ name, value: measured(value, error) });
  };
  length('radius', surface.radius, errors.radius);
  length('tube radius', surface.tube_radius, errors.tube_radius);
  if (surface.half_angle !== undefined)
    numbers.push({ name: 'half angle', value: measured(surface.half_angle, errors.half_angle, '°') });
  for (const name of ['normal', 'axis'] as const) {
    const direction = surface[name];
    if (direction) numbers.push({ name, value: `(${direction.map(cosine).join(', ')}) ${spread(errors[name], '°')}` });
  }
  for (const name of ['point', 'centre', 'apex'] as const) {
    const place = surface[name];
    if (place) numbers.push({ name, value: `(${coordinates(place, surface)}) ${spread(errors[name])}` });
  }
  length('residual', surface.residual, undefined);
  return numbers;
}

/** The numbers that tell how large a surface is, as short as a table needs them. */
export function sizeOf({ type, radius, tube_radius, half_angle }: Surface): string {
  if (type === 'torus') return `R ${short(radius!, 4)}, r ${short(tube_radius!, 4)}`;
  if (radius !== undefined) return `r ${short(radius, 4)}`;
  return half_angle === undefined ? '' : `${short(half_angle, 4)}°`;
}

/** A snap in words; differences of lengths are in the mesh's unit. */
export function snapText({ regularity, labels, difference }: SurfaceSnap): string {
  const isAngle = ['parallel', 'perpendicular', 'equal half angle'].includes(regularity);
  return `Parts ${labels[0] + 1} and ${labels[1] + 1}: ${regularity}, before off by ${short(difference)}${isAngle ? '°' : ''}`;
}

/** @param digits significant ones */
export function short(value: number, digits = 2): string {
  return String(Number(value.toPrecision(digits)));
}

function spread(error: number | null | undefined, unit = ''): string {
  return error === null || error === undefined ? '± ?' : `± ${short(error)}${unit}`;
}

/** Coordinates that are nothing beside the others and the radius are 0. */
function coordinates(place: readonly number[], { radius = 0 }: Surface): string {
  const size = Math.max(radius, ...place.map(Math.abs));
  return place.map((x) => (Math.abs(x) < rounding * size ? 0 : short(x, 6))).join(', ');
}

/** A coordinate of a unit vector. */
function cosine(value: number): string {
  const text = value.toFixed(4);
  return String(Number(text) === 0 ? 0 : Number(text));
}
