// SPDX-License-Identifier: MIT

import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import type { Curves } from '../worker/EngineModule';

/** Curves of one colour on the surface. */
export class SurfaceCurves {
  readonly object: LineSegments2;

  constructor(color: number) {
    this.object = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ color, linewidth: 2.2 }));
    this.object.visible = false;
    this.object.frustumCulled = false;
  }

  /** @param curves null shows none */
  show(curves: Curves | null): void {
    this.object.visible = curves !== null && curves.points.length > 0;
    if (!curves || !this.object.visible) return;
    this.object.geometry.dispose();
    this.object.geometry = new LineSegmentsGeometry().setPositions(segmentsOf(curves));
  }
}

/** The straight pieces of the curves, two points each. */
export function segmentsOf({ points, starts }: Curves): Float32Array {
  const curves = starts.length - 1;
  const pieces = new Float32Array(2 * (points.length - 3 * curves));
  let end = 0;
  for (let curve = 0; curve < curves; ++curve)
    for (let i = starts[curve]; i + 1 < starts[curve + 1]; ++i) {
      pieces.set(points.subarray(3 * i, 3 * i + 6), end);
      end += 6;
    }
  return pieces;
}
