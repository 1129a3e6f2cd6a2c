/** The list of loops, and which of them are in it. */
import { get } from "../elements.ts";
import type { Data } from "./data.ts";
import { loopRow } from "./details.ts";
import { Listing } from "./listing.ts";
import { byLength, lengthOf, LengthScale, shorterThan, sliderSteps } from "./loops.ts";
import { counted, numberText, sideText } from "./mesh_text.ts";
import { lineSwatch } from "./swatch.ts";

export class LoopsPanel {
  /** The loops that are listed now, by their numbers in the data. */
  listed: number[] = [];
  private readonly order: number[];
  /** Of each loop its row. */
  private readonly rowOf: number[];
  private readonly list: Listing;
  private readonly scale: LengthScale;
  private readonly sides = new Map<string, HTMLInputElement>();
  private limit = Infinity;

  constructor(private readonly data: Data, private readonly on: { onChoose: (loop: number) => void; onOpen: (loop: number) => void; onList: (listed: number[]) => void }) {
    this.order = byLength(data.loops);
    this.rowOf = [];
    this.order.forEach((loop, row) => (this.rowOf[loop] = row));
    this.scale = new LengthScale(data.loops.map(lengthOf));
    this.list = new Listing(get("loops"), (row) => on.onChoose(this.order[row] ?? -1), (row) => on.onOpen(this.order[row]));
    this.list.fill(
      this.order.map((k) => {
        const parts = loopRow(data.loops[k], data.components_in_all > 1).map(([name, text]) => {
          const part = document.createElement("span");
          [part.className, part.textContent] = [name, text];
          return part;
        });
        return { parts: [lineSwatch(data.loops[k].side), ...parts] };
      }),
    );
    get<HTMLElement>("loops-section").hidden = data.loops_in_all === 0;
    get<HTMLElement>("filter").hidden = data.loops.length < 2;
    this.makeSides();
    this.listen();
    this.setLimit(data.shorter_than ?? Infinity);
  }

  /** What a loop is called: its place in the list, from 0. */
  numberOf(loop: number): number {
    return this.rowOf[loop];
  }

  mark(loop: number): void {
    this.list.mark(loop < 0 ? -1 : this.rowOf[loop]);
  }

  private makeSides(): void {
    for (const side of ["handle", "tunnel", null] as const) {
      const count = this.data.loops.filter((loop) => loop.side === side).length;
      if (count > 0) {
        const label = document.createElement("label");
        const box = document.createElement("input");
        [box.type, box.checked] = ["checkbox", true];
        box.addEventListener("input", () => this.update());
        label.append(box, ` ${sideText({ side })} (${count})`);
        get("sides").append(label);
        this.sides.set(String(side), box);
      }
    }
    get<HTMLElement>("sides").hidden = this.sides.size < 2;
  }

  private listen(): void {
    const field = get<HTMLInputElement>("limit");
    const slider = get<HTMLInputElement>("limit-slider");
    slider.max = String(sliderSteps);
    field.addEventListener("input", () => {
      this.limit = field.value === "" || !(field.valueAsNumber > 0) ? Infinity : field.valueAsNumber;
      slider.value = String(this.scale.stepOf(this.limit));
      this.update();
    });
    slider.addEventListener("input", () => {
      const limit = this.scale.limitAt(slider.valueAsNumber);
      this.setLimit(Number.isFinite(limit) ? Number(limit.toPrecision(3)) : limit);
    });
  }

  private setLimit(limit: number): void {
    this.limit = limit;
    get<HTMLInputElement>("limit").value = Number.isFinite(limit) ? String(limit) : "";
    get<HTMLInputElement>("limit-slider").value = String(this.scale.stepOf(limit));
    this.update();
  }

  private update(): void {
    const { loops } = this.data;
    const isOn = (k: number) => this.sides.get(String(loops[k].side))!.checked;
    this.listed = shorterThan(loops, this.order, this.limit).filter(isOn);
    const shown = new Set(this.listed);
    this.list.show((row) => shown.has(this.order[row]));
    const what = Number.isFinite(this.limit) ? ` shorter than ${numberText(this.limit)}` : "";
    get("listed").textContent = what || shown.size < loops.length ? `${shown.size} of ${counted(loops.length, "loop", "loops")}${what}` : `${counted(loops.length, "loop", "loops")}, the shortest first`;
    get<HTMLInputElement>("limit-slider").setAttribute("aria-valuetext", what || "any length");
    this.on.onList(this.listed);
  }
}
