import assert from "node:assert/strict";
import { test } from "node:test";
import { generatorTitle } from "../src/replay/chain_panel.ts";
import { colourOfGenerator, cssColour } from "../src/colours.ts";
import { ObjectState } from "../src/replay/object.ts";
import { chainJson, chainSum, groupsText, remarksOf, typeText } from "../src/replay/replay_text.ts";
import { cellsText, groupText } from "../src/text.ts";
import { square } from "./samples.ts";

test("groups are written as in the table of the program", () => {
  assert.equal(groupText("Z", 2, [2, "4"]), "Z^2 + Z/2 + Z/4");
  assert.equal(groupText("Z", 0, []), "0");
  assert.equal(groupText("Z/2", 3, []), "(Z/2)^3");
  assert.equal(groupsText("Q", { cells: [1, 1], euler: 0, betti: [1, 1], torsion: [[], []] }), "H0 = Q, H1 = Q");
});

test("cells are counted by what they are called", () => {
  assert.equal(cellsText([1, 2, 1, 0, 3]), "1 vertex, 2 edges, 1 face, 0 cells of dimension 3, 3 cells of dimension 4");
  assert.deepEqual([[], [1], [2], [1, 1], [2, 1], [1, 1, 1], [4]].map(typeText), ["vertex", "edge", "triangle", "square", "prism", "cube", "simplex of dimension 4"]);
});

test("a chain is text that a class step takes, and a sum for people", () => {
  const name = (cell: number) => "ab\"c"[cell];
  assert.equal(chainJson({ terms: [["1", 0], ["-2", 2], ["123456789012345678", -1, "x"]] }, name), '[[1,"a"],[-2,"\\""],["123456789012345678","x"]]');
  assert.equal(chainSum({ terms: [["-1", 0], ["2", 1], ["-1/2", -1, "x"]] }, name), "-a + 2 b - 1/2 x");
  assert.equal(chainSum({ terms: [] }, name), "0");
  assert.equal(chainSum({ terms: [["1", 0], ["1", 1]] }, name, 1), "a + ... (1 more terms)");
  assert.match(chainSum({ terms: [], length: 9000 }, name), /9000 terms/);
});

test("what is left out is said", () => {
  const data = { ...square(), left_out: 7, families_left_out: 1, stride: 3, notes: "interrupted" };
  const remarks = remarksOf(data, new ObjectState(data)).join("\n");
  for (const word of [/interrupted/, /7 cells are not shown/, /1 products/, /every 3th/, /oldest/]) {
    assert.match(remarks, word);
  }
});

test("generators have titles and colours that differ", () => {
  assert.equal(generatorTitle({ dim: 1, order: "2", chain: { terms: [] } }, 0), "H1, generator 1: order 2");
  assert.equal(new Set([0, 1, 2, 3, 4, 5, 6].map(colourOfGenerator)).size, 7);
  assert.equal(cssColour(0x0072b2), "#0072b2");
});
