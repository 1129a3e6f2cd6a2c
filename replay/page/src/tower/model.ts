/** What all views look at: the bars, which of them are kept, which one is chosen. */
import { Bars, joined } from "./bars.ts";
import { BettiCurves } from "./betti.ts";
import type { BarClass, Data } from "./data.ts";
import { apply, type Filter, filterText, isPlain, noFilter } from "./filter.ts";
import { counted, type Range, shortNumber, Times, widened, withSeparators } from "./numbers.ts";

export class Model {
  readonly bars: Bars;
  /** Of the kept bars, and of all that there are, also those that are left out of the lists. */
  readonly curves: BettiCurves;
  readonly allCurves: BettiCurves;
  readonly times: Times;
  readonly classes: ReadonlyMap<number, BarClass>;
  /** 1 for each bar that is kept. */
  readonly kept: Uint8Array;
  filter: Filter = noFilter;
  /** What somebody drags just now, and what is not in the filter yet. */
  brush: Partial<Filter> | null = null;
  /** How many are kept of each part, and of all. */
  keptOf: number[] = [];
  keptCount = 0;
  /** The kept bars by dimension and birth. */
  rows: Uint32Array;
  /** A bar, or -1. */
  chosen = -1;
  hovered = -1;
  /** The time that is pointed at, and that of the picture in space. */
  time: number | null = null;
  moment: number | null = null;
  /** Whether axes are those of the kept bars. */
  fits = false;
  /** Of times. */
  range: Range;
  private readonly allRows: Uint32Array;
  private readonly allRange: Range;
  private lengths: Uint32Array | null = null;

  constructor(readonly data: Data) {
    this.bars = new Bars(data.bars);
    this.times = new Times(data.origin);
    this.allRows = this.bars.inRows();
    this.curves = new BettiCurves(this.bars, this.allRows);
    if (data.left_out.length > 0) {
      const all = new Bars(joined(data.bars, data.left_out));
      this.allCurves = new BettiCurves(all, all.inRows());
      this.allRange = widened(all.range(), 0.02);
    } else {
      this.allCurves = this.curves;
      this.allRange = widened(this.bars.range(), 0.02);
    }
    this.classes = new Map(data.classes.map((each) => [each.bar, each]));
    this.kept = new Uint8Array(this.bars.count).fill(1);
    this.keptOf = this.bars.parts.map(({ first, end }) => end - first);
    this.keptCount = this.bars.count;
    this.rows = this.allRows;
    this.range = this.allRange;
  }

  get isFiltered(): boolean {
    return !isPlain(this.filter);
  }

  /** What pictures mark: the filter, and what is being dragged. */
  get marked(): Filter {
    return { ...this.filter, ...this.brush };
  }

  setFilter(filter: Filter): void {
    this.filter = filter;
    this.keptOf = apply(filter, this.bars, this.kept);
    this.keptCount = this.keptOf.reduce((sum, count) => sum + count, 0);
    if (this.keptCount === this.bars.count) {
      this.rows = this.allRows;
    } else {
      const rows = new Uint32Array(this.keptCount);
      let at = 0;
      for (const bar of this.allRows) {
        rows[at] = bar; // overwritten by the next one unless it is kept
        at += this.kept[bar];
      }
      this.rows = rows;
    }
    if (this.hovered >= 0 && !this.kept[this.hovered]) {
      this.hovered = -1;
    }
  }

  /** Axes for what is kept, or for all. Not while somebody drags: what he points at would move. */
  setRange(): void {
    this.range = this.fits && this.keptCount > 0 ? widened(this.bars.range(this.kept), 0.02) : this.allRange;
  }

  /** "4 of 16 bars: alive at a time from 5 to 7". */
  filterText(): string {
    const said = filterText(this.filter, (x) => this.times.text(x), shortNumber);
    return said ? `${withSeparators(this.keptCount)} of ${counted(this.bars.count, "bar")}: ${said}` : `all of ${counted(this.bars.count, "bar")}`;
  }

  /** All bars, the longest first. */
  get byLength(): Uint32Array {
    return (this.lengths ??= this.bars.byLength());
  }

  /** The kept bars, the longest first, from one place on. */
  longest(from: number, most: number): number[] {
    const found: number[] = [];
    let met = 0;
    for (const bar of this.byLength) {
      if (this.kept[bar] && met++ >= from) {
        found.push(bar);
        if (found.length === most) {
          break;
        }
      }
    }
    return found;
  }

  /** Which place a kept bar has in that order. */
  placeOf(wanted: number): number {
    let met = 0;
    for (const bar of this.byLength) {
      if (bar === wanted) {
        break;
      }
      met += this.kept[bar];
    }
    return met;
  }

  /** "H1 [3, 12), length 9". */
  text(bar: number): string {
    const { births, deaths } = this.bars;
    const open = deaths[bar] === Infinity;
    return `H${this.bars.dimension(bar)} ${this.times.interval(births[bar], deaths[bar])}, ${open ? "never ends" : `length ${this.times.length(births[bar], deaths[bar])}`}`;
  }
}
