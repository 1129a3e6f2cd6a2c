import assert from "node:assert/strict";
import { test } from "node:test";
import { drawnOf, isBefore, overlayOf, sortedLabels, TowerComplex } from "../src/tower/complex.ts";
import type { ComplexData, Label, Term } from "../src/tower/data.ts";
import { momentWith } from "../src/tower/space_panel.ts";

/** Operations as lines of a tower. */
function complexOf(lines: string[], points: number[] = []): ComplexData {
  const dims: number[] = [];
  const labels: Label[] = [];
  for (const line of lines) {
    const [kind, ...words] = line.split(" ");
    dims.push(kind === "c" ? -1 : words.length - 1);
    labels.push(...words.map(Number));
  }
  return { dims, labels, times: lines.map((_, k) => k), ends: lines.map((_, k) => k + 1), points, coordinates: 3 };
}

const lines = ["i 0", "i 1", "i 2", "i 0 1", "i 1 2", "i 0 2", "i 0 1 2", "c 0 1", "c 2 1", "i 0"];

test("a complex has what is there after some operations, merged and squashed", () => {
  const complex = new TowerComplex(complexOf(lines));
  assert.deepEqual(complex.at(0), { simplices: [], counts: [] });
  assert.equal(complex.fullest, 7);
  assert.equal(new TowerComplex(complexOf(["i 0", "i 1", "c 0 1", "i 3", "i 4", "i 3 4", "c 3 4"])).fullest, 6);
  assert.deepEqual(complex.at(7).counts, [3, 3, 1]);
  assert.deepEqual(complex.at(8), { simplices: [[1], [2], [1, 2]], counts: [2, 1] });
  assert.deepEqual(complex.at(9), { simplices: [[1]], counts: [1] });
  assert.deepEqual(complex.at(10).simplices, [[1], [0]], "a label that is used again is another vertex");
});

test("a chain is followed through contractions, with signs", () => {
  const complex = new TowerComplex(complexOf(lines));
  const loop: Term[] = [[1, [0, 1]], [-1, [0, 2]], [1, [1, 2]]];
  assert.deepEqual(complex.image(loop, 7, 7, 0), loop);
  assert.deepEqual(complex.image(loop, 7, 8, 0), [], "one is squashed, the others cancel");
  assert.deepEqual(complex.image([[1, [0, 2]], [1, [1, 2]]], 7, 8, 0), [[2, [1, 2]]]);
  assert.deepEqual(complex.image([[1, [0, 2]], [1, [1, 2]]], 7, 8, 2), []);
  assert.deepEqual(complex.image([["1/2", [0, 2]]], 7, 8, 0), [[0.5, [1, 2]]]);
  const turned = new TowerComplex(complexOf(["i 0", "i 5", "i 9", "i 0 5", "c 0 9"]));
  assert.deepEqual(turned.image([[1, [0, 5]]], 4, 5, 3), [[2, [5, 9]]], "the other way round, modulo 3");
  assert.deepEqual(complex.image([[1, [0]]], 9 + 1, 10, 2), [[1, [0]]], "the vertex that is called so at that moment");
});

test("labels are in order, large ones too", () => {
  assert.ok(isBefore(9, 10) && isBefore(9, "18446744073709551615") && !isBefore("18446744073709551615", "9007199254740993"));
  assert.deepEqual(sortedLabels([2, 0, 1]), { sorted: [0, 1, 2], odd: false });
  assert.deepEqual(sortedLabels([1, 0, 2]), { sorted: [0, 1, 2], odd: true });
});

test("simplices are drawn where their points are, and chains over them", () => {
  const complex = new TowerComplex(complexOf(lines, [0, 0, 0, 3, 0, 0, 0, 4, 0]));
  const drawn = drawnOf(complex, complex.at(7));
  assert.deepEqual([drawn.vertices.length, drawn.edges.length, drawn.faces.length, drawn.size], [3, 3, 1, 5]);
  assert.deepEqual(drawn.edges[0].points, [[0, 0, 0], [3, 0, 0]]);
  assert.deepEqual(drawnOf(complex, complex.at(0)).vertices, []);
  const overlay = overlayOf(complex, [[1, [0]], [1, [1, 2]], [1, [0, 1, 2]]], 7);
  assert.deepEqual([overlay.points, overlay.paths.length, overlay.faces.length, overlay.colour], [[[0, 0, 0]], 1, 1, 7]);
  assert.equal(overlayOf(complex, [[1, [0, 1, 2, 3]]], 7).faces.length, 4, "a solid by its triangles");
});

test("a moment is the one that has an operation behind it", () => {
  const data = { ...complexOf(lines), ends: [3, 7, 10] };
  assert.deepEqual([1, 3, 4, 10].map((n) => momentWith(data, n)), [0, 0, 1, 2]);
});
