/** Betti numbers against time, from bars. */
import type { Bars } from "./bars.ts";
import { orderBy } from "./order.ts";

/** The number of entries that are at most x, in a list in increasing order. */
export function countUpTo(sorted: Float64Array, x: number): number {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= x) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

interface Events {
  dim: number;
  /** Bars by birth, and those that end by death. */
  births: Uint32Array;
  deaths: Uint32Array;
  birthTimes: Float64Array;
  deathTimes: Float64Array;
}

function taken(times: Float64Array, bars: Uint32Array): Float64Array {
  const some = new Float64Array(bars.length);
  for (let k = 0; k < bars.length; ++k) {
    some[k] = times[bars[k]];
  }
  return some;
}

/** The curves of the bars. Cost of making it: sorting them; of a curve: the bars. */
export class BettiCurves {
  private readonly events: Events[];
  private largestOf: number[] | null = null;

  /** `rows`: the bars by dimension and birth. */
  constructor(bars: Bars, rows: Uint32Array) {
    this.events = bars.parts.map(({ dim, first, open, end }) => {
      const births = rows.subarray(first, end); // parts are one after the other in both orders
      const deaths = orderBy(bars.deaths.subarray(first, open));
      for (let k = 0; k < deaths.length; ++k) {
        deaths[k] += first;
      }
      return { dim, births, deaths, birthTimes: taken(bars.births, births), deathTimes: taken(bars.deaths, deaths) };
    });
  }

  get dims(): number[] {
    return this.events.map(({ dim }) => dim);
  }

  /** The largest Betti number of each dimension that has bars. */
  get largest(): readonly number[] {
    if (!this.largestOf) {
      this.largestOf = this.events.map((_, part) => {
        let largest = 0;
        this.visit(part, null, (_, value) => (largest = value > largest ? value : largest));
        return largest;
      });
    }
    return this.largestOf;
  }

  /** At a time, by dimension from 0 to the largest. */
  at(time: number): number[] {
    const betti: number[] = new Array((this.dims.at(-1) ?? -1) + 1).fill(0);
    for (const { dim, birthTimes, deathTimes } of this.events) {
      betti[dim] = countUpTo(birthTimes, time) - countUpTo(deathTimes, time);
    }
    return betti;
  }

  /** Calls visit(time, Betti number from it on) at each change, for the bars that are kept: 1 in the list, if any. */
  visit(part: number, kept: Uint8Array | null, visit: (time: number, value: number) => void): void {
    const { births, deaths, birthTimes, deathTimes } = this.events[part];
    let value = 0;
    let told = 0;
    let [b, d] = [0, 0];
    while (b < births.length || d < deaths.length) {
      const birth = b < births.length ? birthTimes[b] : Infinity;
      const death = d < deaths.length ? deathTimes[d] : Infinity;
      const time = birth < death ? birth : death;
      for (; b < births.length && birthTimes[b] === time; ++b) {
        value += kept ? kept[births[b]] : 1;
      }
      for (; d < deaths.length && deathTimes[d] === time; ++d) {
        value -= kept ? kept[deaths[d]] : 1;
      }
      if (value !== told) {
        told = value;
        visit(time, value);
      }
    }
  }
}

/**
 * A curve as a picture has it, corner after corner (x, value, x, value, ...): exact where changes are apart, and with
 * the least and the largest value of each pixel where they are not.
 */
export function cornersOf(curves: BettiCurves, part: number, kept: Uint8Array | null, x: (time: number) => number, right: number): number[] {
  const corners: number[] = [];
  let last = 0;
  let column = -Infinity;
  let [low, high, first] = [0, 0, 0];
  let isOpen = false;
  const flush = () => {
    if (isOpen) {
      // From the value before through both extremes to the last one.
      for (const value of first <= (low + high) / 2 ? [low, high] : [high, low]) {
        if (value !== corners[corners.length - 1]) {
          corners.push(column, value);
        }
      }
      if (last !== corners[corners.length - 1]) {
        corners.push(column, last);
      }
    }
  };
  curves.visit(part, kept, (time, value) => {
    const place = Math.round(x(time) * 2) / 2;
    if (place !== column || !isOpen) {
      flush();
      column = place;
      isOpen = true;
      first = last;
      [low, high] = [Math.min(last, value), Math.max(last, value)];
      corners.push(place, last);
    }
    low = Math.min(low, value);
    high = Math.max(high, value);
    last = value;
  });
  flush();
  if (isOpen) {
    corners.push(right, last);
  }
  return corners;
}
