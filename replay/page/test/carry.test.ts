import assert from "node:assert/strict";
import { test } from "node:test";
import { carried } from "../src/replay/carry.ts";
import { ClassEnds } from "../src/replay/class_ends.ts";
import type { Step } from "../src/replay/data.ts";
import { ObjectState } from "../src/replay/object.ts";
import { dataOf, ref, square } from "./samples.ts";

test("terms of cells that are one now are added up, in integers of any size and in fractions", () => {
  const object = new ObjectState(square());
  object.goTo(1);
  const chain = { terms: [["1", 5], ["-1/2", 6], ["100000000000000000000", 4]] as [string, number][] };
  assert.deepEqual(carried(object, chain).terms, chain.terms);
  object.goTo(2); // bottom and top become one
  const [one, other] = carried(object, chain).terms;
  assert.equal(one[0], "1/2");
  assert.deepEqual(other, ["100000000000000000000", 4]);
});

test("what comes to nothing is no term; what is not shown stays as it is", () => {
  const object = new ObjectState(square());
  object.goTo(2);
  assert.deepEqual(carried(object, { terms: [["1", 5], ["-1", 6], ["2", -1, "far"]] }).terms, [["2", -1, "far"]]);
  assert.deepEqual(carried(object, { terms: [], length: 7 }), { terms: [], length: 7 });
});

test("a cell that is glued the other way round counts with the other sign, a squashed one not at all", () => {
  const cells: [number[], string, number[]][] = [[[], "a", []], [[], "b", []], [[1], "e", [ref(1), ref(0)]], [[1], "f", [ref(0), ref(1)]]];
  const steps: Step[] = [
    { op: "complex", text: "", made: [0, 4] },
    { op: "identify", text: "", removed: [3, ref(2, true)] },
    { op: "degenerate", text: "", removed: [2, -2 - 0] },
  ];
  const object = new ObjectState(dataOf(cells, [], steps));
  object.goTo(2);
  assert.deepEqual(carried(object, { terms: [["3", 3]] }).terms, [["-3", 2]]);
  object.goTo(3);
  assert.deepEqual(carried(object, { terms: [["3", 3]] }).terms, []);
});

test("the end of a class is the next one behind the step where it is looked at", () => {
  const steps: Step[] = [{ op: "a", text: "" }, { op: "b", text: "", ended: [[0, "bounds"]] }, { op: "undo", text: "" }];
  const ends = new ClassEnds(steps);
  assert.equal(ends.after(1, 0)?.step, 1);
  assert.equal(ends.after(2, 0), null);
  steps.push({ op: "c", text: "", ended: [[0, "cut"]] });
  ends.grow();
  assert.equal(ends.after(2, 0)?.step, 3);
  assert.match(ends.after(2, 0)!.sentence, /split/);
  assert.equal(ends.after(0, 1), null);
});
