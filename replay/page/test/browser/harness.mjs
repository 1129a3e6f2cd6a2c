// What the tests of all pages do in a browser.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const executablePath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);

export class Browser {
  static async start(sesame, examples, shots) {
    if (!executablePath) {
      return null;
    }
    const browser = new Browser();
    Object.assign(browser, { sesame, examples, shots, folder: mkdtempSync(join(tmpdir(), "sesame-browser-")) });
    browser.chromium = await chromium.launch({
      executablePath,
      args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    });
    return browser;
  }

  async end() {
    await this.chromium.close();
    rmSync(this.folder, { recursive: true });
  }

  /** Runs the program; what it prints. */
  run(...words) {
    return execFileSync(this.sesame, words, { encoding: "utf8", maxBuffer: 1 << 30 });
  }

  /** A file of the folder for tests. */
  file(name) {
    return join(this.folder, name);
  }

  /** A page of this address, and what is wrong on it: errors, warnings, requests of anything else than `allowed`. */
  async goTo(url, { colorScheme = "light", viewport = { width: 1200, height: 900 }, allowed = (other) => other === url } = {}) {
    const context = await this.chromium.newContext({ colorScheme, viewport });
    const page = await context.newPage();
    page.setDefaultTimeout(120_000); // machines may be slow, and have other things to do
    const wrong = [];
    page.on("console", (message) => ["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && wrong.push(message.text()));
    page.on("pageerror", (error) => wrong.push(String(error)));
    page.on("request", (request) => !allowed(request.url()) && wrong.push(`request of ${request.url()}`));
    await page.goto(url, { timeout: 120_000 }); // a busy machine takes long for the first page
    return { page, wrong, close: () => context.close() };
  }

  /** The page in a file. */
  open(html, options) {
    return this.goTo(pathToFileURL(html).href, options);
  }

  /** A picture of the page, for people to look at, if they want any. */
  async shot(page, name) {
    await (this.shots && page.screenshot({ path: join(this.shots, `${name}.png`) }));
  }
}

/** How many pixels of the picture in space are none of the background. */
export function drawnPixels(page) {
  return page.evaluate(async () => {
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
}

export const texts = (page, selector) => page.locator(selector).allTextContents();
