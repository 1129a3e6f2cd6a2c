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

/** How a class came to its end: see generator_history.hpp. */
export type End = "bounds" | "cut" | "removed" | "consumed" | "undone";

/** A class that was a generator after some step; its chains have the cells of that time. */
export interface Generator {
  dim: number;
  /** "0" for a free one. */
  order: string;
  /** The step, counted from 0, that made it; left out when that is not known. */
  since?: number;
  chain: Chain;
  bounds?: Chain;
}

/**
 * Lists that are not there are empty; numbers that are not there are those of the step before. Steps at which the page
 * does not stop have events only. One that made some cells, and of which there is nothing else to say, is their number:
 * cells are numbered in the order in which they were made.
 */
export type AnyStep = Step | number;

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
  /** Classes that ended with it. */
  ended?: [number, End][];
  /** The classes that are generators after it; null: that is not known. */
  generators?: number[] | null;
  answer?: Answer;
}

/** What may be other when a page has grown. */
export interface Head {
  title: string;
  notes: string;
  stride: number;
  left_out: number;
  families_left_out: number;
  /** After so many steps generators were no longer kept, but for those at the end. */
  generators_until?: number;
}

export interface Cells {
  types: number[][];
  names: string[];
  type: number[];
  first: number[];
  faces: number[];
}

export interface Places {
  cells: number[];
  points: number[];
  counts: { given: number; sum: number; beside: number; computed: number };
}

/** What is new in a replay that goes on: cells and steps behind those there are, places that are other ones. */
export interface News extends Head {
  cells: Cells;
  places: Places;
  steps: AnyStep[];
  classes: Generator[];
}

export interface Data extends Head {
  format: number;
  version: string;
  source: string;
  ring: string;
  /** Of a page that grows with its replay: how far it is, as the server wants to be told, and whether it may send steps. */
  live?: { place: string; writable: boolean };
  limits: { cells: number; cells_of_family: number; steps: number; generators: number; terms: number };
  cells: Cells;
  places: Places;
  steps: AnyStep[];
  classes: Generator[];
}

/** Adds what is new, but for places: those are kept by who draws. */
export function addNews(data: Data, { cells, places, steps, classes, ...rest }: News): void {
  const add = <T>(to: T[], from: readonly T[]) => from.forEach((item) => to.push(item)); // of any length
  data.cells.types = cells.types;
  add(data.cells.names, cells.names);
  add(data.cells.type, cells.type);
  add(data.cells.first, cells.first);
  add(data.cells.faces, cells.faces);
  data.places.counts = places.counts;
  add(data.steps, steps);
  add(data.classes, classes);
  Object.assign(data, rest);
}

const nothing = {} as Step;

/** What is said of a step but for the number of cells that it made. */
export function stepOf(step: AnyStep): Step {
  return typeof step === "number" ? nothing : step;
}

/** The numbers of an object after so many steps. */
export interface Numbers {
  steps: number;
  cells: number[];
  euler: number;
  betti: number[];
  torsion: (number | string)[][];
  generators: number[] | null;
}

/** What there is at each stop, the empty object before the first step included. `stops`: ascending, from 0 on. */
export function numbersOf(steps: readonly AnyStep[], stops: readonly number[]): Numbers[] {
  let now: Numbers = { steps: 0, cells: [], euler: 0, betti: [], torsion: [], generators: [] };
  let read = 0;
  return stops.map((stop) => {
    now = { ...now, steps: stop };
    for (; read < stop; ++read) {
      const { op, cells, euler, betti, torsion, generators } = stepOf(steps[read]);
      if (op !== undefined) {
        now.cells = cells ?? now.cells;
        now.euler = euler ?? now.euler;
        now.betti = betti ?? now.betti;
        now.torsion = torsion ?? now.torsion;
        now.generators = generators === undefined ? now.generators : generators;
      }
    }
    return now;
  });
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
  const type = data.cells.types[data.cells.type[cell]];
  return type[0] <= 0 ? type[1] : type.reduce((sum, part) => sum + part, 0);
}
