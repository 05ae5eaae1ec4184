// SPDX-License-Identifier: MIT

/** A segment as it is listed. */
export interface Segment {
  label: number;
  faces: number;
  /** As a part of the whole. */
  area: number;
}

/** Counts and areas of the segments, in the order of their labels. */
export function segmentsOf(labels: Uint32Array, faceAreas: Float64Array): Segment[] {
  const segments = new Map<number, Segment>();
  let wholeArea = 0;
  labels.forEach((label, face) => {
    let segment = segments.get(label);
    if (!segment) segments.set(label, (segment = { label, faces: 0, area: 0 }));
    ++segment.faces;
    segment.area += faceAreas[face];
    wholeArea += faceAreas[face];
  });
  const sorted = [...segments.values()].sort((a, b) => a.label - b.label);
  for (const segment of sorted) segment.area = wholeArea > 0 ? segment.area / wholeArea : 0;
  return sorted;
}

/**
 * The neighbours of each segment, as indices into the segments.
 *
 * @param adjacentFaces pairs of faces that share an edge
 */
export function neighboursOf(
  segments: readonly Segment[],
  labels: Uint32Array,
  adjacentFaces: Uint32Array,
): number[][] {
  const index = new Map(segments.map(({ label }, i) => [label, i]));
  const neighbours = segments.map(() => new Set<number>());
  for (let i = 0; i < adjacentFaces.length; i += 2) {
    const [a, b] = [labels[adjacentFaces[i]], labels[adjacentFaces[i + 1]]];
    if (a === b) continue;
    neighbours[index.get(a)!].add(index.get(b)!);
    neighbours[index.get(b)!].add(index.get(a)!);
  }
  return neighbours.map((set) => [...set]);
}
