/** What the three pictures have in common: a frame with axes, and what happens when somebody points or drags. */
import type { Filter } from "./filter.ts";
import type { Inks } from "./inks.ts";
import type { Model } from "./model.ts";
import { marksIn, type Range } from "./numbers.ts";
import type { Paper } from "./paper.ts";

export interface Size {
  width: number;
  height: number;
}

export interface Plot {
  /** Whether an axis is time, so that the time that is pointed at is marked. */
  readonly hasTimes: boolean;
  /** How high it would like to be. */
  height(model: Model, width: number): number;
  /** Everything but what changes with the mouse. */
  draw(paper: Paper, model: Model, size: Size, inks: Inks): void;
  /** What was chosen, what is pointed at, and the time. To be called after `draw`. */
  mark(paper: Paper, model: Model, inks: Inks): void;
  /** The bar at a point, or -1. */
  barAt(model: Model, x: number, y: number): number;
  /** The time there, or null where there is none. */
  timeAt(x: number, y: number): number | null;
  /** What dragging from one point to another says of bars. */
  brushed(x1: number, y1: number, x2: number, y2: number): Partial<Filter>;
  /** What else is to be said of the picture as it is. */
  note(): string;
}

/** Of the inner part of a picture. */
export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** The linear map from numbers to pixels, and back. */
export class Scale {
  constructor(private readonly range: Range, private readonly from: number, private readonly to: number) {}

  at(x: number): number {
    const near = Math.min(Math.max(x, -9e307), 9e307); // differences of others may be no numbers
    return this.from + (this.to - this.from) * ((near - this.range.low) / (this.range.high - this.range.low));
  }

  back(pixel: number): number {
    return this.range.low + (this.range.high - this.range.low) * ((pixel - this.from) / (this.to - this.from));
  }
}

/** What marks at the left side take, with the name of the axis before them. */
export function leftMargin(marks: readonly string[]): number {
  return 30 + 6.4 * Math.max(2, ...marks.map((text) => text.length));
}

/** Below the box, with the name of what is counted. */
export function timeAxis(paper: Paper, box: Box, range: Range, name: string, inks: Inks): void {
  const scale = new Scale(range, box.left, box.right);
  const marks = marksIn(range, Math.max(2, Math.floor((box.right - box.left) / 80)));
  paper.segments(marks.flatMap(({ value }) => [scale.at(value), box.top, scale.at(value), box.bottom]), inks.line, 1);
  for (const { value, text } of marks) {
    paper.text(scale.at(value), box.bottom + 15, text, inks.weak, { anchor: "middle" });
  }
  paper.text((box.left + box.right) / 2, box.bottom + 31, name, inks.weak, { anchor: "middle" });
  paper.segments([box.left, box.bottom, box.right, box.bottom], inks.weak, 1);
}

/** Where the time is that is pointed at. */
export function markTimes(paper: Paper, box: Box, scale: Scale, model: Model, inks: Inks): void {
  const { moment, time } = model;
  const { alive } = model.marked;
  const within = (x: number) => Math.min(Math.max(scale.at(x), box.left), box.right);
  if (alive[0] > -Infinity || alive[1] < Infinity) {
    const [from, to] = [alive[0] === -Infinity ? box.left : within(alive[0]), alive[1] === Infinity ? box.right : within(alive[1])];
    paper.rect(from, box.top, Math.max(to - from, 1), box.bottom - box.top, inks.mark, 0.16);
  }
  for (const [at, width, dashes] of [[moment, 1.5, []], [time, 1, [3, 3]]] as const) {
    if (at !== null && scale.at(at) >= box.left - 0.5 && scale.at(at) <= box.right + 0.5) {
      paper.line([scale.at(at), box.top, scale.at(at), box.bottom], inks.mark, width, dashes);
    }
  }
}

/** Both ends of a drag as an interval of numbers, outwards without end where it leaves the picture. */
export function dragged(scale: Scale, from: number, to: number, low: number, high: number): [number, number] {
  const [a, b] = [Math.min(from, to), Math.max(from, to)];
  return [a <= low ? -Infinity : scale.back(a), b >= high ? Infinity : scale.back(b)];
}
