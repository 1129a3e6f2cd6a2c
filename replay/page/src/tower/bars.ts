/** Bars as lists of numbers, and the orders in which they are looked at. */
import type { BarList } from "./data.ts";
import { orderBy } from "./order.ts";

/** The bars of one dimension: from `first` those that end, from `open` those that do not, before `end`. */
export interface Part {
  dim: number;
  first: number;
  open: number;
  end: number;
}

export class Bars {
  readonly count: number;
  readonly births: Float64Array;
  /** Infinity for those that never end. */
  readonly deaths: Float64Array;
  readonly parts: Part[] = [];

  constructor(lists: readonly BarList[]) {
    this.count = lists.reduce((sum, { births, open }) => sum + births.length + open.length, 0);
    this.births = new Float64Array(this.count);
    this.deaths = new Float64Array(this.count).fill(Infinity);
    let at = 0;
    for (const { dim, births, deaths, lengths, open } of lists) {
      const part = { dim, first: at, open: at + births.length, end: at + births.length + open.length };
      let before = 0;
      for (let k = 0; k < births.length; ++k, ++at) {
        before = lengths ? before + births[k] : births[k];
        this.births[at] = before;
        this.deaths[at] = lengths ? before + lengths[k] : deaths![k];
      }
      before = 0;
      for (let k = 0; k < open.length; ++k, ++at) {
        before = lengths ? before + open[k] : open[k];
        this.births[at] = before;
      }
      this.parts.push(part);
    }
  }

  partOf(bar: number): Part {
    return this.parts.find(({ end }) => bar < end)!;
  }

  dimension(bar: number): number {
    return this.partOf(bar).dim;
  }

  length(bar: number): number {
    return this.deaths[bar] - this.births[bar];
  }

  /** The longest that ends; 0 when none does. */
  longestOf({ first, open }: Part): number {
    let longest = 0;
    for (let bar = first; bar < open; ++bar) {
      longest = Math.max(longest, this.deaths[bar] - this.births[bar]);
    }
    return longest;
  }

  /** Bars as a picture has them: dimension by dimension, by birth and then by death. */
  inRows(): Uint32Array {
    const rows = new Uint32Array(this.count);
    let at = 0;
    for (const { first, open, end } of this.parts) {
      let [ended, unended] = [first, open];
      while (ended < open || unended < end) {
        const isEnded = unended === end || (ended < open && this.births[ended] <= this.births[unended]);
        rows[at++] = isEnded ? ended++ : unended++;
      }
    }
    return rows;
  }

  /** The longest first; of equal length in their order. */
  byLength(): Uint32Array {
    const order = new Uint32Array(this.count);
    let at = 0;
    for (const { open, end } of this.parts) {
      for (let bar = open; bar < end; ++bar) {
        order[at++] = bar;
      }
    }
    // Of those that end: infinite numbers among them would keep the others from being whole.
    const ended = new Uint32Array(this.count - at);
    const negative = new Float64Array(this.count - at);
    let next = 0;
    for (const { first, open } of this.parts) {
      for (let bar = first; bar < open; ++bar) {
        ended[next] = bar;
        negative[next++] = this.births[bar] - this.deaths[bar];
      }
    }
    for (const k of orderBy(negative)) {
      order[at++] = ended[k];
    }
    return order;
  }

  /** From the first birth to the last birth or end, of all or of those with a 1. */
  range(kept: Uint8Array | null = null): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (let bar = 0; bar < this.count; ++bar) {
      if (!kept || kept[bar]) {
        const [birth, death] = [this.births[bar], this.deaths[bar]];
        low = birth < low ? birth : low;
        const last = death < Infinity ? death : birth;
        high = last > high ? last : high;
      }
    }
    return low > high ? [0, 1] : [low, high];
  }
}

/** Both together, in the same form. */
export function joined(some: readonly BarList[], others: readonly BarList[]): BarList[] {
  const decoded = (lists: readonly BarList[]) => {
    const bars = new Bars(lists);
    return bars.parts.map(({ dim, first, open, end }) => ({
      dim,
      pairs: Array.from({ length: open - first }, (_, k) => [bars.births[first + k], bars.deaths[first + k]] as const),
      open: [...bars.births.subarray(open, end)],
    }));
  };
  const all = [...decoded(some), ...decoded(others)];
  const dims = [...new Set(all.map(({ dim }) => dim))].sort((a, b) => a - b);
  return dims.map((dim) => {
    const same = all.filter((each) => each.dim === dim);
    const pairs = same.flatMap((each) => each.pairs).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    return {
      dim,
      births: pairs.map(([birth]) => birth),
      deaths: pairs.map(([, death]) => death),
      open: same.flatMap(({ open }) => open).sort((a, b) => a - b),
    };
  });
}
