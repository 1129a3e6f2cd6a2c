import assert from "node:assert/strict";
import { test } from "node:test";
import { chainJson, chainSum } from "../src/tower/chain_text.ts";
import { barSentences, operationText } from "../src/tower/class_panel.ts";
import { shapeOf } from "../src/tower/inks.ts";
import { Model } from "../src/tower/model.ts";
import { counted, marksIn, shortNumber, Times, widened, withSeparators } from "../src/tower/numbers.ts";
import { circle, towerData } from "./tower_samples.ts";

test("numbers are short, whole ones in full", () => {
  assert.deepEqual([1 / 3, 12345678, 1e-9 / 3, Infinity, -2.5].map(shortNumber), ["0.333333", "12345678", "3.33333e-10", "\u221e", "-2.5"]);
  assert.deepEqual([0, 999, 1000, 1234567].map(withSeparators), ["0", "999", "1,000", "1,234,567"]);
  assert.deepEqual([counted(1, "bar"), counted(2000, "bar")], ["1 bar", "2,000 bars"]);
});

test("times are read and written in full, from wherever they are counted", () => {
  const far = new Times("1732800000000000000");
  assert.equal(far.text(3), "1732800000000000003");
  assert.equal(far.read("1732800000000000007"), 7);
  assert.equal(far.interval(3, Infinity), "[1732800000000000003, \u221e)");
  assert.equal(far.axis("time"), "time, counted from 1732800000000000000");
  const near = new Times("0");
  assert.deepEqual(["12", " 1,000 ", "-2.5e1", "inf", "-inf", "", "x", "1 2"].map((text) => near.read(text)), [12, 1000, -25, Infinity, -Infinity, null, null, null]);
  assert.equal(near.axis("time"), "time");
});

const texts = (low: number, high: number, most: number) => marksIn({ low, high }, most).map(({ text }) => text);

test("axes have marks at round numbers, with the decimals that they need", () => {
  assert.deepEqual(texts(0, 11, 6), ["0", "2", "4", "6", "8", "10"]);
  assert.deepEqual(texts(-0.25, 0.3, 6), ["-0.2", "-0.1", "0.0", "0.1", "0.2", "0.3"]);
  assert.deepEqual(texts(0, 2e6, 5), ["0", "500,000", "1,000,000", "1,500,000", "2,000,000"]);
});

test("axes end, whatever the numbers are", () => {
  for (const ends of [[-1e308, 1e308], [0, 5e-324], [1e16, 1e16 + 2], [1.7e308, 1.7e308], [0, 0], [-2, -1]] as const) {
    const range = widened(ends, 0.02);
    assert.ok(range.low < range.high || ends[0] === 1e16, JSON.stringify(range));
    assert.ok(Number.isFinite(range.high - range.low));
    assert.ok(marksIn(range, 8).length <= 20);
  }
});

test("chains are text that people read and programs take", () => {
  const chain: [number | string, number[]][] = [[-1, [0, 1]], [2, [1, 2]], ["-1/2", [2, 3]]];
  assert.equal(chainSum(chain), "-{0 1} + 2 {1 2} - 1/2 {2 3}");
  assert.equal(chainSum([]), "0");
  assert.equal(chainSum(chain, 1), "-{0 1} + \u2026 (2 more terms)");
  assert.deepEqual(JSON.parse(chainJson(chain)), chain);
  assert.equal(chainJson([[1, ["18446744073709551615", 3]]]), "[[1,[18446744073709551615,3]]]");
});

test("a bar is said with the operations that made it and ended it", () => {
  const classes = [{ bar: 3, born: { line: 6, text: "i 0 2", after: 6 }, killed: { line: 7, text: "c 0 1", after: 7 }, cycle: [], bounds: [] }];
  const model = new Model(towerData(circle, { classes }));
  assert.deepEqual(barSentences(model, 3), ["Born at time 5 by including {0 2}, line 6.", "Ends at time 6 by contracting 0 into 1, line 7; length 1."]);
  assert.deepEqual(barSentences(model, 2), ["Born at time 0.", "It never ends."]);
  assert.equal(operationText({ line: 9, text: "column 4: 1 2", after: 5 }), "by column 4: 1 2");
});

test("dimensions differ in colour or shape", () => {
  const looks = Array.from({ length: 32 }, (_, dim) => `${dim % 8} ${shapeOf(dim)}`);
  assert.equal(new Set(looks).size, 32);
});
