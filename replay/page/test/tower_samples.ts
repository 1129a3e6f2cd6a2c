/** Small pages of towers as C++ would write them, and bars at random. */
import type { BarList, Data } from "../src/tower/data.ts";

/** Numbers from 0 to 1, the same ones each time. */
export function randomNumbers(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 1103515245 + 12345) % 2147483648;
    return state / 2147483648;
  };
}

/** Bars of dimensions 0 and 2 with whole numbers, some of them open, some alike. */
export function randomLists(count: number, seed = 1): BarList[] {
  const random = randomNumbers(seed);
  return [0, 2].map((dim) => {
    const pairs = Array.from({ length: count }, () => {
      const birth = Math.floor(random() * 40);
      return [birth, birth + 1 + Math.floor(random() * 20)];
    }).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const open = Array.from({ length: Math.ceil(count / 10) }, () => Math.floor(random() * 40)).sort((a, b) => a - b);
    return { dim, births: pairs.map(([birth]) => birth), deaths: pairs.map(([, death]) => death), open };
  });
}

export function towerData(bars: BarList[], more: Partial<Data> = {}): Data {
  return {
    format: 1,
    version: "0",
    title: "t",
    ring: "Z/2",
    time_name: "time",
    facts: [],
    notes: [],
    origin: "0",
    bars,
    left_out: [],
    classes: [],
    complex: null,
    ...more,
  };
}

/** Three vertices, the edges of a triangle, then 0 contracted into 1 and 2 into 1. */
export const circle: BarList[] = [
  { dim: 0, births: [1, 1], lengths: [2, 2], open: [0] },
  { dim: 1, births: [5], lengths: [1], open: [] },
];
