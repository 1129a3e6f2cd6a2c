import assert from "node:assert/strict";
import { test } from "node:test";
import { ObjectState } from "../src/replay/object.ts";
import { dataOf, ref, square } from "./samples.ts";

test("cells are those of each step, forwards and backwards, and past an undo", () => {
  const object = new ObjectState(square());
  const counts = (steps: number) => {
    object.goTo(steps);
    const cells = object.currentCells();
    return [0, 1, 2].map((p) => cells.filter((cell) => object.dimension(cell) === p).length);
  };
  const expected = [[0, 0, 0], [4, 4, 1], [2, 3, 1], [1, 2, 1], [4, 4, 1]];
  for (const steps of [0, 1, 2, 3, 4, 3, 2, 4, 1, 4, 0, 3]) {
    assert.deepEqual(counts(steps), expected[steps], `after ${steps} steps`);
  }
});

test("what was glued has the oldest cell's name, and loses it when that is taken back", () => {
  const object = new ObjectState(square());
  object.goTo(3);
  assert.deepEqual(object.find(3), { cell: 0, turned: false, squashed: false });
  assert.equal(object.name(object.find(6)!.cell), "bottom");
  object.goTo(4);
  assert.equal(object.name(object.find(6)!.cell), "top");
});

test("the older of two names stays when the younger cell does", () => {
  const object = new ObjectState(dataOf([[[], "a", []], [[], "b", []]], [], [{ op: "s", text: "", made: [0, 2] }, { op: "i", text: "", removed: [0, ref(1)] }]));
  object.goTo(2);
  assert.deepEqual([object.oldest(1), object.name(1)], [0, "a"]);
  object.goTo(1);
  assert.equal(object.name(1), "b");
});

test("turns add up along a way, and a squashed cell is followed onto what it lies on", () => {
  const edge = (name: string): [number[], string, number[]] => [[1], name, [ref(0), ref(0)]];
  const object = new ObjectState(
    dataOf([[[], "v", []], edge("a"), edge("b"), edge("c")], [], [
      { op: "s", text: "", made: [0, 4] },
      { op: "i", text: "", removed: [1, ref(2, true), 2, ref(3, true)] },
      { op: "d", text: "", removed: [3, -2] },
    ]),
  );
  object.goTo(2);
  assert.deepEqual(object.find(1), { cell: 3, turned: false, squashed: false });
  assert.deepEqual(object.find(2), { cell: 3, turned: true, squashed: false });
  object.goTo(3);
  assert.deepEqual(object.find(1), { cell: 0, turned: false, squashed: true });
});

test("a face that has moved is another one, until that is taken back", () => {
  const object = new ObjectState(
    dataOf([[[], "v", []], [[1], "e", [ref(0), ref(0)]], [[], "w", []]], [], [
      { op: "s", text: "", made: [0, 2] },
      { op: "deidentify", text: "", made: [2, 1], moved: [1, 0, ref(2)] },
    ]),
  );
  object.goTo(2);
  assert.deepEqual([object.face(1, 0)!.cell, object.face(1, 1)!.cell], [2, 0]);
  assert.deepEqual([...object.touchedBy(1, 2)].sort(), [1, 2]);
  object.goTo(1);
  assert.equal(object.face(1, 0)!.cell, 0);
});

test("factors are gone after a product, and there again before it", () => {
  const object = new ObjectState(dataOf([[[], "a", []], [[], "P.(a|a)", []]], [], [{ op: "s", text: "", made: [0, 1] }, { op: "product", text: "", made: [1, 1], consumed: [0] }]));
  object.goTo(2);
  assert.deepEqual(object.currentCells(), [1]);
  object.goTo(1);
  assert.deepEqual(object.currentCells(), [0]);
});

test("a step touches what it made and what it glued, an undo what it brought back", () => {
  const object = new ObjectState(square());
  object.goTo(2);
  assert.deepEqual([...object.touchedBy(1, 2)].sort(), [0, 2, 5]);
  object.goTo(4);
  assert.deepEqual([...object.touchedBy(3, 4)].sort(), [1, 2, 3, 6, 7]);
});

test("steps that made cells and nothing else are their number", () => {
  const cells: [number[], string, number[]][] = ["a", "b", "c", "d"].map((name) => [[], name, []]);
  const data = dataOf(cells, [], [{ op: "s", text: "", made: [0, 1] }]);
  data.steps.push(2, 0, { op: "s", text: "", made: [3, 1] });
  const object = new ObjectState(data);
  assert.deepEqual([0, 1, 2, 3, 4].map((steps) => (object.goTo(steps), object.currentCells().length)), [0, 1, 3, 3, 4]);
  assert.deepEqual([...object.touchedBy(1, 3)], [1, 2]);
  object.goTo(1);
  assert.deepEqual(object.currentCells(), [0]);
});
