import assert from "node:assert/strict";
import { test } from "node:test";
import { dashed, byLength, LengthScale, shorterThan, sliderSteps } from "../src/mesh/loops.ts";
import { boxText, componentText, meaningText, meetingsText, numberText, orientationText, pointText, sideMeaning, verdictText, verticesText, vertexText } from "../src/mesh/mesh_text.ts";
import { ballOf, placeGroups } from "../src/mesh/places.ts";
import { remarksOf } from "../src/mesh/remarks.ts";
import { type Data, type Loop, Mesh } from "../src/mesh/data.ts";
import { length, sub, type Vec } from "../src/vectors.ts";
import { packedFloats, packedWholes, squareMesh } from "./mesh_samples.ts";

const loopOf = (length: number | string, rest: Partial<Loop> = {}): Loop => ({
  order: "0", side: null, component: 0, length, short: true, closed: true, box: [[0, 0, 0], [1, 1, 0]], centre: [0, 0, 0], edges: [0, 1, 1, 2, 2, 0], ...rest,
});

test("loops are listed by length, and those of the limit are left out, as by --shorter-than", () => {
  const loops = [loopOf(3), loopOf(1), loopOf("1e+400"), loopOf(2)];
  const order = byLength(loops);
  assert.deepEqual(order, [1, 3, 0, 2]);
  assert.deepEqual(shorterThan(loops, order, 2), [1]);
  assert.deepEqual(shorterThan(loops, order, 2.001), [1, 3]);
  assert.deepEqual(shorterThan(loops, order, Infinity), [1, 3, 0]);
});

test("a slider for lengths begins with none and ends with all, and knows its steps again", () => {
  const scale = new LengthScale([0.01, 5, 100]);
  assert.equal(scale.limitAt(0), 0.01);
  assert.ok(scale.limitAt(sliderSteps - 1) > 100);
  assert.equal(scale.limitAt(sliderSteps), Infinity);
  for (const step of [0, 17, 120, sliderSteps]) {
    assert.equal(scale.stepOf(scale.limitAt(step)), step);
  }
  assert.equal(new LengthScale([]).limitAt(sliderSteps), Infinity);
  assert.equal(new LengthScale([2, 2]).stepOf(Infinity), sliderSteps);
});

test("dashes go on over the corners of a line, and have the share of its length that they should", () => {
  const corner: [Vec, Vec][] = [[[0, 0, 0], [1.5, 0, 0]], [[1.5, 0, 0], [1.5, 1.5, 0]]];
  const cut = dashed(corner, 1, 1);
  assert.deepEqual(cut.map(([from, to]) => [from.slice(0, 2), to.slice(0, 2)]), [[[0, 0], [1, 0]], [[1.5, 0.5], [1.5, 1.5]]]);
  const fine = dashed(corner, 0.02, 0.03).reduce((sum, [from, to]) => sum + length(sub(to, from)), 0);
  assert.ok(Math.abs(fine - 3 * 0.4) < 0.03, String(fine));
});

test("numbers are written as in the table of the program", () => {
  assert.equal(numberText(4.828427124746), "4.82843");
  assert.equal(numberText("1.5e+400"), "1.5e+400");
  assert.equal(numberText(1e-7), "1e-7");
  assert.equal(pointText([1e-20, 2, -0.333333333], 2), "(0, 2, -0.33333)");
  assert.equal(boxText([[0, 0, 0], [1, 2, 3]]), "(0, 0, 0) to (1, 2, 3)");
});

test("what a mesh is stands in plain words", () => {
  const data = squareMesh();
  assert.equal(verdictText(data), "A surface with boundary, 1 component.");
  assert.equal(orientationText(data, 0), "Orientable, and the faces agree.");
  assert.equal(orientationText({ ...data, consistently_oriented: false }, 2), "Orientable, but the faces disagree across 2 edges.");
  assert.equal(componentText(data.components[0]), "4 vertices, 5 edges, 2 faces, Euler characteristic 1, 1 boundary loop, genus 0");
  assert.equal(meaningText(data, 1), "no tunnels: every loop is filled in");
  assert.match(meaningText({ ...data, torsion: [[], [2], []] }, 1), /^no tunnels; torsion/);
});

test("a loop says where it runs and on which side it bounds", () => {
  const data = squareMesh();
  const mesh = new Mesh({ ...data, numbers: packedWholes([7, 8, 9, 12]), points_in_file: 12 });
  assert.equal(verticesText(loopOf(1), mesh), "7 8 9");
  assert.equal(verticesText(loopOf(1, { closed: false }), mesh), "7-8 8-9 9-7");
  assert.match(sideMeaning(loopOf(1, { side: "handle" }), []), /inside/);
  assert.match(sideMeaning(loopOf(1, { side: "tunnel" }), []), /outside/);
  assert.equal(sideMeaning(loopOf(1), data.components), "It has no side: it has a boundary, so it has no inside.");
  assert.equal(vertexText(1, mesh), "vertex 8 at (30, 10, 5)");
  assert.match(vertexText(3, mesh), /^point in the middle of a polygon/);
});

test("coordinates of the page are those of the file, moved and scaled", () => {
  const mesh = new Mesh(squareMesh());
  assert.deepEqual(mesh.toFile(mesh.at(2)), [30, 30, 5]);
  assert.deepEqual(mesh.fromFile([20, 20, 5]), [0, 0, 0]);
});

test("runs of triangles are those that are drawn, also when only some are", () => {
  const data = squareMesh();
  assert.deepEqual([...new Mesh(data).cornersOf([0, 2])], [0, 1, 2, 0, 2, 3]);
  assert.deepEqual([...new Mesh(data).cornersOf([1, 1])], [0, 2, 3]);
  const every = new Mesh({ ...data, stride: 2, triangles: packedWholes([0, 1, 2, 0, 2, 3]), triangles_in_all: 4 });
  assert.deepEqual([...every.cornersOf([1, 2])], [0, 2, 3]);
  assert.deepEqual([...every.cornersOf([1, 1])], []);
});

test("places are listed by kind, each with what is to be marked and seen", () => {
  const data = squareMesh();
  data.places.non_manifold_vertices = packedWholes([2]);
  data.places.non_manifold_edges = packedWholes([0, 2]);
  const groups = placeGroups(data, new Mesh(data));
  assert.deepEqual(groups.map(({ title, count }) => [title, count]), [
    ["Edges on more than two faces", 1],
    ["Vertices where sheets touch", 1],
    ["Boundary loops", 1],
    ["Faces that are there twice, left out", 1],
    ["Components", 1],
  ]);
  const [edges, vertices, boundary, faces, components] = groups.map(({ places }) => places[0]);
  assert.deepEqual([edges.title, edges.segments.length], ["edge 0-2", 2]);
  assert.deepEqual([vertices.title, vertices.points], ["vertex 2", [[1, 1, 0]]]);
  assert.equal(boundary.text, "4 edges, length 80");
  assert.match(faces.text, /corners 0 1 2$/);
  assert.deepEqual(components.box, [[-1, -1, 0], [1, 1, 0]]);
  assert.ok(Math.abs(ballOf(components.box).radius - Math.SQRT2) < 1e-9);
});

test("faces that meet are places, with both of them marked", () => {
  const data = squareMesh();
  assert.equal(meetingsText(data), "It does not meet itself.");
  assert.match(meetingsText({ ...data, meetings_complete: false }), /not known/);
  Object.assign(data, { meetings_in_all: 7, meetings: [{ faces: [0, 1], crosses: true, place: [0, 0, 0], corners: [[0, 1, 2], [0, 2, 3]] }] });
  const group = placeGroups(data, new Mesh(data))[0];
  assert.deepEqual([group.title, group.count, group.places.length], ["Faces that meet", 7, 1]);
  assert.deepEqual([group.places[0].segments.length, group.places[0].title], [12, "faces 0 and 1"]);
  assert.match(meetingsText(data), /^It meets itself: 7 pairs/);
});

test("a list of places ends somewhere, and says how many there are", () => {
  const data = squareMesh();
  data.places.reversed_edges = packedWholes(Array.from({ length: 1000 }, () => [0, 2]).flat());
  const group = placeGroups(data, new Mesh(data)).find(({ title }) => title.includes("disagree"))!;
  assert.equal(group.count, 500 * 2);
  assert.equal(group.places.length, 300);
});

test("what is left out is said, and remarks of the program are", () => {
  const data: Data = { ...squareMesh(), stride: 3, triangles_in_all: 9, loops_in_all: 5, loops: [loopOf(1)], generators: false, remarks: ["left out 2 points"] };
  const remarks = remarksOf(data).join("\n");
  for (const word of [/9 triangles.*one of 3 is drawn/, /1 of 5 loops/, /generators-limit 0/, /^Left out 2 points\.$/m, /search, not a proof/]) {
    assert.match(remarks, word);
  }
  assert.doesNotMatch(remarksOf(squareMesh()).join("\n"), /are on this page|is drawn/);
});

test("samples are packed as C++ packs", () => {
  assert.deepEqual(packedFloats([1, -2.5]), { kind: "f32", data: "AACAPwAAIMA=" });
});
