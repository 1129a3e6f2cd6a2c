/** The barcode: a line for each bar, or, of more than there is room for, rows of many that are shades. */
import type { Part } from "./bars.ts";
import type { Filter } from "./filter.ts";
import { inkOf, type Inks } from "./inks.ts";
import type { Model } from "./model.ts";
import { counted, withSeparators } from "./numbers.ts";
import type { Paper } from "./paper.ts";
import { type Box, dragged, markTimes, type Plot, Scale, type Size, timeAxis } from "./plot.ts";

/** The rows of one dimension. */
interface Band {
  part: Part;
  /** In the rows of the model: its first bar, and how many it has. */
  first: number;
  bars: number;
  top: number;
  rows: number;
  /** Between rows. */
  step: number;
  /** Bars in a row, the last one may have fewer. */
  each: number;
}

const gap = 10;
/** A bar by itself takes that much at least. */
const leastStep = 2;
const most = 440;

export class BarcodePlot implements Plot {
  readonly hasTimes = true;
  private bands: Band[] = [];
  private box: Box = { left: 0, top: 0, right: 0, bottom: 0 };
  private scale = new Scale({ low: 0, high: 1 }, 0, 1);

  height({ bars }: Model): number {
    return Math.min(most, Math.max(110, bars.count * 11 + bars.parts.length * gap)) + 48;
  }

  draw(paper: Paper, model: Model, { width, height }: Size, inks: Inks): void {
    this.box = { left: 46, top: 8, right: width - 18, bottom: height - 40 };
    this.scale = new Scale(model.range, this.box.left, this.box.right);
    this.bands = this.bandsOf(model);
    timeAxis(paper, this.box, model.range, model.times.axis(model.data.time_name), inks);
    for (const band of this.bands) {
      const colour = inkOf(inks, band.part.dim);
      paper.text(this.box.left - 8, band.top + (band.rows * band.step) / 2 + 4, `H${band.part.dim}`, colour, { anchor: "end", bold: true });
      if (band.each === 1) {
        this.drawLines(paper, model, band, colour);
      } else {
        paper.shades(this.box.left, band.top, this.shadesOf(model, band), colour);
      }
      const line = band.top - gap / 2;
      if (band !== this.bands[0]) {
        paper.segments([this.box.left, line, this.box.right, line], inks.line, 1);
      }
    }
    if (this.bands.length === 0) {
      paper.text((this.box.left + this.box.right) / 2, (this.box.top + this.box.bottom) / 2, "no bars", inks.weak, { anchor: "middle", size: 13 });
    }
  }

  mark(paper: Paper, model: Model, inks: Inks): void {
    markTimes(paper, this.box, this.scale, model, inks);
    for (const [bar, width] of [[model.hovered, 2], [model.chosen, 4]] as const) {
      const y = this.rowOf(model, bar);
      if (y !== null) {
        const [from, to] = this.ends(model, bar);
        const dim = model.bars.dimension(bar);
        paper.line([from - 3, y, to + 3, y], inks.paper, width + 6);
        paper.line([from - 1.5, y, to + 1.5, y], inks.text, width + 3);
        paper.line([from, y, to, y], inkOf(inks, dim), width);
      }
    }
  }

  barAt(model: Model, x: number, y: number): number {
    const band = this.bands.find(({ top, rows, step }) => y >= top - gap / 2 && y < top + rows * step + gap / 2);
    if (!band || x < this.box.left - 4 || x > this.box.right + 4) {
      return -1;
    }
    const row = Math.min(Math.max(Math.floor((y - band.top) / band.step), 0), band.rows - 1);
    const begin = band.first + row * band.each;
    const end = Math.min(begin + band.each, band.first + band.bars);
    let best = -1;
    for (let at = begin; at < end; ++at) {
      const bar = model.rows[at];
      const [from, to] = this.ends(model, bar);
      if (x >= from - 4 && x <= to + 4 && (best < 0 || model.bars.length(bar) > model.bars.length(best))) {
        best = bar;
      }
    }
    return best < 0 && band.each === 1 ? model.rows[begin] : best;
  }

  timeAt(x: number): number | null {
    return x >= this.box.left && x <= this.box.right ? this.scale.back(x) : null;
  }

  brushed(x1: number, _: number, x2: number): Partial<Filter> {
    return { alive: dragged(this.scale, x1, x2, this.box.left, this.box.right) };
  }

  note(): string {
    const dense = this.bands.filter(({ each }) => each > 1);
    if (dense.length === 0) {
      return "";
    }
    const parts = dense.map(({ part, bars, rows, each }) => `H${part.dim} has ${counted(bars, "bar")} in ${withSeparators(rows)} rows, up to ${withSeparators(each)} in each`);
    return `Nothing is left out: ${parts.join("; ")}. The darker, the more of them are alive; a click takes the longest one there.`;
  }

  private bandsOf({ bars, keptOf }: Model): Band[] {
    const some = bars.parts.map((part, k) => ({ part, count: keptOf[k] })).filter(({ count }) => count > 0);
    const room = this.box.bottom - this.box.top - gap * some.length;
    const total = some.reduce((sum, { count }) => sum + count, 0);
    const isDense = total * leastStep > room;
    // Those that are few have a line each, and leave the others what is left.
    const step = isDense ? leastStep : Math.min(14, room / Math.max(total, 1));
    const fair = room / Math.max(some.length, 1);
    const few = some.filter(({ count }) => !isDense || count * leastStep <= fair);
    const left = room - few.reduce((sum, { count }) => sum + count * step, 0);
    const many = some.length - few.length;
    let top = this.box.top + gap / 2;
    let first = 0;
    return some.map(({ part, count }) => {
      const isFew = few.some((each) => each.part === part);
      const rows = isFew ? count : Math.floor(left / many);
      const each = isFew ? 1 : Math.ceil(count / rows);
      const band = { part, first, bars: count, top, rows: isFew ? count : Math.ceil(count / each), step: isFew ? step : 1, each };
      first += count;
      top += band.rows * band.step + gap;
      return band;
    });
  }

  private ends({ bars }: Model, bar: number): [number, number] {
    const within = (x: number) => Math.min(Math.max(x, this.box.left), this.box.right);
    return [within(this.scale.at(bars.births[bar])), bars.deaths[bar] === Infinity ? this.box.right : within(this.scale.at(bars.deaths[bar]))];
  }

  /** The height of the line of a bar, or null when it has none. */
  private rowOf(model: Model, bar: number): number | null {
    if (bar < 0 || !model.kept[bar]) {
      return null;
    }
    const band = this.bands.find(({ part }) => bar >= part.first && bar < part.end);
    const at = model.rows.indexOf(bar);
    return band ? band.top + (Math.floor((at - band.first) / band.each) + 0.5) * band.step : null;
  }

  private drawLines(paper: Paper, model: Model, band: Band, colour: string): void {
    const thickness = Math.min(5, Math.max(1.2, band.step * 0.5));
    const segments: number[] = [];
    const arrows: number[] = [];
    for (let row = 0; row < band.bars; ++row) {
      const bar = model.rows[band.first + row];
      const y = band.top + (row + 0.5) * band.step;
      const [from, to] = this.ends(model, bar);
      segments.push(from, y, Math.max(to, from + 1), y);
      if (model.bars.deaths[bar] === Infinity) {
        const size = Math.min(5, Math.max(2, band.step * 0.45));
        arrows.push(to, y - size, to + 1.5 * size, y, to + 1.5 * size, y, to, y + size);
      }
    }
    paper.segments(segments, colour, thickness);
    paper.segments(arrows, colour, 1.4);
  }

  /** For each row and pixel how many bars are alive there. */
  private shadesOf(model: Model, band: Band): { values: Uint8Array; columns: number; size: number } {
    const columns = Math.max(1, Math.floor(this.box.right - this.box.left));
    const counts = new Int32Array(columns + 1);
    const alive = new Int32Array(columns * band.rows);
    const { births, deaths } = model.bars;
    const { low, high } = model.range;
    const perTime = columns / (high - low);
    let largest = 1;
    for (let row = 0; row < band.rows; ++row) {
      counts.fill(0);
      const begin = band.first + row * band.each;
      const end = Math.min(begin + band.each, band.first + band.bars);
      for (let at = begin; at < end; ++at) {
        const bar = model.rows[at];
        const from = Math.max(0, Math.floor((births[bar] - low) * perTime));
        const to = Math.min(columns, Math.floor((deaths[bar] - low) * perTime) + 1);
        if (from < columns && to > 0) {
          ++counts[from];
          --counts[Math.max(to, from + 1)];
        }
      }
      let now = 0;
      for (let column = 0; column < columns; ++column) {
        now += counts[column];
        alive[row * columns + column] = now;
        largest = Math.max(largest, now);
      }
    }
    const values = new Uint8Array(alive.length);
    const unit = 190 / Math.log1p(largest);
    for (let k = 0; k < alive.length; ++k) {
      values[k] = alive[k] > 0 ? 65 + unit * Math.log1p(alive[k]) : 0;
    }
    return { values, columns, size: 1 };
  }
}
