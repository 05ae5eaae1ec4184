// SPDX-License-Identifier: MIT

import { gzipSync } from 'node:zlib';
import { labelFormats, meshFormats } from '../../src/files/formats';
import { cube, offFile, triangulated } from '../meshes';
import { expect, test, type SegmentationTester } from './fixture';

const n = 6;
const mesh = cube(n);
const middleOf = (side: number) => side * n * n + (n * n) / 2 + n / 2;

test.beforeEach(async ({ segmentation }) => {
  await segmentation.openMesh('cube.off', mesh);
  await segmentation.seed(middleOf(3), middleOf(5));
});

test('PLY files have the segments and colours, and can be opened', async ({ segmentation }) => {
  const labels = await segmentation.labels();
  const color = await segmentation.colorOf(middleOf(5));
  const { name, content } = await segmentation.savedAs('ply');
  expect(name).toBe('cube_segments.ply');
  const faces = facesOfPly(content);
  expect(faces.map((face) => face.segment)).toEqual(labels);
  expect(faces.map((face) => fromLowest(face.corners))).toEqual(mesh.faces.map(fromLowest));
  expect(faces[middleOf(5)].color).toEqual(color);
  await segmentation.open(name, content);
  await expect(segmentation.page.locator('#mesh-name')).toHaveText(name);
  expect(await segmentation.page.evaluate(() => window.segmentationPage.faces())).toBe(mesh.faces.length);
});

/** The corners of a polygon, beginning with the lowest. */
function fromLowest(corners: number[]): number[] {
  const start = corners.indexOf(Math.min(...corners));
  return [...corners.slice(start), ...corners.slice(0, start)];
}

/** The faces of a PLY file whose points are three doubles. */
function facesOfPly(file: Buffer): { corners: number[]; color: number[]; segment: number }[] {
  const end = file.indexOf('end_header\n') + 'end_header\n'.length;
  const count = (element: string) => Number(new RegExp(`element ${element} (\\d+)`).exec(file.toString('latin1'))?.[1]);
  let at = end + 24 * count('vertex');
  return Array.from({ length: count('face') }, () => {
    const degree = file.readUInt8(at);
    const corners = Array.from({ length: degree }, (_, i) => file.readInt32LE(at + 1 + 4 * i));
    at += 1 + 4 * degree;
    const face = { corners, color: [...file.subarray(at, at + 3)], segment: file.readUInt32LE(at + 3) };
    at += 7;
    return face;
  });
}

test('OBJ files have a group for each segment and come with their materials', async ({ segmentation }) => {
  const { page } = segmentation;
  const labels = (await segmentation.labels()) ?? [];
  const downloads: string[] = [];
  page.on('download', (download) => downloads.push(download.suggestedFilename()));
  const { name, content } = await segmentation.savedAs('obj');
  await expect.poll(() => downloads).toEqual(['cube_segments.obj', 'cube_segments.mtl']);
  const facesOfGroups = new Map<string, number>();
  let group = '';
  for (const line of content.toString().split('\n')) {
    if (line.startsWith('g ')) group = line.slice(2);
    if (line.startsWith('f ')) facesOfGroups.set(group, (facesOfGroups.get(group) ?? 0) + 1);
  }
  for (const label of [0, 1])
    expect(facesOfGroups.get(`segment_${label}`)).toBe(labels.filter((other) => other === label).length);
  await segmentation.open(name, content);
  await expect(page.locator('#mesh-name')).toHaveText(name);
  expect(await page.evaluate(() => window.segmentationPage.faces())).toBe(mesh.faces.length);
});

test('SEG files have the label of each face', async ({ segmentation }) => {
  const { name, content } = await segmentation.savedAs('seg');
  expect(name).toBe('cube.seg');
  expect(content.toString().trim().split('\n').map(Number)).toEqual(await segmentation.labels());
});

test('every format is offered, and those that the page does not open are saved', async ({ segmentation }) => {
  const all = [...meshFormats, ...labelFormats];
  const offered = await segmentation.page
    .locator('#save-format option')
    .evaluateAll((options) => options.map((option) => (option as HTMLOptionElement).value));
  expect(offered).toEqual(all.map(({ format }) => format));
  // The others are saved by tests of their own.
  for (const { format, ending } of all.filter(({ format }) => ['glb', 'csv', 'npz'].includes(format))) {
    const { name, content } = await segmentation.savedAs(format);
    expect(name).toBe(`cube${ending}`);
    expect(content.length, format).toBeGreaterThan(100);
  }
  await expect(segmentation.page.getByRole('alert')).toBeHidden();
  await segmentation.screenshot('formats');
});

for (const { format } of meshFormats.filter(({ format }) => format !== 'glb'))
  test(`a mesh saved as ${format} is opened again, packed by gzip or not`, async ({ segmentation }) => {
    const { page } = segmentation;
    const hasTriangles = ['stl', 'stl-text', '3mf', 'msh', 'mesh'].includes(format);
    const { name, content } = await segmentation.savedAs(format);
    for (const [fileName, bytes] of [
      [name, content],
      [`again_${name}.gz`, gzipSync(content)],
    ] as const) {
      await segmentation.open(fileName, bytes);
      await expect(page.locator('#mesh-name')).toHaveText(fileName);
      const faces = hasTriangles && format !== 'msh' ? triangulated(mesh).faces : mesh.faces;
      const found = await page.evaluate(() => window.segmentationPage.faces());
      expect([faces.length, triangulated(mesh).faces.length]).toContain(found);
    }
  });

test('a packed mesh that is cut off is refused, and what is saved of it has no .gz', async ({ segmentation }) => {
  const { page } = segmentation;
  const packed = gzipSync(offFile(mesh.points, mesh.faces));
  await segmentation.open('cut.off.gz', packed.subarray(0, packed.length / 2));
  await expect(page.getByRole('alert')).toContainText('The gzip file is broken or cut off.');
  await segmentation.open('whole.off.gz', packed);
  await expect(page.locator('#mesh-name')).toHaveText('whole.off.gz');
  await segmentation.seed(middleOf(3), middleOf(5));
  expect((await segmentation.savedAs('vtp')).name).toBe('whole_segments.vtp');
});

test('seeds are saved and loaded again, with names and colours, as an edit', async ({ segmentation }) => {
  const { page } = segmentation;
  await page.getByLabel('Name of label 2').fill('Front');
  await page.keyboard.press('Enter');
  const [labels, seeds] = [await segmentation.labels(), await segmentation.seeds()];
  const { name, content } = await segmentation.saved('#save-seeds');
  await page.click('#clear-seeds');
  await expect.poll(() => segmentation.labels()).toBeNull();
  await page.getByLabel('Name of label 2').fill('Other');
  await page.keyboard.press('Enter');
  await segmentation.open(name, content);
  await expect.poll(() => segmentation.labels()).toEqual(labels);
  expect(await segmentation.seeds()).toEqual(seeds);
  await expect(page.getByLabel('Name of label 2')).toHaveValue('Front');
  await page.click('#undo');
  await expect.poll(() => segmentation.labels()).toBeNull();
});

test('the picture shows the mesh', async ({ segmentation }) => {
  const { name, content } = await segmentation.saved('#save-picture');
  expect(name).toBe('cube.png');
  const colors = await segmentation.page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)).size;
  }, content.toString('base64'));
  expect(colors).toBeGreaterThan(3); // at least the ground and three sides
});

test('a mesh that comes while another one is being opened is opened after it', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.holdEngine();
  await segmentation.open('first.off', offFile(mesh.points, mesh.faces));
  await segmentation.open('skipped.off', offFile(mesh.points, mesh.faces));
  await segmentation.open('last.off', offFile(mesh.points, mesh.faces));
  await expect(page.locator('#opening')).toHaveText('Opening last.off …');
  await segmentation.releaseEngine();
  await expect(page.locator('#mesh-name')).toHaveText('last.off');
  await expect(page.locator('#opening')).toBeHidden();
  expect((await segmentation.engineCalls()).load).toBe(4); // with the page's own model and the cube
});

test('segments are not saved while the engine opens another mesh', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.holdEngine();
  await segmentation.open('other.off', offFile(mesh.points, mesh.faces));
  const [isPossible, isOpening] = await page.evaluate(() => [
    !document.querySelector<HTMLButtonElement>('#save-segments')!.disabled,
    !document.querySelector<HTMLElement>('#opening')!.hidden,
  ]);
  expect([isPossible, isOpening]).toEqual([false, true]);
});

/** Drops files on the page. */
async function drop({ page }: SegmentationTester, files: [name: string, content: string][]): Promise<void> {
  const dropped = await page.evaluateHandle((files) => {
    const transfer = new DataTransfer();
    for (const [name, content] of files) transfer.items.add(new File([content], name));
    return transfer;
  }, files);
  await page.dispatchEvent('#canvas', 'drop', { dataTransfer: dropped });
}

test('a mesh is dropped together with its seeds and materials', async ({ segmentation }) => {
  const { page } = segmentation;
  const other = cube(4);
  const seeds = JSON.stringify({
    format: 'RW_segmentation seeds',
    faces: other.faces.length,
    labels: [{ id: 0, name: 'Lid', color: '#0072b2' }],
    seeds: [{ face: 7, label: 0 }],
  });
  const obj = [
    ...other.points.map((point) => `v ${point.join(' ')}`),
    ...other.faces.map((face) => `f ${face.map((vertex) => vertex + 1).join(' ')}`),
  ].join('\n');
  await drop(segmentation, [
    ['a_seeds.json', seeds],
    ['b.mtl', 'newmtl a'],
    ['c.obj', obj],
  ]);
  await expect(page.locator('#mesh-name')).toHaveText('c.obj');
  await expect.poll(() => segmentation.seeds()).toEqual([[7, 0]]);
  await expect(page.getByRole('alert')).toBeHidden();
});

test('of several meshes that are dropped together none is opened, which is told', async ({ segmentation }) => {
  const off = offFile(mesh.points, mesh.faces);
  await drop(segmentation, [
    ['a.off', off],
    ['b.off', off],
  ]);
  await expect(segmentation.page.getByRole('alert')).toContainText('None of the 2 files was opened.');
  await expect(segmentation.page.locator('#mesh-name')).toHaveText('cube.off');
});

for (const [what, name, content, message] of [
  ['no mesh', 'notes.off', 'To whom it may concern', 'notes.off was not opened.'],
  ['a cut file', 'cut.off', offFile(mesh.points, mesh.faces).slice(0, 800), 'cut.off was not opened.'],
  ['an unknown format', 'mesh.docx', 'PK', 'mesh.docx was not opened.'],
  ['a 3MF file that is cut off', 'cut.3mf', 'PK\x03\x04', 'cut.3mf: the ZIP archive is cut off'],
  ['an empty file', 'empty.ply', '', 'empty.ply was not opened.'],
  ['seeds of another mesh', 'other.json', '{"format": "RW_segmentation seeds", "faces": 3}', 'a mesh of 3 faces'],
] as const)
  test(`${what} is refused with a message, and the former mesh stays`, async ({ segmentation }) => {
    const { page } = segmentation;
    const labels = await segmentation.labels();
    await segmentation.open(name, content);
    await expect(page.getByRole('alert')).toContainText(message);
    if (what === 'no mesh') await segmentation.screenshot('error');
    await expect(page.locator('#mesh-name')).toHaveText('cube.off');
    expect(await segmentation.labels()).toEqual(labels);
    await page.getByRole('button', { name: 'Close the message' }).click();
    await expect(page.getByRole('alert')).toBeHidden();
    await page.keyboard.press('3');
    await segmentation.clickFace(middleOf(4));
    await segmentation.labelsAfter(labels);
  });
