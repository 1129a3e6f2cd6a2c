// The pictures of the README are what the pages look like today.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { makePictures } from "../../tools/pictures.mjs";

/** The share of pixels that are not the same in two pictures, or 1 when they are not of one size. */
async function difference(page, one, other) {
  return page.evaluate(async (files) => {
    const [a, b] = await Promise.all(
      files.map(async (file) => {
        const image = new Image();
        image.src = `data:image/png;base64,${file}`;
        await image.decode();
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [image.width, image.height];
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, image.width, image.height);
      }),
    );
    if (a.width !== b.width || a.height !== b.height) {
      return 1;
    }
    let count = 0;
    for (let k = 0; k < a.data.length; k += 4) {
      count += [0, 1, 2].some((part) => Math.abs(a.data[k + part] - b.data[k + part]) > 40) ? 1 : 0;
    }
    return (4 * count) / a.data.length;
  }, [one, other].map((file) => readFileSync(file, "base64")));
}

export const short = {};

export const long = {
  async "the pictures of the README are those of the pages, but for fonts"(browser) {
    const kept = join(browser.examples, "pictures");
    const { shots } = browser;
    browser.shots = browser.folder;
    try {
      await makePictures(browser);
    } finally {
      browser.shots = shots;
    }
    const { page, close } = await browser.goTo("about:blank", { allowed: () => true });
    for (const name of ["torus_page.png", "tower_page.png", "mesh_page.png"]) {
      const share = await difference(page, browser.file(name), join(kept, name));
      assert.ok(share < 0.04, `${name}: ${(100 * share).toFixed(2)} % of the pixels are others; tools/pictures.mjs makes them anew`);
      console.log(`  ${name}: ${(100 * share).toFixed(2)} % of the pixels differ`);
    }
    const apart = await difference(page, join(kept, "torus_page.png"), join(kept, "mesh_page.png"));
    assert.ok(apart > 0.08, `two different pages differ in ${(100 * apart).toFixed(2)} % only`);
    await close();
  },
};
