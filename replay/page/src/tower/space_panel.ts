/** The complex in space at a moment, and over it the class of the chosen bar. */
import { rgb } from "../buffers.ts";
import { dark, light, type Theme } from "../colours.ts";
import type { Drawn } from "../drawn.ts";
import { get } from "../elements.ts";
import { type Overlay, Picture } from "../scene.ts";
import { cellsText } from "../text.ts";
import { drawnOf, overlayOf, TowerComplex } from "./complex.ts";
import type { BarClass, ComplexData } from "./data.ts";
import type { Model } from "./model.ts";

const cycleColour = 0xd55e00;
const boundsColour = 0x56b4e9;

/** The place of the moment after so many operations. */
export function momentWith({ ends }: ComplexData, operations: number): number {
  const found = ends.findIndex((end) => end >= operations);
  return found < 0 ? ends.length - 1 : found;
}

export class SpacePanel {
  private readonly complex: TowerComplex;
  private readonly picture: Picture | null;
  private readonly slider = get<HTMLInputElement>("moment");
  private moment: number;
  private drawn: Drawn = { vertices: [], edges: [], faces: [], size: 1, missing: 0 };
  private cells = "";

  constructor(private readonly model: Model, private readonly data: ComplexData, private theme: Theme, private readonly onMoment: () => void) {
    this.complex = new TowerComplex(data);
    const last = Math.max(data.ends.length - 1, 0);
    this.moment = Math.min(momentWith(data, this.complex.fullest), last); // what is contracted to a point is nothing to begin with
    get<HTMLElement>("stage").hidden = false;
    this.picture = this.makePicture();
    this.slider.max = String(last);
    this.slider.addEventListener("input", () => this.toMoment(this.slider.valueAsNumber));
    const press = (id: string, act: () => void) => get(id).addEventListener("click", act);
    press("fit", () => this.fit());
    press("to-birth", () => this.toOperation((known) => known.born.after));
    press("to-end", () => this.toOperation((known) => known.killed?.after));
    get("solid").addEventListener("input", () => this.show());
    new ResizeObserver(() => this.resize()).observe(get("picture"));
    this.resize();
    this.toMoment(this.moment);
  }

  setTheme(isDark: boolean): void {
    this.theme = isDark ? dark : light;
    this.picture?.setTheme(this.theme);
    this.show();
  }

  /** After another bar has been chosen: to its birth. */
  choose(): void {
    const known = this.known();
    get<HTMLButtonElement>("to-birth").disabled = !known;
    get<HTMLButtonElement>("to-end").disabled = !known?.killed;
    known ? this.toOperation(({ born }) => born.after) : this.show();
  }

  private known(): BarClass | undefined {
    return this.model.classes.get(this.model.chosen);
  }

  private makePicture(): Picture | null {
    try {
      return new Picture(get("canvas"), this.theme);
    } catch {
      get<HTMLElement>("nopicture").hidden = false;
      return null; // all else works without
    }
  }

  private fit(): void {
    if (this.picture) {
      this.picture.moved = false;
      this.picture.fit();
    }
  }

  private resize(): void {
    const { clientWidth, clientHeight } = get("picture");
    this.picture?.resize(clientWidth, clientHeight);
    if (this.picture && !this.picture.moved) {
      this.picture.fit();
    }
  }

  private toOperation(of: (known: BarClass) => number | undefined): void {
    const known = this.known();
    const operations = known && of(known);
    if (operations !== undefined) {
      this.toMoment(momentWith(this.data, operations));
    }
  }

  private toMoment(moment: number): void {
    this.moment = Math.min(Math.max(moment, 0), this.data.ends.length - 1);
    const operations = this.data.ends[this.moment] ?? 0;
    const now = this.complex.at(operations);
    this.drawn = drawnOf(this.complex, now);
    const time = this.data.times[this.moment] ?? 0;
    this.model.moment = this.data.times.length > 0 ? time : null;
    this.cells = cellsText(now.counts);
    const betti = this.model.allCurves.at(time);
    this.slider.value = String(this.moment);
    const text = `${this.model.data.time_name} ${this.model.times.text(time)}: ${this.cells}; Betti numbers ${betti.join(", ")}`;
    this.slider.setAttribute("aria-valuetext", text);
    get("moment-text").textContent = text;
    this.show();
    this.onMoment();
  }

  /** The cycle from the birth on, and what it bounds from the end on. */
  private overlays(): { overlays: Overlay[]; said: string } {
    const known = this.known();
    const operations = this.data.ends[this.moment] ?? 0;
    if (!known) {
      return { overlays: [], said: this.model.chosen >= 0 ? "The class of the chosen bar is not on this page." : "" };
    }
    if (operations < known.born.after) {
      return { overlays: [], said: "The class of the chosen bar is not born yet." };
    }
    const overlays: Overlay[] = [];
    const said: string[] = [];
    const p = Number(/^Z\/(\d+)$/.exec(this.model.data.ring)?.[1] ?? 0);
    if (known.killed && operations >= known.killed.after && known.bounds) {
      overlays.push(overlayOf(this.complex, this.complex.image(known.bounds, known.killed.after, operations, p), boundsColour));
      said.push("in blue the chain that it bounds");
    }
    if (known.cycle) {
      overlays.push(overlayOf(this.complex, this.complex.image(known.cycle, known.born.after, operations, p), cycleColour));
      said.unshift("In orange, thick: the cycle of the chosen bar");
    }
    return { overlays, said: said.join(", ") };
  }

  private show(): void {
    const { overlays, said } = this.overlays();
    const colour = rgb(this.theme.face);
    get("overlaid").textContent = said;
    get("canvas").setAttribute("aria-label", `The complex: ${this.cells}. ${said}`);
    this.picture?.show({ drawn: this.drawn, colourOf: () => colour, highlighted: new Set(), opacity: get<HTMLInputElement>("solid").valueAsNumber / 100, overlays });
  }
}
