// SPDX-License-Identifier: MIT

import { bumpySphere, cube, offFile } from '../meshes';
import { noWalls } from '../../src/worker/calls';
import { answer, engineWith, expect, test, type SegmentationTester } from './fixture';

const squares = 12; // along each edge of the cube
const rings = 24; // of the sphere's vertices, poles included
const ringOfWalls = 9;

/** The edges of a ring of the bumpy sphere, as a file. */
const ringFile = Array.from({ length: 2 * rings }, (_, j) => {
  const vertex = (j: number) => 1 + (ringOfWalls - 1) * 2 * rings + (j % (2 * rings));
  return `${vertex(j)} ${vertex(j + 1)}\n`;
}).join('');

/** Labels of faces on the two sides of the ring. */
function sides({ points, faces }: ReturnType<typeof bumpySphere>, labels: number[]): [Set<number>, Set<number>] {
  const above = points.findIndex((_, vertex) => vertex === 1 + ringOfWalls * 2 * rings); // the first vertex below
  const isAbove = faces.map((corners) => corners.every((corner) => corner < above));
  return [new Set(labels.filter((_, face) => isAbove[face])), new Set(labels.filter((_, face) => !isAbove[face]))];
}

async function openWalls(segmentation: SegmentationTester, name: string, text: string): Promise<void> {
  await segmentation.page.setInputFiles('#wall-file', { name, mimeType: 'text/plain', buffer: Buffer.from(text) });
}

async function openPanel({ page }: SegmentationTester): Promise<void> {
  await page.getByText('Walls', { exact: false }).first().click();
  await expect(page.locator('#wall-angle')).toBeVisible();
}

function expectSidesOfCube(labels: number[]): void {
  const size = squares * squares;
  const labelsOfSide = Array.from({ length: 6 }, (_, side) => labels.slice(side * size, side * size + size));
  const all = labelsOfSide.flatMap((side) => [...new Set(side)]);
  expect(new Set(all).size).toBe(all.length); // none is on two sides
}

test('no part crosses edges sharper than the angle', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', cube(squares));
  await page.click('#tab-automatic');
  await openPanel(segmentation);
  await page.click('#compute');
  await expect(page.locator('#parts')).toHaveAttribute('min', '1');
  await page.locator('#wall-angle').fill('45');
  await expect(page.locator('#wall-count')).toHaveText(`${12 * squares} edges`);
  await page.click('#compute');
  await expect(page.locator('#parts')).toHaveAttribute('min', '6');
  await segmentation.screenshot('walls');
  for (const parts of ['6', '8']) {
    await page.locator('#parts').fill(parts);
    expectSidesOfCube((await segmentation.labels()) ?? []);
  }
  await page.getByText('Machine part').click();
  await page.click('#compute');
  await page.locator('#parts').fill('6');
  expectSidesOfCube((await segmentation.labels()) ?? []);
  await page.getByText('Natural shape').click();
  await page.locator('#wall-angle').fill('180');
  await expect(page.locator('#wall-count')).toHaveText('');
  await expect(page.locator('#parts')).toHaveAttribute('min', '1'); // the parts without walls are kept
  expect((await segmentation.engineCalls()).hierarchy).toBe(3);
});

test('no seed reaches faces behind walls', async ({ segmentation }) => {
  const { page } = segmentation;
  const mesh = bumpySphere(rings);
  await segmentation.openMesh('bumps.off', mesh);
  const box = (await page.locator('#canvas').boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const before = await segmentation.labelsAfter(null);
  expect(new Set(before).size).toBe(1);
  await openPanel(segmentation);
  await openWalls(segmentation, 'ring.txt', ringFile);
  const [above, below] = sides(mesh, await segmentation.labelsAfter(before));
  expect([above.size, below.size]).toEqual([1, 1]);
  expect(above).not.toEqual(below);
  await expect(page.locator('#wall-file-name')).toHaveText('ring.txt');
  await expect(page.locator('#wall-count')).toHaveText(`${2 * rings} edges`);
});

test('parts and their boundaries heed the walls of a file until it is removed', async ({ segmentation }) => {
  const { page } = segmentation;
  const mesh = bumpySphere(rings);
  await segmentation.openMesh('bumps.off', mesh);
  await page.click('#tab-automatic');
  await openPanel(segmentation);
  await openWalls(segmentation, 'ring.txt', ringFile);
  await expect(page.locator('#wall-count')).toHaveText(`${2 * rings} edges`);
  await page.click('#compute');
  await expect(page.locator('#parts')).toHaveAttribute('min', '2');
  for (const parts of ['2', '9']) {
    await page.locator('#parts').fill(parts);
    const [above, below] = sides(mesh, (await segmentation.labels()) ?? []);
    expect([...above].filter((label) => below.has(label))).toEqual([]);
  }
  await page.locator('#parts').fill('2');
  await expect.poll(() => page.evaluate(() => window.segmentationPage.curves())).toBe(1);
  await segmentation.screenshot('walls-of-a-file');
  await page.getByLabel('Remove the edges of the file').click();
  await expect(page.locator('#wall-count')).toHaveText('');
  await page.click('#compute');
  await expect(page.locator('#parts')).toHaveAttribute('min', '1');
});

test('a file of walls that cannot be is refused with its line, and the walls stay', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('bumps.off', bumpySphere(rings));
  await openPanel(segmentation);
  await openWalls(segmentation, 'ring.txt', ringFile);
  await expect(page.locator('#wall-count')).toHaveText(`${2 * rings} edges`);
  for (const [text, message] of [
    ['1 2\n1 500\n', 'wrong.txt:2: no edge of the mesh joins vertex 1 and vertex 500'],
    ['99999 1\n', 'wrong.txt:1: the file has'],
    ['1\n', 'wrong.txt:1: the second vertex is missing'],
  ]) {
    await openWalls(segmentation, 'wrong.txt', text);
    await expect(page.locator('#message-text')).toContainText(message);
    await expect(page.locator('#wall-file-name')).toHaveText('ring.txt');
    await page.click('#message-close');
  }
  await expect(page.locator('#wall-count')).toHaveText(`${2 * rings} edges`);
});

test('another mesh keeps the angle, but no edges of the file', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('bumps.off', bumpySphere(rings));
  await openPanel(segmentation);
  await page.locator('#wall-angle').fill('60');
  await openWalls(segmentation, 'ring.txt', ringFile);
  await expect(page.locator('#wall-file-name')).toHaveText('ring.txt');
  await segmentation.openMesh('cube.off', cube(squares));
  await expect(page.locator('#wall-file-name')).toBeHidden();
  await expect(page.locator('#wall-angle')).toHaveValue('60');
  await expect(page.locator('#wall-count')).toHaveText(`${12 * squares} edges`);
});

test('a file of walls that is chosen while a mesh is being opened is for that mesh', async ({ segmentation }) => {
  const { page } = segmentation;
  await openPanel(segmentation);
  const other = bumpySphere(24);
  await segmentation.holdEngine();
  await segmentation.open('other.off', offFile(other.points, other.faces));
  await openWalls(segmentation, 'edge.txt', other.faces[0].slice(0, 2).join(' '));
  await segmentation.releaseEngine();
  await expect(page.locator('#mesh-name')).toHaveText('other.off');
  await expect(page.locator('#wall-count')).toHaveText('1 edge');
  await expect(page.locator('#wall-file-name')).toHaveText('edge.txt');
});

test('walls that fail leave those of the engine', async () => {
  const { points, faces } = cube(squares);
  const engine = await engineWith('cube.off', offFile(points, faces));
  const count = (walls: { starts: ArrayLike<number> }) => walls.starts.length - 1;
  expect(count(answer(engine.setWalls({ ...noWalls, angle: 45 })))).toBe(12 * squares);
  expect(() => answer(engine.setWalls({ angle: null, file: { name: 'walls', text: '0 0' } }))).toThrow(/walls:1/);
  answer(engine.prepare(0.02, 1));
  answer(engine.addSeed(0, 0));
  expectSidesOfCube([...answer(engine.segment())]);
  expect(count(answer(engine.setWalls(noWalls)))).toBe(0);
});
