import assert from "node:assert/strict";
import { test } from "node:test";
import { componentsOf, drawnOf, placesOf, skeletonOf } from "../src/replay/geometry.ts";
import { ballAround, faceBuffers, lineBuffers, rgb } from "../src/buffers.ts";
import { overlayOf } from "../src/replay/chains.ts";
import { ObjectState } from "../src/replay/object.ts";
import { dataOf, ref, square } from "./samples.ts";

function drawn(steps: number) {
  const data = square();
  const object = new ObjectState(data);
  object.goTo(steps);
  return { object, drawing: drawnOf(object, placesOf(data.places.cells, data.places.points)) };
}

test("what is drawn is what is there, with glued vertices where the oldest is", () => {
  const { drawing } = drawn(2);
  assert.deepEqual(drawing.vertices.map(({ cell, at }) => [cell, at]), [[0, [0, 0, 0]], [2, [1, 0, 0]]]);
  assert.deepEqual(drawing.edges.map(({ cell }) => cell).sort(), [4, 5, 7]);
  assert.deepEqual([drawing.faces.length, drawing.missing], [1, 0]);
});

test("buffers have the cell of each triangle and segment", () => {
  const { drawing } = drawn(1);
  const faces = faceBuffers(drawing.faces, () => rgb(0xffffff));
  assert.deepEqual([faces.positions.length, [...faces.cells]], [18, [8, 8]]);
  assert.ok(Math.abs(faces.colours[0] - 1) < 1e-6);
  assert.deepEqual(lineBuffers(drawing.edges, () => [0, 0, 0]).cells.sort(), [4, 5, 6, 7]);
});

test("everything that is drawn is within the ball around it", () => {
  const { middle, radius } = ballAround(drawn(1).drawing);
  assert.deepEqual([...middle], [0.5, 0.5, 0]);
  assert.ok(Math.abs(radius - Math.SQRT1_2) < 1e-9);
});

test("pieces that hang together have one number, the largest piece 0", () => {
  const data = dataOf([[[], "a", []], [[], "b", []], [[], "c", []], [[1], "e", [ref(2), ref(1)]]], [], [{ op: "s", text: "", made: [0, 4] }]);
  const object = new ObjectState(data);
  object.goTo(1);
  assert.deepEqual([...componentsOf(object)], [[0, 1], [1, 0], [2, 0], [3, 0]]);
});

test("a solid without faces cannot be drawn, and is counted", () => {
  const data = dataOf([[[], "v", []], [[3], "t", [-2, -2, -2, -2]]], [[0, 0, 0, 0]], [{ op: "s", text: "", made: [0, 2] }]);
  const object = new ObjectState(data);
  object.goTo(1);
  assert.equal(drawnOf(object, placesOf(data.places.cells, data.places.points)).missing, 1);
});

test("a solid is shown by its faces, a chain by its cells as they are now", () => {
  const data = square();
  data.cells.types.push([1, 1, 1]);
  data.cells.type.push(data.cells.types.length - 1);
  data.cells.names.push("cube");
  data.cells.faces.push(ref(8), ref(8), -2);
  data.cells.first.push(data.cells.faces.length);
  const object = new ObjectState(data);
  object.goTo(1);
  assert.deepEqual([...skeletonOf(object, 9)], [8]);
  object.goTo(3);
  const drawing = drawnOf(object, placesOf(data.places.cells, data.places.points));
  const overlay = overlayOf(object, drawing, { terms: [["1", 6], ["-2", -1, "x"]] }, 0xff0000);
  assert.equal(drawing.missing, 0);
  assert.deepEqual([overlay.paths.length, overlay.points.length, overlay.faces.length], [1, 0, 0]);
});
