// Makes the pictures of pages that the README has: node tools/pictures.mjs SESAME MESH FOLDER
// MESH: a file with a surface of some handles, such as tests/scripts/make_handles.py writes.
import { join } from "node:path";
import { Browser } from "../test/browser/harness.mjs";

const [sesame, mesh, folder] = process.argv.slice(2);
const examples = join(import.meta.dirname ?? new URL(".", import.meta.url).pathname, "../../examples");
const browser = await Browser.start(sesame, examples, folder);

async function picture(name, words, act) {
  const html = browser.file(`${name}.html`);
  browser.run(...words, "--quiet", "--html", html);
  const { page, wrong, close } = await browser.open(html, { viewport: { width: 1200, height: 800 } });
  await act(page);
  await page.mouse.move(0, 0);
  await page.waitForTimeout(1500); // pictures in space take a moment without a graphics card
  await browser.shot(page, `${name}_page`);
  if (wrong.length > 0) {
    throw new Error(wrong.join("\n"));
  }
  await close();
}

await picture("torus", ["replay", join(examples, "torus.jsonl")], (page) => page.locator("#generators button", { hasText: "H1, generator 1" }).click());
await picture("tower", ["tower", join(examples, "contracted_torus.tower")], async () => {});
await picture("mesh", ["mesh", mesh], async () => {});
await browser.end();
