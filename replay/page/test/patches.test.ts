import assert from "node:assert/strict";
import { test } from "node:test";
import { bentCurve, circleAt, circleCurve, curvesOf, straightCurve } from "../src/replay/curves.ts";
import { ObjectState } from "../src/replay/object.ts";
import { patchOf, squarePoint, trianglePoint } from "../src/replay/patches.ts";
import { length, sub, type Vec } from "../src/vectors.ts";
import { dataOf, ref, square } from "./samples.ts";

const near = (a: Vec, b: Vec) => length(sub(a, b)) < 1e-9;

test("a triangle has its three curves as sides", () => {
  const [a, b, c]: Vec[] = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
  const [ab, bc, ac] = [bentCurve(a, b, 0, 2), straightCurve(b, c), bentCurve(a, c, 1, 3)];
  for (const t of [0, 0.3, 1]) {
    assert.ok(near(trianglePoint(ab, bc, ac, 1 - t, t, 0), ab.at(t)));
    assert.ok(near(trianglePoint(ab, bc, ac, 0, 1 - t, t), bc.at(t)));
    assert.ok(near(trianglePoint(ab, bc, ac, 1 - t, 0, t), ac.at(t)));
  }
});

test("a square has its four curves as sides, loops too", () => {
  const [one, other] = [0, 1].map((k) => circleCurve(circleAt([0, 0, 0], k, 1)));
  for (const t of [0, 0.3, 1]) {
    assert.ok(near(squarePoint(one, one, other, other, t, 0), one.at(t)));
    assert.ok(near(squarePoint(one, one, other, other, t, 1), one.at(t)));
    assert.ok(near(squarePoint(one, one, other, other, 0, t), other.at(t)));
  }
});

function patch(steps: number, data = square()) {
  const object = new ObjectState(data);
  object.goTo(steps);
  const cells = object.currentCells();
  const at = new Map(data.places.cells.map((cell, k) => [cell, data.places.points.slice(3 * k, 3 * k + 3) as unknown as Vec]));
  const placeOf = (cell: number) => at.get(object.oldest(cell)) ?? ([0, 0, 0] as Vec);
  const curves = curvesOf(object, cells.filter((cell) => object.dimension(cell) === 1), placeOf, 1);
  const face = cells.find((cell) => object.dimension(cell) === 2)!;
  return { triangles: patchOf(object, curves, placeOf, face, 6, new Map(), 1), curves };
}

test("a square that is flat is two triangles", () => {
  assert.equal(patch(1).triangles!.length, 6);
});

test("a square whose sides are two loops is a torus that contains both, with room inside", () => {
  const { triangles, curves } = patch(3);
  for (const curve of curves.of.values()) {
    const [quarter] = [curve.at(0.25)];
    assert.ok(triangles!.some((point) => near(point, quarter)));
  }
  const extent = [0, 1, 2].map((axis) => {
    const values = triangles!.map((point) => point[axis]);
    return Math.max(...values) - Math.min(...values);
  });
  assert.ok(extent.every((x) => x > 0.5), String(extent));
});

test("a triangle with one edge thrice is no flat disc", () => {
  const data = dataOf([[[], "v", []], [[1], "e", [ref(0), ref(0)]], [[2], "t", [ref(1), ref(1), ref(1)]]], [[0, 0, 0, 0]], [{ op: "s", text: "", made: [0, 3] }]);
  const heights = patch(1, data).triangles!.map((point) => point[2]);
  assert.ok(Math.max(...heights) - Math.min(...heights) > 0.1);
});

test("a face is not drawn when a side is not shown", () => {
  const data = dataOf([[[], "v", []], [[1], "e", [ref(0), ref(0)]], [[2], "t", [ref(1), -1, ref(1)]]], [[0, 0, 0, 0]], [{ op: "s", text: "", made: [0, 3] }]);
  assert.equal(patch(1, data).triangles, null);
});

test("a face all of whose sides are squashed is a sphere", () => {
  const data = dataOf([[[], "v", []], [[2], "t", [-2, -2, -2]]], [[0, 5, 0, 0]], [{ op: "s", text: "", made: [0, 2] }]);
  const { triangles } = patch(1, data);
  assert.ok(triangles!.some((point) => near(point, [5, 0, 0])));
  const middle = triangles!.reduce((sum, point) => sum.map((x, k) => x + point[k] / triangles!.length) as unknown as Vec, [0, 0, 0] as Vec);
  assert.ok(triangles!.every((point) => Math.abs(length(sub(point, middle)) - 0.25) < 0.02));
});

test("a side that is squashed is a point", () => {
  const data = dataOf([[[], "v", []], [[1], "e", [ref(0), ref(0)]], [[2], "t", [ref(1), -2, ref(1)]]], [[0, 5, 0, 0]], [{ op: "s", text: "", made: [0, 3] }]);
  assert.ok(patch(1, data).triangles!.some((point) => near(point, [5, 0, 0])));
});
