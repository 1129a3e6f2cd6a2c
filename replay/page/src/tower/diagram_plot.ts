/** The persistence diagram: a symbol at (birth, death) for each bar; of very many, shades. */
import { type Filter, says } from "./filter.ts";
import { inkOf, type Inks, shapeOf } from "./inks.ts";
import type { Model } from "./model.ts";
import { counted, marksIn } from "./numbers.ts";
import type { Paper } from "./paper.ts";
import { type Box, dragged, leftMargin, type Plot, Scale, type Size, timeAxis } from "./plot.ts";

/** More symbols than these would hide one another. */
const mostSymbols = 3000;
const cell = 2;
/** Of these, the longest, as each of them matters. */
const symbolsOverShades = 300;

/** The first place between two at which a list in increasing order has x or more. */
function firstFrom(sorted: Float64Array, from: number, to: number, x: number): number {
  while (from < to) {
    const middle = (from + to) >> 1;
    if (sorted[middle] < x) {
      from = middle + 1;
    } else {
      to = middle;
    }
  }
  return from;
}

export class DiagramPlot implements Plot {
  readonly hasTimes = false;
  private box: Box = { left: 0, top: 0, right: 0, bottom: 0 };
  private x = new Scale({ low: 0, high: 1 }, 0, 1);
  private y = new Scale({ low: 0, high: 1 }, 1, 0);
  /** Where those are that never end. */
  private infinity = 0;
  private shown = 0;

  height(_: Model, width: number): number {
    return Math.min(width, 460);
  }

  draw(paper: Paper, model: Model, { width, height }: Size, inks: Inks): void {
    this.infinity = 18;
    const marks = marksIn(model.range, Math.max(2, Math.floor((height - 74) / 50)));
    this.box = { left: leftMargin(marks.map(({ text }) => text)), top: 34, right: width - 22, bottom: height - 40 };
    this.x = new Scale(model.range, this.box.left, this.box.right);
    this.y = new Scale(model.range, this.box.bottom, this.box.top);
    this.shown = model.keptCount;
    timeAxis(paper, this.box, model.range, `birth (${model.times.axis(model.data.time_name)})`, inks);
    for (const { value, text } of marks) {
      const y = this.y.at(value);
      paper.segments([this.box.left, y, this.box.right, y], inks.line, 1);
      paper.text(this.box.left - 7, y + 4, text, inks.weak, { anchor: "end" });
    }
    paper.text(12, (this.box.top + this.box.bottom) / 2, "death", inks.weak, { anchor: "middle", upwards: true });
    paper.segments([this.box.left, this.box.top - 6, this.box.left, this.box.bottom], inks.weak, 1);
    paper.segments([this.box.left, this.box.bottom, this.box.right, this.box.top], inks.weak, 1);
    paper.line([this.box.left, this.infinity, this.box.right, this.infinity], inks.weak, 1, [5, 3]);
    paper.text(this.box.left - 7, this.infinity + 5, "\u221e", inks.weak, { anchor: "end", size: 15 });
    this.legend(paper, model, inks);
    if (model.keptCount > mostSymbols) {
      this.drawShades(paper, model, inks);
      this.drawSymbols(paper, model, inks, model.longest(0, symbolsOverShades));
    } else {
      this.drawSymbols(paper, model, inks, model.rows);
    }
  }

  mark(paper: Paper, model: Model, inks: Inks): void {
    const { birth, death } = model.marked;
    if (says(birth) || says(death)) {
      const within = (x: number, low: number, high: number) => Math.min(Math.max(x, low), high);
      const across = birth.map((x) => within(this.x.at(x), this.box.left, this.box.right));
      const top = death[1] === Infinity ? this.infinity - 10 : within(this.y.at(death[1]), this.box.top, this.box.bottom);
      const bottom = within(this.y.at(death[0]), this.box.top - 8, this.box.bottom);
      paper.rect(across[0], top, Math.max(across[1] - across[0], 1), Math.max(bottom - top, 1), inks.mark, 0.16);
    }
    for (const [bar, radius] of [[model.hovered, 6], [model.chosen, 8]] as const) {
      if (bar >= 0 && model.kept[bar]) {
        const [x, y] = this.place(model, bar);
        if (x >= this.box.left - 1 && x <= this.box.right + 1) {
          const dim = model.bars.dimension(bar);
          paper.symbols(shapeOf(dim), [x, y, radius + 2], inks.paper);
          paper.symbols(shapeOf(dim), [x, y, radius], inks.text);
          paper.symbols(shapeOf(dim), [x, y, radius - 2.5], inkOf(inks, dim));
        }
      }
    }
  }

  barAt({ bars, kept }: Model, x: number, y: number): number {
    const reach = 12;
    const [low, high] = [this.x.back(x - reach), this.x.back(x + reach)];
    let best = -1;
    let least = reach * reach;
    // Births are in order in each of the two lists of a dimension, so not all have to be looked at.
    for (const { first, open, end } of bars.parts) {
      for (const [from, to] of [[first, open], [open, end]]) {
        for (let bar = firstFrom(bars.births, from, to, low); bar < to && bars.births[bar] <= high; ++bar) {
          const dx = this.x.at(bars.births[bar]) - x;
          const dy = (bars.deaths[bar] === Infinity ? this.infinity : this.y.at(bars.deaths[bar])) - y;
          const distance = dx * dx + dy * dy;
          if (kept[bar] && (distance < least || (distance === least && best >= 0 && bars.length(bar) > bars.length(best)))) {
            [best, least] = [bar, distance];
          }
        }
      }
    }
    return best;
  }

  timeAt(): number | null {
    return null;
  }

  brushed(x1: number, y1: number, x2: number, y2: number): Partial<Filter> {
    const [top, bottom] = [Math.min(y1, y2), Math.max(y1, y2)];
    const middle = (this.infinity + this.box.top) / 2;
    return {
      birth: dragged(this.x, x1, x2, this.box.left, this.box.right),
      death: [
        bottom >= this.box.bottom ? -Infinity : bottom < middle ? Infinity : this.y.back(bottom),
        top < middle ? Infinity : this.y.back(top),
      ],
    };
  }

  note(): string {
    return this.shown > mostSymbols ? `Nothing is left out: ${counted(this.shown, "bar")} as shades, the darker the more fall together; the ${symbolsOverShades} longest have symbols.` : "";
  }

  private place({ bars }: Model, bar: number): [number, number] {
    return [this.x.at(bars.births[bar]), bars.deaths[bar] === Infinity ? this.infinity : this.y.at(bars.deaths[bar])];
  }

  private isInside(x: number, y: number): boolean {
    return x >= this.box.left - 0.5 && x <= this.box.right + 0.5 && y <= this.box.bottom + 0.5 && (y >= this.box.top - 0.5 || y === this.infinity);
  }

  /** Where no bar can be: below the diagonal. */
  private legend(paper: Paper, { bars, keptOf }: Model, inks: Inks): void {
    const some = bars.parts.filter((_, k) => keptOf[k] > 0);
    const shown = some.slice(0, 8);
    shown.forEach(({ dim }, k) => {
      const y = this.box.bottom - 14 - 17 * (shown.length - 1 - k);
      paper.symbols(shapeOf(dim), [this.box.right - 40, y, 4], inkOf(inks, dim));
      paper.text(this.box.right - 30, y + 4, `H${dim}${k === 7 && some.length > 8 ? " \u2026" : ""}`, inks.text);
    });
  }

  private drawSymbols(paper: Paper, model: Model, inks: Inks, bars: Iterable<number>): void {
    const radius = model.keptCount > 500 ? 3 : 4;
    const ofDimension = new Map<number, Map<string, [number, number, number]>>();
    for (const bar of bars) {
      const [x, y] = this.place(model, bar);
      if (this.isInside(x, y)) {
        const dim = model.bars.dimension(bar);
        const at = ofDimension.get(dim) ?? new Map<string, [number, number, number]>();
        ofDimension.set(dim, at);
        const key = `${Math.round(2 * x)},${Math.round(2 * y)}`;
        const same = at.get(key);
        same ? ++same[2] : at.set(key, [x, y, 1]);
      }
    }
    for (const [dim, at] of [...ofDimension].sort((a, b) => a[0] - b[0])) {
      // What falls together is one larger symbol.
      const places = [...at.values()].flatMap(([x, y, count]) => [x, y, Math.min(radius * 2.5, radius * count ** 0.25)]);
      paper.symbols(shapeOf(dim), places, inkOf(inks, dim), 0.8);
    }
  }

  private drawShades(paper: Paper, model: Model, inks: Inks): void {
    const top = this.infinity - 6;
    const columns = Math.max(1, Math.floor((this.box.right - this.box.left) / cell));
    const rows = Math.max(1, Math.floor((this.box.bottom - top) / cell));
    const { births, deaths } = model.bars;
    for (const { dim, first, end } of model.bars.parts) {
      const counts = new Uint32Array(columns * rows);
      let largest = 1;
      for (let bar = first; bar < end; ++bar) {
        if (!model.kept[bar]) {
          continue;
        }
        const column = Math.floor((this.x.at(births[bar]) - this.box.left) / cell);
        const y = deaths[bar] === Infinity ? this.infinity : this.y.at(deaths[bar]);
        const row = Math.floor((y - top) / cell);
        const isIn = column >= 0 && column < columns && row >= 0 && row < rows && (y >= this.box.top || deaths[bar] === Infinity);
        if (isIn) {
          largest = Math.max(largest, ++counts[row * columns + column]);
        }
      }
      const values = new Uint8Array(counts.length);
      const unit = 175 / Math.log1p(largest);
      for (let k = 0; k < counts.length; ++k) {
        values[k] = counts[k] > 0 ? 80 + unit * Math.log1p(counts[k]) : 0;
      }
      paper.shades(this.box.left, top, { values, columns, size: cell }, inkOf(inks, dim));
    }
  }
}
