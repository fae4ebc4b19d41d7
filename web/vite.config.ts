import { readFileSync } from 'node:fs';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { defineConfig } from 'vitest/config';

/** What the page contains of others, all under the MIT licence, which wants to be told. */
const OTHERS = ['three', 'three-mesh-bvh', 'camera-controls', 'uplot'];

// The page is one file, `walk.html`: no request goes anywhere else, and it opens from a disk as well.
export default defineConfig({
  base: './',
  plugins: [viteSingleFile({ removeViteModuleLoader: true }), finished('walk.html')],
  build: {
    target: 'es2022',
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    chunkSizeWarningLimit: 4000,
    modulePreload: false,
    emptyOutDir: false,
  },
  worker: { format: 'iife' },
  test: { include: ['src/**/*.test.ts'] },
});

/** Gives the page its name, and the licences of what is in it. */
function finished(fileName: string) {
  return {
    name: 'isolux-finished',
    enforce: 'post' as const,
    generateBundle(_options: unknown, bundle: Record<string, { fileName: string; source?: string | Uint8Array }>) {
      const page = bundle['index.html'];
      if (!page) return;
      page.fileName = fileName;
      page.source = String(page.source).replace(/<!doctype html>\n?/i, (start) => `${start}<!--\n${licences()}\n-->\n`);
    },
  };
}

function licences(): string {
  const text = (name: string): string => readFileSync(new URL(`node_modules/${name}/LICENSE`, import.meta.url), 'utf8').trim();
  return OTHERS.map((name) => `This page contains ${name}:\n\n${text(name)}`).join('\n\n').replaceAll('--', '- -');
}
