// SPDX-License-Identifier: MIT

import type { Seeds } from '../model/seeds';
import type {
  AutomaticMethod,
  Curves,
  FileFormat,
  FoundSurfaces,
  Hierarchy,
  MeshData,
  Policies,
  Regularity,
  Walls,
} from './EngineModule';

/** Where a mesh comes from. */
export type MeshSource = { fileName: string; bytes: Uint8Array } | { model: string };

/** What makes faces different from their neighbours. */
export interface WalkParameters {
  convexWeight: number;
  sigma: number;
  walls: Walls;
}

export const noWalls: Walls = { angle: null, file: null };

/** Those of the tool segment_mesh, which agree best with people. */
export const defaultParameters: WalkParameters = {
  convexWeight: 0.02,
  sigma: 1,
  walls: noWalls,
};

/** Likewise, without seeds. */
export const defaultPolicies: Policies = {
  difference: 'concavity',
  radius: 3,
  seeding: 'farthest',
  mergeCost: 'learned',
};

export interface LoadedMesh extends MeshData {
  /** Pairs of faces that share an edge. */
  adjacentFaces: Uint32Array;
  /** A curve each. */
  walls: Curves;
}

export interface TimedHierarchy extends Hierarchy {
  milliseconds: number;
}

/** What the page can ask of the worker. */
export interface Calls {
  models(): string[];
  /** Reads and prepares a mesh. The former one stays if that fails. */
  load(source: MeshSource, parameters: WalkParameters): LoadedMesh;
  /** Reads a mesh that another worker has read, and prepares the walk if there are parameters for it. */
  follow(source: MeshSource, parameters: WalkParameters | null): void;
  /** Gives the walls, a curve each. Walls that cannot be leave all as it was. */
  prepare(parameters: WalkParameters): Curves;
  /** The label of each face; null without seeds. */
  segment(seeds: Seeds): Uint32Array | null;
  /** The probability of a label for each face. */
  probabilities(seeds: Seeds, label: number): Float32Array;
  hierarchy(method: AutomaticMethod, walls: Walls): TimedHierarchy;
  surfaces(labels: Uint32Array, regularity: Regularity | null, walls: Walls): FoundSurfaces;
  smoothBoundaries(labels: Uint32Array, walls: Walls): Curves;
  file(format: FileFormat, name: string, materials: string, labels: Uint32Array, colors: Uint32Array): Uint8Array;
}

export type Request = {
  [Name in keyof Calls]: { id: number; name: Name; values: Parameters<Calls[Name]> };
}[keyof Calls];

/** `fatal` says that the worker can do no more. */
export type Reply =
  { id: number; result: unknown } | { id: number; error: string; fatal: boolean } | { id: number; progress: number };
