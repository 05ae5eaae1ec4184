// SPDX-License-Identifier: MIT

/**
 * The bytes of a file, unpacked if it is packed by gzip.
 *
 * @throws Error if the gzip file is broken or cut off
 */
export async function unpacked(file: Blob): Promise<Uint8Array> {
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  try {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new Error('The gzip file is broken or cut off.');
  }
}
