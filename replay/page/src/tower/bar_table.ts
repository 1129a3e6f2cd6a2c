/** The kept bars as a table, the longest first, some at a time. */
import { dimensionMark } from "./marks.ts";
import type { Model } from "./model.ts";
import { withSeparators } from "./numbers.ts";

export const barsOnPage = 50;

export class BarTable {
  private page = 0;
  private rows = new Map<number, HTMLButtonElement>();

  constructor(
    private readonly body: HTMLTableSectionElement,
    private readonly said: HTMLElement,
    private readonly back: HTMLButtonElement,
    private readonly forward: HTMLButtonElement,
    private readonly model: Model,
    private readonly onChoose: (bar: number) => void,
    onPoint: (bar: number) => void,
  ) {
    back.addEventListener("click", () => this.turn(-1));
    forward.addEventListener("click", () => this.turn(1));
    const barOf = (event: Event) => Number((event.target as Element).closest("tr")?.dataset.bar ?? -1);
    body.addEventListener("click", (event) => barOf(event) >= 0 && onChoose(barOf(event)));
    body.addEventListener("pointerover", (event) => onPoint(barOf(event)));
    body.addEventListener("pointerleave", () => onPoint(-1));
    body.addEventListener("keydown", (event) => this.key(event));
  }

  /** After the filter has changed. */
  reset(): void {
    this.page = 0;
    this.fill();
  }

  /** After a bar has been chosen: it is on the page. */
  update(): void {
    const { chosen, kept } = this.model;
    if (chosen >= 0 && kept[chosen] && !this.rows.has(chosen)) {
      this.page = Math.floor(this.model.placeOf(chosen) / barsOnPage);
      this.fill();
    }
    for (const [bar, button] of this.rows) {
      button.setAttribute("aria-pressed", String(bar === chosen));
      button.closest("tr")!.classList.toggle("chosen", bar === chosen);
    }
  }

  private get pages(): number {
    return Math.max(1, Math.ceil(this.model.keptCount / barsOnPage));
  }

  private turn(by: number): void {
    this.page = Math.min(Math.max(this.page + by, 0), this.pages - 1);
    this.fill();
  }

  private fill(): void {
    const { bars, times, keptCount, chosen, classes } = this.model;
    const first = this.page * barsOnPage;
    const some = this.model.longest(first, barsOnPage);
    this.rows = new Map();
    this.body.replaceChildren(
      ...some.map((bar) => {
        const row = document.createElement("tr");
        row.dataset.bar = String(bar);
        row.classList.toggle("chosen", bar === chosen);
        const button = document.createElement("button");
        button.type = "button";
        const dim = bars.dimension(bar);
        button.append(dimensionMark(dim), `H${dim}`);
        button.setAttribute("aria-label", this.model.text(bar));
        button.setAttribute("aria-pressed", String(bar === chosen));
        row.insertCell().append(button);
        const [birth, death] = [bars.births[bar], bars.deaths[bar]];
        for (const text of [times.text(birth), times.text(death), times.length(birth, death), classes.has(bar) ? "yes" : ""]) {
          row.insertCell().textContent = text;
        }
        this.rows.set(bar, button);
        return row;
      }),
    );
    const last = first + some.length;
    this.said.textContent = keptCount === 0 ? "no bars" : `${withSeparators(first + 1)} to ${withSeparators(last)} of ${withSeparators(keptCount)}`;
    this.back.disabled = this.page === 0;
    this.forward.disabled = this.page >= this.pages - 1;
  }

  private key(event: KeyboardEvent): void {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const row = (event.target as Element).closest("tr");
    if (by === undefined || !row) {
      return;
    }
    event.preventDefault();
    const next = by > 0 ? row.nextElementSibling : row.previousElementSibling;
    if (next) {
      next.querySelector("button")!.focus();
      this.onChoose(Number((next as HTMLElement).dataset.bar));
    } else if (by > 0 ? this.page < this.pages - 1 : this.page > 0) {
      this.turn(by);
      const buttons = [...this.rows.values()];
      buttons[by > 0 ? 0 : buttons.length - 1].focus();
    }
  }
}
