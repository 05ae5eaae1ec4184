/** The segment of each face, a line each, as the Princeton Segmentation Benchmark has it. */
export function segFile(segmentOfFace: Uint32Array): string {
  return segmentOfFace.join('\n') + '\n';
}
