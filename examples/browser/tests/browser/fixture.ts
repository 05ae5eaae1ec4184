// SPDX-License-Identifier: MIT

import { readFileSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { test as base, expect, type Page } from '@playwright/test';
import type { EngineModule, Engine, Failure } from '../../src/worker/EngineModule';
import { offFile } from '../meshes';

export { expect };

const build = fileURLToPath(new URL('../../../../build/browser/', import.meta.url));
export const pageFile = `${build}page/index.html`;

/** The page, opened from disk. The test fails if the console reports an error. */
export const test = base.extend<{ segmentation: SegmentationTester }>({
  segmentation: async ({ page }, use) => {
    const errors: string[] = [];
    page.on('console', (message) => {
      if (message.type() === 'error') errors.push(message.text());
    });
    page.on('pageerror', (error) => errors.push(error.message));
    const tester = new SegmentationTester(page);
    await tester.goto(pathToFileURL(pageFile).href);
    await use(tester);
    expect(errors).toEqual([]);
  },
});

/** What a user does on the page. */
export class SegmentationTester {
  constructor(readonly page: Page) {}

  /** Goes to the page and waits for the mesh that it shows at first. */
  async goto(url: string): Promise<void> {
    await this.page.goto(url);
    await this.page.waitForFunction(() => window.segmentationPage?.faces() > 0);
  }

  async open(name: string, content: string | Uint8Array): Promise<void> {
    await this.page.setInputFiles('#file', {
      name,
      mimeType: 'application/octet-stream',
      buffer: Buffer.from(content),
    });
  }

  async openMesh(name: string, mesh: { points: number[][]; faces: number[][] }): Promise<void> {
    await this.open(name, offFile(mesh.points, mesh.faces));
    await expect(this.page.locator('#mesh-name')).toHaveText(name);
  }

  labels(): Promise<number[] | null> {
    return this.page.evaluate(() => window.segmentationPage.labels());
  }

  seeds(): Promise<[number, number][]> {
    return this.page.evaluate(() => window.segmentationPage.seeds());
  }

  colorOf(face: number): Promise<number[]> {
    return this.page.evaluate((face) => window.segmentationPage.colorOf(face), face);
  }

  /** From now on, and on pages that are gone to, the engine is asked nothing before it is released. */
  async holdEngine(): Promise<void> {
    await this.page.addInitScript(holdWorkers);
    await this.page.evaluate(holdWorkers);
  }

  releaseEngine(): Promise<void> {
    return this.page.evaluate(() => window.releaseWorkers());
  }

  engineCalls(): Promise<Record<string, number>> {
    return this.page.evaluate(() => window.segmentationPage.engineCalls());
  }

  /** The place of a face that can be seen. */
  async placeOf(face: number): Promise<{ x: number; y: number }> {
    const place = await this.page.evaluate((face) => window.segmentationPage.placeOf(face), face);
    expect(place.isVisible).toBe(true);
    return place;
  }

  async clickFace(face: number): Promise<void> {
    const { x, y } = await this.placeOf(face);
    await this.page.mouse.click(x, y);
  }

  /** Waits until the labels are others than those given. */
  async labelsAfter(former: number[] | null): Promise<number[]> {
    await this.page.waitForFunction(
      (former) => JSON.stringify(window.segmentationPage.labels()) !== former,
      JSON.stringify(former),
    );
    return (await this.labels()) ?? [];
  }

  /** Clicks faces, each with a label of its own, and gives the labels of all faces. */
  async seed(...faces: number[]): Promise<number[]> {
    let labels = await this.labels();
    for (const [label, face] of faces.entries()) {
      await this.page.keyboard.press(String(label + 1));
      await this.clickFace(face);
      labels = await this.labelsAfter(labels);
    }
    return labels ?? [];
  }

  /** What a button gives to save. */
  async saved(button: string): Promise<{ name: string; content: Buffer }> {
    const download = this.page.waitForEvent('download');
    await this.page.click(button);
    const file = await download;
    return { name: file.suggestedFilename(), content: readFileSync(await file.path()) };
  }

  /** What is saved of the segments in a format. */
  async savedAs(format: string): Promise<{ name: string; content: Buffer }> {
    await this.page.selectOption('#save-format', format);
    return this.saved('#save-segments');
  }

  /** Keeps a picture of the page to look at. */
  async screenshot(name: string): Promise<void> {
    await this.page.screenshot({ path: `${build}screenshots/${name}.png` });
  }
}

declare global {
  interface Window {
    releaseWorkers: () => void;
  }
}

/** Keeps what is posted to workers until they are released. */
function holdWorkers(): void {
  const { postMessage } = Worker.prototype;
  const held: (() => void)[] = [];
  Worker.prototype.postMessage = function (this: Worker, ...message: unknown[]) {
    held.push(() => Reflect.apply(postMessage, this, message) as void);
  };
  window.releaseWorkers = () => {
    Worker.prototype.postMessage = postMessage;
    for (const post of held) post();
  };
}

/** The engine as Node runs it. */
export async function engineModule(): Promise<EngineModule> {
  const { loadInNode } = await import(new URL('../../engine/load_in_node.mjs', import.meta.url).href);
  return loadInNode(pathToFileURL(`${build}engine.mjs`).href);
}

/** The engine with a mesh. */
export async function engineWith(fileName: string, content: string): Promise<Engine> {
  const module = await engineModule();
  const engine = answer(module.readMesh(new TextEncoder().encode(content), fileName));
  answer(engine.prepare(0.02, 1));
  return engine;
}

export function answer<T>(result: T | Failure): T {
  if (typeof result === 'object' && result !== null && 'error' in result) throw new Error(result.error);
  return result as T;
}
