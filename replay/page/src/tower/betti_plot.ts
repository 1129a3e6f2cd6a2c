/** Betti numbers against time: a curve of steps for each dimension. */
import { cornersOf } from "./betti.ts";
import type { Filter } from "./filter.ts";
import { dashesOf, inkOf, type Inks } from "./inks.ts";
import type { Model } from "./model.ts";
import { marksIn, withSeparators } from "./numbers.ts";
import type { Paper } from "./paper.ts";
import { type Box, dragged, leftMargin, markTimes, type Plot, Scale, type Size, timeAxis } from "./plot.ts";

interface Curve {
  dim: number;
  corners: number[];
}

export class BettiPlot implements Plot {
  readonly hasTimes = true;
  private box: Box = { left: 0, top: 0, right: 0, bottom: 0 };
  private x = new Scale({ low: 0, high: 1 }, 0, 1);
  private isFiltered = false;
  private all: { key: string; curves: Curve[] } | null = null;

  height(_: Model, width: number): number {
    return Math.min(width, 460);
  }

  draw(paper: Paper, model: Model, { width, height }: Size, inks: Inks): void {
    const largest = Math.max(1, ...model.allCurves.largest);
    const least = Math.min(largest, ...model.allCurves.largest.filter((value) => value > 0));
    const isLogarithmic = largest > 40 * least;
    const marks = marksOf(largest, isLogarithmic).map((value) => ({ value, text: withSeparators(value) }));
    this.box = { left: leftMargin(marks.map(({ text }) => text)), top: 26, right: width - 22, bottom: height - 40 };
    this.x = new Scale(model.range, this.box.left, this.box.right);
    this.isFiltered = model.isFiltered;
    timeAxis(paper, this.box, model.range, model.times.axis(model.data.time_name), inks);
    const x = (time: number) => Math.min(Math.max(this.x.at(time), this.box.left), this.box.right);
    const all = this.allOf(model, x);
    const kept = this.isFiltered ? model.curves.dims.map((dim, part) => ({ dim, corners: cornersOf(model.curves, part, model.kept, x, this.box.right) })) : all;
    const size = (value: number) => (isLogarithmic ? Math.log1p(value) / Math.log1p(largest) : value / largest);
    const y = (value: number) => this.box.bottom - (this.box.bottom - this.box.top - 4) * size(value);
    for (const { value, text } of marks) {
      paper.segments([this.box.left, y(value), this.box.right, y(value)], inks.line, 1);
      paper.text(this.box.left - 7, y(value) + 4, text, inks.weak, { anchor: "end" });
    }
    paper.text(12, (this.box.top + this.box.bottom) / 2, `Betti number${isLogarithmic ? " (logarithmic)" : ""}`, inks.weak, { anchor: "middle", upwards: true });
    paper.segments([this.box.left, this.box.top - 6, this.box.left, this.box.bottom], inks.weak, 1);
    if (this.isFiltered) {
      all.forEach(({ dim, corners }) => this.curve(paper, corners, y, inkOf(inks, dim), 1, [], 0.35));
    }
    kept.forEach(({ dim, corners }) => this.curve(paper, corners, y, inkOf(inks, dim), 2, dashesOf(dim), 1));
    let at = this.box.left + 6;
    for (const { dim } of kept) {
      paper.line([at, 14, at + 26, 14], inkOf(inks, dim), 2, dashesOf(dim));
      paper.text(at + 31, 18, `H${dim}`, inks.text);
      at += 62;
    }
  }

  /** The curves of all bars, which stay what they are while the axis does. */
  private allOf({ allCurves, range }: Model, x: (time: number) => number): Curve[] {
    const key = [range.low, range.high, this.box.left, this.box.right].join();
    if (this.all?.key !== key) {
      this.all = { key, curves: allCurves.dims.map((dim, part) => ({ dim, corners: cornersOf(allCurves, part, null, x, this.box.right) })) };
    }
    return this.all.curves;
  }

  mark(paper: Paper, model: Model, inks: Inks): void {
    markTimes(paper, this.box, this.x, model, inks);
    const y = this.box.bottom + 4;
    for (const [bar, width] of [[model.hovered, 2], [model.chosen, 3]] as const) {
      if (bar >= 0 && model.kept[bar]) {
        // A bar has no place among the curves but below their axis.
        const [from, to] = [model.bars.births[bar], model.bars.deaths[bar]].map((time) => Math.min(Math.max(this.x.at(time), this.box.left), this.box.right));
        paper.line([from - 1, y, to + 1, y], inks.text, width + 2);
        paper.line([from, y, to, y], inkOf(inks, model.bars.dimension(bar)), width);
      }
    }
  }

  barAt(): number {
    return -1;
  }

  timeAt(x: number): number | null {
    return x >= this.box.left && x <= this.box.right ? this.x.back(x) : null;
  }

  brushed(x1: number, _: number, x2: number): Partial<Filter> {
    return { alive: dragged(this.x, x1, x2, this.box.left, this.box.right) };
  }

  note(): string {
    return this.isFiltered ? "Thick: the bars that are kept. Thin: all of them." : "";
  }

  /** Values of Betti numbers as a line of steps. */
  private curve(paper: Paper, corners: readonly number[], y: (value: number) => number, colour: string, width: number, dashes: readonly number[], alpha: number): void {
    const points: number[] = [];
    for (let k = 0; k < corners.length; k += 2) {
      if (k > 0 && corners[k] !== corners[k - 2]) {
        points.push(corners[k], y(corners[k - 1]));
      }
      points.push(corners[k], y(corners[k + 1]));
    }
    paper.line(points, colour, width, dashes, alpha);
  }
}

function marksOf(largest: number, isLogarithmic: boolean): number[] {
  if (!isLogarithmic) {
    return marksIn({ low: 0, high: largest }, Math.min(8, largest)).map(({ value }) => value);
  }
  const marks = [0];
  for (let value = 1; value <= largest; value *= 10) {
    marks.push(value);
  }
  return marks;
}
