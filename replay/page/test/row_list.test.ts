import assert from "node:assert/strict";
import { test } from "node:test";
import { rowsInSight } from "../src/replay/row_list.ts";

test("a short list is there as a whole", () => {
  assert.deepEqual(rowsInSight(0, 28, 0, 280), [0, 0]);
  assert.deepEqual(rowsInSight(200, 28, 2800, 280), [0, 200]);
});

test("of a long one what is in sight, and as much on each side as there is", () => {
  assert.deepEqual(rowsInSight(10_000, 28, 0, 280), [0, 30]);
  assert.deepEqual(rowsInSight(10_000, 28, 28_014, 280), [980, 1031]);
  assert.deepEqual(rowsInSight(10_000, 28, 280_000 - 280, 280), [9970, 10_000]);
});

test("what is scrolled beyond the end shows the end", () => {
  assert.deepEqual(rowsInSight(300, 28, 1e9, 280), [280, 300]);
});
