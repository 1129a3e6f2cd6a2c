/** What the page is given, as C++ writes it (page_writer.cpp), and what follows from it at once. */

/** A term: coefficient, cell (or -1), and the name of a cell that is not shown. */
export type Term = [string, number, string?];

export interface Chain {
  terms: Term[];
  /** Instead of terms: how long the chain is, or is at most. */
  length?: number;
  length_at_most?: number;
}

export interface Answer {
  cycle: boolean;
  zero: boolean;
  coefficients: string[];
  asked: Chain;
  bounds?: Chain;
}

export interface Generator {
  dim: number;
  /** "0" for a free one. */
  order: string;
  chain: Chain;
  bounds?: Chain;
}

/**
 * Lists that are not there are empty; numbers that are not there are those of the step before. Steps at which the page
 * does not stop have events only.
 */
export interface Step {
  op: string;
  text: string;
  made?: [number, number];
  removed?: number[];
  moved?: number[];
  consumed?: number[];
  undone?: number[];
  cells?: number[];
  euler?: number;
  betti?: number[];
  torsion?: (number | string)[][];
  answer?: Answer;
}

export interface Data {
  format: number;
  version: string;
  title: string;
  source: string;
  notes: string;
  ring: string;
  stride: number;
  left_out: number;
  families_left_out: number;
  limits: { cells: number; cells_of_family: number; steps: number; generators: number; terms: number };
  cells: { types: number[][]; names: string[]; type: number[]; first: number[]; faces: number[] };
  places: {
    cells: number[];
    points: number[];
    counts: { given: number; sum: number; beside: number; computed: number };
  };
  steps: Step[];
  generators: Generator[];
}

/** The numbers of an object after a step. */
export interface Numbers {
  cells: number[];
  euler: number;
  betti: number[];
  torsion: (number | string)[][];
}

/** By step, the empty object before the first one included: entry n is what there is after n steps. */
export function numbersOf(steps: readonly Step[]): Numbers[] {
  let now: Numbers = { cells: [], euler: 0, betti: [], torsion: [] };
  const all = [now];
  for (const step of steps) {
    now = {
      cells: step.cells ?? now.cells,
      euler: step.euler ?? now.euler,
      betti: step.betti ?? now.betti,
      torsion: step.torsion ?? now.torsion,
    };
    all.push(now);
  }
  return all;
}

/** Where the page stops: after 0 steps, after so many more each time, and at the end. */
export function stopsOf(steps: number, stride: number): number[] {
  const stops = [];
  for (let n = 0; n < steps; n += stride) {
    stops.push(n);
  }
  stops.push(steps);
  return stops;
}

export function dimensionOf(data: Data, cell: number): number {
  return data.cells.types[data.cells.type[cell]].reduce((sum, part) => sum + part, 0);
}
