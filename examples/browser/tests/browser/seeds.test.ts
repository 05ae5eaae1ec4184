// SPDX-License-Identifier: MIT

import { bumpySphere, cube, offFile, triangulated } from '../meshes';
import { answer, engineWith, expect, test } from './fixture';

const n = 10;
const mesh = cube(n);
const middleOf = (side: number) => side * n * n + (n * n) / 2 + n / 2;
const [right, top, front] = [middleOf(3), middleOf(4), middleOf(5)];

test('the page begins with a model that can be segmented', async ({ segmentation }) => {
  await expect(segmentation.page.locator('#mesh-name')).toHaveText('Hand');
  await expect(segmentation.page.locator('#hint')).toContainText('Click the mesh');
  expect(await segmentation.labels()).toBeNull();
});

test('clicked seeds give the labels that the engine gives', async ({ segmentation }) => {
  await segmentation.openMesh('cube.off', mesh);
  const labels = await segmentation.seed(right, front);
  expect(await segmentation.seeds()).toEqual([
    [right, 0],
    [front, 1],
  ]);
  const engine = await engineWith('cube.off', offFile(mesh.points, mesh.faces));
  answer(engine.addSeed(right, 0));
  answer(engine.addSeed(front, 1));
  expect(labels).toEqual([...answer(engine.segment())]);
  expect(labels[right]).toBe(0);
  expect(labels[front]).toBe(1);
});

test('faces have the colours of their labels, also after another colour was chosen', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(right, front);
  expect(await segmentation.colorOf(right)).not.toEqual(await segmentation.colorOf(front));
  await page.getByLabel('Colour of Part 2').fill('#123456');
  await expect.poll(() => segmentation.colorOf(front)).toEqual([0x12, 0x34, 0x56]);
});

test('undo and redo walk through the edits, and the segments follow', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await expect(page.locator('#undo')).toBeDisabled();
  const one = await segmentation.seed(right);
  await page.keyboard.press('2');
  await segmentation.clickFace(front);
  const two = await segmentation.labelsAfter(one);
  await page.click('#undo');
  expect(await segmentation.labelsAfter(two)).toEqual(one);
  expect(await segmentation.seeds()).toEqual([[right, 0]]);
  await page.keyboard.press('Control+Z');
  await expect.poll(() => segmentation.labels()).toBeNull();
  await page.keyboard.press('Control+Shift+Z');
  await page.click('#redo');
  await expect.poll(() => segmentation.labels()).toEqual(two);
  await expect(page.locator('#redo')).toBeDisabled();
});

test('a stroke paints seeds, is one edit, and can be erased', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await page.keyboard.press('p');
  await expect(page.locator('#brush')).toBeVisible();
  const [from, to] = [await segmentation.placeOf(front - 3), await segmentation.placeOf(front + 3)];
  const drag = async () => {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(to.x, to.y, { steps: 6 });
    await page.mouse.up();
  };
  await drag();
  const painted = await segmentation.seeds();
  expect(painted.length).toBeGreaterThan(2);
  for (const [face] of painted) expect(Math.floor(face / (n * n))).toBe(5);
  expect(await segmentation.placeOf(front - 3)).toEqual(from); // the camera stayed
  await page.keyboard.press('Control+Z');
  expect(await segmentation.seeds()).toEqual([]);
  await page.keyboard.press('Control+Y');
  await page.keyboard.press('e');
  await drag();
  expect(await segmentation.seeds()).toEqual([]);
});

test('a stroke that is undone before its end takes no earlier edit with it', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(right);
  await page.keyboard.press('p');
  const [from, to] = [await segmentation.placeOf(front - 3), await segmentation.placeOf(front + 3)];
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await expect.poll(async () => (await segmentation.seeds()).length).toBeGreaterThan(1);
  await page.keyboard.press('Control+Z');
  expect(await segmentation.seeds()).toEqual([[right, 0]]);
  await page.mouse.move(to.x, to.y, { steps: 6 });
  await page.mouse.up();
  expect((await segmentation.seeds()).length).toBeGreaterThan(1);
  await page.keyboard.press('Control+Z');
  expect(await segmentation.seeds()).toEqual([[right, 0]]);
});

test('dragging with the seed tool turns the mesh and places no seed', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  const before = await segmentation.placeOf(front);
  await page.mouse.move(before.x, before.y);
  await page.mouse.down();
  await page.mouse.move(before.x + 40, before.y + 20, { steps: 4 });
  await page.mouse.up();
  expect(await segmentation.seeds()).toEqual([]);
  const after = await segmentation.placeOf(front);
  expect(Math.abs(after.x - before.x)).toBeGreaterThan(5);
  await page.keyboard.press('f');
  await segmentation.clickFace(front);
  expect(await segmentation.seeds()).toEqual([[front, 0]]);
});

test('labels are added, named and removed, and their names are shown with the segments', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await page.click('#add-label');
  await expect(page.locator('#labels > li')).toHaveCount(3);
  await page.getByLabel('Name of label 3').fill('Lid');
  await page.keyboard.press('Enter');
  await segmentation.clickFace(top);
  await expect(page.locator('#segments')).toContainText('Lid');
  await page.getByRole('button', { name: 'Remove Lid' }).click();
  await expect(page.locator('#labels > li')).toHaveCount(2);
  expect(await segmentation.seeds()).toEqual([]);
  await page.click('#undo');
  await expect(page.getByLabel('Name of label 3')).toHaveValue('Lid');
  expect(await segmentation.seeds()).toEqual([[top, 2]]);
});

test('the heat map shows the probability of a label', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(right, front);
  const plain = await segmentation.colorOf(front);
  await page.getByRole('button', { name: 'Probability of Part 2' }).click();
  await expect(page.locator('#legend')).toContainText('Probability of “Part 2”');
  await expect.poll(() => segmentation.colorOf(front)).toEqual([253, 231, 37]);
  expect(await segmentation.colorOf(right)).toEqual([68, 1, 84]);
  await segmentation.screenshot('probability');
  await page.click('#legend-close');
  await expect.poll(() => segmentation.colorOf(front)).toEqual(plain);
});

test('the key of the heat map does nothing where its button could not', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(front);
  await page.keyboard.press('2'); // a label without seeds
  await page.keyboard.press('h');
  await expect(page.locator('#legend')).toBeHidden();
  await page.keyboard.press('1');
  await page.click('#tab-automatic');
  await page.keyboard.press('h');
  await page.click('#tab-seeds');
  await expect(page.locator('#legend')).toBeHidden();
  await page.keyboard.press('h');
  await expect(page.locator('#legend')).toContainText('Part 1');
  await page.keyboard.press('h');
  await expect(page.locator('#legend')).toBeHidden();
});

test('the sliders change what separates parts', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(right, front);
  await page.getByText('What separates parts').click();
  await page.locator('#convex-weight').fill('1');
  await page.locator('#sigma').fill('-1');
  await expect(page.locator('#sigma-value')).toHaveText('0.10');
  const engine = await engineWith('cube.off', offFile(mesh.points, mesh.faces));
  answer(engine.prepare(1, 0.1));
  answer(engine.addSeed(right, 0));
  answer(engine.addSeed(front, 1));
  const expected = [...answer(engine.segment())];
  await expect.poll(() => segmentation.labels()).toEqual(expected);
  await page.getByText('Usual values').click();
  await expect(page.locator('#convex-weight')).toHaveValue('0.02');
});

test('segments are hidden, shown alone, and moved apart', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(right, front);
  const isVisible = (face: number) => page.evaluate((face) => window.segmentationPage.placeOf(face).isVisible, face);
  const rows = page.locator('#segments > li');
  await expect(rows).toHaveCount(2);
  await expect(rows.first()).toContainText('faces');

  await page.getByRole('button', { name: 'Hide Part 1' }).click();
  expect([await isVisible(right), await isVisible(front)]).toEqual([false, true]);
  await page.getByRole('button', { name: 'Show Part 1' }).click();
  await page.getByRole('button', { name: 'Part 1 alone' }).click();
  expect([await isVisible(right), await isVisible(front)]).toEqual([true, false]);
  await page.click('#show-all');
  const before = [await segmentation.placeOf(right), await segmentation.placeOf(front)];
  await page.locator('#explosion').fill('1');
  const after = [await segmentation.placeOf(right), await segmentation.placeOf(front)];
  const distance = ([a, b]: { x: number; y: number }[]) => Math.hypot(a.x - b.x, a.y - b.y);
  expect(distance(after)).toBeGreaterThan(1.3 * distance(before));
  await segmentation.screenshot('apart');
  await page.locator('#explosion').fill('0');
  expect([await segmentation.placeOf(right), await segmentation.placeOf(front)]).toEqual(before);
});

test('smooth boundaries are drawn between segments, of polygons as of triangles', async ({ segmentation }) => {
  const { page } = segmentation;
  const curves = () => page.evaluate(() => window.segmentationPage.curves());
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(right, front);
  await expect.poll(curves).toBeGreaterThan(0);
  await segmentation.openMesh('triangles.off', triangulated(mesh));
  await expect.poll(curves).toBe(0);
  const labels = await segmentation.seed(2 * right, 2 * front);
  await expect.poll(curves).toBeGreaterThan(0);
  await page.keyboard.press('b');
  await expect.poll(curves).toBe(0);
  await page.keyboard.press('b');
  await expect.poll(curves).toBeGreaterThan(0);
  await page.keyboard.press('Control+Z');
  expect(new Set(await segmentation.labelsAfter(labels)).size).toBe(1);
  await expect.poll(curves).toBe(0);
});

test('sliders that are moved while a mesh is being opened hold for it', async ({ segmentation }) => {
  const { page } = segmentation;
  await page.getByText('What separates parts').click();
  const other = bumpySphere(24);
  await segmentation.holdEngine();
  await segmentation.open('other.off', offFile(other.points, other.faces));
  await page.locator('#sigma').fill('-1');
  await segmentation.releaseEngine();
  await expect(page.locator('#mesh-name')).toHaveText('other.off');
  await expect(page.locator('#sigma-value')).toHaveText('0.10');
  await expect.poll(async () => (await segmentation.engineCalls()).prepare).toBe(1);
});

test('a component without seeds has no label, though one is free', async ({ segmentation }) => {
  const { page } = segmentation;
  const { points, faces } = cube(4);
  const beside = points.map(([x, y, z]) => [x + 1.5, y, z]);
  const corners = faces.map((face) => face.map((vertex) => vertex + points.length));
  await segmentation.openMesh('two.off', { points: [...points, ...beside], faces: [...faces, ...corners] });
  const labels = await segmentation.seed(5 * 16 + 10);
  expect(new Set(labels).size).toBe(2);
  await expect(page.locator('#segments > li')).toHaveCount(2);
  await expect(page.locator('#segments')).toContainText('Part 1');
  await expect(page.locator('#segments')).toContainText('Unseeded');
  await expect(page.locator('#segments')).not.toContainText('Part 2');
});

test('seeds are not undone, nor labels added, by keys while they are not shown', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(front);
  await page.click('#tab-automatic');
  await page.keyboard.press('Control+Z');
  await page.keyboard.press('n');
  expect(await segmentation.seeds()).toEqual([[front, 0]]);
  await expect(page.locator('#labels > li')).toHaveCount(2);
  await page.click('#tab-seeds');
  await page.keyboard.press('Control+Z');
  expect(await segmentation.seeds()).toEqual([]);
});
