/** Which bars are looked at. */
import type { Bars } from "./bars.ts";

/** Both ends belong to it; infinite ones say nothing. */
export type Interval = readonly [number, number];

export const everything: Interval = [-Infinity, Infinity];

export interface Filter {
  /** Dimensions that are left out. */
  without: ReadonlySet<number>;
  /** Whether bars that never end are wanted. */
  open: boolean;
  length: Interval;
  birth: Interval;
  /** Bars that never end die at infinity. */
  death: Interval;
  /** Bars that are alive at some time of it. */
  alive: Interval;
}

export const noFilter: Filter = { without: new Set(), open: true, length: everything, birth: everything, death: everything, alive: everything };

export const says = (interval: Interval) => interval[0] > -Infinity || interval[1] < Infinity;

export function isPlain({ without, open, length, birth, death, alive }: Filter): boolean {
  return without.size === 0 && open && ![length, birth, death, alive].some(says);
}

/** Sets a 1 for each bar that a filter keeps, and 0 for others. Returns how many it keeps of each part. */
export function apply({ without, open, length, birth, death, alive }: Filter, bars: Bars, kept: Uint8Array): number[] {
  const { births, deaths } = bars;
  const [bornFrom, bornTo] = birth;
  const [diesFrom, diesTo] = open ? death : [death[0], Math.min(death[1], Number.MAX_VALUE)];
  const [lengthFrom, lengthTo] = length;
  const [aliveFrom, aliveTo] = alive;
  return bars.parts.map((part) => {
    let count = 0;
    if (without.has(part.dim)) {
      kept.fill(0, part.first, part.end);
      return 0;
    }
    for (let bar = part.first; bar < part.end; ++bar) {
      const b = births[bar];
      const d = deaths[bar];
      const size = d - b;
      const has =
        b >= bornFrom && b <= bornTo && d >= diesFrom && d <= diesTo && size >= lengthFrom && size <= lengthTo &&
        b <= aliveTo && (d > aliveFrom || aliveFrom === -Infinity);
      kept[bar] = has ? 1 : 0;
      count += has ? 1 : 0;
    }
    return count;
  });
}

/** What a filter says, in words. */
export function filterText({ without, open, length, birth, death, alive }: Filter, time: (x: number) => string, size: (x: number) => string): string {
  const parts: string[] = [];
  const range = (what: string, [from, to]: Interval, text: (x: number) => string) => {
    if (from === Infinity) {
      parts.push("only those that never end");
    } else if (from > -Infinity || to < Infinity) {
      parts.push(`${what} ${from === -Infinity ? `up to ${text(to)}` : to === Infinity ? `from ${text(from)} on` : `from ${text(from)} to ${text(to)}`}`);
    }
  };
  if (without.size > 0) {
    parts.push(`without ${[...without].sort((a, b) => a - b).map((dim) => `H${dim}`).join(", ")}`);
  }
  range("length", length, size);
  range("born", birth, time);
  range("ending", death, time);
  range("alive at a time", alive, time);
  if (!open) {
    parts.push("none that never end");
  }
  return parts.join("; ");
}
