import assert from "node:assert/strict";
import { test } from "node:test";
import { Player } from "../src/replay/player.ts";
import { matches, wordsOf } from "../src/replay/steps_panel.ts";
import { marksOf, stepPath, torsionRuns } from "../src/replay/timeline.ts";
import { across, cross, dot, turned, unit } from "../src/vectors.ts";

test("a curve has a corner only where its value changes", () => {
  assert.equal(stepPath([1, 1, 1, 2, 2], [0, 1, 2, 3, 4], 5, (x) => 10 * x, (y) => -y), "M0,-1H30V-2H50");
  assert.equal(stepPath([1, 2], [0, 6], 9, (x) => x, (y) => y), "M0,1H6V2H9");
  assert.equal(stepPath([], [], 1, (x) => x, (y) => y), "");
});

test("axes have a few round marks", () => {
  assert.deepEqual(marksOf(0, 1), [0, 1]);
  assert.deepEqual(marksOf(-2, 2), [-2, -1, 0, 1, 2]);
  assert.deepEqual(marksOf(0, 1000), [0, 200, 400, 600, 800, 1000]);
});

test("torsion comes in runs of steps", () => {
  const numbers = [[], [[], [2]], [[], [2]], [[], [4]], []].map((torsion, steps) => ({ steps, cells: [], euler: 0, betti: [], torsion, generators: [] }));
  assert.deepEqual(torsionRuns(numbers), [
    { from: 1, to: 2, text: "H1: Z/2" },
    { from: 3, to: 3, text: "H1: Z/4" },
  ]);
});

test("a player begins at the end, stays within the stops and says where it goes", () => {
  const seen: number[] = [];
  const player = new Player([0, 4, 8, 10], (steps) => seen.push(steps));
  assert.equal(player.steps, 10);
  player.move(1);
  player.move(-1);
  assert.equal(player.before, 4);
  player.toStep(3);
  player.toPosition(-5);
  player.toStep(99);
  assert.deepEqual(seen, [8, 4, 0, 10]);
});

test("a search wants all of its words, in any case", () => {
  assert.ok(matches(wordsOf(" Ident  q.0 "), 3, "identify", '{"pairs":[["q.0","q.1"]]}'));
  assert.ok(!matches(wordsOf("identify x"), 3, "identify", ""));
  assert.ok(matches(wordsOf(""), 1, "note", ""));
});

test("directions are at right angles where they should be", () => {
  const axis = unit([1, 2, 3]);
  assert.ok(Math.abs(dot(across(axis), axis)) < 1e-12);
  const quarter = turned(across(axis), axis, Math.PI / 2);
  assert.ok(dot(quarter, cross(axis, across(axis))) > 1 - 1e-12);
});
