// SPDX-License-Identifier: MIT

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Mesh,
  MeshLambertMaterial,
  type Ray,
  Sphere,
  type Triangle,
  Vector3,
} from 'three';
import { CENTER, INTERSECTED, MeshBVH, NOT_INTERSECTED } from 'three-mesh-bvh';
import type { Color } from '../model/colorVision';
import type { MeshData } from '../worker/EngineModule';

/** Where a ray meets the mesh. */
export interface Hit {
  face: number;
  point: Vector3;
}

/** How a segment is placed: moved by an offset, or hidden. */
export type Placement = Vector3 | 'hidden';

/**
 * The faces of a mesh in their colours. Triangles share no vertices, so that each has its own colour and place: to show
 * other segments only the colours are written, to hide or move them only the points.
 */
export class SegmentedMesh {
  readonly object: Mesh;
  /** Whether all faces are shown in place. */
  isPlain = true;
  private readonly corners: Float32Array;
  private readonly placed: BufferAttribute;
  private readonly colors: BufferAttribute;
  /** The colours as one number a corner. */
  private readonly packedColors: Uint32Array;
  private readonly firstTriangle: Uint32Array;
  private readonly bvh: MeshBVH;
  private bvhIsCurrent = true;

  constructor(private readonly mesh: MeshData) {
    this.corners = cornersOf(mesh);
    this.placed = new BufferAttribute(this.corners.slice(), 3);
    this.packedColors = new Uint32Array(mesh.triangles.length);
    this.colors = new BufferAttribute(new Uint8Array(this.packedColors.buffer), 4, true);
    this.firstTriangle = firstTriangles(mesh);

    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.placed);
    geometry.setAttribute('color', this.colors);
    this.bvh = new MeshBVH(geometry, { indirect: true, strategy: CENTER });
    const material = new MeshLambertMaterial({
      vertexColors: true,
      flatShading: true,
      side: DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.object = new Mesh(geometry, material);
    this.object.frustumCulled = false;
  }

  dispose(): void {
    this.object.geometry.dispose();
    (this.object.material as MeshLambertMaterial).dispose();
  }

  /** @param colorOfFace as `packed()` gives it */
  paint(colorOfFace: (face: number) => number): void {
    const { faceOfTriangle } = this.mesh;
    for (let triangle = 0; triangle < faceOfTriangle.length; ++triangle)
      this.packedColors.fill(colorOfFace(faceOfTriangle[triangle]), 3 * triangle, 3 * triangle + 3);
    this.colors.needsUpdate = true;
  }

  /** The red, green and blue of a face. */
  colorOf(face: number): number[] {
    const corner = 3 * this.firstTriangle[face];
    return [...(this.colors.array as Uint8Array).subarray(4 * corner, 4 * corner + 3)];
  }

  /** Hides faces, by making points of their triangles, or moves them. */
  place(placementOfFace: (face: number) => Placement): void {
    const { faceOfTriangle } = this.mesh;
    const points = this.placed.array;
    for (let triangle = 0; triangle < faceOfTriangle.length; ++triangle) {
      const placement = placementOfFace(faceOfTriangle[triangle]);
      for (let i = 9 * triangle; i < 9 * triangle + 9; ++i) {
        const axis = i % 3;
        if (placement === 'hidden') points[i] = this.corners[9 * triangle + axis];
        else points[i] = this.corners[i] + placement.getComponent(axis);
      }
    }
    this.placed.needsUpdate = true;
    this.bvhIsCurrent = false;
  }

  /** A sphere around the mesh as it is placed. */
  bounds(): Sphere {
    this.object.geometry.computeBoundingSphere();
    return this.object.geometry.boundingSphere!;
  }

  /** A sphere around some of the faces as they are placed, and the sum of their normals by area: 0 for what is closed. */
  boundsOf(isPart: (face: number) => boolean): { sphere: Sphere; normal: Vector3 } {
    const { faceOfTriangle } = this.mesh;
    const box = new Box3();
    const normal = new Vector3();
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    faceOfTriangle.forEach((face, triangle) => {
      if (!isPart(face)) return;
      [a, b, c].forEach((corner, i) => box.expandByPoint(corner.fromBufferAttribute(this.placed, 3 * triangle + i)));
      normal.add(b.sub(a).cross(c.sub(a)));
    });
    const sphere = box.getBoundingSphere(new Sphere());
    if (normal.length() < 1e-3 * sphere.radius ** 2) normal.set(0, 0, 0);
    return { sphere, normal };
  }

  /** The first face that a ray meets. */
  hit(ray: Ray): Hit | null {
    const hit = this.currentBvh().raycastFirst(ray, DoubleSide);
    return hit && hit.faceIndex != null ? { face: this.mesh.faceOfTriangle[hit.faceIndex], point: hit.point } : null;
  }

  /** The faces around a hit that lie on the same side as seen from the ray. */
  facesAround({ face, point }: Hit, radius: number, ray: Ray): number[] {
    const faces = new Set([face]);
    const sphere = new Sphere(point, radius);
    const center = new Vector3();
    const normal = new Vector3();
    this.currentBvh().shapecast({
      intersectsBounds: (box) => (sphere.intersectsBox(box) ? INTERSECTED : NOT_INTERSECTED),
      intersectsTriangle: (triangle: Triangle, index: number) => {
        triangle.getMidpoint(center);
        triangle.getNormal(normal);
        if (sphere.containsPoint(center) && normal.dot(ray.direction) < 0) faces.add(this.mesh.faceOfTriangle[index]);
        return false;
      },
    });
    return [...faces];
  }

  /** The centre of a face where it is shown, null if it is hidden. */
  center(face: number): Vector3 | null {
    const { faceOfTriangle } = this.mesh;
    const sum = new Vector3();
    let triangle = this.firstTriangle[face];
    const first = triangle;
    const corner = new Vector3();
    for (; faceOfTriangle[triangle] === face; ++triangle)
      for (let i = 0; i < 3; ++i) sum.add(corner.fromBufferAttribute(this.placed, 3 * triangle + i));
    const isHidden = corner
      .fromBufferAttribute(this.placed, 3 * first)
      .equals(new Vector3().fromBufferAttribute(this.placed, 3 * first + 1));
    return isHidden ? null : sum.divideScalar(3 * (triangle - first));
  }

  private currentBvh(): MeshBVH {
    if (!this.bvhIsCurrent) this.bvh.refit();
    this.bvhIsCurrent = true;
    return this.bvh;
  }
}

/** A colour as one number, as `paint()` takes it. */
export function packed([red, green, blue]: Color): number {
  return (red | (green << 8) | (blue << 16) | (255 << 24)) >>> 0;
}

/** The corners of the triangles, three coordinates each. */
function cornersOf({ positions, triangles }: MeshData): Float32Array {
  const corners = new Float32Array(3 * triangles.length);
  for (let i = 0; i < triangles.length; ++i)
    for (let axis = 0; axis < 3; ++axis) corners[3 * i + axis] = positions[3 * triangles[i] + axis];
  return corners;
}

function firstTriangles({ faceOfTriangle, faces }: MeshData): Uint32Array {
  const first = new Uint32Array(faces);
  for (let triangle = faceOfTriangle.length - 1; triangle >= 0; --triangle) first[faceOfTriangle[triangle]] = triangle;
  return first;
}
