// SPDX-License-Identifier: MIT

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { defaultPolicies } from '../../src/worker/calls';
import type {
  AutomaticMethod,
  Engine,
  FoundSurfaces,
  MeshData,
  Regularity,
  Surface,
  Walls,
} from '../../src/worker/EngineModule';
import { labelFormats, meshFormats } from '../../src/files/formats';
import { answer, engineModule, engineWith, expect, pageFile, test } from '../browser/fixture';
import { bumpySphere, cube, offFile } from '../meshes';
import { segmentsAtLevel } from '../../src/model/mergeTree';

// What the page's engine and the tool segment_mesh, the same headers compiled natively, make of the same files.

const tool = process.env.SEGMENT_MESH;
if (!tool) throw new Error('SEGMENT_MESH must be the path of the tool segment_mesh');

let folder = '';
test.beforeEach(() => void (folder = mkdtempSync(join(tmpdir(), 'page-'))));
test.afterEach(() => rmSync(folder, { recursive: true }));

function segmentNatively(...options: string[]): void {
  execFileSync(tool!, ['mesh.off', '--quiet', ...options], { cwd: folder });
}

const labelsIn = (file: string): number[] => readFileSync(join(folder, file), 'utf8').trim().split('\n').map(Number);

function fileOf({ positions, triangles }: MeshData): string {
  const rows = (numbers: ArrayLike<number>, before: string) =>
    Array.from(
      { length: numbers.length / 3 },
      (_, i) => `${before}${numbers[3 * i]} ${numbers[3 * i + 1]} ${numbers[3 * i + 2]}`,
    );
  return [
    'OFF',
    `${positions.length / 3} ${triangles.length / 3} 0`,
    ...rows(positions, ''),
    ...rows(triangles, '3 '),
  ].join('\n');
}

/**
 * The engine with a generated mesh that is also the file mesh.off in the folder.
 *
 * @param noise that each coordinate may be off by
 */
async function engineWithModel(model: string, noise = 0): Promise<{ engine: Engine; faces: number }> {
  const module = await engineModule();
  const mesh = answer(answer(module.generateMesh(model)).mesh());
  const positions = mesh.positions.map((x, i) => x + noise * Math.sin(i * i));
  const content = fileOf({ ...mesh, positions });
  writeFileSync(join(folder, 'mesh.off'), content);
  const engine = answer(module.readMesh(new TextEncoder().encode(content), 'mesh.off'));
  return { engine, faces: answer(engine.mesh()).faces };
}

for (const model of ['hand', 'quadruped', 'turned shaft'])
  test(`seeds give ${model} the labels that they give natively`, async () => {
    const { engine, faces } = await engineWithModel(model);
    answer(engine.prepare(0.02, 1));
    const seeds = [0.05, 0.3, 0.5, 0.7, 0.95].map((part) => Math.floor(part * faces));
    for (const [label, face] of seeds.entries()) {
      answer(engine.addSeed(face, label));
      answer(engine.segment());
      answer(engine.anticipate());
    }
    segmentNatively(...seeds.flatMap((face) => ['--seed', String(face)]), '--labels', 'labels.seg');
    expect([...answer(engine.segment())]).toEqual(labelsIn('labels.seg'));
  });

for (const [model, choices, options] of [
  ['hand', { kind: 'graphical' }, []],
  ['quadruped', { kind: 'graphical' }, []],
  ['hand', { difference: 'dihedral', seeding: 'particles' }, ['--difference', 'dihedral', '--seeding', 'particles']],
  ['hand', { difference: 'curvature' }, ['--difference', 'curvature']],
  ['hand', { difference: 'curvature', radius: 5 }, ['--difference', 'curvature', '--radius', '5']],
  ['hand', { mergeCost: 'size' }, ['--merge-cost', 'size']],
  ['quadruped', { seeding: 'coarse', mergeCost: 'boundary' }, ['--seeding', 'coarse', '--merge-cost', 'boundary']],
  ['turned shaft', { kind: 'engineering' }, ['--engineering']],
] as [string, Partial<AutomaticMethod>, string[]][])
  test(`${model} has the parts that it has natively: ${Object.values(choices).join(', ')}`, async () => {
    const { engine } = await engineWithModel(model);
    const method: AutomaticMethod = { kind: 'graphical', ...defaultPolicies, ...choices };
    const hierarchy = answer(engine.hierarchy(method, () => true));
    segmentNatively(...options, '--labels', 'labels.seg');
    expect([...segmentsAtLevel(hierarchy, hierarchy.suggested)]).toEqual(labelsIn('labels.seg'));
  });

for (const [model, walls, options] of [
  ['turned shaft', { angle: 40, file: null }, ['--constraints-angle', '40']],
  ['hand', { angle: 60, file: { name: 'walls.txt', text: '' } }, ['--constraints-angle', '60']],
  ['hand', { angle: null, file: { name: 'walls.txt', text: '' } }, ['--constraints', 'walls.txt']],
] as [string, Walls, string[]][])
  test(`walls of ${model} are those that it has natively: ${options.join(' ')}`, async () => {
    const { engine } = await engineWithModel(model);
    const { triangles } = answer(engine.mesh());
    if (walls.file) walls.file.text = `${triangles[0]} ${triangles[1]}\n${triangles[300]} ${triangles[301]} # another`;
    writeFileSync(join(folder, 'walls.txt'), walls.file?.text ?? '');
    const edges = answer(engine.setWalls(walls)).starts.length - 1;
    if (walls.file && walls.angle !== null) options.push('--constraints', 'walls.txt');
    segmentNatively(...options, '--labels', 'labels.seg', '--report', 'report.json');
    const report = JSON.parse(readFileSync(join(folder, 'report.json'), 'utf8')) as { walls: number };
    expect(edges).toBeGreaterThan(0);
    expect(edges).toBe(report.walls);
    const hierarchy = answer(engine.hierarchy({ kind: 'graphical', ...defaultPolicies }, () => true));
    expect([...segmentsAtLevel(hierarchy, hierarchy.suggested)]).toEqual(labelsIn('labels.seg'));
  });

/** The report of the tool, as far as it tells surfaces. */
interface Report {
  segments: { label: number; faces: number; area_share: number; surface: Surface }[];
  regular?: FoundSurfaces['regular'];
}

const readReport = () => JSON.parse(readFileSync(join(folder, 'report.json'), 'utf8')) as Report;

/** Far below the standard errors of surfaces with noise: fits end where a step gains nothing, not at the last digit. */
const sameNumber = 1e-7;

/** Expects the same names, and nearly the same numbers: the two are compiled to other instructions. */
function expectSame(here: unknown, there: unknown, name = ''): void {
  if (typeof there === 'number') {
    expect(Math.abs((here as number) - there), name).toBeLessThan(sameNumber * Math.max(1, Math.abs(there)));
  } else if (typeof there === 'object' && there !== null) {
    expect(Object.keys(here as object), name).toEqual(Object.keys(there));
    for (const [key, value] of Object.entries(there))
      expectSame((here as Record<string, unknown>)[key], value, `${name}.${key}`);
  } else {
    expect(here, name).toBe(there);
  }
}

// With noise, so that means are weighted by errors of the fits instead of those of rounding.
for (const [regularity, options] of [
  [null, []],
  [{ length: null, angle: null }, ['--regular']],
  [{ length: 0.1, angle: 2 }, ['--regular', '--regular-length', '0.1', '--regular-angle', '2']],
] as [Regularity | null, string[]][])
  test(`surfaces of the turned shaft are those of the report: ${options.join(' ')}`, async () => {
    const { engine } = await engineWithModel('turned shaft', 2e-4);
    segmentNatively('--engineering', ...options, '--labels', 'labels.seg', '--report', 'report.json');
    const found = answer(engine.surfaces(Uint32Array.from(labelsIn('labels.seg')), regularity));
    const { surfaces, regular } = JSON.parse(found) as FoundSurfaces;
    const report = readReport();
    for (const { surface } of report.segments)
      for (const error of Object.values('errors' in surface ? surface.errors : {}))
        expect(error).toBeGreaterThan(10 * sameNumber);
    expectSame(
      surfaces,
      report.segments.map(({ surface }) => surface),
    );
    expectSame(regular, report.regular ?? []);
  });

test('a page that the tool writes has its surfaces, and saves its report', async ({ segmentation }) => {
  await engineWithModel('turned shaft');
  const options = ['--engineering', '--regular', '--regular-length', '0.1', '--regular-angle', '2'];
  segmentNatively(...options, '--html', 'result.html', '--page', pageFile, '--report', 'report.json');
  const { page } = segmentation;
  await segmentation.goto(pathToFileURL(join(folder, 'result.html')).href);
  const tool = readReport();
  await expect(page.locator('#surface-rows tr')).toHaveCount(tool.segments.length);
  await expect(page.locator('#regular')).toBeChecked();
  await expect(page.locator('#regular-length')).toHaveValue('0.1');
  await expect(page.locator('#regular-angle')).toHaveValue('2');
  await expect(page.locator('#snaps li')).toHaveCount(tool.regular?.length ?? 0);
  expect((await segmentation.engineCalls()).surfaces ?? 0).toBe(0); // nothing is fitted anew
  const saved = JSON.parse((await segmentation.saved('#save-report')).content.toString()) as Report;
  expect(saved.segments.map(({ surface }) => surface)).toEqual(tool.segments.map(({ surface }) => surface));
  expect(saved.regular).toEqual(tool.regular);
  for (const [i, { label, faces, area_share }] of tool.segments.entries()) {
    expect([saved.segments[i].label, saved.segments[i].faces]).toEqual([label, faces]);
    expect(saved.segments[i].area_share).toBeCloseTo(area_share, 9);
  }
  await segmentation.screenshot('surfaces-written-by-the-tool');
});

test('every file is byte for byte what the tool writes', async () => {
  const { points, faces } = cube(6);
  const off = offFile(points, faces);
  writeFileSync(join(folder, 'mesh.off'), off);
  const seeds = ['--seed', '20=3', '--seed', '120=0', '--seed', '200=7'];
  segmentNatively(...seeds, '--labels', 'mesh.seg', '--report', 'report.json');
  const labels = Uint32Array.from(labelsIn('mesh.seg'));
  const report = JSON.parse(readFileSync(join(folder, 'report.json'), 'utf8')) as {
    segments: { label: number; color: number[] }[];
  };
  const colors = Uint32Array.from(report.segments.flatMap(({ label, color }) => [label, ...color]));
  const engine = await engineWith('mesh.off', off);
  const formats = [...meshFormats, ...labelFormats].map(({ format }) => format);
  for (const format of [...formats, 'mtl'] as const) {
    const name = format === 'stl-text' ? 'text.stl' : `out.${format}`;
    if (labelFormats.some((other) => other.format === format)) segmentNatively(...seeds, '--labels', name);
    else if (format === 'stl-text') segmentNatively(...seeds, '-o', name, '--output-format', format);
    else if (format !== 'mtl') segmentNatively(...seeds, '-o', name); // that of OBJ comes with materials
    const written = Buffer.from(answer(engine.file(format, name, 'out.mtl', labels, colors)));
    expect(written.equals(readFileSync(join(folder, name))), format).toBe(true);
  }
});

test('a page that the tool writes has its walls and its policies', async ({ segmentation }) => {
  await engineWithModel('turned shaft');
  const options = ['--constraints-angle', '40', '--difference', 'curvature', '--radius', '4'];
  segmentNatively(...options, '--html', 'result.html', '--page', pageFile, '--report', 'report.json');
  const report = JSON.parse(readFileSync(join(folder, 'report.json'), 'utf8')) as { walls: number };
  const { page } = segmentation;
  await segmentation.goto(pathToFileURL(join(folder, 'result.html')).href);
  await expect(page.locator('#wall-file-name')).toHaveText('Walls of mesh.off');
  await expect(page.locator('#wall-count')).toHaveText(`${report.walls.toLocaleString('en')} edges`);
  await expect(page.locator('#radius')).toHaveValue('4');
  await expect(page.locator('#parts')).toBeVisible(); // nothing is to be found anew
});

test('a page that the tool writes shows what the tool found', async ({ segmentation }) => {
  await engineWithModel('quadruped');
  segmentNatively('--html', 'result.html', '--page', pageFile, '--labels', 'labels.seg');
  await segmentation.goto(pathToFileURL(join(folder, 'result.html')).href);
  await expect(segmentation.page.locator('#mesh-name')).toHaveText('mesh.off');
  await expect.poll(() => segmentation.labels()).toEqual(labelsIn('labels.seg'));
  await segmentation.screenshot('written-by-the-tool');
});

for (const options of [[], ['--engineering']])
  test(`a page shows segments as they are cut along their smooth boundaries: ${options.join()}`, async ({
    segmentation,
  }) => {
    const { points, faces } = bumpySphere(24);
    writeFileSync(join(folder, 'mesh.off'), offFile(points, faces));
    segmentNatively('--refine', ...options, '--html', 'result.html', '--page', pageFile, '--labels', 'labels.seg');
    await segmentation.goto(pathToFileURL(join(folder, 'result.html')).href);
    expect(labelsIn('labels.seg').length).toBeGreaterThan(faces.length);
    await expect.poll(() => segmentation.labels()).toEqual(labelsIn('labels.seg'));
  });
