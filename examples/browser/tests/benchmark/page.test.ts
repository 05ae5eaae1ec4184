// SPDX-License-Identifier: MIT

import { readFileSync } from 'node:fs';
import { loadavg } from 'node:os';
import { gzipSync } from 'node:zlib';
import { expect, pageFile, test, type SegmentationTester } from '../browser/fixture';
import { bumpySphere } from '../meshes';
import { processorTimeOfChildren } from './processorTime';

function result(values: Record<string, string | number>): void {
  const pairs = Object.entries(values).map(([name, value]) => `${name}=${value}`);
  console.log(`RESULT bench=browser ${pairs.join(' ')} load=${loadavg()[0].toFixed(1)}`);
}

test('the size of the page', () => {
  const page = readFileSync(pageFile);
  result({ page_bytes: page.length, page_gzip_bytes: gzipSync(page, { level: 9 }).length });
});

for (const [size, rings] of [
  ['40K', 101],
  ['200K', 224],
] as const)
  test(`edits and parts of ${size} faces`, async ({ segmentation }) => {
    test.setTimeout(600_000);
    const { page } = segmentation;
    const mesh = bumpySphere(rings);
    const start = performance.now();
    await segmentation.openMesh('bumps.off', mesh);
    const open_ms = Math.round(performance.now() - start);
    const box = (await page.locator('#canvas').boundingBox())!;
    const click = ([x, y]: readonly [number, number]) =>
      timeOfClick(segmentation, box.x + x * box.width, box.y + y * box.height);
    const first_ms = await click(places[0]);
    await page.keyboard.press('2');
    const second_ms = await click(places[1]);
    await page.keyboard.press('b'); // what is not an edit shall not be counted
    await page.waitForTimeout(3000);
    const before = processorTimeOfChildren();
    const times: number[] = [];
    for (const place of places.slice(2)) times.push(await click(place));
    const edit_processor_ms = Math.round((processorTimeOfChildren() - before) / times.length);
    times.sort((a, b) => a - b);
    const [edit_ms, least_ms] = [times[Math.floor(times.length / 2)], times[0]];
    const faces = mesh.faces.length;
    result({ faces, open_ms, first_ms, second_ms, edit_ms, least_ms, edit_processor_ms });

    await page.click('#tab-automatic');
    await page.click('#compute');
    await expect(page.locator('#parts')).toBeVisible({ timeout: 300_000 });
    const found = /Found in ([\d.]+) (ms|s)/.exec((await page.locator('#level-remark').textContent()) ?? '')!;
    result({ faces, automatic_ms: Number(found[1]) * (found[2] === 's' ? 1000 : 1) });
  });

/** Places of seeds, as parts of the canvas: a top, a bottom, and a grid between them. */
const places: readonly (readonly [number, number])[] = [
  [0.5, 0.3],
  [0.5, 0.7],
  ...Array.from({ length: 16 }, (_, i): [number, number] => [0.44 + 0.04 * (i % 4), 0.4 + 0.06 * Math.floor(i / 4)]),
];

/** Milliseconds from a click to the end of the picture with the new segments. */
async function timeOfClick({ page }: SegmentationTester, x: number, y: number): Promise<number> {
  const time = await page.evaluateHandle(() => {
    const { answers } = window.segmentationPage;
    const milliseconds = new Promise<number>((resolve) => {
      const begin = () => {
        const [start, before] = [performance.now(), answers()];
        const look = () => {
          if (answers() === before) requestAnimationFrame(look);
          else finish();
        };
        const context = document.querySelector('canvas')!.getContext('webgl2')!;
        const finish = () => {
          const fence = context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0)!;
          const wait = () => {
            const isDone =
              context.clientWaitSync(fence, context.SYNC_FLUSH_COMMANDS_BIT, 0) !== context.TIMEOUT_EXPIRED;
            if (isDone) resolve(Math.round(performance.now() - start));
            else setTimeout(wait, 1);
          };
          wait();
        };
        look();
      };
      window.addEventListener('pointerup', begin, { capture: true, once: true });
    });
    return { milliseconds };
  });
  await page.mouse.click(x, y);
  return time.evaluate(({ milliseconds }) => milliseconds);
}
