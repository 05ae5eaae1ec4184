// SPDX-License-Identifier: MIT

import { once } from 'node:events';
import { createServer } from 'node:http';
import { readFileSync, writeFileSync } from 'node:fs';
import type { AddressInfo } from 'node:net';
import { pathToFileURL } from 'node:url';
import { bumpySphere, cube, offFile } from '../meshes';
import { defaultPolicies } from '../../src/worker/calls';
import { answer, engineWith, expect, pageFile, test } from './fixture';

test('a mesh can be segmented with the keyboard alone', async ({ segmentation }) => {
  const { page } = segmentation;
  const focusOn = async (id: string) => {
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press('Tab');
      if ((await page.evaluate(() => document.activeElement?.id)) === id) return;
    }
    throw new Error(`Tab does not lead to ${id}.`);
  };
  await focusOn('canvas');
  await page.keyboard.press('Enter');
  let labels = await segmentation.labelsAfter(null);
  expect(new Set(labels)).toEqual(new Set([0]));
  await page.keyboard.press('2');
  for (let i = 0; i < 10; ++i) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  labels = await segmentation.labelsAfter(labels);
  expect(new Set(labels)).toEqual(new Set([0, 1]));
  await segmentation.screenshot('keyboard');
  await focusOn('tab-seeds');
  await page.keyboard.press('ArrowRight');
  await expect(page.locator('#automatic-panel')).toBeVisible();
  await focusOn('compute');
  await page.keyboard.press('Enter');
  await expect(page.locator('#parts')).toBeVisible();
  await focusOn('parts');
  const before = Number(await page.locator('#parts').inputValue());
  await page.keyboard.press('ArrowRight');
  expect(new Set(await segmentation.labels()).size).toBe(before + 1);
});

test('the focus goes from the search for parts to their number, or back where it is cancelled', async ({
  segmentation,
}) => {
  const { page } = segmentation;
  await segmentation.openMesh('bumps.off', bumpySphere(90));
  await page.click('#tab-automatic');
  await page.locator('#compute').press('Enter');
  await page.keyboard.press('Enter');
  await expect(page.locator('#progress')).toBeHidden();
  await expect(page.locator('#compute')).toBeFocused();
  await page.keyboard.press('Enter');
  await expect(page.locator('#cancel')).toBeFocused();
  await expect(page.locator('#parts')).toBeFocused();
});

test('arrow keys lead to every model, and the same one can be opened again', async ({ segmentation }) => {
  const { page } = segmentation;
  const list = page.locator('#model');
  await expect.poll(() => list.locator('option').count()).toBeGreaterThan(3);
  const names = (await list.locator('option').allTextContents()).slice(1);
  await list.focus();
  for (const name of names) {
    await page.keyboard.press('ArrowDown');
    await expect(page.locator('#mesh-name')).toHaveText(name);
  }
  const last = { label: names.at(-1)! };
  await segmentation.openMesh('cube.off', cube(4));
  await list.selectOption(last);
  await expect(page.locator('#mesh-name')).toHaveText(last.label);
  const { load = 0 } = await segmentation.engineCalls();
  await page.locator('#canvas').focus();
  await list.selectOption(last);
  await expect.poll(async () => (await segmentation.engineCalls()).load).toBe(load + 1);
});

test('every control has a name', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', cube(4));
  for (const tab of ['seeds', 'automatic']) {
    await page.click(`#tab-${tab}`);
    for (const summary of await page.locator('summary').all()) if (await summary.isVisible()) await summary.click();
    const controls = await page.locator('button, select, input:not([hidden]), canvas').all();
    for (const control of controls) if (await control.isVisible()) await expect(control).toHaveAccessibleName(/\S/);
  }
});

test('the help lists the shortcuts and gives the focus back', async ({ segmentation }) => {
  const { page } = segmentation;
  await page.locator('#help').focus();
  await page.keyboard.press('Enter');
  await expect(page.getByRole('dialog')).toContainText('Ctrl+Z');
  await segmentation.screenshot('help');
  await page.keyboard.press('p'); // not while the help is open
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog')).toBeHidden();
  await expect(page.locator('#help')).toBeFocused();
  await expect(page.locator('input[value=seed]')).toBeChecked();
});

test('the help is read from its beginning, also where the window is too small for it', async ({ segmentation }) => {
  const { page } = segmentation;
  await page.setViewportSize({ width: 640, height: 360 });
  await page.keyboard.press('?');
  await expect(page.getByRole('heading', { name: 'Segmenting a mesh' })).toBeInViewport();
  await page.keyboard.press('Tab');
  await expect(page.getByRole('button', { name: 'Close', exact: true })).toBeFocused();
});

test('texts have the contrast that WCAG AA asks for, dark and light', async ({ segmentation }) => {
  const { page } = segmentation;
  for (const scheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme: scheme });
    const contrasts = await page.evaluate(() => {
      const style = getComputedStyle(document.documentElement);
      const light = (name: string) => {
        const probe = document.createElement('span');
        probe.style.color = style.getPropertyValue(name);
        document.body.append(probe);
        const channels = getComputedStyle(probe)
          .color.match(/\d+/g)!
          .map((channel) => Number(channel) / 255);
        probe.remove();
        const [r, g, b] = channels.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const contrast = (a: string, b: string) => {
        const [low, high] = [light(a), light(b)].sort((x, y) => x - y);
        return (high + 0.05) / (low + 0.05);
      };
      return [
        ...['--text', '--text-faint', '--accent'].flatMap((text) =>
          ['--surface', '--accent-faint', '--ground', '--ground-far'].map((ground) => [text, ground]),
        ),
        ['--accent-text', '--accent'],
        ['--error', '--error-faint'],
      ].map(([text, ground]) => ({ text, ground, contrast: contrast(text, ground) }));
    });
    for (const pair of contrasts)
      expect(pair.contrast, `${scheme}: ${pair.text} on ${pair.ground}`).toBeGreaterThanOrEqual(4.5);
  }
});

test.describe('on a phone', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });

  test('everything is within the width, and the panel folds', async ({ segmentation }) => {
    const { page } = segmentation;
    await segmentation.openMesh('cube.off', cube(8));
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    for (const control of await page.locator('.bar button, .bar select, .tools label').all()) {
      const box = (await control.boundingBox())!;
      expect(box.x).toBeGreaterThanOrEqual(0);
      expect(box.x + box.width).toBeLessThanOrEqual(390);
    }
    const height = async () => (await page.locator('#canvas').boundingBox())!.height;
    const before = await height();
    await segmentation.screenshot('phone');
    await page.click('#panel-toggle');
    expect(await height()).toBeGreaterThan(before + 200);
    await page.click('#panel-toggle');
    expect(await height()).toBe(before);
  });

  test('a tap places a seed, a finger paints with the brush', async ({ segmentation }) => {
    const { page } = segmentation;
    const n = 8;
    await segmentation.openMesh('cube.off', cube(n));
    const front = 5 * n * n + (n * n) / 2 + n / 2;
    const place = await segmentation.placeOf(front);
    await page.touchscreen.tap(place.x, place.y);
    await expect.poll(() => segmentation.seeds()).toEqual([[front, 0]]);
    await page.getByText('Paint', { exact: true }).tap();
    const touch = await page.context().newCDPSession(page);
    const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', x?: number, y?: number) =>
      touch.send('Input.dispatchTouchEvent', { type, touchPoints: x === undefined ? [] : [{ x, y: y! }] });
    await send('touchStart', place.x, place.y);
    for (let step = 1; step <= 5; ++step) await send('touchMove', place.x, place.y - 20 * step);
    await send('touchEnd');
    await expect.poll(async () => (await segmentation.seeds()).length).toBeGreaterThan(2);
    expect(await segmentation.placeOf(front)).toEqual(place);
  });
});

test('a result that was put into the page is shown when it is opened from disk', async ({ segmentation }, testInfo) => {
  const mesh = cube(6);
  const off = offFile(mesh.points, mesh.faces);
  const hierarchy = answer(
    (await engineWith('cube.off', off)).hierarchy({ kind: 'engineering', ...defaultPolicies }, () => true),
  );
  expect(hierarchy.fragments).toBe(6);
  const labels = Uint32Array.from(hierarchy.fragmentOfFace);
  labels[0] = labels[36]; // as a face that was cut off along a smooth boundary
  const { fragments, fewest, suggested, levels } = hierarchy;
  const result = {
    name: 'result.off',
    mesh: Buffer.from(asciiPly(mesh)).toString('base64'),
    labels: base64(labels),
    hierarchy: {
      fragmentOfFace: base64(hierarchy.fragmentOfFace),
      merges: base64(hierarchy.merges),
      costs: base64(hierarchy.costs),
      fragments,
      fewest,
      suggested,
      levels: Array.from(levels),
    },
    segments: 6,
    mode: 'engineering',
    policies: null,
    seeds: [],
  };
  await segmentation.goto(pageWith(result, testInfo.outputPath('result.html')));
  await expect(segmentation.page.locator('#mesh-name')).toHaveText('result.off');
  await expect(segmentation.page.locator('#parts')).toHaveValue('6');
  expect(await segmentation.labels()).toEqual([...labels]);
  await segmentation.page.locator('#parts').fill('5');
  expect(new Set(await segmentation.labels()).size).toBe(5);
  await segmentation.page.locator('#parts').fill('6');
  expect(await segmentation.labels()).toEqual([...labels]);
  expect((await segmentation.engineCalls()).hierarchy).toBeUndefined();
});

test('what the user chooses while a result in the page is being opened stays chosen', async ({
  segmentation,
}, testInfo) => {
  const { page } = segmentation;
  const mesh = bumpySphere(24);
  const result = {
    name: 'result.off',
    mesh: Buffer.from(asciiPly(mesh)).toString('base64'),
    labels: base64(new Uint32Array(mesh.faces.length)),
    hierarchy: null,
    segments: 1,
    mode: 'engineering',
    policies: null,
    seeds: [],
  };
  await segmentation.holdEngine();
  await page.goto(pageWith(result, testInfo.outputPath('result.html')));
  await expect(page.getByLabel('Machine part')).toBeChecked();
  await page.getByText('Natural shape').click();
  await page.click('#tab-seeds');
  await expect(page.locator('#opening')).toBeVisible();
  await segmentation.releaseEngine();
  await expect(page.locator('#mesh-name')).toHaveText('result.off');
  await expect(page.locator('#tab-seeds')).toHaveAttribute('aria-selected', 'true');
  await page.click('#tab-automatic');
  await expect(page.getByLabel('Natural shape')).toBeChecked();
});

test('seeds that were put into the page go on growing by the numbers that they grew by', async ({
  segmentation,
}, testInfo) => {
  const { page } = segmentation;
  const mesh = bumpySphere(24);
  const [middle, beside] = [1100, 300];
  const labelsBy = async (convexWeight: number, sigma: number, seeds: number[]) => {
    const engine = await engineWith('bumps.off', offFile(mesh.points, mesh.faces));
    answer(engine.prepare(convexWeight, sigma));
    for (const [label, face] of seeds.entries()) answer(engine.addSeed(face, label));
    return answer(engine.segment());
  };
  const labels = await labelsBy(0.8, 0.2, [middle, beside]);
  expect(labels).not.toEqual(await labelsBy(0.02, 1, [middle, beside]));
  const result = {
    name: 'result.off',
    mesh: Buffer.from(asciiPly(mesh)).toString('base64'),
    labels: base64(labels),
    hierarchy: null,
    segments: 2,
    mode: 'seeds',
    parameters: { convexWeight: 0.8, sigma: 0.2 },
    seeds: [middle, beside].map((face, label) => ({ face, label })),
  };
  await segmentation.goto(pageWith(result, testInfo.outputPath('result.html')));
  await expect(page.locator('#mesh-name')).toHaveText('result.off');
  expect(await segmentation.labels()).toEqual([...labels]);
  await page.getByRole('button', { name: 'Remove Part 2' }).click();
  await expect.poll(async () => new Set(await segmentation.labels()).size).toBe(1);
  await page.click('#undo');
  await expect.poll(() => segmentation.labels()).toEqual([...labels]);
  await page.getByText('What separates parts').click();
  await expect(page.locator('#convex-weight-value')).toHaveText('0.80');
  await expect(page.locator('#sigma-value')).toHaveText('0.20');
});

const base64 = (array: Uint32Array | Float64Array) => Buffer.from(array.buffer).toString('base64');

/** The address of a page that a result is put into. */
function pageWith(result: unknown, path: string): string {
  const begin = '<script type="application/json" id="embedded-result">';
  const page = readFileSync(pageFile, 'utf8');
  expect(page.split(begin)).toHaveLength(2);
  const [before, after] = page.split(begin);
  writeFileSync(path, before + begin + JSON.stringify(result) + after.slice(after.indexOf('</script>')));
  return pathToFileURL(path).href;
}

function asciiPly({ points, faces }: { points: number[][]; faces: number[][] }): string {
  const header = [
    'ply\nformat ascii 1.0',
    `element vertex ${points.length}\nproperty double x\nproperty double y\nproperty double z`,
    `element face ${faces.length}\nproperty list uchar int vertex_indices\nend_header`,
  ];
  return (
    [...header, ...points.map((p) => p.join(' ')), ...faces.map((f) => [f.length, ...f].join(' '))].join('\n') + '\n'
  );
}

test('the page works from a static host', async ({ segmentation }) => {
  const server = createServer((_, response) => {
    response.setHeader('Content-Type', 'text/html');
    response.end(readFileSync(pageFile));
  }).listen(0, '127.0.0.1');
  await once(server, 'listening');
  try {
    await segmentation.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
    await expect(segmentation.page.locator('#mesh-name')).toHaveText('Hand');
  } finally {
    server.close();
  }
});

test('the picture comes back when the browser has taken the graphics card away for a while', async ({
  segmentation,
}) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', cube(8));
  const picture = async () => (await page.locator('#canvas').screenshot()).toString('base64');
  await expect.poll(async () => (await picture()) === (await picture())).toBe(true);
  const before = await picture();
  const card = await page.evaluateHandle(() =>
    document.querySelector('canvas')!.getContext('webgl2')!.getExtension('WEBGL_lose_context')!,
  );
  await card.evaluate((card) => card.loseContext());
  await expect.poll(picture).not.toBe(before);
  await card.evaluate((card) => card.restoreContext());
  await expect.poll(picture).toBe(before);
});

test('the picture is as fine as the screen after the window has gone to another one', async ({ segmentation }) => {
  const { page } = segmentation;
  const sharpness = () =>
    page.evaluate(() => {
      const canvas = document.querySelector('canvas')!;
      return canvas.width / canvas.clientWidth;
    });
  expect(await sharpness()).toBe(1);
  const screen = await page.context().newCDPSession(page);
  const metrics = { width: 1200, height: 720, deviceScaleFactor: 2, mobile: false };
  await screen.send('Emulation.setDeviceMetricsOverride', metrics);
  await expect.poll(sharpness).toBe(2);
});
