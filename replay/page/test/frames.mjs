// How quickly a page opens, and how fluid it is: node test/frames.mjs PAGE.html [--seconds S] [--size WIDTHxHEIGHT] [--press SELECTOR]
// In headless Chromium, where everything is drawn by the processor. Prints one JSON object: the milliseconds until the
// first picture is on the screen, reckoned from the navigation, and the frames per second while the camera is turned by
// the mouse. SELECTOR is clicked before that, to choose something. What other programs do at the time slows it down; the
// processor time that the browser takes for a frame, on Linux, does not depend on them. No test runs this.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser/harness.mjs";

/** Of all processes that this one has started, in milliseconds. */
function processorTime() {
  if (!existsSync("/proc/self/stat")) {
    return null;
  }
  const all = new Map();
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${id}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
      all.set(Number(id), { parent: Number(fields[1]), time: 10 * (Number(fields[11]) + Number(fields[12])) });
    } catch {
      // it has ended
    }
  }
  const isOurs = (id) => id === process.pid || (all.has(id) && isOurs(all.get(id).parent));
  return [...all].filter(([id]) => id !== process.pid && isOurs(id)).reduce((sum, [, { time }]) => sum + time, 0);
}

const words = process.argv.slice(2);
const option = (name, otherwise) => {
  const at = words.indexOf(name);
  return at >= 0 ? words.splice(at, 2)[1] : otherwise;
};
const seconds = Number(option("--seconds", "4"));
const [width, height] = option("--size", "1280x800").split("x").map(Number);
const press = option("--press", "");
const [html] = words;
const browser = html && (await Browser.start("", ""));
if (!browser) {
  console.log(html ? "no chromium here" : "node test/frames.mjs PAGE.html [--seconds S] [--size WIDTHxHEIGHT] [--press SELECTOR]");
  process.exit(html ? 77 : 1);
}
const context = await browser.chromium.newContext({ viewport: { width, height } });
const page = await context.newPage();
await page.addInitScript(() => {
  // A frame is a moment between two repaints at which something is drawn.
  const counts = { frames: 0, isDrawn: false, times: [] };
  globalThis.counts = counts;
  const tick = () => {
    if (counts.isDrawn) {
      ++counts.frames;
      counts.times.push(performance.now());
    }
    counts.isDrawn = false;
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
  for (const name of ["drawElements", "drawArrays", "drawElementsInstanced", "drawArraysInstanced"]) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...rest) {
      counts.isDrawn = true;
      return draw.apply(this, rest);
    };
  }
});
const busyAtFirst = processorTime();
await page.goto(pathToFileURL(html).href);
await page.waitForFunction(() => globalThis.counts.frames > 0);
const opened = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())))));
const busyWhenOpen = processorTime();
await (press && page.click(press));
const box = await page.locator("#canvas").boundingBox();
const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
await page.mouse.move(x, y);
await page.mouse.down();
await page.mouse.move(x + 5, y);
const turn = async (time) => {
  // As a hand does, a move each 8 ms, whether the browser has come to the one before or not: an answer waits for a frame.
  const start = Date.now();
  const waiting = new Set();
  for (let k = 0; Date.now() - start < time; ++k) {
    if (waiting.size < 8) {
      const move = page.mouse.move(x + 200 * Math.sin(k / 80), y + 60 * Math.cos(k / 80)).then(() => waiting.delete(move));
      waiting.add(move);
    }
    await new Promise((done) => setTimeout(done, 8));
  }
  await Promise.all(waiting);
};
await turn(1000); // until everything is warm
const frames = () => page.evaluate(() => ({ frames: globalThis.counts.frames, now: performance.now() }));
const before = await frames();
const busyBefore = processorTime();
await turn(1000 * seconds);
const busyAfter = processorTime();
const after = await frames();
const gaps = await page.evaluate((from) => globalThis.counts.times.filter((time) => time > from).map((time, k, all) => (k > 0 ? time - all[k - 1] : 0)), before.now);
await page.mouse.up();
const canvas = await page.evaluate(() => [document.getElementById("canvas").width, document.getElementById("canvas").height]);
console.log(JSON.stringify({
  opened_ms: Math.round(opened),
  processor_ms_to_open: busyWhenOpen && busyWhenOpen - busyAtFirst,
  frames_per_second: Number(((1000 * (after.frames - before.frames)) / (after.now - before.now)).toFixed(1)),
  processor_ms_per_frame: busyBefore && Number(((busyAfter - busyBefore) / (after.frames - before.frames)).toFixed(1)),
  longest_frame_ms: Math.round(Math.max(...gaps)),
  canvas,
}));
await browser.end();
