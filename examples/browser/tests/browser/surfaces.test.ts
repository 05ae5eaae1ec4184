// SPDX-License-Identifier: MIT

import { shaft } from '../meshes';
import { expect, test, type SegmentationTester } from './fixture';

const grey = [196, 202, 210];

/** The page with the surfaces of a shaft of two cylinders, of radii 2 and 1, and three planes. */
async function surfacesOfShaft(segmentation: SegmentationTester) {
  const { page } = segmentation;
  const mesh = shaft([2, 1]);
  await segmentation.openMesh('shaft.off', mesh);
  await page.click('#tab-automatic');
  await page.getByText('Machine part').click();
  await page.click('#compute');
  await expect(page.locator('#surface-rows tr')).toHaveCount(5);
  return mesh;
}

const columnOf = ({ page }: SegmentationTester, column: number) =>
  page.locator(`#surface-rows td:nth-child(${column})`).allTextContents();

/** A face of a side that can be seen. */
async function visibleFace({ page }: SegmentationTester, label: number): Promise<number> {
  const face = await page.evaluate((label) => {
    const { labels, placeOf } = window.segmentationPage;
    return labels()!.findIndex((other, face) => other === label && placeOf(face).isVisible);
  }, label);
  expect(face).toBeGreaterThanOrEqual(0);
  return face;
}

/** The label of the only row that has that text. */
const labelWith = async ({ page }: SegmentationTester, text: string) =>
  Number(await page.locator('#surface-rows tr', { hasText: text }).getAttribute('data-label'));

test('the table has each surface with its numbers, and is sorted by any of them', async ({ segmentation }) => {
  const { page } = segmentation;
  await surfacesOfShaft(segmentation);
  expect((await columnOf(segmentation, 2)).sort()).toEqual(['cylinder', 'cylinder', 'plane', 'plane', 'plane']);
  await page.getByRole('button', { name: 'Size' }).click();
  expect((await columnOf(segmentation, 3)).slice(0, 2)).toEqual(['r 2', 'r 1']);
  await expect(page.locator('th[data-column=size]')).toHaveAttribute('aria-sort', 'descending');
  await page.getByRole('button', { name: 'Size' }).press('Enter');
  expect((await columnOf(segmentation, 3)).slice(0, 2)).toEqual(['r 1', 'r 2']);
  await page.locator('th[data-column=area] button').click();
  const areas = (await columnOf(segmentation, 4)).map(Number);
  expect(areas).toEqual([...areas].sort((a, b) => b - a));
  expect(areas[0]).toBeCloseTo(2 * 48 * 2 * Math.sin(Math.PI / 48) * 2, 1);
  const faces = (await columnOf(segmentation, 5)).map((text) => Number(text.replaceAll(',', '')));
  expect(faces.reduce((sum, count) => sum + count, 0)).toBe(await page.evaluate(() => window.segmentationPage.faces()));
  await segmentation.screenshot('surfaces');
});

test('the surface under the pointer is told, and its row stands out', async ({ segmentation }) => {
  const { page } = segmentation;
  await surfacesOfShaft(segmentation);
  await expect(page.locator('#pointed-surface')).toBeHidden();
  const label = await labelWith(segmentation, 'r 2');
  const { x, y } = await segmentation.placeOf(await visibleFace(segmentation, label));
  await page.mouse.move(x, y);
  await expect(page.locator('#pointed-surface-title')).toHaveText(`Part ${label + 1}: cylinder`);
  await expect(page.locator('#pointed-surface-numbers')).toContainText(/radius2\.0000\d* ± /);
  await expect(page.locator('#pointed-surface-numbers')).toContainText('axis');
  await expect(page.locator('#surface-rows tr.is-pointed')).toHaveAttribute('data-label', String(label));
  await segmentation.screenshot('surface-under-pointer');
  await page.mouse.move(5, 5);
  await expect(page.locator('#pointed-surface')).toBeHidden();
  await page.locator('#canvas').press('Enter'); // at the cross in the middle
  await expect(page.locator('#pointed-surface')).toBeVisible();
});

test('types that are filtered out are grey', async ({ segmentation }) => {
  const { page } = segmentation;
  await surfacesOfShaft(segmentation);
  const label = await labelWith(segmentation, 'r 2');
  const labels = (await segmentation.labels())!;
  const faceOf = (label: number) => labels.indexOf(label);
  const plane = Number(await page.locator('#surface-rows tr', { hasText: 'plane' }).first().getAttribute('data-label'));
  await expect(page.locator('#surface-types label:visible')).toHaveText(['plane 3', 'cylinder 2']);
  const color = await segmentation.colorOf(faceOf(label));
  await page.getByLabel('plane').first().uncheck();
  await expect.poll(() => segmentation.colorOf(faceOf(plane))).toEqual(grey);
  expect(await segmentation.colorOf(faceOf(label))).toEqual(color);
  await expect(page.locator('#surface-rows tr.is-greyed')).toHaveCount(3);
  await segmentation.screenshot('surfaces-filtered');
  await page.getByLabel('plane').first().check();
  await expect.poll(() => segmentation.colorOf(faceOf(plane))).not.toEqual(grey);
});

test('a click on a row, or Enter, lets its part stand out and shows it', async ({ segmentation }) => {
  const { page } = segmentation;
  await surfacesOfShaft(segmentation);
  const labels = (await segmentation.labels())!;
  const colors = async () => {
    const faces = [...new Set(labels)].map((label) => labels.indexOf(label));
    return Promise.all(faces.map((face) => segmentation.colorOf(face)));
  };
  const before = await colors();
  for (const label of new Set(labels)) {
    const row = page.locator(`#surface-rows tr[data-label="${label}"]`);
    await row.getByRole('button').press('Enter');
    await expect(row).toHaveClass(/is-chosen/);
    await visibleFace(segmentation, label); // also what was behind
    const changed = (await colors()).map((color, i) => String(color) !== String(before[i]));
    expect(changed).toEqual([...new Set(labels)].map((other) => other !== label));
  }
  await segmentation.screenshot('surface-chosen');
  await page.locator('#surface-rows tr.is-chosen td').nth(1).click();
  await expect(page.locator('#surface-rows tr.is-chosen')).toHaveCount(0);
  expect(await colors()).toEqual(before);
});

test('surfaces are made regular within tolerances, and each snap is told', async ({ segmentation }) => {
  const { page } = segmentation;
  await surfacesOfShaft(segmentation);
  await page.getByText('Regular surfaces').click();
  await page.getByLabel('Make parallel').check();
  await expect(page.locator('#snaps li').first()).toContainText(/parallel|coaxial|perpendicular/);
  await expect(page.locator('#snaps li', { hasText: 'equal radius' })).toHaveCount(0);
  await page.getByLabel('Lengths off by').fill('1.5');
  await page.getByLabel('Lengths off by').press('Tab');
  await expect(page.locator('#snaps li', { hasText: 'equal radius' })).toContainText('off by 1');
  expect(new Set((await columnOf(segmentation, 3)).filter((text) => text !== '')).size).toBe(1);
  await segmentation.screenshot('surfaces-regular');
  await page.getByLabel('Make parallel').uncheck();
  await expect(page.locator('#snaps li')).toHaveCount(0);
  await expect(page.locator('#surface-rows tr')).toHaveCount(5); // fitted again
  expect((await columnOf(segmentation, 3)).filter((text) => text !== '').sort()).toEqual(['r 1', 'r 2']);
});

test('surfaces are as fitted again when a tolerance is wrong and the tick is taken away', async ({ segmentation }) => {
  const { page } = segmentation;
  await surfacesOfShaft(segmentation);
  await page.getByText('Regular surfaces').click();
  await page.getByLabel('Make parallel').check();
  await expect(page.locator('#snaps li').first()).toBeVisible();
  await page.getByLabel('Lengths off by').fill('-1');
  await page.getByLabel('Lengths off by').press('Tab');
  await page.getByLabel('Make parallel').uncheck();
  await expect(page.locator('#snaps li')).toHaveCount(0);
  await page.getByLabel('Make parallel').check(); // which asks for a number that can be
  await page.getByLabel('Lengths off by').fill('');
  await page.getByLabel('Lengths off by').press('Tab');
  await expect(page.locator('#snaps li').first()).toBeVisible();
  await expect(page.locator('#message')).toBeHidden();
});

test('surfaces are fitted though parts that were looked for meanwhile are cancelled', async ({ segmentation }) => {
  const { page } = segmentation;
  const { points, faces } = shaft([1, 2, 3], 600);
  await segmentation.openMesh('shaft.off', { points, faces });
  await page.click('#tab-automatic');
  await page.getByText('Machine part').click();
  await page.click('#compute');
  await expect(page.locator('#surface-rows tr').first()).toBeVisible();
  await page.getByText('Natural shape').click();
  await page.getByText('How parts are found').click();
  await page.getByLabel('Faces differ by').selectOption('curvature');
  await page.locator('#radius').fill('10'); // takes long
  await page.click('#compute');
  await page.getByText('Machine part').click();
  await expect(page.locator('#finding-surfaces')).toBeVisible();
  await page.click('#cancel');
  await expect(page.locator('#surface-rows tr').first()).toBeVisible();
  await expect.poll(() => page.evaluate(() => window.segmentationPage.curves())).toBeGreaterThan(0);
});

test('surfaces follow the number of parts, and natural shapes have none', async ({ segmentation }) => {
  const { page } = segmentation;
  await surfacesOfShaft(segmentation);
  await page.locator('#parts').fill('4');
  await expect(page.locator('#surface-rows tr')).toHaveCount(4);
  await page.getByText('Natural shape').click();
  await expect(page.locator('#surfaces-section')).toBeHidden();
});

test('the report has the surfaces', async ({ segmentation }) => {
  await surfacesOfShaft(segmentation);
  const { name, content } = await segmentation.saved('#save-report');
  expect(name).toBe('shaft_report.json');
  const report = JSON.parse(content.toString());
  const radii = report.segments.flatMap(({ surface }: { surface: { radius?: number } }) => surface.radius ?? []);
  expect(radii.map((radius: number) => radius.toFixed(6)).sort()).toEqual(['1.000000', '2.000000']);
});
