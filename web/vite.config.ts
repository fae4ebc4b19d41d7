import { defineConfig } from 'vitest/config';
import { viteSingleFile } from 'vite-plugin-singlefile';

// The page is one file, `walk.html`: no request goes anywhere else, and it opens from a disk as well.
export default defineConfig({
  base: './',
  plugins: [viteSingleFile({ removeViteModuleLoader: true }), named('walk.html')],
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

/** Gives the page its name. */
function named(fileName: string) {
  return {
    name: 'isolux-name',
    enforce: 'post' as const,
    generateBundle(_options: unknown, bundle: Record<string, { fileName: string }>) {
      const page = bundle['index.html'];
      if (page) page.fileName = fileName;
    },
  };
}
