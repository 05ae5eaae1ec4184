import type { Color } from '../model/colorVision';
import type { MeshData } from '../worker/EngineModule';
import { polygonsOf } from './polygons';

/** A binary PLY file with a colour and a segment for each face, as the tool `segment_mesh` writes it. */
export function plyFile(
  mesh: MeshData,
  segmentOfFace: Uint32Array,
  colorOfSegment: ReadonlyMap<number, Color>,
): Uint8Array {
  const polygons = polygonsOf(mesh);
  const corners = polygons.reduce((sum, polygon) => sum + polygon.length, 0);
  const hasSmallDegrees = polygons.every((polygon) => polygon.length < 256);
  const header = new TextEncoder().encode(headerOf(mesh, hasSmallDegrees));
  const bytes = new Uint8Array(
    header.length + 8 * mesh.positions.length + 4 * corners + (hasSmallDegrees ? 8 : 11) * polygons.length,
  );
  bytes.set(header);
  const data = new DataView(bytes.buffer);
  let at = header.length;
  const byte = (value: number) => data.setUint8(at++, value);
  const word = (value: number) => data.setUint32((at += 4) - 4, value, true);

  for (const coordinate of mesh.positions) data.setFloat64((at += 8) - 8, coordinate, true);
  polygons.forEach((polygon, face) => {
    if (hasSmallDegrees) byte(polygon.length);
    else word(polygon.length);
    polygon.forEach(word);
    const segment = segmentOfFace[face];
    colorOfSegment.get(segment)!.forEach(byte);
    word(segment);
  });
  return bytes;
}

function headerOf({ positions, faces }: MeshData, hasSmallDegrees: boolean): string {
  return `ply
format binary_little_endian 1.0
element vertex ${positions.length / 3}
property double x
property double y
property double z
element face ${faces}
property list ${hasSmallDegrees ? 'uchar' : 'uint'} int vertex_indices
property uchar red
property uchar green
property uchar blue
property uint segment
end_header
`;
}
