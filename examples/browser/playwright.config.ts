// SPDX-License-Identifier: MIT

import { defineConfig } from '@playwright/test';

const output = '../../build/browser';

export default defineConfig({
  testDir: 'tests',
  testMatch: '**/*.test.ts',
  outputDir: `${output}/test-results`,
  workers: 1, // of which the browser takes more than one core
  timeout: 120_000,
  expect: { timeout: 30_000 },
  reporter: 'line',
  use: {
    viewport: { width: 1280, height: 720 },
    launchOptions: {
      executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
      args: [
        '--no-sandbox',
        '--use-gl=angle',
        '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader',
        '--disable-gpu-rasterization', // where the processor is the graphics card, that is slower
      ],
    },
  },
  projects: [
    { name: 'unit', testDir: 'tests/unit' },
    { name: 'browser', testDir: 'tests/browser' },
    { name: 'native', testDir: 'tests/native' },
    { name: 'picture', testDir: 'tests/picture' },
    { name: 'benchmark', testDir: 'tests/benchmark' },
  ],
});
