// Each file starts applications and a browser of its own; one file at a time, as two CPUs have enough to do with one.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['src/**/*.test.ts'],
    setupFiles: ['src/standstill.ts'],
    retry: 3, // only of what a standstill of the machine disturbed
    pool: 'forks',
    fileParallelism: false,
    // Only so that a test which waits for what never comes ends at all.
    testTimeout: 900_000,
    hookTimeout: 300_000,
  },
});
