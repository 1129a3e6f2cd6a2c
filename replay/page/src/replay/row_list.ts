/** A list of which, when it is long, only the rows in sight are there, and some around them. All are equally high. */

/** Lists up to here are there as a whole. */
const few = 200;
/** So many rows more are there on each side, so that keys can go on from row to row. */
const spare = 20;

/** The first row that has to be there, and the one behind the last; sizes in pixels. */
export function rowsInSight(count: number, height: number, top: number, seen: number): [number, number] {
  if (count <= few) {
    return [0, count];
  }
  const first = Math.max(Math.min(Math.floor(top / height), count) - spare, 0);
  return [first, Math.min(Math.ceil((top + seen) / height) + spare, count)];
}

export class RowList {
  private count = 0;
  private first = 0;
  private rows: HTMLElement[] = [];
  private height = 28;
  private readonly above = document.createElement("li");
  private readonly below = document.createElement("li");

  /** `make`: the row of a number, which is made again whenever it comes into sight. */
  constructor(private readonly list: HTMLElement, private readonly make: (index: number) => HTMLElement) {
    for (const space of [this.above, this.below]) {
      space.setAttribute("role", "presentation");
    }
    list.addEventListener("scroll", () => this.update());
    list.addEventListener("focusin", ({ target }) => {
      // Browsers scroll, and say so, only after the next key may have been pressed. Where the mouse is nothing may move.
      const k = (target as Element).matches(":focus-visible") ? this.rows.findIndex((row) => row.contains(target as Element)) : -1;
      k >= 0 && this.bringIntoSight(this.first + k);
    });
  }

  /** There are so many rows now, of which so many at the beginning are as they were. */
  change(count: number, same: number): void {
    this.count = count;
    this.keep(this.first, Math.max(same, this.first));
    this.update();
    const height = this.rows[0]?.offsetHeight ?? 0;
    if (count > few && height > 0 && height !== this.height) {
      this.height = height;
      this.update();
    }
    this.rows.forEach((row) => row.setAttribute("aria-setsize", String(count))); // who does not see the list is told how long it is
  }

  /** The row of a number, if it is there. */
  at(index: number): HTMLElement | null {
    return this.rows[index - this.first] ?? null;
  }

  /** Scrolls the list, not the page, if a row is out of sight. */
  bringIntoSight(index: number): void {
    const { list } = this;
    const row = this.at(index);
    const height = row?.offsetHeight || this.height;
    const top = row ? row.offsetTop - list.offsetTop : index * this.height;
    if (top < list.scrollTop || top + height > list.scrollTop + list.clientHeight) {
      list.scrollTop = top - list.clientHeight / 2;
      this.update();
    }
  }

  /** Removes rows but those from one number to another. */
  private keep(first: number, end: number): void {
    const kept = this.rows.slice(Math.max(first - this.first, 0), Math.max(end - this.first, 0));
    this.rows.filter((row) => !kept.includes(row)).forEach((row) => row.remove());
    this.first = Math.max(first, this.first);
    this.rows = kept;
  }

  private update(): void {
    const { list, height, count } = this;
    const [first, end] = rowsInSight(count, height, list.scrollTop, count > few ? list.clientHeight : 0);
    this.keep(first, end);
    if (this.rows.length === 0) {
      this.first = first;
    }
    while (this.first > first) {
      const row = this.numbered(--this.first);
      this.rows[0] ? this.rows[0].before(row) : list.append(row);
      this.rows.unshift(row);
    }
    const made = document.createDocumentFragment();
    while (this.first + this.rows.length < end) {
      const row = this.numbered(this.first + this.rows.length);
      made.append(row);
      this.rows.push(row);
    }
    this.below.isConnected ? this.below.before(made) : list.append(made);
    if (count > few) {
      this.above.style.height = `${first * height}px`;
      this.below.style.height = `${(count - end) * height}px`;
      this.above.isConnected || list.prepend(this.above);
      this.below.isConnected || list.append(this.below);
    } else {
      this.above.remove();
      this.below.remove();
    }
  }

  private numbered(index: number): HTMLElement {
    const row = this.make(index);
    row.setAttribute("aria-posinset", String(index + 1));
    row.setAttribute("aria-setsize", String(this.count));
    return row;
  }
}
