/** The dimensions, and number fields that say which bars are looked at. */
import { button } from "../elements.ts";
import { everything, type Filter, type Interval, noFilter } from "./filter.ts";
import { dimensionMark } from "./marks.ts";
import type { Model } from "./model.ts";
import { shortNumber, withSeparators } from "./numbers.ts";

type Ranged = "length" | "birth" | "death" | "alive";

const ranges: [Ranged, string][] = [
  ["length", "length"],
  ["birth", "born"],
  ["death", "ends"],
  ["alive", "alive"],
];

export class FilterPanel {
  private readonly boxes = new Map<number, { box: HTMLInputElement; kept: HTMLTableCellElement }>();
  private readonly fields = new Map<Ranged, [HTMLInputElement, HTMLInputElement]>();
  private readonly open: HTMLInputElement;
  private readonly fits: HTMLInputElement;

  constructor(
    table: HTMLTableElement,
    fields: HTMLElement,
    private readonly summary: HTMLElement,
    private readonly model: Model,
    private readonly onFilter: (filter: Filter) => void,
    onFit: (fits: boolean) => void,
  ) {
    this.fillTable(table);
    for (const [what, name] of ranges) {
      fields.append(this.rangeRow(what, name));
    }
    this.open = checkbox("bars that never end", true);
    this.open.addEventListener("change", () => onFilter({ ...model.filter, open: this.open.checked }));
    this.fits = checkbox("axes for the kept bars only", false);
    this.fits.addEventListener("change", () => onFit(this.fits.checked));
    const all = button("all bars", () => onFilter(noFilter));
    all.id = "all-bars";
    fields.append(this.open.parentElement!, this.fits.parentElement!, all);
  }

  /** After the filter has changed. */
  update(): void {
    const { filter, bars, keptOf, times } = this.model;
    bars.parts.forEach(({ dim }, k) => {
      const { box, kept } = this.boxes.get(dim)!;
      box.checked = !filter.without.has(dim);
      kept.textContent = withSeparators(keptOf[k]);
    });
    for (const [what, pair] of this.fields) {
      const texts = filter[what].map((x, end) => (x === (end === 0 ? -Infinity : Infinity) ? "" : x === Infinity ? "inf" : what === "length" ? String(x) : times.text(x)));
      pair.forEach((field, end) => {
        if (document.activeElement !== field || this.valueOf(what, field.value, end) !== filter[what][end]) {
          field.value = texts[end];
        }
        field.removeAttribute("aria-invalid");
      });
    }
    this.open.checked = filter.open;
    this.summary.textContent = this.model.filterText();
  }

  private fillTable(table: HTMLTableElement): void {
    const { bars } = this.model;
    const head = table.createTHead().insertRow();
    for (const name of ["dimension", "bars", "never end", "longest that ends", "kept"]) {
      const cell = document.createElement("th");
      cell.scope = "col";
      cell.textContent = name;
      head.append(cell);
    }
    const body = table.createTBody();
    for (const part of bars.parts) {
      const row = body.insertRow();
      const label = document.createElement("label");
      const box = document.createElement("input");
      box.type = "checkbox";
      box.checked = true;
      box.addEventListener("change", () => {
        const without = new Set(this.model.filter.without);
        box.checked ? without.delete(part.dim) : without.add(part.dim);
        this.onFilter({ ...this.model.filter, without });
      });
      label.append(box, dimensionMark(part.dim), `H${part.dim}`);
      row.insertCell().append(label);
      const some = part.open > part.first;
      for (const text of [withSeparators(part.end - part.first), withSeparators(part.end - part.open), some ? shortNumber(bars.longestOf(part)) : "\u2013"]) {
        row.insertCell().textContent = text;
      }
      this.boxes.set(part.dim, { box, kept: row.insertCell() });
    }
  }

  private rangeRow(what: Ranged, name: string): HTMLElement {
    const row = document.createElement("div");
    row.className = "range";
    const label = document.createElement("span");
    label.textContent = name;
    const pair = [0, 1].map((end) => {
      const field = document.createElement("input");
      field.type = "text";
      field.inputMode = "decimal";
      field.id = `${what}-${end === 0 ? "from" : "to"}`;
      field.setAttribute("aria-label", `${name}, ${end === 0 ? "from" : "to"}`);
      field.placeholder = end === 0 ? "from" : "to";
      field.addEventListener("change", () => this.take(what, end, field));
      return field;
    }) as [HTMLInputElement, HTMLInputElement];
    row.append(label, ...pair);
    this.fields.set(what, pair);
    return row;
  }

  private valueOf(what: Ranged, text: string, end: number): number | null {
    if (text.trim() === "") {
      return everything[end];
    }
    return what === "length" ? (/^[+]?(inf|infinity)$/i.test(text.trim()) ? Infinity : Number.isNaN(Number(text)) ? null : Number(text)) : this.model.times.read(text);
  }

  private take(what: Ranged, end: number, field: HTMLInputElement): void {
    const value = this.valueOf(what, field.value, end);
    if (value === null) {
      field.setAttribute("aria-invalid", "true");
      this.summary.textContent = `"${field.value}" is no number: the field "${field.getAttribute("aria-label")}" takes one, or nothing`;
      return;
    }
    const interval = [...this.model.filter[what]] as [number, number];
    interval[end] = value;
    this.onFilter({ ...this.model.filter, [what]: interval as Interval });
  }
}

/** In a label of its own. */
function checkbox(text: string, isChecked: boolean): HTMLInputElement {
  const label = document.createElement("label");
  const box = document.createElement("input");
  box.type = "checkbox";
  box.checked = isChecked;
  label.className = "check";
  label.append(box, text);
  return box;
}
