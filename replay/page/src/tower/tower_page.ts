/** Puts the page of a tower together. */
import { dark, light } from "../colours.ts";
import { get } from "../elements.ts";
import { BarTable } from "./bar_table.ts";
import { BarcodePlot } from "./barcode_plot.ts";
import { BettiPlot } from "./betti_plot.ts";
import { ClassPanel } from "./class_panel.ts";
import type { Data } from "./data.ts";
import { DiagramPlot } from "./diagram_plot.ts";
import type { Filter } from "./filter.ts";
import { FilterPanel } from "./filter_panel.ts";
import { darkInks, lightInks } from "./inks.ts";
import { Model } from "./model.ts";
import { type PlotEvents, PlotView } from "./plot_view.ts";
import { SpacePanel } from "./space_panel.ts";

/** As long as a picture may take that follows the mouse, in ms. */
const fluid = 20;

/** What is to be done before the next frame. */
interface Due {
  filter: Filter | null;
  draw: boolean;
  mark: boolean;
  table: boolean;
}

export class TowerPage {
  private readonly model: Model;
  private readonly views: PlotView[];
  private readonly filters: FilterPanel;
  private readonly table: BarTable;
  private readonly details: ClassPanel;
  private readonly space: SpacePanel | null;
  private readonly scheme = matchMedia("(prefers-color-scheme: dark)");
  private due: Due | null = null;
  /** For which everything is drawn. */
  private width = 0;
  private resting: ReturnType<typeof setTimeout> | undefined;
  /** How long it took to draw with a filter the last time, in ms. */
  private cost = 0;

  constructor(private readonly data: Data) {
    this.model = new Model(data);
    this.fillHead();
    const events: PlotEvents = {
      choose: (bar) => this.choose(bar),
      move: (by) => this.move(by),
      point: (bar, time) => this.point(bar, time),
      brush: (some, isDone) => this.brush(some, isDone),
    };
    const plots = [
      ["barcode", "Barcode", new BarcodePlot()],
      ["diagram", "Persistence diagram", new DiagramPlot()],
      ["betti", "Betti curves", new BettiPlot()],
    ] as const;
    this.views = plots.map(([id, name, plot]) => new PlotView(get(id), name, plot, this.model, events));
    this.filters = new FilterPanel(get("dims"), get("fields"), get("kept"), this.model, (filter) => this.setFilter(filter, true), (fits) => this.fit(fits));
    this.details = new ClassPanel(get("details"), this.model);
    this.table = new BarTable(get("bars"), get("listed"), get("list-back"), get("list-forward"), this.model, (bar) => this.choose(bar), (bar) => this.point(bar, null));
    this.space = data.complex ? new SpacePanel(this.model, data.complex, this.scheme.matches ? dark : light, () => this.request({ mark: true })) : null;
    this.scheme.addEventListener("change", () => {
      this.space?.setTheme(this.scheme.matches);
      this.request({ draw: true });
    });
    new ResizeObserver(() => this.width !== get("plots").clientWidth && this.request({ draw: true })).observe(get("plots"));
    this.filters.update();
    this.details.update();
    this.table.reset();
    const start = performance.now();
    this.draw();
    this.cost = performance.now() - start;
  }

  private fillHead(): void {
    const { title, facts, notes } = this.data;
    document.title = `${title} - sesame tower`;
    get("title").textContent = title;
    get("facts").textContent = facts.join(" \u00b7 ");
    for (const note of notes) {
      const item = document.createElement("li");
      item.textContent = note;
      get("remarks").append(item);
    }
    get<HTMLElement>("notes").hidden = notes.length === 0;
  }

  private get inks() {
    return this.scheme.matches ? darkInks : lightInks;
  }

  private setFilter(filter: Filter, isDone: boolean): void {
    this.model.brush = null;
    this.request({ filter, draw: true, table: isDone });
  }

  /** While somebody drags all follows at once, or, where that would not be fluid, when the mouse rests. */
  private brush(some: Partial<Filter>, isDone: boolean): void {
    clearTimeout(this.resting);
    const set = () => this.setFilter({ ...this.model.filter, ...some }, isDone);
    if (isDone || this.cost < fluid) {
      set();
    } else {
      this.model.brush = some;
      this.request({ mark: true });
      this.resting = setTimeout(set, 200);
    }
  }

  private fit(fits: boolean): void {
    this.model.fits = fits;
    this.request({ draw: true, table: true });
  }

  private choose(bar: number): void {
    if (bar !== this.model.chosen) {
      this.model.chosen = bar;
      this.details.update();
      this.table.update();
      this.space?.choose();
      get("said").textContent = bar >= 0 ? `chosen: ${this.model.text(bar)}` : "no bar chosen";
      this.request({ mark: true });
    }
  }

  /** Along the list; from nothing to its first bar. */
  private move(by: number): void {
    const { chosen, kept } = this.model;
    const place = by === -Infinity || chosen < 0 || !kept[chosen] ? 0 : Math.max(this.model.placeOf(chosen) + by, 0);
    const [bar] = this.model.longest(place, 1);
    if (bar !== undefined) {
      this.choose(bar);
    }
  }

  private point(bar: number, time: number | null): void {
    if (bar === this.model.hovered && time === this.model.time) {
      return;
    }
    this.model.hovered = bar;
    this.model.time = time;
    this.request({ mark: true });
  }

  private request(some: Partial<Due>): void {
    const isNew = this.due === null;
    this.due = { filter: null, draw: false, mark: false, table: false, ...this.due };
    this.due.filter = some.filter ?? this.due.filter;
    this.due.draw ||= some.draw ?? false;
    this.due.mark ||= some.mark ?? false;
    this.due.table ||= some.table ?? false;
    if (isNew) {
      requestAnimationFrame(() => this.carryOut());
    }
  }

  private carryOut(): void {
    const { filter, draw, table } = this.due!;
    this.due = null;
    const start = performance.now();
    if (filter) {
      this.model.setFilter(filter);
      this.filters.update();
    }
    if (table) {
      this.model.setRange();
      this.table.reset();
      this.details.update();
    }
    draw ? this.draw() : this.views.forEach((view) => view.mark(this.inks));
    if (filter) {
      this.cost = performance.now() - start;
    }
    this.sayPointed();
  }

  private draw(): void {
    this.width = get("plots").clientWidth;
    this.views.forEach((view) => view.draw(this.inks));
  }

  private sayPointed(): void {
    const { hovered, time } = this.model;
    const parts = hovered >= 0 ? [this.model.text(hovered)] : [];
    if (time !== null) {
      const betti = this.model.allCurves.at(time).map((value, dim) => `b${dim} = ${value}`);
      parts.push(`at ${this.data.time_name} ${this.model.times.near(time)}: ${betti.join(", ")}`);
    }
    get("pointed").textContent = parts.join("; ");
  }
}
