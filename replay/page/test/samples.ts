/** Small pages as C++ would write them. */
import type { Data, Step } from "../src/replay/data.ts";

const turned = 1;
export const ref = (cell: number, isTurned = false) => 2 * cell + (isTurned ? turned : 0);

/** Cells as [type, name, faces]. */
export function dataOf(cells: [number[], string, number[]][], points: [number, number, number, number][], steps: Step[]): Data {
  const types: number[][] = [];
  const type = cells.map(([each]) => {
    const known = types.findIndex((other) => other.join() === each.join());
    return known >= 0 ? known : types.push(each) - 1;
  });
  const first = [0];
  cells.forEach(([, , faces]) => first.push(first[first.length - 1] + faces.length));
  return {
    format: 1,
    version: "0",
    title: "",
    source: "sample",
    notes: "",
    ring: "Z",
    stride: 1,
    left_out: 0,
    families_left_out: 0,
    limits: { cells: 100, cells_of_family: 100, steps: 100, generators: 100, terms: 100 },
    cells: { types, names: cells.map(([, name]) => name), type, first, faces: cells.flatMap(([, , faces]) => faces) },
    places: {
      cells: points.map(([cell]) => cell),
      points: points.flatMap(([, ...point]) => point),
      counts: { given: points.length, sum: 0, beside: 0, computed: 0 },
    },
    steps,
    classes: [],
  };
}

/**
 * A square: vertices 0 to 3 as (0,0), (0,1), (1,0), (1,1); edges 4 left, 5 bottom, 6 top, 7 right; face 8. Step 1 makes it,
 * step 2 glues top and bottom, step 3 left and right, so it is a torus; step 4 takes both back.
 */
export function square(): Data {
  const edge = (tail: number, head: number) => [ref(head), ref(tail)];
  return dataOf(
    [
      [[], "00", []],
      [[], "01", []],
      [[], "10", []],
      [[], "11", []],
      [[1], "left", edge(0, 1)],
      [[1], "bottom", edge(0, 2)],
      [[1], "top", edge(1, 3)],
      [[1], "right", edge(2, 3)],
      [[1, 1], "q", [ref(7), ref(4), ref(6), ref(5)]],
    ],
    [
      [0, 0, 0, 0],
      [1, 0, 1, 0],
      [2, 1, 0, 0],
      [3, 1, 1, 0],
    ],
    [
      { op: "simploid", text: "q", made: [0, 9], cells: [4, 4, 1], euler: 1, betti: [1, 0, 0], torsion: [[], [], []] },
      { op: "identify", text: "top bottom", removed: [1, ref(0), 3, ref(2), 6, ref(5)], cells: [2, 3, 1], euler: 0, betti: [1, 1, 0], torsion: [[], [], []] },
      { op: "identify", text: "left right", removed: [2, ref(0), 7, ref(4)], cells: [1, 2, 1], euler: 0, betti: [1, 2, 1], torsion: [[], [], []] },
      { op: "undo", text: "2", undone: [2, 1], cells: [4, 4, 1], euler: 1, betti: [1, 0, 0], torsion: [[], [], []] },
    ],
  );
}
