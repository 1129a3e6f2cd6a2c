/** A picture on the page: its canvases, what the mouse, fingers and keys do with it, and its SVG file. */
import type { Filter } from "./filter.ts";
import { type Inks, lightInks } from "./inks.ts";
import type { Model } from "./model.ts";
import { CanvasPaper } from "./paper.ts";
import type { Plot, Size } from "./plot.ts";
import { SvgPaper } from "./svg_paper.ts";

export interface PlotEvents {
  choose(bar: number): void;
  /** The next bar, or the one before, of the list. */
  move(by: number): void;
  point(bar: number, time: number | null): void;
  /** While somebody drags, and at the end. */
  brush(some: Partial<Filter>, isDone: boolean): void;
}

/** The mouse goes farther than this in a drag, not in a click. */
const leastDrag = 5;

export class PlotView {
  private readonly ground: HTMLCanvasElement;
  private readonly marks: HTMLCanvasElement;
  private readonly noteLine: HTMLElement;
  private size: Size = { width: 0, height: 0 };
  /** What the marks are of. */
  private marked = "";

  constructor(
    private readonly figure: HTMLElement,
    private readonly name: string,
    private readonly plot: Plot,
    private readonly model: Model,
    private readonly events: PlotEvents,
  ) {
    this.ground = figure.querySelector(".ground")!;
    this.marks = figure.querySelector(".marks")!;
    this.noteLine = figure.querySelector(".note")!;
    figure.querySelector(".save")!.addEventListener("click", () => this.save());
    this.listen();
  }

  draw(inks: Inks): void {
    const width = Math.floor(this.figure.querySelector(".sheet")!.clientWidth);
    this.size = { width, height: Math.floor(this.plot.height(this.model, width)) };
    for (const canvas of [this.ground, this.marks]) {
      const density = Math.min(window.devicePixelRatio, 2);
      const wanted = [Math.floor(width * density), Math.floor(this.size.height * density)];
      if (canvas.width !== wanted[0] || canvas.height !== wanted[1]) {
        [canvas.width, canvas.height] = wanted;
        canvas.style.height = `${this.size.height}px`;
      }
    }
    this.plot.draw(this.paper(this.ground), this.model, this.size, inks);
    this.noteLine.textContent = this.plot.note();
    this.marked = "";
    this.mark(inks);
  }

  mark(inks: Inks): void {
    const { hovered, chosen: now, time, moment, brush } = this.model;
    const key = JSON.stringify([hovered, now, moment, brush, this.plot.hasTimes ? time : null]);
    if (key === this.marked) {
      return; // clearing a canvas costs as much as all else
    }
    this.marked = key;
    this.plot.mark(this.paper(this.marks), this.model, inks);
    const { chosen, keptCount } = this.model;
    this.marks.setAttribute("aria-label", `${this.name} of ${keptCount} bars${chosen >= 0 ? `; chosen: ${this.model.text(chosen)}` : ""}. Arrow keys choose a bar.`);
  }

  /** The picture as it is seen, on white paper. */
  svg(): string {
    const paper = new SvgPaper();
    paper.rect(0, 0, this.size.width, this.size.height, lightInks.paper);
    this.plot.draw(paper, this.model, this.size, lightInks);
    if (this.model.chosen >= 0) {
      const { time, hovered } = this.model;
      Object.assign(this.model, { time: null, hovered: -1 }); // a file has no mouse
      this.plot.mark(paper, this.model, lightInks);
      Object.assign(this.model, { time, hovered });
    }
    const said = [...this.model.data.facts, this.model.filterText(), this.plot.note()].filter(Boolean);
    return paper.file(this.size.width, this.size.height, `${this.name}: ${this.model.data.title}`, said.join("; "));
  }

  private save(): void {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.svg()], { type: "image/svg+xml" }));
    link.download = `${this.name.toLowerCase().replace(/ /g, "_")}.svg`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  private paper(canvas: HTMLCanvasElement): CanvasPaper {
    const context = canvas.getContext("2d")!;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    const density = canvas.width / Math.max(this.size.width, 1);
    context.scale(density, density);
    return new CanvasPaper(context);
  }

  private listen(): void {
    let from: [number, number] | null = null;
    let isDragging = false;
    const at = (event: PointerEvent): [number, number] => {
      const box = this.marks.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.marks.addEventListener("pointerdown", (event) => {
      from = event.button === 0 ? at(event) : null;
      isDragging = false;
    });
    this.marks.addEventListener("pointermove", (event) => {
      const [x, y] = at(event);
      if (from && (isDragging || Math.hypot(x - from[0], y - from[1]) >= leastDrag)) {
        if (!isDragging) {
          this.marks.setPointerCapture(event.pointerId);
        }
        isDragging = true;
        this.events.brush(this.plot.brushed(...from, x, y), false);
      } else if (!from) {
        this.events.point(this.plot.barAt(this.model, x, y), this.plot.timeAt(x, y));
      }
    });
    const end = (event: PointerEvent, isReal: boolean) => {
      const [x, y] = at(event);
      if (from && isDragging) {
        this.events.brush(this.plot.brushed(...from, x, y), true);
      } else if (from && isReal) {
        this.events.choose(this.plot.barAt(this.model, x, y));
      }
      from = null;
      isDragging = false;
    };
    this.marks.addEventListener("pointerup", (event) => end(event, true));
    this.marks.addEventListener("pointercancel", (event) => end(event, false));
    this.marks.addEventListener("pointerleave", () => this.events.point(-1, null));
    this.marks.addEventListener("keydown", (event) => {
      const acts: Record<string, () => void> = {
        ArrowDown: () => this.events.move(1),
        ArrowUp: () => this.events.move(-1),
        ArrowRight: () => this.events.move(1),
        ArrowLeft: () => this.events.move(-1),
        Home: () => this.events.move(-Infinity),
        Escape: () => this.events.choose(-1),
      };
      if (acts[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
        event.preventDefault();
        acts[event.key]();
      }
    });
  }
}
