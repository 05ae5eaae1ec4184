// SPDX-License-Identifier: MIT

// The engine for programs that run in Node.
import { createRequire } from 'node:module';

/** @param {string} url of engine.mjs */
export async function loadInNode(url) {
  // Emscripten 3.1 looks for these even in a module of ECMAScript.
  globalThis.require ??= createRequire(import.meta.url);
  globalThis.__dirname ??= '.';
  return (await import(url)).default();
}
