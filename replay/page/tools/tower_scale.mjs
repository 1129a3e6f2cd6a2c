// How long the page of a large tower takes to open, and how fluid it is then: node tools/tower_scale.mjs PAGE.html
// Chromium without a graphics card, 1280 x 800. Times are from the beginning of the navigation, and between frames.
import { pathToFileURL } from "node:url";
import { Browser } from "../test/browser/harness.mjs";

const browser = await Browser.start("", "");
const url = pathToFileURL(process.argv[2]).href;
const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())))));

/** Frames that somebody sees while he does something, in ms. */
async function frames(page, what, act) {
  await page.evaluate(() => {
    window.frameTimes = [];
    window.isWatched = true;
    let last = performance.now();
    const tick = (now) => {
      window.frameTimes.push(now - last);
      last = now;
      window.isWatched && requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  });
  await act();
  const times = await page.evaluate(() => ((window.isWatched = false), window.frameTimes.slice(1)));
  times.sort((a, b) => a - b);
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
  console.log(`${what}: ${times.length} frames, median ${at(0.5)} ms, 95 % ${at(0.95)} ms, longest ${at(1)} ms`);
}

// The browser's own beginning is not the page's.
await (await browser.goTo("about:blank", { allowed: () => true })).close();
for (let run = 0; run < 3; ++run) {
  const { page, wrong, close } = await browser.goTo(url, { viewport: { width: 1280, height: 800 } });
  const opened = await settled(page);
  console.log(`opened after ${opened.toFixed(0)} ms; heap ${await page.evaluate(() => Math.round(performance.memory.usedJSHeapSize / 1e6))} MB; wrong: ${wrong.length}`);
  if (run === 2) {
    const centre = async (id) => {
      await page.locator(`#${id} .marks`).scrollIntoViewIfNeeded();
      const box = await page.locator(`#${id} .marks`).boundingBox();
      return (x, y) => [box.x + x * box.width, box.y + y * box.height];
    };
    for (const id of ["barcode", "diagram", "betti"]) {
      const at = await centre(id);
      await frames(page, `pointing at ${id}`, async () => {
        for (let k = 0; k < 90; ++k) {
          await page.mouse.move(...at(0.2 + 0.006 * k, 0.2 + 0.005 * k));
        }
      });
      await page.mouse.move(...at(0.3, 0.3));
      await page.mouse.down();
      await frames(page, `dragging over ${id}`, async () => {
        for (let k = 0; k < 60; ++k) {
          await page.mouse.move(...at(0.3 + 0.006 * k, 0.3 + 0.006 * k));
        }
      });
      await page.mouse.up();
      await settled(page);
      await page.locator("#all-bars").click();
      await settled(page);
    }
  }
  await close();
}
await browser.end();
