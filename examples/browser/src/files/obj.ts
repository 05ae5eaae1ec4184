import type { Color } from '../model/colorVision';
import type { MeshData } from '../worker/EngineModule';
import { polygonsOf } from './polygons';

/**
 * A Wavefront OBJ file with a group and a material `segment_<label>` for each segment, as the tool `segment_mesh` writes
 * it. Faces come segment by segment.
 *
 * @param materialLibrary name of the file with the materials
 */
export function objFile(mesh: MeshData, segmentOfFace: Uint32Array, materialLibrary: string): string {
  const lines = [`mtllib ${materialLibrary}`];
  for (let i = 0; i < mesh.positions.length; i += 3) lines.push(`v ${mesh.positions.subarray(i, i + 3).join(' ')}`);
  const polygons = polygonsOf(mesh);
  const faces = [...polygons.keys()].sort((a, b) => segmentOfFace[a] - segmentOfFace[b] || a - b);
  let segment: number | undefined;
  for (const face of faces) {
    if (segment !== segmentOfFace[face]) {
      segment = segmentOfFace[face];
      lines.push(`g segment_${segment}`, `usemtl segment_${segment}`);
    }
    lines.push(`f ${polygons[face].map((corner) => corner + 1).join(' ')}`);
  }
  return lines.join('\n') + '\n';
}

/** The materials of an OBJ file. */
export function materialsFile(colorOfSegment: ReadonlyMap<number, Color>): string {
  const share = (channel: number) => String(Number((channel / 255).toPrecision(6)));
  return [...colorOfSegment]
    .sort(([a], [b]) => a - b)
    .map(([segment, color]) => `newmtl segment_${segment}\nKd ${color.map(share).join(' ')}\n`)
    .join('');
}
