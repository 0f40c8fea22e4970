// How the page is built: static files with hashed names, nothing inline, so that a strict content policy holds.
import { loadEnv } from 'vite';
import { defineConfig } from 'vitest/config';
import { shortTemplates } from './short_templates';

// `npm run dev` serves the sources and passes everything else on to a running application, at FLEXRF_PANEL.
const environment = loadEnv('', '.', 'FLEXRF_');
const application = environment['FLEXRF_PANEL'] ?? 'http://127.0.0.1:8080';
// Tests try what the documentation shows; the build's copy of this folder lies elsewhere.
const documentation = environment['FLEXRF_DOCUMENTATION'] ?? decodeURIComponent(new URL('../../docs', import.meta.url).pathname);

export default defineConfig({
  base: '/',
  plugins: [shortTemplates()],
  build: {
    target: 'es2022',
    assetsDir: 'assets',
    assetsInlineLimit: 0, // data: addresses would need a wider content policy
    cssCodeSplit: true,
    modulePreload: { polyfill: false },
    sourcemap: false,
    reportCompressedSize: true,
    rollupOptions: {
      output: {
        // What every first view needs comes in few files: small ones are compressed badly, each for itself.
        manualChunks: (id) => (/\/src\/(shell\/(?!consent|dialog|login|machine|password|settings)\w+|views\/(index|overview|widget_place|view_styles|view_base)|widgets\/(index|styles|live_text)|core\/(?!format_number|machine)\w+)\.ts$/.test(id) ? 'first' : undefined),
      },
    },
    chunkSizeWarningLimit: 700, // the 3D view, which is loaded when it is shown
  },
  server: {
    fs: { allow: ['.', documentation] },
    proxy: {
      '/api': { target: application, ws: true, changeOrigin: true, headers: { origin: application } },
      '/application': { target: application, changeOrigin: true },
    },
  },
  test: {
    alias: { documentation },
    environment: 'jsdom',
    pool: 'vmThreads', // makes a document in a fraction of the time that a process of its own takes
    include: ['src/**/*.test.ts'],
  },
});
