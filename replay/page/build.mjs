// Makes bundle/page.html from src/: one file with script, style and the licence of three.js in it.
//   node build.mjs          writes it
//   node build.mjs --stdout prints it instead
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync, readdirSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const read = (name) => readFileSync(join(here, name), "utf8");

/** What the bundle is made from, in one order. tests/scripts/page_bundle_test.py reckons the same. */
const inSources = readdirSync(join(here, "src"), { recursive: true, withFileTypes: true });
const files = inSources.filter((entry) => entry.isFile()).map((entry) => relative(here, join(entry.parentPath ?? entry.path, entry.name)));
const sources = ["build.mjs", "package.json", "package-lock.json", "tsconfig.json", ...files.sort()];
const hash = createHash("sha256");
for (const name of sources) {
  hash.update(`${name}\n${read(name)}`);
}

const options = { bundle: true, minify: true, write: false, charset: "ascii", legalComments: "none", logLevel: "warning" };
const script = (await build({ ...options, entryPoints: [join(here, "src/main.ts")], format: "iife", target: "es2020" })).outputFiles[0].text.trim();
const style = (await build({ ...options, entryPoints: [join(here, "src/pages.css")], target: "es2020" })).outputFiles[0].text.trim();
const policy = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;

/** What each page is made of, which is in a folder of its name. */
const bodies = files.filter((name) => name.endsWith("/body.html")).sort();
const templates = bodies.map((name) => `<template id="${name.split("/").at(-2)}-page">\n${read(name).trim()}\n</template>`);

const parts = {
  "@TEMPLATES@": templates.join("\n"),
  "@SCRIPT_HASH@": policy(script),
  "@STYLE_HASH@": policy(style),
  "@STYLE@": style,
  "@SCRIPT@": script,
};
let page = read("src/page.html");
for (const [mark, text] of Object.entries(parts)) {
  page = page.replace(mark, () => text);
}
const licence = read("node_modules/three/LICENSE").trim().replaceAll("\u00a9", "(c)");
const { version } = JSON.parse(read("node_modules/three/package.json"));
page = page.replace("<head>", () => `<head>\n<!-- sources ${hash.digest("hex")} -->\n<!-- This page contains three.js ${version}:\n\n${licence}\n-->`);

// Each of these would break the page, or the C++ literals that it is put into.
const wrong = [
  [/[^\x00-\x7f]/.test(page), "it is not ASCII"],
  [page.split("@SESAME_PAGE_DATA@").length !== 2, "the mark for the data is not there once"],
  [page.includes(')sesame_page"'), "it has the end of a C++ literal in it"],
  [licence.includes("--"), "the licence ends its comment"],
  [/<\/script/i.test(script), "the script ends its element"],
].filter(([is]) => is);
if (wrong.length > 0) {
  throw new Error(wrong.map(([, what]) => what).join("; "));
}
if (process.argv.includes("--stdout")) {
  process.stdout.write(page);
} else {
  writeFileSync(join(here, "bundle/page.html"), page);
  console.log(`bundle/page.html: ${page.length} bytes`);
}
