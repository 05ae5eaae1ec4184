// SPDX-License-Identifier: MIT

/**
 * Pairs of different faces that share an edge, each pair once for each edge it shares.
 *
 * Half-edges wait in an open-addressing hash table for those that run the other way (or, on non-orientable input, the
 * same way). Time and memory are linear in the number of triangles.
 */
export function adjacentFaces(triangles: Uint32Array, faceOfTriangle: Uint32Array): Uint32Array {
  const corners = triangles.length;
  const waiting = emptyTable(corners);
  const mask = waiting.length - 1;
  const end = (corner: number) => triangles[corner % 3 === 2 ? corner - 2 : corner + 1];
  const pairs: number[] = [];
  for (let corner = 0; corner < corners; ++corner) {
    const low = Math.min(triangles[corner], end(corner));
    const high = Math.max(triangles[corner], end(corner));
    let slot = (Math.imul(low, 0x9e3779b1) ^ Math.imul(high, 0x85ebca6b)) & mask;
    for (; waiting[slot] !== none; slot = (slot + 1) & mask) {
      const other = waiting[slot];
      if (Math.min(triangles[other], end(other)) !== low || Math.max(triangles[other], end(other)) !== high) continue;
      const [a, b] = [faceOfTriangle[Math.floor(other / 3)], faceOfTriangle[Math.floor(corner / 3)]];
      if (a !== b) pairs.push(a, b);
      break;
    }
    if (waiting[slot] === none) waiting[slot] = corner;
  }
  return Uint32Array.from(pairs);
}

const none = 0xffffffff;

/** A hash table of a power of two of slots, at most half of which will be taken. */
function emptyTable(entries: number): Uint32Array {
  return new Uint32Array(2 ** Math.ceil(Math.log2(2 * entries + 2))).fill(none);
}
