// SPDX-License-Identifier: MIT

/** The interface of the package's headers as WebAssembly, see `engine/`. All calls are synchronous. */
export interface EngineModule {
  /** The first bytes tell the format, or the name: .off, .ply, .obj, .stl, .msh, .mesh, .meshb, .vtp, .3mf. */
  readMesh(bytes: Uint8Array, fileName: string): Engine | Failure;
  /** Names of the models that can be generated. */
  models(): string[];
  generateMesh(model: string): Engine | Failure;
}

/** A mesh, the walk on its faces and the seeds. */
export interface Engine {
  mesh(): MeshData | Failure;
  /** The walls in place of those before, which stay if that fails. The walk heeds them once it is prepared. */
  setWalls(walls: Walls): Curves | Failure;
  /** Computes everything that does not depend on seeds, which are kept. */
  prepare(convexWeight: number, sigma: number): void | Failure;
  addSeed(face: number, label: number): void | Failure;
  removeSeed(face: number): void | Failure;
  clearSeeds(): void | Failure;
  /** The label of each face; components without a seed get the next unused labels. */
  segment(): Uint32Array | Failure;
  /** While all seeds have one label: prepares for the first seed of another one, which takes long otherwise. */
  anticipate(): void | Failure;
  /** The probability of a label for each face. */
  probabilities(label: number): Float32Array | Failure;
  /** @param progress told the part done, in [0, 1]; false cancels */
  hierarchy(method: AutomaticMethod, progress: (fraction: number) => boolean): Hierarchy | Failure;
  /**
   * `FoundSurfaces` as JSON.
   *
   * @param regularity null leaves surfaces as they were fitted
   */
  surfaces(labels: Uint32Array, regularity: Regularity | null): string | Failure;
  smoothBoundaries(labels: Uint32Array): Curves | Failure;
  /**
   * A file of the mesh with its segments, or of the labels alone, as the tool segment_mesh writes it.
   *
   * @param name names the file in errors
   * @param materials name of the file with the materials of an OBJ file
   * @param colors four numbers for each label: itself, red, green and blue
   */
  file(
    format: FileFormat,
    name: string,
    materials: string,
    labels: Uint32Array,
    colors: Uint32Array,
  ): Uint8Array | Failure;
  /** Frees the memory. */
  delete(): void;
}

export interface Failure {
  error: string;
}

/** Formats of meshes by the names of `--output-format`, materials of OBJ files, and formats of labels. */
export type FileFormat =
  | ('ply' | 'obj' | 'off' | 'stl' | 'stl-text' | 'glb' | '3mf' | 'msh' | 'mesh' | 'vtp')
  | 'mtl'
  | ('seg' | 'csv' | 'npz');

export interface MeshData {
  /** Three coordinates a vertex, from a corner of the mesh. */
  positions: Float32Array;
  /** Three vertices a triangle; the triangles of a polygon follow each other. */
  triangles: Uint32Array;
  faceOfTriangle: Uint32Array;
  faces: number;
  faceAreas: Float64Array;
  /** What was repaired, one sentence each. */
  notes: string[];
}

export type HierarchyKind = 'graphical' | 'engineering';

/** Edges that nothing crosses: neither walks nor merges nor surfaces. */
export interface Walls {
  /** Edges are walls over which the surface turns by more than this, in degrees; null for none. */
  angle: number | null;
  /** Two vertices a line, by their numbers in the file of the mesh. */
  file: { name: string; text: string } | null;
}

/** How natural shapes are segmented, by the names of the options of the tool segment_mesh. */
export interface Policies {
  difference: 'concavity' | 'dihedral' | 'curvature';
  /** Of the balls in which curvatures are measured, in mean edge lengths. */
  radius: number;
  seeding: 'farthest' | 'particles' | 'coarse';
  mergeCost: 'learned' | 'size' | 'boundary';
}

/** What an automatic segmentation is made by. Machine parts heed no policies. */
export interface AutomaticMethod extends Policies {
  kind: HierarchyKind;
}

/** All levels of an automatic segmentation, from fragments to connected components. */
export interface Hierarchy {
  fragmentOfFace: Uint32Array;
  /** Two regions a merge; merge i makes region `fragments` + i. */
  merges: Uint32Array;
  costs: Float64Array;
  fragments: number;
  /** The number of connected components. */
  fewest: number;
  /** The number of segments that the shape suggests. */
  suggested: number;
  /** The numbers of segments that people may prefer, that one among them, rising. */
  levels: ArrayLike<number>;
}

export type SurfaceType = 'plane' | 'cylinder' | 'cone' | 'sphere' | 'torus' | 'free form';
type Vector = [number, number, number];

/**
 * What a segment lies on, by the names of the report of the tool segment_mesh: angles are in degrees, all else is in the
 * mesh's unit. Each type has some of the numbers, a free form none.
 */
export interface Surface {
  type: SurfaceType;
  point?: Vector;
  centre?: Vector;
  apex?: Vector;
  normal?: Vector;
  axis?: Vector;
  /** Of a torus, the circle that its tube is centred on. */
  radius?: number;
  tube_radius?: number;
  half_angle?: number;
  /** Root mean square distance of the vertices. */
  residual?: number;
  /** Standard errors; null where the vertices do not tell a number. */
  errors?: Partial<
    Record<'point' | 'centre' | 'apex' | 'normal' | 'axis' | 'radius' | 'tube_radius' | 'half_angle', number | null>
  >;
}

/** What surfaces may be off by to be made regular; null for what their standard errors and rounding excuse. */
export interface Regularity {
  /** In the mesh's unit. */
  length: number | null;
  /** In degrees. */
  angle: number | null;
}

/** What two surfaces have been made to have in common. */
export interface SurfaceSnap {
  regularity: string;
  labels: [number, number];
  /** That they had before, in degrees or in the mesh's unit. */
  difference: number;
}

export interface FoundSurfaces {
  /** By label. */
  surfaces: Surface[];
  regular: SurfaceSnap[];
}

/** Curves, with coordinates as those of the mesh. Curve i has the points `starts[i]` .. `starts[i + 1]` - 1; closed ones repeat their first point. */
export interface Curves {
  points: Float32Array;
  starts: Uint32Array;
}
