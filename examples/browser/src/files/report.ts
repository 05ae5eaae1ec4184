// SPDX-License-Identifier: MIT

import type { ShownSegment } from '../model/Session';
import type { LoadedMesh } from '../worker/calls';
import type { FoundSurfaces } from '../worker/EngineModule';

/** What is known of the segments as JSON, by the names of the report of the tool segment_mesh. */
export function reportFile(
  mesh: string,
  { positions, faces, notes }: LoadedMesh,
  segments: readonly ShownSegment[],
  found: FoundSurfaces | null,
): string {
  const report = {
    mesh,
    vertices: positions.length / 3,
    faces,
    repairs: notes,
    segments: segments.map(({ label, faces, area, color }) => ({
      label,
      faces,
      area_share: area,
      color,
      ...(found && { surface: found.surfaces[label] }),
    })),
    ...(found && found.regular.length > 0 && { regular: found.regular }),
  };
  return JSON.stringify(report, null, 2) + '\n';
}
