/** The list of operations, with a search. */
import { type Data, stepOf } from "./data.ts";

/** Whether a step is what somebody looks for: each of the words is in its number, its name or its text. */
export function matches(words: readonly string[], number: number, op: string, text: string): boolean {
  const all = `${number} ${op} ${text}`.toLowerCase();
  return words.every((word) => all.includes(word));
}

export function wordsOf(search: string): string[] {
  return search.toLowerCase().split(/\s+/).filter(Boolean);
}

export class StepsPanel {
  private rows: { stop: number; row: HTMLLIElement; button: HTMLButtonElement }[] = [];
  private current: HTMLButtonElement | null = null;

  constructor(
    private readonly list: HTMLOListElement,
    private readonly search: HTMLInputElement,
    private readonly found: HTMLElement,
    private readonly data: Data,
    stops: readonly number[],
    private readonly onJump: (steps: number) => void,
  ) {
    search.addEventListener("input", () => this.filter());
    this.setStops(stops);
  }

  /** The page stops there now: steps at which it does no longer go from the list, others come. */
  setStops(stops: readonly number[]): void {
    let same = 0;
    while (same < this.rows.length && this.rows[same].stop === stops[same + 1]) {
      ++same;
    }
    this.rows.splice(same).forEach(({ row }) => row.remove());
    for (let k = same + 1; k < stops.length; ++k) {
      const stop = stops[k];
      const step = stepOf(this.data.steps[stop - 1]);
      const row = document.createElement("li");
      const button = document.createElement("button");
      const parts: [string, string][] = [
        ["number", String(stop)],
        ["op", step.op],
        ["text", this.summary(stop, stops[k - 1])],
      ];
      for (const [name, text] of parts) {
        const part = document.createElement("span");
        part.className = name;
        part.textContent = text;
        button.append(part);
      }
      button.type = "button";
      button.title = step.text;
      button.addEventListener("click", () => this.onJump(stop));
      row.append(button);
      this.list.append(row);
      this.rows.push({ stop, row, button });
    }
    this.filter();
  }

  setStep(steps: number): void {
    this.current?.removeAttribute("aria-current");
    this.current = this.rows.find(({ stop }) => stop === steps)?.button ?? null;
    this.current?.setAttribute("aria-current", "step");
    const list = this.current?.closest("ol");
    if (this.current && list) {
      // Only the list scrolls, not the page.
      const [top, height] = [this.current.parentElement!.offsetTop - list.offsetTop, this.current.offsetHeight];
      if (top < list.scrollTop || top + height > list.scrollTop + list.clientHeight) {
        list.scrollTop = top - list.clientHeight / 2;
      }
    }
  }

  private summary(stop: number, before: number): string {
    const { text, op } = stepOf(this.data.steps[stop - 1]);
    const fields = text.replace(/^\{"op":"[a-z]+",?/, "").replace(/\}$/, "");
    const more = stop - before - 1;
    return (fields === text && text.startsWith(op) ? text.slice(op.length) : fields) + (more > 0 ? ` (and the ${more} steps before)` : "");
  }

  private filter(): void {
    const words = wordsOf(this.search.value);
    let count = 0;
    for (const { stop, row } of this.rows) {
      const { op, text } = stepOf(this.data.steps[stop - 1]);
      row.hidden = !matches(words, stop, op, text);
      count += row.hidden ? 0 : 1;
    }
    this.found.textContent = words.length > 0 ? `${count} of ${this.rows.length} steps` : `${this.rows.length} steps`;
  }
}
