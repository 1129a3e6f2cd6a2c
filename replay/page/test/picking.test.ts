import assert from "node:assert/strict";
import { test } from "node:test";
import { directionsAround, directionTo, isHidden, turnedTowards } from "../src/flight.ts";
import { floats, wholes } from "../src/packed.ts";
import { type Lens, pointAt, projected, segmentAt, triangleAt } from "../src/picking.ts";
import { dot, length, sub, unit, type Vec } from "../src/vectors.ts";

/** A camera at the origin that looks along -z, with an angle of 90 degrees, onto 100 x 100 pixels. */
const lens: Lens = { matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0], width: 100, height: 100 };

test("points are where a camera sees them, and nowhere when they are behind it", () => {
  const screen = projected(lens, [0, 0, -2, 1, 1, -2, 0, 0, 1]);
  assert.deepEqual([...screen], [50, 50, 0.5, 75, 25, 0.5, 0, 0, 0]);
});

test("of triangles the nearest that covers a point is found, in either order of its corners", () => {
  const far = [-9, -9, -5, 9, -9, -5, 0, 9, -5];
  const near = [0, 9, -2, 9, -9, -2, -9, -9, -2];
  const screen = projected(lens, [...far, ...near]);
  assert.deepEqual(triangleAt(screen, null, 50, 50), { index: 1, nearness: 0.5 });
  assert.equal(triangleAt(screen, [0, 1, 2], 50, 50)!.index, 0);
  assert.equal(triangleAt(screen, [0, 1, 2], 1, 1), null);
});

test("nearness within a triangle is that of the place, whatever its slope", () => {
  // A floor at y = -1: seen 25 pixels below the middle it is at distance 2.
  const screen = projected(lens, [-10, -1, -1, 10, -1, -1, 0, -1, -20]);
  assert.ok(Math.abs(triangleAt(screen, null, 50, 75)!.nearness - 0.5) < 1e-6);
});

test("segments and points are met within a reach in pixels, and not behind what hides them", () => {
  const screen = projected(lens, [-1, 0, -2, 1, 0, -2, -1, 0.1, -1, 1, 0.1, -1]);
  assert.equal(segmentAt(screen, null, 50, 51, 5)!.index, 0);
  assert.equal(segmentAt(screen, null, 50, 46, 5)!.index, 1);
  assert.equal(segmentAt(screen, [0, 1], 50, 46, 5)!.index, 0);
  assert.equal(segmentAt(screen, null, 50, 51, 5, 0.9), null);
  assert.equal(segmentAt(screen, null, 50, 70, 5), null);
  assert.equal(pointAt(screen, 76, 51, 5)!.index, 1);
  assert.equal(pointAt(screen, 76, 51, 5, 0.9), null);
});

test("directions are all round, the first one first", () => {
  const all = directionsAround([0, 3, 0]);
  assert.deepEqual([...all[0]], [0, 1, 0]);
  assert.ok(all.every((way) => Math.abs(length(way) - 1) < 1e-9));
  assert.ok(all.slice(2).every((way, k) => dot(way, all[0]) <= dot(all[k + 1], all[0])));
  assert.ok(all.some((way) => dot(way, [0, -1, 0]) > 0.9));
});

const wall = { points: [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], corners: [0, 1, 2, 0, 2, 3] };

test("a wall hides what is behind it, not what is on it or before it", () => {
  const hides = (eye: Vec, place: Vec) => isHidden(eye, place, wall.points, wall.corners);
  assert.ok(hides([0.1, 0.2, 5], [0.1, 0.2, -1]));
  assert.ok(!hides([0.1, 0.2, 5], [0.1, 0.2, 0]));
  assert.ok(!hides([0.1, 0.2, 5], [0.1, 0.2, 1]));
  assert.ok(!hides([3, 0.2, 5], [3, 0.2, -1]));
});

test("the camera turns no more than it takes to see a place", () => {
  const place: Vec = [0, 0, -0.5];
  const from = directionTo(place, 4, [0, 0, 1], wall.points, wall.corners);
  assert.ok(!isHidden([4 * from[0], 4 * from[1], 4 * from[2] - 0.5], place, wall.points, wall.corners));
  assert.ok(from[2] > -0.6, String(from));
  assert.deepEqual([...directionTo(place, 4, [0, 0, -1], wall.points, wall.corners)], [0, 0, -1]);
});

test("a turn goes from one direction to the other, and across when they are opposite", () => {
  for (const [a, b] of [[[1, 0, 0], [0, 2, 0]], [[0, 0, 1], [0, 0, -1]], [[0, 1, 0], [0, -1, 0]]] as [Vec, Vec][]) {
    assert.ok(length(sub(turnedTowards(a, b, 0), unit(a))) < 1e-9);
    assert.ok(length(sub(turnedTowards(a, b, 1), unit(b))) < 1e-6);
    assert.ok(Math.abs(length(turnedTowards(a, b, 0.5)) - 1) < 1e-9);
  }
});

test("packed numbers are read as C++ wrote them", () => {
  // In C++: tests/replay/page_test.cpp.
  assert.deepEqual([...floats({ kind: "f32", data: "AACAPwAAIMA=" })], [1, -2.5]);
  assert.deepEqual([...wholes({ kind: "u16", data: "AQD//wAB" })], [1, 65535, 256]);
  assert.deepEqual([...wholes({ kind: "u32", data: "AQAAAAAAAQA=" })], [1, 65536]);
  assert.deepEqual([...wholes({ kind: "u16", data: "" })], []);
});
