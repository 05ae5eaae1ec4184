// SPDX-License-Identifier: MIT

import type { Surface } from '../worker/EngineModule';
import { surfaceTypes } from './surfaceNumbers';

/** What the table of surfaces is sorted by. */
export type SurfaceColumn = 'label' | 'type' | 'size' | 'area' | 'faces';

export interface SurfaceOrder {
  column: SurfaceColumn;
  isDescending: boolean;
}

/** A segment with its surface; its area as a part of the whole. */
export interface SurfaceSegment {
  label: number;
  surface: Surface;
  area: number;
  faces: number;
}

/**
 * Segments in an order. By size, those with a radius come first, then cones by their angles, then those with neither,
 * whichever way they are sorted. What is equal stays in the order of the labels.
 */
export function sortedSurfaces<Row extends SurfaceSegment>(
  rows: readonly Row[],
  { column, isDescending }: SurfaceOrder,
): Row[] {
  const sign = isDescending ? -1 : 1;
  return [...rows].sort((a, b) => {
    const group = column === 'size' ? sizeGroup(a.surface) - sizeGroup(b.surface) : 0;
    return group || sign * (valueOf(a, column) - valueOf(b, column)) || a.label - b.label;
  });
}

function sizeGroup({ radius, half_angle }: Surface): number {
  if (radius !== undefined) return 0;
  return half_angle !== undefined ? 1 : 2;
}

function valueOf({ label, surface, area, faces }: SurfaceSegment, column: SurfaceColumn): number {
  const values: Record<SurfaceColumn, number> = {
    label,
    type: surfaceTypes.indexOf(surface.type),
    size: surface.radius ?? surface.half_angle ?? 0,
    area,
    faces,
  };
  return values[column];
}
