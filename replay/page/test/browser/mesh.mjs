// The page of a mesh. Numbers on it are compared with those of `mesh --json`.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { drawnPixels, texts } from "./harness.mjs";

const off = (points, faces) => ["OFF", `${points.length} ${faces.length} 0`, ...points.map((p) => p.join(" ")), ...faces.map((f) => [f.length, ...f].join(" "))].join("\n") + "\n";

/** A torus about a circle of radius 2, around an axis and a centre; what is there before it is kept. */
function torus({ points = [], faces = [] } = {}, centre = [0, 0, 0], axis = 2, n = 32, m = 12, r = 0.6) {
  const first = points.length;
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < m; ++j) {
      const [t, u] = [(2 * Math.PI * i) / n, (2 * Math.PI * j) / m];
      const flat = [(2 + r * Math.cos(u)) * Math.cos(t), (2 + r * Math.cos(u)) * Math.sin(t)];
      const point = axis === 2 ? [...flat, r * Math.sin(u)] : [flat[0], r * Math.sin(u), flat[1]];
      points.push(point.map((x, k) => x + centre[k]));
      const at = (di, dj) => first + ((i + di) % n) * m + ((j + dj) % m);
      faces.push([at(0, 0), at(1, 0), at(1, 1)], [at(0, 0), at(1, 1), at(0, 1)]);
    }
  }
  return { points, faces };
}

/** Two linked tori, and three triangles at one edge; a face that is there twice. */
function rings() {
  const mesh = torus(torus(), [2, 0, 0], 1);
  const first = mesh.points.length;
  mesh.points.push([4, 3, 1], [5, 3, 1], [4.5, 4, 1], [4.5, 3, 2], [4.5, 2.4, 0.4]);
  mesh.faces.push([first, first + 1, first + 2], [first, first + 1, first + 3], [first, first + 1, first + 4], [0, 12, 13]);
  return mesh;
}

/** The page of a mesh, and what the program says of it. */
async function opened(browser, mesh, words = [], options = {}, name = "mesh.off") {
  const file = browser.file(name);
  writeFileSync(file, typeof mesh === "string" ? mesh : off(mesh.points, mesh.faces));
  const html = browser.file("mesh.html");
  const report = JSON.parse(browser.run("mesh", "--json", "--html", html, ...words, file));
  const opened = await browser.open(html, options);
  await opened.page.waitForSelector("#groups .meaning, #groups:empty", { state: "attached" });
  return { ...opened, report, loops: report.generators.filter(({ dim }) => dim === 1) };
}

const short6 = (x) => String(Number(x.toPrecision(6)));
const rows = (page) => page.locator("#loops [role=option]:visible");
const detail = (page, name) => page.locator(`#chosen dd[data-name="${name}"]`).textContent();

async function comparesAll(browser, mesh, words, name) {
  const { page, wrong, report, loops, close } = await opened(browser, mesh, words, {}, name);
  const { validity } = report;
  assert.match(await page.locator("#facts").textContent(), new RegExp(`^${validity.vertices} ver\\w+, ${validity.edges} edges?, ${validity.faces} faces?; Euler characteristic ${report.euler};`));
  const groups = (await texts(page, "#groups b")).map((text) => text.replace(/^H\d = /, ""));
  assert.equal(groups.length, report.betti.length);
  groups.forEach((group, p) => {
    const parts = report.torsion[p].map((order) => `Z/${order}`);
    const free = report.betti[p] === 0 ? [] : [report.betti[p] === 1 ? report.ring : `${report.ring.startsWith("Z/") ? `(${report.ring})` : report.ring}^${report.betti[p]}`];
    assert.equal(group, [...free, ...parts].join(" + ") || "0");
  });
  const sorted = [...loops].sort((a, b) => a.length - b.length);
  const listed = await rows(page).evaluateAll((all) => all.map((row) => [row.querySelector(".what").textContent, row.querySelector(".number").textContent, row.querySelector(".rest").textContent]));
  assert.deepEqual(listed.map(([side, length]) => [side, length]), sorted.map(({ loop, length }) => [loop ?? "no side", short6(length)]));
  listed.forEach(([, , rest], k) => assert.match(rest, new RegExp(`^${sorted[k].edges.length} edges?`)));
  const counts = Object.fromEntries((await texts(page, "#places .places-head")).map((text) => text.split(": ").map((part) => part.replace(/,.*/, ""))));
  const wanted = { "Edges on more than two faces": "non_manifold_edges", "Vertices where sheets touch": "non_manifold_vertices", "Boundary loops": "boundary_loops", "Edges on no face": "lines" };
  for (const [title, key] of Object.entries(wanted)) {
    assert.equal(Number(counts[title] ?? 0), validity[key], title);
  }
  assert.equal(Number(counts.Components), validity.components.length);
  assert.deepEqual(wrong, []);
  await close();
}

export const short = {
  async "the mesh has the numbers, groups, loops and faults that the program reports"(browser) {
    await comparesAll(browser, rings(), []);
  },
  async "arrow keys go through the loops, and each is said and drawn"(browser) {
    const { page, wrong, loops, close } = await opened(browser, rings());
    const before = await drawnPixels(page);
    assert.ok(before > 5000, `${before} pixels`);
    await browser.shot(page, "mesh");
    await page.locator("#loops").focus();
    const sorted = [...loops].sort((a, b) => a.length - b.length);
    for (const [k, loop] of sorted.entries()) {
      await page.keyboard.press("ArrowDown");
      assert.equal(await page.locator("#loops [aria-selected=true]").count(), 1);
      assert.equal(await page.locator("#loops").getAttribute("aria-activedescendant"), await page.locator("#loops [aria-selected=true]").getAttribute("id"));
      assert.match(await page.locator("#chosen h2").textContent(), new RegExp(`^${loop.loop === "handle" ? "Handle" : "Tunnel"} loop ${k + 1}$`));
      assert.equal(await detail(page, "length"), short6(loop.length));
      assert.equal(await detail(page, "edges"), String(loop.edges.length));
      assert.equal(await detail(page, "component"), String(loop.component));
      const numbers = [...(await detail(page, "box")).matchAll(/-?\d[\d.e-]*/g)].map(([x]) => Number(x));
      loop.box.flat().forEach((x, i) => assert.ok(Math.abs(x - numbers[i]) < 1e-4, `box ${numbers}`));
    }
    const shown = await page.locator("#chosen textarea").inputValue();
    const same = sorted.filter(({ length }) => short6(length) === short6(sorted.at(-1).length)).map(({ vertices }) => vertices.join(" "));
    assert.ok(same.includes(shown), shown);
    await browser.shot(page, "mesh_loop");
    await page.keyboard.press("Enter");
    await page.keyboard.press("Escape");
    assert.equal(await page.locator("#chosen").textContent(), "");
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a length leaves the loops that --shorter-than leaves, by the field, the slider and the option"(browser) {
    const { page, wrong, report, loops, close } = await opened(browser, rings(), ["--shorter-than", "5"]);
    assert.ok(report.loops_left_out > 0 && loops.length > 0);
    assert.equal(await rows(page).count(), loops.length);
    const all = loops.length + report.loops_left_out;
    assert.equal(await page.locator("#listed").textContent(), `${loops.length} of ${all} loops shorter than 5`);
    await page.fill("#limit", "");
    assert.equal(await rows(page).count(), all);
    await page.fill("#limit", String(loops[0].length));
    assert.equal(await rows(page).count(), loops.filter(({ length }) => length < loops[0].length).length);
    await page.locator("#limit-slider").fill("200");
    assert.equal(await rows(page).count(), all);
    await page.getByLabel("tunnel (2)").uncheck();
    assert.equal(await rows(page).count(), all - 2);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a click into the picture chooses a loop, or says what is there"(browser) {
    const { page, wrong, close } = await opened(browser, torus());
    const { x, y, width, height } = await page.locator("#canvas").boundingBox();
    const met = new Set();
    for (let k = 0; k < 120 && !(met.has("triangle") && met.has("loop")); ++k) {
      await page.mouse.click(x + width * (0.2 + 0.005 * k), y + height * 0.5);
      met.add(((await page.locator("#cell").textContent()) || "nothing").split(" ")[0]);
      (await page.locator("#chosen h2").count()) > 0 && met.add("loop");
    }
    assert.ok(met.has("triangle") && met.has("loop"), [...met].join());
    assert.equal(await page.locator("#loops [aria-selected=true]").count(), 1);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a place of the list is flown to and marked; layers are switched"(browser) {
    const { page, wrong, close } = await opened(browser, rings(), [], { colorScheme: "dark" });
    const before = await drawnPixels(page);
    await page.locator("#places [role=option]").first().click();
    await page.waitForTimeout(1200);
    assert.notEqual(await drawnPixels(page), before);
    assert.match(await page.locator("#chosen").textContent(), /more than two faces/);
    assert.equal(await page.locator("#places [aria-selected=true]").count(), 1);
    await browser.shot(page, "mesh_place");
    await page.click("#fit");
    await page.waitForTimeout(400);
    const whole = await drawnPixels(page);
    for (const name of ["faces", "edges", "boundary", "faults", "loops"]) {
      await page.locator(`#show-${name}`).uncheck();
    }
    await page.keyboard.press("Tab");
    assert.ok((await drawnPixels(page)) < whole / 10);
    await page.locator("#surfaces [role=option]").first().click();
    assert.match(await page.locator("#chosen").textContent(), /Closed surface 1/);
    assert.ok((await drawnPixels(page)) > whole / 10);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "faces that meet are places, as many as the program reports, and take the sides of loops away"(browser) {
    const { page, wrong, report, loops, close } = await opened(browser, torus(torus(), [0.31, 0.17, 0.23]));
    const { self_intersections: count, first_self_intersections: first } = report.validity;
    assert.ok(count > 0 && loops.every(({ loop }) => loop === null));
    assert.match(await page.locator("#verdict").textContent(), new RegExp(`It meets itself: ${count} pairs of faces`));
    const head = page.locator("#places .places-head").filter({ hasText: "Faces that meet" });
    assert.match(await head.textContent(), new RegExp(`: ${count}\\b`));
    const row = page.locator("#places [role=option]").first();
    assert.match(await row.textContent(), new RegExp(`^faces ${first[0].faces.join(" and ")}`));
    await row.click();
    await page.waitForTimeout(1200);
    await browser.shot(page, "mesh_meeting");
    await rows(page).first().click();
    assert.match(await page.locator("#chosen").textContent(), /no side: the surface meets that of component 1/);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "it fits on a phone, and what a file is called is text"(browser) {
    const name = "<img src=x onerror=alert(1)>.off";
    const { page, wrong, close } = await opened(browser, torus(), [], { viewport: { width: 390, height: 800 } }, name);
    assert.ok((await page.locator("#title").textContent()).endsWith(name));
    assert.equal(await page.locator("img").count(), 0);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
    assert.ok((await drawnPixels(page)) > 2000);
    await browser.shot(page, "mesh_phone");
    assert.deepEqual(wrong, []);
    await close();
  },
};

/** A projective plane of six vertices. */
const plane = { points: [[0, 0, 1], [1, 0, 0], [0.3, 0.95, 0], [-0.8, 0.6, 0], [-0.8, -0.6, 0], [0.3, -0.95, 0]], faces: [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1], [1, 2, 4], [2, 3, 5], [3, 4, 1], [4, 5, 2], [5, 1, 3]] };

export const long = {
  async "meshes of all kinds have the numbers that the program reports"(browser) {
    await comparesAll(browser, plane, []);
    await comparesAll(browser, torus(), ["--ring", "Z/3"]);
    await comparesAll(browser, "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", [], "points.off");
    await comparesAll(browser, "OFF\n1 0 0\n5 5 5\n", [], "point.off");
    await comparesAll(browser, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 3\n", [], "square.obj");
    await comparesAll(browser, off([[0, 0, 0], [1e300, 0, 0], [0, 1e300, 0]], [[0, 1, 2]]), [], "large.off");
  },
  async "a loop that bounds when it is run twice is drawn with what it bounds"(browser) {
    const { page, wrong, close } = await opened(browser, plane);
    const before = await drawnPixels(page);
    await page.locator("#show-faces").uncheck();
    await rows(page).first().click();
    assert.equal(await detail(page, "order"), "2 times it bounds");
    assert.ok((await drawnPixels(page)) > before / 4);
    assert.deepEqual(wrong, []);
    await close();
  },
  async "a page without generators says so"(browser) {
    const { page, wrong, close } = await opened(browser, torus(), ["--generators-limit", "0"]);
    assert.equal(await page.locator("#loops-section").isVisible(), false);
    assert.match(await page.locator("#remarks").textContent(), /generators-limit 0/);
    assert.deepEqual(wrong, []);
    await close();
  },
};
