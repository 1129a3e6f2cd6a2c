// The page of a tower. Numbers on it are compared with those of `tower --json`.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "esbuild";
import { drawnPixels, texts } from "./harness.mjs";

/** The page of an input, and what the program says of it. */
async function opened(browser, input, { words = [], ...options } = {}) {
  const html = browser.file("tower.html");
  browser.run("tower", input, "--quiet", "--html", html, ...words);
  const other = words.filter((word, k) => !["--points", "--generators"].includes(word) && words[k - 1] !== "--points");
  const report = JSON.parse(browser.run("tower", input, "--json", ...(input.endsWith(".jsonl") ? [] : ["--generators"]), ...other));
  const opened = await browser.open(html, { ...options, allowed: (url) => url.endsWith("/tower.html") || url.startsWith("blob:") });
  await settled(opened.page);
  return { ...opened, report };
}

const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

const number = (x) => (x === null ? "\u221e" : String(Number.isInteger(x) ? x : Number(x.toPrecision(6))));
const nameOf = ([dim, birth, death]) => `H${dim} [${number(birth)}, ${number(death)})`;
const lengthOf = ([, birth, death]) => (death ?? Infinity) - birth;
const aliveAt = (bars, time) => bars.filter(([, birth, death]) => birth <= time && time < (death ?? Infinity));

/** As the list has them. */
function longestFirst(bars) {
  const inOrder = [...bars].sort((a, b) => a[0] - b[0] || (a[2] === null) - (b[2] === null));
  return inOrder.sort((a, b) => (lengthOf(a) === lengthOf(b) ? 0 : lengthOf(b) - lengthOf(a)));
}

const rows = (page) => page.locator("#bars tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
const chains = (page) => page.locator("#details textarea").evaluateAll((all) => all.map(({ value }) => JSON.parse(value)));
const which = async (page) => ((await page.locator("#details .which").count()) > 0 ? (await page.locator("#details .which").textContent()).replace(/^[^H]*/, "").replace(/,[^,)]*$/, "") : "");

/** Moves down a picture until a bar is pointed at. */
async function find(page, plot, bar, across) {
  await page.locator(`#${plot} .marks`).scrollIntoViewIfNeeded();
  const box = await page.locator(`#${plot} .marks`).boundingBox();
  for (let y = 4; y < box.height; y += 5) {
    await page.mouse.move(box.x + across * box.width, box.y + y);
    await settled(page);
    if ((await page.locator("#pointed").textContent()).startsWith(bar)) {
      return { x: box.x + across * box.width, y: box.y + y };
    }
  }
  assert.fail(`${bar} is not in ${plot}`);
}

/** Chooses bars of the list and compares what is said of them. */
async function comparesClasses(page, report, most) {
  const said = await page.evaluate((most) => {
    const buttons = [...document.querySelectorAll("#bars button")].slice(0, most);
    return buttons.map((button) => {
      button.click();
      return [document.querySelector("#details .which").textContent, ...[...document.querySelectorAll("#details textarea")].map(({ value }) => JSON.parse(value))];
    });
  }, most);
  assert.ok(said.length > 0);
  const left = [...report.generators];
  for (const [title, cycle, second] of said) {
    const at = left.findIndex((each) => title.includes(`${nameOf([each.dim, each.birth, each.death])},`) && JSON.stringify([each.cycle, each.now ?? each.bounds]) === JSON.stringify([cycle, second]));
    assert.ok(at >= 0, `${title}: ${JSON.stringify([cycle, second])}`);
    left.splice(at, 1); // each bar has a class of its own
  }
}

/** Twelve points on a circle, for coarsened_circle. */
function circlePoints(browser) {
  const file = browser.file("points.txt");
  const places = Array.from({ length: 12 }, (_, k) => [Math.cos((k * Math.PI) / 6), Math.sin((k * Math.PI) / 6)].map((x) => x.toFixed(6)).join(" "));
  writeFileSync(file, places.join("\n"));
  return file;
}

const circle = (browser) => join(browser.examples, "coarsened_circle.tower");

export const short = {
  async "the bars are listed, and each has its class, as the program reports"(browser) {
    const { page, wrong, report, close } = await opened(browser, circle(browser));
    const expected = longestFirst(report.bars).map((bar) => [number(bar[1]), number(bar[2]), number(bar[2] === null ? null : lengthOf(bar)), "yes"]);
    assert.deepEqual((await rows(page)).map(([, ...cells]) => cells), expected);
    const ofDimension = (dim) => report.bars.filter((bar) => bar[0] === dim);
    assert.deepEqual(
      await page.locator("#dims tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].slice(1).map((cell) => cell.textContent))),
      [0, 1].map((dim) => [String(ofDimension(dim).length), String(ofDimension(dim).filter(([, , death]) => death === null).length), String(Math.max(...ofDimension(dim).map(lengthOf).filter(Number.isFinite))), String(ofDimension(dim).length)]),
    );
    assert.match(await page.locator("#facts").textContent(), /coefficients Z\/2 \u00b7 41 operations \u00b7 16 bars, of which 1 never ends/);
    await comparesClasses(page, report, 100);
    await page.locator("#bars button").nth(1).click();
    assert.match(await page.locator("#details").textContent(), /Born at time 3 by including \{11 0\}, line 29\.Ends at time 12 by contracting 4 into 0, line 45; length 9\./);
    assert.equal(await page.locator("#stage").isVisible(), false);
    await browser.shot(page, "tower");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a bar that is chosen in one picture is chosen in all, and the time that is pointed at has its Betti numbers"(browser) {
    const { page, wrong, report, close } = await opened(browser, circle(browser));
    for (const [plot, across] of [["barcode", 0.8], ["diagram", 0.33]]) {
      const at = await find(page, plot, "H1 [3, 12)", across);
      await page.mouse.click(at.x, at.y);
      assert.equal(await which(page), "H1 [3, 12)", plot);
      await settled(page);
      for (const canvas of await page.locator(".marks").all()) {
        assert.match(await canvas.getAttribute("aria-label"), /chosen: H1 \[3, 12\), length 9/);
      }
      assert.equal(await page.locator("#bars tr.chosen").count(), 1);
      await page.locator("#diagram .marks").focus();
      await page.keyboard.press("Escape");
      assert.equal(await which(page), "");
    }
    for (const plot of ["barcode", "betti"]) {
      await page.locator(`#${plot} .marks`).scrollIntoViewIfNeeded();
      const box = await page.locator(`#${plot} .marks`).boundingBox();
      for (const across of [0.3, 0.45, 0.6, 0.9]) {
        await page.mouse.move(box.x + across * box.width, box.y + 60);
        await settled(page);
        const [, time, ...betti] = /at time ([^:]*): b0 = (\d+), b1 = (\d+)/.exec(await page.locator("#pointed").textContent());
        assert.deepEqual(betti.map(Number), [0, 1].map((dim) => aliveAt(report.bars, Number(time)).filter((bar) => bar[0] === dim).length));
      }
    }
    assert.deepEqual(wrong, []);
    await close();
  },
  async "number fields, boxes and drags filter all that is shown"(browser) {
    const { page, wrong, report, close } = await opened(browser, circle(browser));
    const kept = async (keeps) => {
      await settled(page);
      const expected = longestFirst(report.bars.filter(keeps));
      const listed = await rows(page);
      assert.deepEqual(listed.map(([, birth, death]) => [birth, death]), expected.map(([, birth, death]) => [number(birth), number(death)]));
      assert.match(await page.locator("#kept").textContent(), expected.length === report.bars.length ? /^all of 16 bars/ : new RegExp(`^${expected.length} of 16 bars`));
      assert.match(await page.locator("#barcode .marks").getAttribute("aria-label"), new RegExp(`^Barcode of ${expected.length} bars`));
    };
    const fill = async (id, text) => {
      await page.locator(`#${id}`).fill(text);
      await page.keyboard.press("Tab");
    };
    await fill("length-from", "2");
    await kept((bar) => lengthOf(bar) >= 2);
    await fill("birth-to", "3");
    await kept((bar) => lengthOf(bar) >= 2 && bar[1] <= 3);
    await page.locator("#dims input").first().uncheck();
    await kept((bar) => lengthOf(bar) >= 2 && bar[1] <= 3 && bar[0] !== 0);
    await fill("alive-from", "wrong");
    assert.match(await page.locator("#kept").textContent(), /^"wrong" is no number: the field "alive, from" takes one/);
    assert.equal(await page.locator("#alive-from").getAttribute("aria-invalid"), "true");
    await page.click("#all-bars");
    await kept(() => true);
    await page.locator("#fields label").first().locator("input").uncheck();
    await kept((bar) => bar[2] !== null);
    await page.click("#all-bars");
    // A drag over the time axis, and a box in the diagram; what they came to is in the fields.
    await page.locator("#barcode .marks").scrollIntoViewIfNeeded();
    const bars = await page.locator("#barcode .marks").boundingBox();
    await page.mouse.move(bars.x + 0.5 * bars.width, bars.y + 50);
    await page.mouse.down();
    await page.mouse.move(bars.x + 0.6 * bars.width, bars.y + 60, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    const [from, to] = await page.locator("#alive-from, #alive-to").evaluateAll((all) => all.map(({ value }) => Number(value)));
    assert.ok(from > 4 && from < to && to < 9, `${from} ${to}`);
    await kept(([, birth, death]) => birth <= to && (death ?? Infinity) > from);
    await browser.shot(page, "tower_filter");
    await page.click("#all-bars");
    await page.locator("#diagram .marks").scrollIntoViewIfNeeded();
    const diagram = await page.locator("#diagram .marks").boundingBox();
    await page.mouse.move(diagram.x + 0.22 * diagram.width, diagram.y + 0.1 * diagram.height);
    await page.mouse.down();
    await page.mouse.move(diagram.x + 0.6 * diagram.width, diagram.y + 0.8 * diagram.height, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    const box = await page.locator("#birth-from, #birth-to, #death-from, #death-to").evaluateAll((all) => all.map(({ value }) => Number(value)));
    await kept(([, birth, death]) => birth >= box[0] && birth <= box[1] && death !== null && death >= box[2] && death <= box[3]);
    assert.ok((await page.locator("#bars tr").count()) > 0);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "everything can be done by keyboard"(browser) {
    const { page, wrong, close } = await opened(browser, circle(browser));
    const list = await rows(page);
    await page.locator("#bars button").first().focus();
    await page.keyboard.press("ArrowDown");
    assert.equal(await which(page), `H1 [${list[1][1]}, ${list[1][2]})`);
    await page.keyboard.press("Enter");
    await page.locator("#betti .marks").focus();
    await page.keyboard.press("ArrowDown");
    assert.equal(await which(page), `H0 [${list[2][1]}, ${list[2][2]})`);
    await page.keyboard.press("Home");
    assert.equal(await which(page), `H0 [${list[0][1]}, ${list[0][2]})`);
    assert.match(await page.locator("#said").textContent(), /^chosen: H0/);
    // Whatever takes part has a name.
    const unnamed = await page.evaluate(() =>
      [...document.querySelectorAll("button, input, canvas[tabindex], textarea")]
        .filter((each) => each.checkVisibility())
        .filter((each) => !(each.getAttribute("aria-label") || each.textContent.trim() || each.labels?.[0]?.textContent.trim()))
        .map((each) => each.outerHTML),
    );
    assert.deepEqual(unnamed, []);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "each picture is saved as SVG, as it is seen"(browser) {
    const { page, wrong, close } = await opened(browser, circle(browser), { colorScheme: "dark" });
    for (const [plot, name] of [["barcode", "barcode.svg"], ["diagram", "persistence_diagram.svg"], ["betti", "betti_curves.svg"]]) {
      const [download] = await Promise.all([page.waitForEvent("download"), page.click(`#${plot} .save`)]);
      assert.equal(download.suggestedFilename(), name);
      const svg = readFileSync(await download.path(), "utf8");
      assert.match(svg, /^<\?xml version="1\.0" encoding="UTF-8"\?>\n<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg"/);
      assert.match(svg, />H1<\/text>/);
      assert.match(svg, /<desc>coefficients Z\/2; 41 operations; .*; all of 16 bars<\/desc>/);
      assert.ok(svg.includes("#0072b2") && svg.includes('fill="#ffffff"'), "on white paper, whatever the page is");
      assert.equal(await page.evaluate((text) => new DOMParser().parseFromString(text, "image/svg+xml").querySelector("parsererror")?.textContent ?? "", svg), "");
    }
    assert.deepEqual(wrong, []);
    await close();
  },
  async "with points the complex is drawn at each moment, and the class over it"(browser) {
    const { page, wrong, close } = await opened(browser, circle(browser), { words: ["--points", circlePoints(browser)] });
    const states = browser.run("tower", circle(browser), "--json", "--every", "1").trim().split("\n").map(JSON.parse).slice(0, -1);
    const moments = states.filter(({ time }, k) => states[k + 1]?.time !== time);
    assert.equal(Number(await page.locator("#moment").getAttribute("max")), moments.length - 1);
    for (let k = 0; k < moments.length; ++k) {
      await page.locator("#moment").fill(String(k));
      const { time, cells, betti } = moments[k];
      const text = await page.locator("#moment-text").textContent();
      const counts = [...text.matchAll(/(\d+) (?:vert|edge|face)/g)].map((found) => Number(found[1]));
      assert.equal(Number(/^time ([^:]*):/.exec(text)[1]), time);
      assert.deepEqual(counts, cells.filter((count) => count > 0), text);
      const numbers = /Betti numbers (.*)$/.exec(text)[1].split(", ").map(Number);
      assert.deepEqual(numbers, [0, 1].map((dim) => betti[dim] ?? 0), text);
    }
    await page.locator("#moment").fill("3");
    const without = await drawnPixels(page);
    await page.locator("#bars button").nth(1).click();
    assert.match(await page.locator("#moment-text").textContent(), /^time 3:/);
    assert.equal(await page.locator("#overlaid").textContent(), "In orange, thick: the cycle of the chosen bar");
    assert.ok((await drawnPixels(page)) > without + 2000);
    await browser.shot(page, "tower_points");
    await page.click("#to-end");
    assert.match(await page.locator("#moment-text").textContent(), /^time 12:/);
    const filled = (await rows(page)).findIndex(([, birth, death]) => birth === "4" && death === "6");
    await page.locator("#bars button").nth(filled).click();
    await page.click("#to-end");
    assert.match(await page.locator("#overlaid").textContent(), /in blue the chain that it bounds$/);
    await browser.shot(page, "tower_bounds");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "it is dark where people want that, and fits on a phone"(browser) {
    const { page, wrong, close } = await opened(browser, circle(browser), { colorScheme: "dark", viewport: { width: 390, height: 800 }, words: ["--points", circlePoints(browser)] });
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(21, 24, 28)");
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
    await page.locator("#barcode").scrollIntoViewIfNeeded();
    await browser.shot(page, "tower_phone");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "names are text on the page, whatever they are, and an empty tower is a page"(browser) {
    const input = browser.file("<img src=x onerror=alert(1)>.tower");
    writeFileSync(input, "# nothing\n");
    const { page, wrong, close } = await opened(browser, input);
    assert.match(await page.locator("#title").textContent(), /<img src=x onerror=alert\(1\)>\.tower$/);
    assert.equal(await page.locator("img").count(), 0);
    assert.equal(await page.locator("#listed").textContent(), "no bars");
    assert.match(await page.locator("#kept").textContent(), /^all of 0 bars/);
    assert.deepEqual(wrong, []);
    await close();
  },
};

export const long = {
  async "inputs of all formats have the bars and classes that the program reports"(browser) {
    const random = browser.file("random.tower");
    browser.run("generate", "tower-A", "--size", "3000", "-o", random);
    const matrix = browser.file("torus.phat");
    browser.run("generate", "torus-300", "--size", "12", "-o", matrix);
    for (const [input, words] of [[random, []], [random, ["--ring", "Z/5"]], [matrix, []], [join(browser.examples, "projective_plane.tower"), ["--ring", "Q"]]]) {
      const { page, wrong, report, close } = await opened(browser, input, { words });
      const expected = longestFirst(report.bars).map((bar) => [number(bar[1]), number(bar[2])]);
      assert.deepEqual((await rows(page)).map(([, birth, death]) => [birth, death]), expected.slice(0, 50));
      await comparesClasses(page, report, 30);
      assert.deepEqual(wrong, []);
      await close();
    }
  },
  async "classes that are carried along in space are what the program says that they become"(browser) {
    const folder = browser.file("modules");
    await build({ entryPoints: [fileURLToPath(new URL("../../src/tower/complex.ts", import.meta.url))], bundle: true, format: "esm", outfile: join(folder, "complex.mjs"), logLevel: "warning" });
    const { TowerComplex } = await import(pathToFileURL(join(folder, "complex.mjs")).href);
    const [random, points] = ["classes.tower", "classes.txt"].map((name) => browser.file(name));
    browser.run("generate", "tower-A", "--size", "1000", "-o", random);
    writeFileSync(points, Array.from({ length: 4000 }, (_, k) => `${Math.cos(k)} ${Math.sin(k)} ${k / 4000}`).join("\n"));
    for (const [ring, p] of [["Z/3", 3], ["Q", 0]]) {
      const { page, wrong, close } = await opened(browser, random, { words: ["--points", points, "--generators", "--ring", ring] });
      const data = JSON.parse(await page.locator("#data").textContent());
      const complex = new TowerComplex(data.complex);
      const residue = (x) => (p > 0 ? ((x % p) + p) % p : x);
      const asMap = (chain) => new Map(chain.map(([c, labels]) => [labels.join(), residue(Number(c))]).filter(([, c]) => c !== 0).sort());
      let [open, killed] = [0, 0];
      for (const known of data.classes.filter((_, k) => k % 7 === 0)) {
        const end = known.killed?.after ?? data.complex.dims.length;
        const image = asMap(complex.image(known.cycle, known.born.after, end, p));
        if (known.now) {
          ++open;
          assert.deepEqual(image, asMap(known.now), JSON.stringify(known));
        } else {
          ++killed;
          const boundary = new Map();
          for (const [c, labels] of known.bounds) {
            labels.forEach((_, k) => {
              const face = labels.filter((__, other) => other !== k).join();
              boundary.set(face, (boundary.get(face) ?? 0) + (k % 2 === 0 ? 1 : -1) * Number(c));
            });
          }
          assert.deepEqual(image, new Map([...boundary].map(([face, c]) => [face, residue(c)]).filter(([, c]) => c !== 0).sort()), JSON.stringify(known));
        }
      }
      assert.ok(open > 0 && killed > 20, `${open} ${killed}`);
      assert.ok((await drawnPixels(page)) > 500);
      assert.deepEqual(wrong, []);
      await close();
    }
  },
  async "a script has its bars, and says where its generators are"(browser) {
    const { page, wrong, report, close } = await opened(browser, join(browser.examples, "contracted_circle.jsonl"));
    assert.deepEqual((await rows(page)).map(([, birth, death]) => [birth, death]), longestFirst(report.bars).map((bar) => [number(bar[1]), number(bar[2])]));
    assert.match(await page.locator("#remarks").textContent(), /sesame replay --html draws/);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "of many bars none is left out, and the page says how they are drawn"(browser) {
    const input = browser.file("cubical.bin");
    browser.run("generate", "cubical", "--size", "24", "-o", input);
    const { page, wrong, close } = await opened(browser, input, { words: ["--min-length", "3"] });
    const report = JSON.parse(browser.run("tower", input, "--json", "--min-length", "3"));
    const many = report.bars.length.toLocaleString("en");
    assert.match(await page.locator("#listed").textContent(), new RegExp(`^1 to 50 of ${many}$`));
    assert.match(await page.locator("#barcode .note").textContent(), /^Nothing is left out: H0 has/);
    assert.match(await page.locator("#diagram .note").textContent(), new RegExp(`^Nothing is left out: ${many} bars as shades`));
    assert.match(await page.locator("#facts").textContent(), new RegExp(`${report.shorter.toLocaleString("en")} bars shorter than 3 left out`));
    assert.match(await page.locator("#remarks").textContent(), /more than 20,000 operations/);
    await page.click("#list-forward");
    assert.match(await page.locator("#listed").textContent(), /^51 to 100 of/);
    const at = await find(page, "barcode", "H1", 0.5);
    await page.mouse.click(at.x, at.y);
    assert.match(await which(page), /^H1 \[/);
    assert.equal(await page.locator("#bars tr.chosen").count(), 1);
    // Betti numbers are those of all bars, also of those that are left out.
    const csv = browser.file("betti.csv");
    browser.run("tower", input, "--quiet", "--csv", csv);
    const changes = readFileSync(csv, "utf8").trim().split("\n").slice(1).map((line) => line.split(",").map(Number));
    await page.locator("#betti .marks").scrollIntoViewIfNeeded();
    const box = await page.locator("#betti .marks").boundingBox();
    for (const across of [0.3, 0.5, 0.8]) {
      await page.mouse.move(box.x + across * box.width, box.y + 60);
      await settled(page);
      const [, time, betti] = /at column ([^:]*): (.*)$/.exec(await page.locator("#pointed").textContent());
      const [, ...expected] = changes.filter(([when]) => when <= Number(time)).at(-1);
      assert.equal(betti, expected.map((value, dim) => `b${dim} = ${value}`).join(", "));
    }
    // A drag over many waits until it rests, and then keeps what it says.
    await page.locator("#barcode .marks").scrollIntoViewIfNeeded();
    const bars = await page.locator("#barcode .marks").boundingBox();
    await page.mouse.move(bars.x + 0.4 * bars.width, bars.y + 50);
    await page.mouse.down();
    await page.mouse.move(bars.x + 0.5 * bars.width, bars.y + 60, { steps: 5 });
    await page.mouse.up();
    await settled(page);
    const [from, to] = await page.locator("#alive-from, #alive-to").evaluateAll((all) => all.map(({ value }) => Number(value)));
    const some = report.bars.filter(([, birth, death]) => birth <= to && (death ?? Infinity) > from);
    assert.match(await page.locator("#listed").textContent(), new RegExp(`^1 to 50 of ${some.length.toLocaleString("en")}$`));
    assert.match(await page.locator("#kept").textContent(), new RegExp(`^${some.length.toLocaleString("en")} of ${many} bars: alive`));
    await browser.shot(page, "tower_many");
    assert.deepEqual(wrong, []);
    await close();
  },
};
