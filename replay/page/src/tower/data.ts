/** What the page of a tower is given, as C++ writes it (tower_page.cpp, page_bars.cpp). */

/** Vertices by the labels of the input; those that are no exact doubles are texts. */
export type Label = number | string;

/** A simplex with its coefficient; a fraction is a text. */
export type Term = [number | string, Label[]];

/**
 * Bars of one dimension, those that end by birth and death, then the open ones by birth. With `lengths`, births are
 * what they are more than the one before.
 */
export interface BarList {
  dim: number;
  births: number[];
  deaths?: number[];
  lengths?: number[];
  open: number[];
}

/** An operation: where it stands in the input, and how many there were after all that happened at its time. */
export interface Operation {
  line: number;
  text: string;
  after: number;
}

/** What is known of the class of a bar. Of a chain that is too long there is its length. */
export interface BarClass {
  bar: number;
  born: Operation;
  killed?: Operation;
  cycle?: Term[];
  cycle_terms?: number;
  bounds?: Term[];
  bounds_terms?: number;
  now?: Term[];
  now_terms?: number;
}

/** The operations (a dimension, or -1 for a contraction) with their labels, and where the vertices are. */
export interface ComplexData {
  dims: number[];
  labels: Label[];
  /** The times at which something happens, and how many operations there were after each. */
  times: number[];
  ends: number[];
  /** Three numbers for each label. */
  points: number[];
  coordinates: number;
}

export interface Data {
  format: number;
  version: string;
  title: string;
  ring: string;
  time_name: string;
  facts: string[];
  notes: string[];
  /** Where times are counted from; a whole number, as text. */
  origin: string;
  bars: BarList[];
  /** Those that are only counted in the Betti curves. */
  left_out: BarList[];
  classes: BarClass[];
  complex: ComplexData | null;
}
