// The page of a replay that goes on. Numbers on it are compared with what the program reports of the same steps.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { appendFileSync, writeFileSync } from "node:fs";
import { drawnPixels, texts } from "./harness.mjs";

const lines = (...steps) => steps.map((step) => `${JSON.stringify(step)}\n`).join("");
const header = { sesame: 1, title: "growing" };
const circle = [{ op: "simplex", name: "e", dim: 1 }, { op: "identify", pairs: [["e.0", "e.1"]] }];

/** A server of a script, and its page; what it reports, as it does. */
async function served(browser, name, content, ...options) {
  const script = browser.file(name);
  writeFileSync(script, content);
  const program = spawn(browser.sesame, ["replay", "--json", script, "--serve", "0", ...options]);
  const output = { out: "", err: "" };
  program.stdout.on("data", (data) => (output.out += data));
  const ended = new Promise((done) => program.on("exit", done));
  const url = await new Promise((done, fail) => {
    program.on("exit", () => fail(new Error(output.err)));
    program.stderr.on("data", (data) => {
      output.err += data;
      const found = /serving (http\S+)/.exec(output.err);
      found && done(found[1]);
    });
  });
  const end = async () => {
    program.kill("SIGINT");
    return ended;
  };
  const opened = await browser.goTo(url, { allowed: (other) => new URL(other).origin === new URL(url).origin });
  await opened.page.waitForSelector("#connection.live");
  const reports = () => output.out.trim().split("\n").filter(Boolean).map(JSON.parse);
  const close = async () => {
    await opened.close();
    return end();
  };
  return { ...opened, url, script, reports, end, close };
}

const isAt = (page, now) => page.waitForFunction((text) => document.getElementById("now").textContent === text, now);
const send = async (page, text) => {
  await page.fill("#lines", text);
  await page.click("#send [type=submit]");
};

export const short = {
  async "a page grows with the log, and stays where somebody looks"(browser) {
    const { page, wrong, script, reports, close } = await served(browser, "growing.jsonl", lines(header, circle[0]), "--follow");
    await isAt(page, "1 of 1");
    assert.equal(await page.locator("#title").textContent(), "growing");
    appendFileSync(script, lines(circle[1]));
    await isAt(page, "2 of 2");
    assert.deepEqual(await texts(page, "#groups .group"), ["H0 = Z", "H1 = Z"]);
    assert.deepEqual(reports().at(-1).betti, [1, 1]);
    assert.equal(await page.locator("#generators button").count(), 2);
    assert.ok((await drawnPixels(page)) > 500);
    assert.equal(await page.locator("#send").isVisible(), false);
    await page.keyboard.press("Home");
    appendFileSync(script, lines({ op: "cone", apex: "v" }, { op: "simplex", name: "f", dim: 1 }));
    await isAt(page, "0 of 4");
    await page.keyboard.press("End");
    assert.deepEqual(await texts(page, "#groups .group"), ["H0 = Z^2", "H1 = 0", "H2 = 0"]);
    assert.equal(await page.locator("#steps li").count(), 4);
    assert.deepEqual(wrong, []);
    assert.equal(await close(), 130);
  },
  async "steps are sent, refused where they are wrong, and taken back"(browser) {
    const log = browser.file("by_hand.jsonl");
    const { page, wrong, reports, close } = await served(browser, "empty.jsonl", lines(header), "--writable", "--log", log);
    await isAt(page, "0 of 0");
    await send(page, lines(...circle));
    await isAt(page, "2 of 2");
    assert.deepEqual(await texts(page, "#groups .group"), ["H0 = Z", "H1 = Z"]);
    assert.equal(await page.inputValue("#lines"), "");
    const rest = `{"op":"cone","apex":"v","over":"nothing"}\n{"op":"note","text":"behind it"}`;
    await send(page, `{"op":"note","text":"first"}\n${rest}`);
    await isAt(page, "3 of 3");
    await page.waitForSelector("#refusal:not(:empty)");
    assert.equal(await page.locator("#refusal").textContent(), 'there is no body "nothing"');
    assert.equal(await page.inputValue("#lines"), rest);
    assert.equal(await page.evaluate(() => getSelection().toString()), rest.split("\n")[0]);
    await page.click("#undo");
    await isAt(page, "4 of 4");
    await page.click("#undo");
    await isAt(page, "5 of 5");
    assert.deepEqual(await texts(page, "#groups .group"), ["H0 = Z", "H1 = 0"]);
    await browser.shot(page, "live");
    assert.deepEqual(wrong.filter((text) => !/status of 422/.test(text)), []); // which browsers list themselves
    assert.equal(reports().length, 5);
    assert.equal(await close(), 130);
    const again = browser.run("replay", "--json", log).trim().split("\n").map(JSON.parse);
    assert.deepEqual(again.slice(0, 5).map(({ betti }) => betti), reports().slice(0, 5).map(({ betti }) => betti));
  },
};

export const long = {
  async "nobody else may have it do anything"(browser) {
    const { page, url, reports, close } = await served(browser, "empty.jsonl", lines(header), "--writable");
    const at = new URL(url);
    const post = (headers) => fetch(`${at.origin}/steps`, { method: "POST", headers, body: lines(circle[0]) });
    const token = at.searchParams.get("token");
    assert.equal((await post({})).status, 403);
    assert.equal((await post({ "X-Sesame-Token": token.replace(/./g, "0") })).status, 403);
    assert.equal((await post({ "X-Sesame-Token": token, Origin: "http://elsewhere.example" })).status, 403);
    assert.equal((await fetch(`${at.origin}/events?after=x`)).status, 400);
    assert.equal((await fetch(`${at.origin}/other`)).status, 404);
    assert.equal(reports().length, 0);
    assert.equal((await post({ "X-Sesame-Token": token, Origin: at.origin })).status, 200);
    await isAt(page, "1 of 1");
    await page.goto(at.origin);
    await page.waitForSelector("#refusal:not(:empty)");
    assert.equal(await page.locator("#send").isVisible(), false);
    await close();
  },
  async "many steps come in a few pieces"(browser) {
    const { page, script, close } = await served(browser, "replaced.jsonl", lines(header, circle[0]), "--follow");
    await isAt(page, "1 of 1");
    appendFileSync(script, Array.from({ length: 300 }, (_, k) => lines({ op: "insert", simplex: [k, k + 1] })).join(""));
    await isAt(page, "301 of 301");
    assert.deepEqual(await texts(page, "#groups .group"), ["H0 = Z^2", "H1 = 0"]);
    await close();
    await page.close();
  },
};
