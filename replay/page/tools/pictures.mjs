// Makes the pictures of pages that the README has: node tools/pictures.mjs SESAME FOLDER
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser } from "../test/browser/harness.mjs";

const root = join(dirname(fileURLToPath(import.meta.url)), "../../..");

/** A page as somebody sees it who has chosen something. */
async function picture(browser, name, words, act) {
  const html = browser.file(`${name}.html`);
  browser.run(...words, "--html", html);
  const { page, wrong, close } = await browser.open(html, { viewport: { width: 1200, height: 800 } });
  await act(page);
  await page.evaluate(() => scrollTo(0, 0));
  await page.mouse.move(2, 2);
  await page.waitForTimeout(2500); // pictures in space take a moment without a graphics card
  await browser.shot(page, `${name}_page`);
  if (wrong.length > 0) {
    throw new Error(wrong.join("\n"));
  }
  await close();
}

/** Points all over a torus, and their Rips filtration up to triangles and this length, as a list of simplices. */
function torusFiltration(browser, count, longest) {
  const points = Array.from({ length: count }, (_, k) => {
    const [u, v] = [2 * Math.PI * k * 0.7548776662, 2 * Math.PI * k * 0.5698402910]; // evenly, whatever their number
    return [(2 + 0.8 * Math.cos(v)) * Math.cos(u), (2 + 0.8 * Math.cos(v)) * Math.sin(u), 0.8 * Math.sin(v)];
  });
  const far = (a, b) => Math.hypot(...points[a].map((x, axis) => x - points[b][axis]));
  const simplices = points.map((_, k) => [0, [k]]);
  for (let a = 0; a < count; ++a) {
    for (let b = a + 1; b < count; ++b) {
      far(a, b) <= longest && simplices.push([far(a, b), [a, b]]);
      for (let c = b + 1; c < count; ++c) {
        const size = Math.max(far(a, b), far(a, c), far(b, c));
        size <= longest && simplices.push([size, [a, b, c]]);
      }
    }
  }
  simplices.sort(([x, a], [y, b]) => x - y || a.length - b.length);
  writeFileSync(browser.file("points.txt"), points.map((point) => `${point.join(" ")}\n`).join(""));
  writeFileSync(browser.file("torus.gudhi"), simplices.map(([value, all]) => `${all.length - 1} ${all.join(" ")} ${value}\n`).join(""));
}

/** All of them, into the folder of the browser for pictures. */
export async function makePictures(browser) {
  await picture(browser, "torus", ["replay", join(root, "replay/examples/torus.jsonl")], (page) => page.locator("#generators button", { hasText: "H1, generator 1" }).click());

  torusFiltration(browser, 130, 1.9);
  await picture(browser, "tower", ["tower", browser.file("torus.gudhi"), "--max-dim", "1", "--points", browser.file("points.txt")], async (page) => {
    await page.locator("#fields input").first().fill("0.3");
    await page.keyboard.press("Tab");
    await page.waitForTimeout(500);
    await page.locator("#bars tr", { hasText: "H1" }).first().locator("button").click();
  });

  writeFileSync(browser.file("plate.off"), execFileSync("python3", [join(root, "tests/scripts/make_handles.py"), "plate", "2", "9"]));
  await picture(browser, "mesh", ["mesh", browser.file("plate.off")], async (page) => {
    await page.locator("#loops").focus();
    await page.keyboard.press("End");
  });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [sesame, folder] = process.argv.slice(2);
  const browser = await Browser.start(sesame, "", folder);
  await makePictures(browser);
  await browser.end();
}
