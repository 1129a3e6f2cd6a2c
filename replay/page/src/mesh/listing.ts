/** Lists in which one thing is chosen, by click or by arrow keys. */

export interface Row {
  /** What stands in the row; its text is what a screen reader says. */
  parts: (string | Node)[];
  title?: string;
}

let lists = 0;

/** A list box: rows that can be hidden, one of them chosen or none. */
export class Listing {
  private rows: HTMLElement[] = [];
  private chosen = -1;
  private readonly prefix = `row-${++lists}`;

  /** `list` becomes the list box; `onChoose` is called with the number of a row, or -1; `onOpen` when one is entered. */
  constructor(private readonly list: HTMLElement, private readonly onChoose: (row: number) => void, private readonly onOpen: (row: number) => void) {
    list.setAttribute("role", "listbox");
    list.tabIndex = 0;
    list.addEventListener("keydown", (event) => this.press(event));
    list.addEventListener("click", (event) => {
      const row = this.rows.indexOf((event.target as Element).closest<HTMLElement>("[role=option]")!);
      if (row >= 0) {
        this.set(row === this.chosen ? -1 : row);
      }
    });
    list.addEventListener("dblclick", () => this.chosen >= 0 && onOpen(this.chosen));
  }

  fill(rows: readonly Row[]): void {
    this.rows = rows.map(({ parts, title }, k) => {
      const row = document.createElement("div");
      row.id = `${this.prefix}-${k}`;
      row.setAttribute("role", "option");
      row.setAttribute("aria-selected", "false");
      row.append(...parts);
      row.title = title ?? "";
      return row;
    });
    this.chosen = -1;
    this.list.replaceChildren(...this.rows);
    this.list.removeAttribute("aria-activedescendant");
  }

  /** Shows those rows only. One that was chosen and is hidden is chosen no more. */
  show(isShown: (row: number) => boolean): void {
    this.rows.forEach((row, k) => (row.hidden = !isShown(k)));
    if (this.chosen >= 0 && this.rows[this.chosen].hidden) {
      this.set(-1);
    }
  }

  /** Chooses a row without telling anybody. */
  mark(row: number): void {
    this.rows[this.chosen]?.setAttribute("aria-selected", "false");
    this.chosen = row;
    const now = this.rows[row];
    if (!now) {
      this.list.removeAttribute("aria-activedescendant");
      return;
    }
    now.setAttribute("aria-selected", "true");
    this.list.setAttribute("aria-activedescendant", now.id);
    // Only the list scrolls, not the page.
    const [top, height] = [now.offsetTop - this.list.offsetTop, now.offsetHeight];
    if (top < this.list.scrollTop || top + height > this.list.scrollTop + this.list.clientHeight) {
      this.list.scrollTop = top - this.list.clientHeight / 2;
    }
  }

  private set(row: number): void {
    this.mark(row);
    this.onChoose(row);
  }

  private press(event: KeyboardEvent): void {
    const shown = this.rows.map((_, k) => k).filter((k) => !this.rows[k].hidden);
    const at = shown.indexOf(this.chosen);
    const to = (index: number) => shown[Math.min(Math.max(index, 0), shown.length - 1)];
    const moves: Record<string, () => number> = {
      ArrowDown: () => to(at + 1),
      ArrowUp: () => to(at < 0 ? 0 : at - 1),
      Home: () => to(0),
      End: () => to(Infinity),
      Escape: () => -1,
    };
    if (event.ctrlKey || event.metaKey || event.altKey || shown.length === 0) {
      return;
    }
    if (event.key === "Enter" && this.chosen >= 0) {
      event.preventDefault();
      this.onOpen(this.chosen);
    } else if (moves[event.key]) {
      event.preventDefault();
      event.stopPropagation();
      this.set(moves[event.key]());
    }
  }
}
