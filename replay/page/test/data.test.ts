import assert from "node:assert/strict";
import { test } from "node:test";
import { dimensionOf, numbersOf, stopsOf } from "../src/replay/data.ts";
import { square } from "./samples.ts";

test("numbers that are not there are those of the step before", () => {
  const numbers = numbersOf([{ op: "a", text: "", betti: [1], euler: 1, cells: [1], torsion: [[]], generators: [4] }, { op: "b", text: "" }], [0, 1, 2]);
  assert.deepEqual(numbers.map(({ betti }) => betti), [[], [1], [1]]);
  assert.deepEqual(numbers.map(({ steps }) => steps), [0, 1, 2]);
  assert.equal(numbers[2].euler, 1);
  assert.deepEqual(numbers[2].generators, [4]);
});

test("numbers of steps at which the page does not stop are passed over", () => {
  const steps = [{ op: "a", text: "", betti: [1] }, 7, { op: "c", text: "", euler: 3, generators: null }];
  const numbers = numbersOf(steps, [0, 3]);
  assert.deepEqual(numbers[1], { steps: 3, cells: [], euler: 3, betti: [1], torsion: [], generators: null });
  assert.deepEqual(numbers[0].betti, []);
});

test("a page stops at the beginning, at the end, and evenly between", () => {
  assert.deepEqual(stopsOf(3, 1), [0, 1, 2, 3]);
  assert.deepEqual(stopsOf(10, 4), [0, 4, 8, 10]);
  assert.deepEqual(stopsOf(8, 4), [0, 4, 8]);
  assert.deepEqual(stopsOf(0, 1), [0]);
});

test("the dimension of a cell is that of its type", () => {
  assert.deepEqual([0, 4, 8].map((cell) => dimensionOf(square(), cell)), [0, 1, 2]);
});
