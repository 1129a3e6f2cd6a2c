import assert from "node:assert/strict";
import { test } from "node:test";
import { bentCurve, curvesOf, reversed, straightCurve } from "../src/replay/curves.ts";
import { ObjectState } from "../src/replay/object.ts";
import { length, sub, type Vec } from "../src/vectors.ts";
import { dataOf, ref, square } from "./samples.ts";

const near = (a: Vec, b: Vec) => length(sub(a, b)) < 1e-9;

test("an edge alone between its ends is straight", () => {
  const object = new ObjectState(square());
  object.goTo(1);
  const curves = curvesOf(object, [4, 5, 6, 7], (cell) => [cell, 0, 0], 1);
  assert.ok([...curves.of.values()].every((curve) => curve.straight));
  assert.ok(near(curves.of.get(5)!.from, [0, 0, 0]) && near(curves.of.get(5)!.to, [2, 0, 0]));
});

test("a loop is a closed curve that leaves its point", () => {
  const object = new ObjectState(square());
  object.goTo(3);
  const curves = curvesOf(object, [4, 5], () => [1, 2, 3], 1);
  for (const curve of curves.of.values()) {
    assert.ok(curve.loop && near(curve.at(0), [1, 2, 3]) && near(curve.at(1), [1, 2, 3]));
    assert.ok(length(sub(curve.at(0.5), [1, 2, 3])) > 0.3);
  }
});

test("edges with the same ends are apart in the middle, whichever way they run", () => {
  const object = new ObjectState(
    dataOf([[[], "v", []], [[], "w", []], [[1], "a", [ref(1), ref(0)]], [[1], "b", [ref(0), ref(1)]]], [], [{ op: "s", text: "", made: [0, 4] }]),
  );
  object.goTo(1);
  const { of } = curvesOf(object, [2, 3], (cell) => [cell, 0, 0], 1);
  assert.ok(length(sub(of.get(2)!.at(0.5), of.get(3)!.at(0.5))) > 0.5);
  assert.ok(near(of.get(2)!.at(0), [0, 0, 0]) && near(of.get(3)!.at(0), [1, 0, 0]));
});

test("a reversed curve runs from its end to its beginning", () => {
  for (const curve of [straightCurve([0, 0, 0], [1, 0, 0]), bentCurve([0, 0, 0], [1, 0, 0], 1, 3)]) {
    const back = reversed(curve);
    assert.ok(near(back.from, curve.to) && near(back.at(0.2), curve.at(0.8)));
  }
});
