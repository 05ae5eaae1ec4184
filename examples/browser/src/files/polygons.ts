import type { MeshData } from '../worker/EngineModule';

/** The corners of the faces of a mesh, whose polygons come as fans of triangles around their first corners. */
export function polygonsOf({ triangles, faceOfTriangle, faces }: MeshData): number[][] {
  const polygons: number[][] = Array.from({ length: faces }, () => []);
  faceOfTriangle.forEach((face, triangle) => {
    const corners = polygons[face];
    if (corners.length === 0) corners.push(triangles[3 * triangle], triangles[3 * triangle + 1]);
    corners.push(triangles[3 * triangle + 2]);
  });
  return polygons;
}
