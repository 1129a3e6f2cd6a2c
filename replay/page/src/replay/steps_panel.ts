/** The list of operations, with a search. */
import { button } from "../elements.ts";
import { type Data, stepOf } from "./data.ts";
import { RowList } from "./row_list.ts";

/** Whether a step is what somebody looks for: each of the words is in its number, its name or its text. */
export function matches(words: readonly string[], number: number, op: string, text: string): boolean {
  const all = `${number} ${op} ${text}`.toLowerCase();
  return words.every((word) => all.includes(word));
}

export function wordsOf(search: string): string[] {
  return search.toLowerCase().split(/\s+/).filter(Boolean);
}

export class StepsPanel {
  private readonly rows: RowList;
  private stops: readonly number[] = [0];
  /** Numbers in `stops` of what is listed: all, or what is searched for. */
  private listed: number[] = [];
  private now = 0;

  constructor(
    list: HTMLOListElement,
    private readonly search: HTMLInputElement,
    private readonly found: HTMLElement,
    private readonly data: Data,
    stops: readonly number[],
    private readonly onJump: (steps: number) => void,
  ) {
    this.rows = new RowList(list, (index) => this.rowOf(this.listed[index]));
    search.addEventListener("input", () => {
      this.filter(0);
      this.setStep(this.now);
    });
    this.setStops(stops);
  }

  /** The page stops there now: steps at which it does no longer go from the list, others come. */
  setStops(stops: readonly number[]): void {
    const same = stops.findIndex((stop, k) => stop !== this.stops[k]);
    this.stops = stops;
    this.filter(same < 0 ? stops.length : same);
  }

  setStep(steps: number): void {
    this.mark(false);
    this.now = steps;
    const index = this.indexOf(steps);
    if (index >= 0) {
      this.rows.bringIntoSight(index);
    }
    this.mark(true);
  }

  private indexOf(steps: number): number {
    return this.listed.findIndex((k) => this.stops[k] === steps);
  }

  private mark(isCurrent: boolean): void {
    const button = this.rows.at(this.indexOf(this.now))?.firstElementChild;
    isCurrent ? button?.setAttribute("aria-current", "step") : button?.removeAttribute("aria-current");
  }

  private rowOf(k: number): HTMLElement {
    const stop = this.stops[k];
    const step = stepOf(this.data.steps[stop - 1]);
    const row = document.createElement("li");
    const parts: [string, string][] = [
      ["number", String(stop)],
      ["op", step.op],
      ["text", this.summary(stop, this.stops[k - 1])],
    ];
    const made = button("", () => this.onJump(stop));
    for (const [name, text] of parts) {
      const part = document.createElement("span");
      part.className = name;
      part.textContent = text;
      made.append(part);
    }
    made.title = step.text;
    if (stop === this.now) {
      made.setAttribute("aria-current", "step");
    }
    row.append(made);
    return row;
  }

  private summary(stop: number, before: number): string {
    const { text, op } = stepOf(this.data.steps[stop - 1]);
    const fields = text.replace(/^\{"op":"[a-z]+",?/, "").replace(/\}$/, "");
    const more = stop - before - 1;
    return (fields === text && text.startsWith(op) ? text.slice(op.length) : fields) + (more > 0 ? ` (and the ${more} steps before)` : "");
  }

  /** Lists what is searched for. Stops before this number are those of before. */
  private filter(same: number): void {
    const words = wordsOf(this.search.value);
    const isListed = (k: number) => {
      const { op, text } = stepOf(this.data.steps[this.stops[k] - 1]);
      return words.length === 0 || matches(words, this.stops[k], op, text);
    };
    const before = this.listed.findIndex((k) => k >= same);
    const kept = same > 0 ? this.listed.slice(0, before < 0 ? this.listed.length : before) : [];
    const from = same > 0 ? same : 1;
    this.listed = [...kept, ...Array.from({ length: this.stops.length - from }, (_, k) => from + k).filter(isListed)];
    this.rows.change(this.listed.length, kept.length);
    const all = this.stops.length - 1;
    this.found.textContent = words.length > 0 ? `${this.listed.length} of ${all} steps` : `${all} steps`;
  }
}
