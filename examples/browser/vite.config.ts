// SPDX-License-Identifier: MIT

import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';

const repository = fileURLToPath(new URL('../..', import.meta.url));

/** Puts the scripts and styles into the page, so that one file is all and opens from disk. */
function oneFile(): Plugin {
  return {
    name: 'one-file',
    enforce: 'post',
    generateBundle(_, bundle) {
      for (const page of Object.values(bundle)) {
        if (page.type !== 'asset' || !page.fileName.endsWith('.html')) continue;
        let html = String(page.source);
        for (const [name, part] of Object.entries(bundle)) {
          if (part.type === 'chunk') {
            const code = part.code.replaceAll('</script', '<\\/script');
            html = html.replace(scriptTag(name), () => `<script type="module">${code}</script>`);
          } else if (name.endsWith('.css')) {
            html = html.replace(styleTag(name), () => `<style>${String(part.source)}</style>`);
          } else continue;
          delete bundle[name];
        }
        page.source = html;
      }
    },
  };
}

const scriptTag = (name: string) => new RegExp(`<script[^>]* src="[^"]*${name}"[^>]*></script>`);
const styleTag = (name: string) => new RegExp(`<link[^>]* href="[^"]*${name}"[^>]*>`);

export default defineConfig({
  base: './',
  resolve: { alias: { engine: `${repository}build/browser/engine.mjs` } },
  plugins: [oneFile()],
  build: {
    outDir: `${repository}build/browser/page`,
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: { polyfill: false },
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    chunkSizeWarningLimit: Number.MAX_SAFE_INTEGER,
  },
});
