// SPDX-License-Identifier: MIT

import { bumpySphere, cube, offFile } from '../meshes';
import { segmentsAtLevel } from '../../src/model/mergeTree';
import { defaultPolicies } from '../../src/worker/calls';
import type { AutomaticMethod } from '../../src/worker/EngineModule';
import { answer, engineWith, expect, test, type SegmentationTester } from './fixture';

/** Lets the page find the parts of a bumpy sphere, and the engine by itself. */
async function partsOfBumps(segmentation: SegmentationTester) {
  const mesh = bumpySphere(24);
  await segmentation.openMesh('bumps.off', mesh);
  await segmentation.page.click('#tab-automatic');
  await segmentation.page.click('#compute');
  await expect(segmentation.page.locator('#parts')).toBeVisible();
  const engine = await engineWith('bumps.off', offFile(mesh.points, mesh.faces));
  return answer(engine.hierarchy({ kind: 'graphical', ...defaultPolicies }, () => true));
}

test('the slider gives as many parts as it says, and the walk runs once', async ({ segmentation }) => {
  const { page } = segmentation;
  await page.click('#tab-automatic');
  await page.click('#compute');
  const slider = page.locator('#parts');
  await expect(slider).toBeVisible();
  const suggested = Number(await slider.inputValue());
  expect(new Set(await segmentation.labels()).size).toBe(suggested);
  await segmentation.screenshot('automatic');
  const [fewest, most] = [Number(await slider.getAttribute('min')), Number(await slider.getAttribute('max'))];
  for (const parts of [fewest, fewest + 1, Math.min(9, most), most]) {
    await slider.fill(String(parts));
    expect(new Set(await segmentation.labels()).size).toBe(parts);
    await expect(page.locator('#segment-count')).toHaveText(String(parts));
  }
  const calls = await segmentation.engineCalls();
  expect(calls.hierarchy).toBe(1);
  expect(calls.segment).toBeUndefined();
});

test('the slider marks the numbers of parts that people may prefer', async ({ segmentation }) => {
  const { page } = segmentation;
  const { levels, suggested } = await partsOfBumps(segmentation);
  expect(levels.length).toBeGreaterThan(1);
  const marks = await page
    .locator('#levels option')
    .evaluateAll((list) => list.map((o) => (o as HTMLOptionElement).value));
  expect(marks).toEqual(Array.from(levels, String));
  for (const parts of Array.from(levels)) await expect(page.locator('#level-remark')).toContainText(String(parts));
  expect(Array.from(levels)).toContain(suggested);
});

test('the engine of the background starts when parts are first sought', async ({ segmentation }) => {
  const { page } = segmentation;
  expect(page.workers()).toHaveLength(1);
  await page.click('#tab-automatic');
  await page.click('#compute');
  await expect(page.locator('#parts')).toBeVisible();
  expect(page.workers()).toHaveLength(2);
});

test('the parts are those that the engine finds', async ({ segmentation }) => {
  const { page } = segmentation;
  const { fragmentOfFace, fragments, suggested } = await partsOfBumps(segmentation);
  expect(new Set(await segmentation.labels()).size).toBe(suggested);
  if (fragments <= 200) {
    await page.locator('#parts').fill(String(fragments));
    const pairs = new Set((await segmentation.labels())?.map((label, face) => `${label} ${fragmentOfFace[face]}`));
    expect(pairs.size).toBe(fragments);
  }
});

test('machine parts have a hierarchy of their own', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('cube.off', cube(12));
  await page.click('#tab-automatic');
  await page.getByText('Machine part').click();
  await page.click('#compute');
  await page.locator('#parts').fill('6');
  const labels = (await segmentation.labels()) ?? [];
  expect(new Set(labels).size).toBe(6);
  for (let side = 0; side < 6; ++side) expect(new Set(labels.slice(side * 144, side * 144 + 144)).size).toBe(1);
  await page.getByText('Natural shape').click();
  await expect(page.locator('#compute')).toBeVisible();
});

test('each choice of policies has a hierarchy of its own, which is kept', async ({ segmentation }) => {
  const { page } = segmentation;
  const mesh = bumpySphere(24);
  await segmentation.openMesh('bumps.off', mesh);
  await page.click('#tab-automatic');
  await page.getByText('How parts are found').click();
  await segmentation.screenshot('policies');
  const engine = await engineWith('bumps.off', offFile(mesh.points, mesh.faces));
  let policies = { ...defaultPolicies };
  for (const [label, choice] of [
    ['Faces differ by', { difference: 'curvature' }],
    ['Seeds lie', { seeding: 'coarse' }],
    ['Merged first are', { mergeCost: 'boundary' }],
  ] as const) {
    policies = { ...policies, ...choice };
    await page.getByLabel(label).selectOption(Object.values(choice)[0]);
    await page.click('#compute');
    await expect(page.locator('#parts')).toBeVisible();
    const { suggested } = answer(engine.hierarchy({ kind: 'graphical', ...policies }, () => true));
    expect(new Set(await segmentation.labels()).size).toBe(suggested);
  }
  await page.getByLabel('Merged first are').selectOption(defaultPolicies.mergeCost);
  await expect(page.locator('#parts')).toBeVisible();
  expect((await segmentation.engineCalls()).hierarchy).toBe(3);
  await page.getByText('Machine part').click();
  await expect(page.getByText('How parts are found')).toBeHidden();
});

test('curvatures have a radius, which changes the parts', async ({ segmentation }) => {
  const { page } = segmentation;
  const mesh = bumpySphere(24);
  await segmentation.openMesh('bumps.off', mesh);
  await page.click('#tab-automatic');
  await page.getByText('How parts are found').click();
  await expect(page.locator('#radius')).toBeHidden();
  await page.getByLabel('Faces differ by').selectOption('curvature');
  const engine = await engineWith('bumps.off', offFile(mesh.points, mesh.faces));
  const answers: (number[] | null)[] = [];
  for (const radius of [3, 6]) {
    await page.locator('#radius').fill(String(radius));
    await expect(page.locator('#radius-value')).toHaveText(`${radius} edges`);
    await page.click('#compute');
    await page.locator('#parts').fill('9');
    const method: AutomaticMethod = { kind: 'graphical', ...defaultPolicies, difference: 'curvature', radius };
    const hierarchy = answer(engine.hierarchy(method, () => true));
    answers.push(await segmentation.labels());
    expect(answers.at(-1)).toEqual([...segmentsAtLevel(hierarchy, 9)]);
  }
  expect(answers[0]).not.toEqual(answers[1]);
  await segmentation.screenshot('radius');
});

test('a computation can be cancelled, and the page goes on as before', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('bumps.off', bumpySphere(224));
  await page.click('#tab-automatic');
  await page.click('#compute');
  await page.click('#cancel');
  await expect(page.locator('#compute')).toBeVisible();
  await expect(page.locator('#message')).toBeHidden();
  expect(await segmentation.labels()).toBeNull();
  await page.click('#tab-seeds');
  const box = (await page.locator('#canvas').boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  expect(new Set(await segmentation.labelsAfter(null))).toEqual(new Set([0]));
});

test('what the user chooses while parts are sought stays chosen, and the parts are kept', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('bumps.off', bumpySphere(24));
  await page.click('#tab-automatic');
  await page.getByText('How parts are found').click();
  await segmentation.holdEngine();
  await page.click('#compute');
  await page.getByLabel('Merged first are').selectOption('size');
  await page.getByText('Machine part').click();
  await expect(page.locator('#progress')).toBeVisible();
  await segmentation.releaseEngine();
  await expect(page.locator('#progress')).toBeHidden();
  await expect(page.getByLabel('Machine part')).toBeChecked();
  await expect(page.locator('#compute')).toBeVisible();
  await page.getByText('Natural shape').click();
  await expect(page.getByLabel('Merged first are')).toHaveValue('size');
  await page.getByLabel('Merged first are').selectOption(defaultPolicies.mergeCost);
  await expect(page.locator('#parts')).toBeVisible();
});

test('segments of seeds that are hidden while parts are sought stay hidden', async ({ segmentation }) => {
  const { page } = segmentation;
  await segmentation.openMesh('bumps.off', bumpySphere(60));
  const box = (await page.locator('#canvas').boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await expect(page.locator('#segments > li')).toHaveCount(1);
  await page.evaluate(() => {
    for (const button of ['#tab-automatic', '#compute', '#tab-seeds', '#segments [aria-label="Hide Part 1"]'])
      document.querySelector<HTMLElement>(button)!.click();
  });
  await expect(page.getByRole('button', { name: 'Show Part 1' })).toBeVisible();
  await expect.poll(() => page.evaluate(() => document.getElementById('level')!.hidden)).toBe(false); // found
  await expect(page.getByRole('button', { name: 'Show Part 1' })).toBeVisible();
});

test('parts are sought only after another mesh has been opened', async ({ segmentation }) => {
  const { page } = segmentation;
  await page.click('#tab-automatic');
  const large = bumpySphere(120);
  await segmentation.holdEngine();
  await segmentation.open('large.off', offFile(large.points, large.faces));
  await expect(page.locator('#compute')).toBeDisabled();
  await segmentation.releaseEngine();
  await page.click('#compute');
  await expect(page.locator('#mesh-name')).toHaveText('large.off');
  await expect(page.locator('#progress')).toBeVisible();
  await page.click('#cancel');
});
