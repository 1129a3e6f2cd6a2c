// Opens pages that the program writes in a real browser, and does with them what people do:
//   node test/browser.mjs SESAME EXAMPLES [short | all [NAME]] [--shots FOLDER]
// NAME: only the tests of that file. short: only those tests that are done each time. Exit status 77: there is no browser.
import { readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser } from "./browser/harness.mjs";

const words = process.argv.slice(2);
const at = words.indexOf("--shots");
const [, shots] = at >= 0 ? words.splice(at, 2) : [];
const [sesame, examples, which, only] = words;
const browser = await Browser.start(sesame, examples, shots);
if (!browser) {
  console.log("no chromium here");
  process.exit(77);
}
const here = join(dirname(fileURLToPath(import.meta.url)), "browser");
let failed = 0;
for (const name of readdirSync(here).filter((file) => file !== "harness.mjs" && (only === undefined || file === only)).sort()) {
  const { short, long } = await import(`./browser/${name}`);
  for (const [what, run] of Object.entries(which === "short" ? short : { ...short, ...long })) {
    const start = Date.now();
    try {
      await run(browser);
      console.log(`ok: ${name}: ${what}, ${Date.now() - start} ms`);
    } catch (error) {
      ++failed;
      console.log(`FAILED: ${name}: ${what}\n${error.stack}`);
    }
  }
}
await browser.end();
process.exit(failed > 0 ? 1 : 0);
