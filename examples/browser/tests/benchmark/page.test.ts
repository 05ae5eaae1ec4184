import { readFileSync } from 'node:fs';
import { loadavg } from 'node:os';
import { gzipSync } from 'node:zlib';
import { expect, pageFile, test, type SegmentationTester } from '../browser/fixture';
import { bumpySphere } from '../meshes';

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
    const times: number[] = [];
    for (const [label, [x, y]] of places.entries()) {
      if (label > 1) await page.keyboard.press('n');
      else await page.keyboard.press(String(label + 1));
      times.push(await timeOfClick(segmentation, box.x + x * box.width, box.y + y * box.height));
      await page.waitForTimeout(1500); // for the boundaries, as someone who looks before the next click
    }
    const [first_ms, second_ms, ...later] = times;
    const edit_ms = later.sort((a, b) => a - b)[Math.floor(later.length / 2)];
    result({ faces: mesh.faces.length, open_ms, first_ms, second_ms, edit_ms, most_ms: later[later.length - 1] });

    await page.click('#tab-automatic');
    await page.click('#compute');
    await expect(page.locator('#parts')).toBeVisible({ timeout: 300_000 });
    const found = /Found in ([\d.]+) (ms|s)/.exec((await page.locator('#level-remark').textContent()) ?? '')!;
    result({ faces: mesh.faces.length, automatic_ms: Number(found[1]) * (found[2] === 's' ? 1000 : 1) });
  });

/** Places of seeds, as parts of the canvas. */
const places = [
  [0.5, 0.3],
  [0.5, 0.7],
  [0.42, 0.5],
  [0.58, 0.5],
  [0.5, 0.5],
  [0.45, 0.4],
  [0.55, 0.6],
] as const;

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
