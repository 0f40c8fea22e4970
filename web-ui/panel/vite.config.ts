// How the page is built: static files with hashed names, nothing inline, so that a strict content policy holds.
import { loadEnv } from 'vite';
import { defineConfig } from 'vitest/config';
import { shortTemplates } from './short_templates';

// `npm run dev` serves the sources and passes everything else on to a running application, at FLEXRF_PANEL.
const application = loadEnv('', '.', 'FLEXRF_')['FLEXRF_PANEL'] ?? 'http://127.0.0.1:8080';

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
    chunkSizeWarningLimit: 700, // the 3D view, which is loaded when it is shown
  },
  server: {
    fs: { allow: ['.', '../../docs'] }, // a test runs the example that is printed there
    proxy: {
      '/api': { target: application, ws: true, changeOrigin: true, headers: { origin: application } },
      '/application': { target: application, changeOrigin: true },
    },
  },
  test: {
    environment: 'jsdom',
    include: ['src/**/*.test.ts'],
  },
});
