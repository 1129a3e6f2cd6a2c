// Opens pages that the program writes in a real browser, and does with them what people do:
//   node test/browser.mjs SESAME EXAMPLES [--shots FOLDER]
// Numbers on the page are compared with those of `replay --json`. Exit status 77: there is no browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [sesame, examples, , shots] = process.argv.slice(2);
const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);
if (!executablePath) {
  console.log("no chromium here");
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), "sesame-browser-"));
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});

/** A page with what was wrong on it, and the reports of the same replay. */
async function opened(script, { colorScheme = "light", viewport = { width: 1200, height: 900 } } = {}) {
  const html = join(folder, "page.html");
  const lines = execFileSync(sesame, ["replay", "--json", "--generators", "--every", "1", "--html", html, script], { encoding: "utf8" });
  const reports = lines.trim().split("\n").map(JSON.parse);
  const context = await browser.newContext({ colorScheme, viewport });
  const page = await context.newPage();
  const wrong = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && wrong.push(message.text()));
  page.on("pageerror", (error) => wrong.push(String(error)));
  page.on("request", (request) => request.url() !== pathToFileURL(html).href && wrong.push(`request of ${request.url()}`));
  await page.goto(pathToFileURL(html).href);
  await page.waitForSelector("#groups .group, #groups:empty", { state: "attached" });
  return { page, wrong, steps: reports.filter((report) => report.op), summary: reports.at(-1), close: () => context.close() };
}

function groups(report, ring) {
  return report.betti.map((betti, p) => {
    const parts = report.torsion[p].map((order) => `Z/${order}`);
    const free = betti === 1 ? ring : `${ring}^${betti}`;
    return `H${p} = ${(betti > 0 ? [free, ...parts] : parts).join(" + ") || "0"}`;
  });
}

const texts = (page, selector) => page.locator(selector).allTextContents();
const now = (page) => page.locator("#now").textContent();
/** How many pixels of the picture are none of the background. */
const drawnPixels = (page) =>
  page.evaluate(async () => {
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const from = document.getElementById("canvas");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [from.width, from.height];
    const context = copy.getContext("2d");
    context.drawImage(from, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) {
      count += Math.abs(data[k] - data[0]) + Math.abs(data[k + 1] - data[1]) + Math.abs(data[k + 2] - data[2]) > 24 ? 1 : 0;
    }
    return count;
  });
const shot = async (page, name) => shots && page.screenshot({ path: join(shots, `${name}.png`) });

const tests = {
  async "every step has the groups and cells that the program reports"() {
    for (const name of ["undo", "projective_plane", "cutting_a_torus", "product_of_circles"]) {
      const { page, wrong, steps, summary, close } = await opened(join(examples, `${name}.jsonl`));
      assert.equal(Number(await page.locator("#slider").getAttribute("max")), steps.length);
      for (const report of [...steps].reverse()) {
        assert.equal(await now(page), `${report.step} of ${steps.length}`);
        assert.deepEqual(await texts(page, "#groups .group"), groups(report, summary.ring), `${name}, step ${report.step}`);
        assert.match(await page.locator("#cells").textContent(), new RegExp(`Euler characteristic ${report.euler}$`));
        await page.keyboard.press("ArrowLeft");
      }
      assert.equal(await now(page), `0 of ${steps.length}`);
      assert.deepEqual(wrong, []);
      await close();
    }
  },
  async "the object is drawn, and another one at another step"() {
    const { page, wrong, steps, close } = await opened(join(examples, "torus.jsonl"));
    await shot(page, "torus");
    const torus = await drawnPixels(page);
    assert.ok(torus > 5000, `${torus} pixels`);
    await page.locator("#slider").fill("1");
    assert.equal(await now(page), `1 of ${steps.length}`);
    assert.match(await page.locator("#canvas").getAttribute("aria-label"), /after step 1: 4 vertices, 4 edges, 1 face/);
    assert.notEqual(await drawnPixels(page), torus);
    await page.keyboard.press("Home");
    await page.locator("#canvas").focus();
    await page.keyboard.press("Home");
    assert.ok((await drawnPixels(page)) < 100);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a click into the timeline, the list and the buttons goes to a step"() {
    const { page, wrong, steps, close } = await opened(join(examples, "torus.jsonl"));
    const box = await page.locator("#timeline").boundingBox();
    await page.mouse.click(box.x + 48, box.y + 60);
    assert.equal(await now(page), `0 of ${steps.length}`);
    await page.click("#forward");
    await page.click("#forward");
    await page.click("#back");
    assert.equal(await now(page), `1 of ${steps.length}`);
    await page.locator("#steps button").nth(4).click();
    assert.equal(await now(page), `5 of ${steps.length}`);
    assert.equal(await page.locator("#steps [aria-current]").count(), 1);
    await page.fill("#search", "class");
    assert.equal(await page.locator("#found").textContent(), `2 of ${steps.length} steps`);
    assert.equal(await page.locator("#steps li:visible").count(), 2);
    await page.locator("#title").click();
    await page.click("#first");
    await page.click("#play");
    await page.waitForFunction((last) => document.getElementById("now").textContent === `${last} of ${last}`, steps.length);
    await page.waitForFunction(() => document.getElementById("play").textContent === "play");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a generator is drawn and said, with what a multiple of it bounds"() {
    const { page, wrong, summary, close } = await opened(join(examples, "projective_plane.jsonl"));
    assert.equal(await page.locator("#generators button").count(), summary.generators.length);
    await page.keyboard.press("Home");
    const index = summary.generators.findIndex(({ order }) => order === 2);
    await page.locator("#generators button").nth(index).click();
    assert.match(await now(page), /^(\d+) of \1$/);
    const chains = await page.locator("#details textarea").evaluateAll((all) => all.map(({ value }) => JSON.parse(value)));
    assert.deepEqual(chains, [summary.generators[index].chain, summary.generators[index].bounds]);
    assert.match(await page.locator("#details").textContent(), /2 times it bounds/);
    await shot(page, "projective_plane");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a class step shows its chain and what that bounds"() {
    const { page, wrong, steps, close } = await opened(join(examples, "class_queries.jsonl"));
    const bounding = steps.find((report) => report.class?.bounds);
    await page.locator("#steps button").nth(bounding.step - 1).click();
    const chains = await page.locator("#details textarea").evaluateAll((all) => all.map(({ value }) => JSON.parse(value)));
    assert.deepEqual(chains[1], bounding.class.bounds);
    await shot(page, "class");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "what a script says is text on the page, whatever it says"() {
    const bad = "</script><script>document.title='broken'</script><img src=x onerror=alert(1)>";
    const script = join(folder, "bad.jsonl");
    writeFileSync(script, [{ sesame: 1, title: bad }, { op: "simplex", name: "<b>&amp;", dim: 1 }, { op: "note", text: bad }].map((line) => JSON.stringify(line)).join("\n"));
    const { page, wrong, close } = await opened(script);
    assert.equal(await page.locator("#title").textContent(), bad);
    assert.equal(await page.locator("img").count(), 0);
    assert.match(await page.locator("#steps").textContent(), /onerror/);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "it is dark where people want that, and fits on a phone"() {
    const { page, wrong, close } = await opened(join(examples, "klein_bottle.jsonl"), { colorScheme: "dark", viewport: { width: 390, height: 800 } });
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(21, 24, 28)");
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
    assert.ok((await drawnPixels(page)) > 2000);
    await shot(page, "phone");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a script without steps is a page, too"() {
    const script = join(folder, "empty.jsonl");
    writeFileSync(script, '{"sesame":1}\n');
    const { page, wrong, close } = await opened(script);
    assert.equal(await now(page), "0 of 0");
    assert.deepEqual(wrong, []);
    await close();
  },
};

let failed = 0;
for (const [name, run] of Object.entries(tests)) {
  try {
    await run();
    console.log(`ok: ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED: ${name}\n${error.stack}`);
  }
}
await browser.close();
rmSync(folder, { recursive: true });
process.exit(failed > 0 ? 1 : 0);
