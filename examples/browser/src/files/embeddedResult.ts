// SPDX-License-Identifier: MIT

import type { WalkParameters } from '../worker/calls';
import type { FoundSurfaces, Hierarchy, HierarchyKind, Policies, Regularity } from '../worker/EngineModule';

/** A result that `segment_mesh --html` has put into the page. */
export interface EmbeddedResult {
  name: string;
  /** A PLY file. */
  mesh: Uint8Array;
  segmentOfFace: Uint32Array;
  hierarchy: Hierarchy | null;
  segments: number;
  mode: 'seeds' | HierarchyKind;
  /** What a natural shape was segmented by. */
  policies?: Partial<Policies> | null;
  /** What seeds grew by. */
  parameters?: Pick<WalkParameters, 'convexWeight' | 'sigma'> | null;
  /** Two vertices a line. */
  walls?: string | null;
  /** Of a machine part, and what they were made regular by. */
  surfaces?: (FoundSurfaces & { regularity: Regularity | null }) | null;
  seeds: { face: number; label: number }[];
}

/** The result in its written form: arrays are in base64. */
type Written = Omit<EmbeddedResult, 'mesh' | 'segmentOfFace' | 'hierarchy'> & {
  mesh: string;
  labels: string;
  hierarchy:
    | ({ fragmentOfFace: string; merges: string; costs: string } & Pick<
        Hierarchy,
        'fragments' | 'fewest' | 'suggested' | 'levels'
      >)
    | null;
};

/** @param text the content of the page's element `embedded-result`; null if that says so */
export function readEmbeddedResult(text: string): EmbeddedResult | null {
  const written = JSON.parse(text) as Written | null;
  if (!written) return null;
  const { mesh, labels, hierarchy, ...rest } = written;
  return {
    ...rest,
    mesh: bytes(mesh),
    segmentOfFace: new Uint32Array(bytes(labels).buffer),
    hierarchy: hierarchy && {
      ...hierarchy,
      fragmentOfFace: new Uint32Array(bytes(hierarchy.fragmentOfFace).buffer),
      merges: new Uint32Array(bytes(hierarchy.merges).buffer),
      costs: new Float64Array(bytes(hierarchy.costs).buffer),
    },
  };
}

function bytes(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const result = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) result[i] = text.charCodeAt(i);
  return result;
}
