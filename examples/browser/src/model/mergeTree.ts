// SPDX-License-Identifier: MIT

import type { Hierarchy } from '../worker/EngineModule';

/** What of a hierarchy tells the segment of each fragment. */
export type MergeTree = Pick<Hierarchy, 'merges' | 'fragments' | 'fewest'>;

/**
 * The segment of each fragment when merging stops at a number of segments, which are numbered from 0 in the order of
 * their lowest fragments. Levels are nested.
 */
export function segmentOfFragments({ merges, fragments, fewest }: MergeTree, segments: number): Uint32Array {
  if (!(segments >= fewest && segments <= fragments))
    throw new RangeError(`The number of parts must lie between ${fewest} and ${fragments}.`);
  const root = Uint32Array.from({ length: 2 * fragments - segments }, (_, region) => region);
  for (let region = root.length - 1; region >= fragments; --region) {
    const merge = 2 * (region - fragments);
    root[merges[merge]] = root[merges[merge + 1]] = root[region];
  }
  const segmentOfRoot = new Map<number, number>();
  return Uint32Array.from({ length: fragments }, (_, fragment) => {
    const region = root[fragment];
    if (!segmentOfRoot.has(region)) segmentOfRoot.set(region, segmentOfRoot.size);
    return segmentOfRoot.get(region)!;
  });
}

/** The segment of each face. */
export function segmentsAtLevel(
  hierarchy: MergeTree & Pick<Hierarchy, 'fragmentOfFace'>,
  segments: number,
): Uint32Array {
  const segment = segmentOfFragments(hierarchy, segments);
  return hierarchy.fragmentOfFace.map((fragment) => segment[fragment]);
}
