// SPDX-License-Identifier: MIT

import { pathToFileURL } from 'node:url';
import { expect, test } from '../browser/fixture';

// Not a test: makes the picture PICTURE of the page PAGE, for the manual and the README, after the KEYS were pressed.

const { PAGE, PICTURE, KEYS = '' } = process.env;
if (!PAGE || !PICTURE) throw new Error('PAGE and PICTURE must be the paths of a page and of its picture');

test('picture', async ({ segmentation }) => {
  await segmentation.goto(pathToFileURL(PAGE).href);
  await expect.poll(() => segmentation.labels()).not.toBeNull();
  for (const key of KEYS) await segmentation.page.keyboard.press(key);
  await segmentation.page.waitForTimeout(3000); // until the boundaries are drawn
  await segmentation.page.screenshot({ path: PICTURE });
});
