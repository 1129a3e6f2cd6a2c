// The page of a replay. Numbers on it are compared with those of `replay --json`.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { drawnPixels, texts } from "./harness.mjs";

/** The page of a script, and the reports of the same replay. */
async function opened(browser, script, options) {
  const html = browser.file("page.html");
  const lines = browser.run("replay", "--json", "--generators", "--every", "1", "--html", html, script);
  const reports = lines.trim().split("\n").map(JSON.parse);
  const opened = await browser.open(html, options);
  await opened.page.waitForSelector("#groups .group, #groups:empty", { state: "attached" });
  return { ...opened, steps: reports.filter((report) => report.op), summary: reports.at(-1) };
}

function groups(report, ring) {
  return report.betti.map((betti, p) => {
    const parts = report.torsion[p].map((order) => `Z/${order}`);
    const free = betti === 1 ? ring : `${ring}^${betti}`;
    return `H${p} = ${(betti > 0 ? [free, ...parts] : parts).join(" + ") || "0"}`;
  });
}

const now = (page) => page.locator("#now").textContent();

async function comparesEachStep(browser, name) {
  const { page, wrong, steps, summary, close } = await opened(browser, join(browser.examples, `${name}.jsonl`));
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

export const short = {
  async "the steps of an example have the groups and cells that the program reports"(browser) {
    await comparesEachStep(browser, "undo");
  },
  async "the object is drawn, and another one at another step"(browser) {
    const { page, wrong, steps, close } = await opened(browser, join(browser.examples, "torus.jsonl"));
    await browser.shot(page, "torus");
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
  async "a click into the timeline, the list and the buttons goes to a step"(browser) {
    const { page, wrong, steps, close } = await opened(browser, join(browser.examples, "torus.jsonl"));
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
    await page.locator("#slider").fill(String(steps.length - 2));
    await page.click("#play");
    await page.waitForFunction((last) => document.getElementById("now").textContent === `${last} of ${last}`, steps.length);
    await page.waitForFunction(() => document.getElementById("play").textContent === "play");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a generator is drawn and said, with what a multiple of it bounds"(browser) {
    const { page, wrong, summary, close } = await opened(browser, join(browser.examples, "projective_plane.jsonl"));
    assert.equal(await page.locator("#generators button").count(), summary.generators.length);
    const index = summary.generators.findIndex(({ order }) => order === 2);
    await page.locator("#generators button").nth(index).click();
    assert.match(await now(page), /^(\d+) of \1$/);
    const chains = await page.locator("#details textarea").evaluateAll((all) => all.map(({ value }) => JSON.parse(value)));
    assert.deepEqual(chains, [summary.generators[index].chain, summary.generators[index].bounds]);
    assert.match(await page.locator("#details").textContent(), /2 times it bounds/);
    await browser.shot(page, "projective_plane");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a class says which step made it and which one ends it, and one goes there"(browser) {
    const script = browser.file("circle.jsonl");
    const lines = [{ sesame: 1 }, { op: "simplex", name: "e", dim: 1 }, { op: "identify", pairs: [["e.0", "e.1"]] }, { op: "simplex", name: "f", dim: 1 }, { op: "cone", apex: "v" }];
    writeFileSync(script, lines.map((line) => JSON.stringify(line)).join("\n"));
    const { page, wrong, close } = await opened(browser, script);
    assert.equal(await page.locator("#generators button").count(), 1);
    await page.locator("#steps button").nth(2).click();
    assert.deepEqual(await texts(page, "#generators button"), ["H0, generator 1: free", "H0, generator 2: free", "H1, generator 1: free", "all of H0"]);
    const circle = page.locator("#generators button", { hasText: "H1" });
    await circle.click();
    assert.equal(await circle.getAttribute("aria-pressed"), "true");
    assert.equal(await page.locator("#details .since").textContent(), "This class is made by step 2, identify.");
    assert.equal(await page.locator("#details .end").textContent(), "Its cycle comes to bound with step 4, cone.");
    await page.locator("#details .since button").click();
    assert.equal(await now(page), "2 of 4");
    assert.equal(await circle.getAttribute("aria-pressed"), "true");
    await page.locator("#details .end button").click();
    assert.equal(await now(page), "4 of 4");
    assert.equal(await circle.count(), 0);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a class step shows its chain and what that bounds"(browser) {
    const { page, wrong, steps, close } = await opened(browser, join(browser.examples, "class_queries.jsonl"));
    const bounding = steps.find((report) => report.class?.bounds);
    await page.locator("#steps button").nth(bounding.step - 1).click();
    const chains = await page.locator("#details textarea").evaluateAll((all) => all.map(({ value }) => JSON.parse(value)));
    assert.deepEqual(chains[1], bounding.class.bounds);
    await browser.shot(page, "class");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a click says which face, edge or vertex it meets"(browser) {
    const { page, wrong, close } = await opened(browser, join(browser.examples, "torus.jsonl"));
    await page.locator("#slider").fill("1");
    const { x, y, width, height } = await page.locator("#canvas").boundingBox();
    const met = new Set();
    for (let k = 0; k < 60 && !(met.has("edge") && met.has("square")); ++k) {
      await page.mouse.click(x + (width * (k + 0.5)) / 60, y + height / 2);
      met.add((await page.locator("#cell").textContent()).split(" ")[0]);
    }
    assert.ok(met.has("edge") && met.has("square"), [...met].join());
    assert.deepEqual(wrong, []);
    await close();
  },
  async "what a script says is text on the page, whatever it says"(browser) {
    const bad = "</script><script>document.title='broken'</script><img src=x onerror=alert(1)>";
    const script = browser.file("bad.jsonl");
    writeFileSync(script, [{ sesame: 1, title: bad }, { op: "simplex", name: "<b>&amp;", dim: 1 }, { op: "note", text: bad }].map((line) => JSON.stringify(line)).join("\n"));
    const { page, wrong, close } = await opened(browser, script);
    assert.equal(await page.locator("#title").textContent(), bad);
    assert.equal(await page.locator("img").count(), 0);
    assert.match(await page.locator("#steps").textContent(), /onerror/);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "it is dark where people want that, and fits on a phone"(browser) {
    const { page, wrong, close } = await opened(browser, join(browser.examples, "klein_bottle.jsonl"), { colorScheme: "dark", viewport: { width: 390, height: 800 } });
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(21, 24, 28)");
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
    assert.ok((await drawnPixels(page)) > 2000);
    await browser.shot(page, "phone");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a script without steps is a page, too"(browser) {
    const script = browser.file("empty.jsonl");
    writeFileSync(script, '{"sesame":1}\n');
    const { page, wrong, close } = await opened(browser, script);
    assert.equal(await now(page), "0 of 0");
    assert.deepEqual(wrong, []);
    await close();
  },
};

export const long = {
  async "of a long list there are the rows in sight, and all others come by keys, by the wheel and by a search"(browser) {
    const script = browser.file("long.jsonl");
    const steps = 1500;
    writeFileSync(script, [{ sesame: 1 }, ...Array.from({ length: steps }, (_, k) => ({ op: "insert", simplex: [k] }))].map((line) => JSON.stringify(line)).join("\n"));
    const { page, wrong, close } = await opened(browser, script);
    const buttons = page.locator("#steps button");
    assert.ok((await buttons.count()) < 200, `${await buttons.count()} rows`);
    const current = page.locator("#steps [aria-current]");
    assert.match(await current.textContent(), new RegExp(`^${steps}insert`));
    const row = page.locator("#steps li:has([aria-current])");
    assert.deepEqual([await row.getAttribute("aria-posinset"), await row.getAttribute("aria-setsize")], [String(steps), String(steps)]);
    await page.locator("#slider").fill("700");
    assert.match(await current.textContent(), /^700insert/);
    assert.ok(await current.isVisible());
    await current.focus();
    for (let k = 0; k < 60; ++k) {
      await page.keyboard.press("Tab");
    }
    await page.keyboard.press("Enter");
    assert.equal(await now(page), `760 of ${steps}`);
    const box = await page.locator("#steps").boundingBox();
    await page.mouse.move(box.x + 20, box.y + 20);
    await page.mouse.wheel(0, -1e6);
    await page.locator("#steps .number").filter({ hasText: /^1$/ }).click();
    assert.equal(await now(page), `1 of ${steps}`);
    await page.fill("#search", "simplex 1234");
    assert.equal(await page.locator("#found").textContent(), `2 of ${steps} steps`);
    await buttons.last().click();
    assert.equal(await now(page), `1235 of ${steps}`);
    await page.fill("#search", "");
    await page.keyboard.press("Tab");
    assert.match(await current.textContent(), /^1235insert/);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "every step has the groups and cells that the program reports"(browser) {
    for (const name of ["projective_plane", "cutting_a_torus", "product_of_circles"]) {
      await comparesEachStep(browser, name);
    }
  },
};
