import assert from "node:assert/strict";
import { test } from "node:test";
import { addNews, type News, numbersOf, stopsOf } from "../src/replay/data.ts";
import { linesLeft, tokenOf } from "../src/replay/live.ts";
import { ObjectState } from "../src/replay/object.ts";
import { Player } from "../src/replay/player.ts";
import { patterns } from "../src/replay/patterns.ts";
import { square } from "./samples.ts";

test("what is left of a text begins with the line that was refused", () => {
  assert.equal(linesLeft("a\nb\nc", { taken: 1, line: 2, error: "no" }), "b\nc");
  assert.equal(linesLeft("a\nb", { taken: 2 }), "");
  assert.equal(linesLeft("a\nb", { taken: 0, error: "no answer" }), "a\nb");
});

test("the token is the one of the address", () => {
  assert.equal(tokenOf("?token=0af3&x=1"), "0af3");
  assert.equal(tokenOf(""), "");
});

test("patterns are objects of one line", () => {
  for (const [, step] of patterns) {
    assert.equal(typeof JSON.parse(step).op, "string");
    assert.ok(!step.includes("\n"));
  }
});

/** One vertex more, and an edge from the first vertex to it. */
function news(): News {
  const data = square();
  const first = data.cells.first.at(-1)!;
  return {
    title: "grown", notes: "", stride: 1, left_out: 0, families_left_out: 0,
    cells: { types: data.cells.types, names: ["v", "f"], type: [data.cells.type[0], data.cells.type[4]], first: [first, first + 2], faces: [0, 2 * data.cells.type.length] },
    places: { cells: [data.cells.type.length], points: [1, 2, 3], counts: { given: 1, sum: 0, beside: 0, computed: 0 } },
    steps: [{ op: "cone", text: "cone", made: [data.cells.type.length, 2], betti: [7] }],
    classes: [],
  };
}

test("news are added behind what there was, wherever the object is", () => {
  for (const at of [0, 1]) {
    const data = square();
    const object = new ObjectState(data);
    const [cells, steps] = [data.cells.type.length, data.steps.length];
    object.goTo(steps * at);
    const before = object.currentCells();
    addNews(data, news());
    object.grow();
    assert.deepEqual(object.currentCells(), before);
    object.goTo(data.steps.length);
    assert.deepEqual(object.currentCells().slice(-2), [cells, cells + 1]);
    assert.deepEqual([0, 1].map((k) => object.face(cells + 1, k)?.cell), [0, cells]);
    assert.equal(object.dimension(cells + 1), 1);
    const numbers = numbersOf(data.steps, stopsOf(data.steps.length, 1));
    assert.deepEqual(numbers.at(-1)!.betti, [7]);
    assert.equal(numbers.length, data.steps.length + 1);
    assert.equal(data.title, "grown");
  }
});

test("who is at the end stays there when steps come, others stay where they are", () => {
  const player = new Player(stopsOf(4, 1), () => {});
  player.setStops(stopsOf(6, 1));
  assert.equal(player.steps, 6);
  player.toPosition(2);
  player.setStops(stopsOf(9, 1));
  assert.equal(player.steps, 2);
  player.toPosition(3);
  player.setStops(stopsOf(9, 2)); // where it no longer stops: the next one
  assert.equal(player.steps, 4);
});
