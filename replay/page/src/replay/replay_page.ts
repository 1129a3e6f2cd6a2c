/** Puts the page of a replay together. */
import { rgb } from "../buffers.ts";
import { carried } from "./carry.ts";
import { ChainPanel, type Chosen } from "./chain_panel.ts";
import { overlayOf } from "./chains.ts";
import { ClassEnds } from "./class_ends.ts";
import { colourOfGenerator, dark, light, palette, type Theme } from "../colours.ts";
import { addNews, type Chain, type Data, type News, type Numbers, numbersOf, stepOf, stopsOf } from "./data.ts";
import { componentsOf, drawnOf, placesOf } from "./geometry.ts";
import { LivePanel } from "./live_panel.ts";
import { ObjectState } from "./object.ts";
import { Player } from "./player.ts";
import type { Drawn } from "../drawn.ts";
import { get } from "../elements.ts";
import { partsOfLargeObjects } from "../parts.ts";
import { type Overlay, Picture } from "../scene.ts";
import { cellsText, groupText } from "../text.ts";
import { StepsPanel } from "./steps_panel.ts";
import { groupsText, remarksOf, typeText } from "./replay_text.ts";
import { Timeline } from "./timeline.ts";

/** With more cells than this it takes a while until there is something to draw. */
const manyCells = 10_000;

export class ReplayPage {
  private numbers: Numbers[];
  private readonly object: ObjectState;
  private readonly places;
  private readonly player: Player;
  private readonly picture: Picture | null;
  private readonly timeline: Timeline;
  private readonly steps: StepsPanel;
  private readonly chains: ChainPanel;
  private readonly ends: ClassEnds;
  private theme: Theme;
  /** Of the picture. */
  private size = "";
  private chosen: number[] = [];
  private live: LivePanel | null = null;
  private isSlow = false;
  private drawn: Drawn = { vertices: [], edges: [], faces: [], size: 1, missing: 0 };

  constructor(private readonly data: Data) {
    const scheme = matchMedia("(prefers-color-scheme: dark)");
    this.theme = scheme.matches ? dark : light;
    this.picture = this.makePicture();
    if (data.cells.type.length > manyCells) {
      this.picture?.prepare(partsOfLargeObjects());
    }
    const stops = stopsOf(data.steps.length, data.stride);
    this.numbers = numbersOf(data.steps, stops);
    this.object = new ObjectState(data);
    this.object.goTo(data.steps.length);
    this.places = placesOf(data.places.cells, data.places.points);
    this.player = new Player(stops, () => this.update());
    scheme.addEventListener("change", () => {
      this.theme = scheme.matches ? dark : light;
      this.picture?.setTheme(this.theme);
      this.update();
    });
    this.timeline = new Timeline(get("timeline"), this.numbers, (step) => this.player.toStep(step));
    this.steps = new StepsPanel(get("steps"), get("search"), get("found"), data, stops, (step) => this.player.toStep(step));
    this.ends = new ClassEnds(data.steps);
    this.chains = new ChainPanel(
      get("generators"),
      get("details"),
      data,
      (cell) => this.object.name(cell),
      (numbers) => this.choose(numbers),
      (step) => this.player.toStep(step),
    );
    this.fillHead();
    this.setRange();
    this.listen();
    new ResizeObserver(() => this.resize()).observe(get("picture"));
    this.resize();
    this.update();
    if (data.live) {
      this.live = new LivePanel(data.live, (news) => this.grow(news));
    }
  }

  /** What is new in a replay that goes on. The page follows it when it is at the end. */
  private grow(news: News): void {
    const isFollowing = this.player.isAtEnd;
    addNews(this.data, news);
    placesOf(news.places.cells, news.places.points).forEach((at, cell) => this.places.set(cell, at));
    this.object.grow();
    this.ends.grow();
    const steps = this.player.steps;
    const stops = stopsOf(this.data.steps.length, this.data.stride);
    this.numbers = numbersOf(this.data.steps, stops);
    this.timeline.setNumbers(this.numbers);
    this.player.setStops(stops);
    this.steps.setStops(stops);
    this.fillHead();
    this.setRange();
    this.drawTimeline();
    if (isFollowing || this.player.steps !== steps) {
      this.update();
    } else {
      this.updateTexts(steps);
    }
  }

  /** The numbers where the page is. */
  private get now(): Numbers {
    return this.numbers[this.player.position];
  }

  private setRange(): void {
    get<HTMLInputElement>("slider").max = String(this.numbers.length - 1);
  }

  private makePicture(): Picture | null {
    try {
      return new Picture(get("canvas"), this.theme, () => {
        this.isSlow = true;
        this.updateTexts(this.player.steps);
      });
    } catch (error) {
      get<HTMLElement>("nopicture").hidden = false;
      return null; // all else works without
    }
  }

  private fillHead(): void {
    const { title, source, ring, version } = this.data;
    document.title = title ? `${title} - sesame` : "sesame replay";
    get("title").textContent = title || source;
    get("facts").textContent = `${source}, ${this.data.steps.length} steps, homology over ${ring}, sesame ${version}`;
    const last = this.numbers[this.numbers.length - 1];
    const remarks = remarksOf(this.data, this.object);
    remarks.push(this.chains.remark(last.generators, last.betti.map((betti, p) => betti + (last.torsion[p]?.length ?? 0))));
    get("remarks").replaceChildren();
    for (const remark of remarks.filter(Boolean)) {
      const item = document.createElement("li");
      item.textContent = remark;
      get("remarks").append(item);
    }
    get<HTMLElement>("notes").hidden = get("remarks").childElementCount === 0;
  }

  private listen(): void {
    const slider = get<HTMLInputElement>("slider");
    slider.addEventListener("input", () => this.player.toPosition(slider.valueAsNumber));
    const press = (id: string, act: () => void) => get(id).addEventListener("click", act);
    const toggle = () => (this.player.isPlaying ? this.pause() : this.play());
    press("play", toggle);
    press("back", () => this.player.move(-1));
    press("forward", () => this.player.move(1));
    press("first", () => this.player.toPosition(0));
    press("last", () => this.player.toPosition(Infinity));
    press("fit", () => this.fit());
    get("solid").addEventListener("input", () => this.show());
    const keys: Record<string, () => void> = {
      ArrowLeft: () => this.player.move(-1),
      ArrowRight: () => this.player.move(1),
      Home: () => this.player.toPosition(0),
      End: () => this.player.toPosition(Infinity),
      " ": toggle,
      f: () => this.fit(),
      "/": () => get<HTMLInputElement>("search").focus(),
    };
    document.addEventListener("keydown", (event) => {
      const isTyping = (event.target as Element).matches("input, textarea");
      const isPressing = event.key === " " && (event.target as Element).matches("button, summary");
      if (!isTyping && !isPressing && !event.ctrlKey && !event.metaKey && !event.altKey && keys[event.key]) {
        event.preventDefault();
        keys[event.key]();
      }
    });
    this.listenToPointer(get("canvas"));
  }

  private listenToPointer(canvas: HTMLCanvasElement): void {
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 5) {
        this.point(event.offsetX, event.offsetY, event.shiftKey);
      }
    });
  }

  /** Says what a cell is, and chooses a generator that goes through it; or writes the name of the cell into a step. */
  private point(x: number, y: number, isForStep: boolean): void {
    const generator = this.picture?.generatorAt(x, y) ?? -1;
    const cell = this.picture?.cellAt(x, y) ?? null;
    if (generator >= 0 && !isForStep) {
      this.choose([generator]);
    }
    if (cell === null) {
      get("cell").textContent = "";
      return;
    }
    const { types, type } = this.data.cells;
    get("cell").textContent = `${typeText(types[type[cell]])} ${this.object.name(cell)}`;
    if (isForStep) {
      this.live?.insertName(this.object.name(cell));
    }
  }

  private fit(): void {
    if (this.picture) {
      this.picture.moved = false;
      this.picture.fit();
    }
  }

  private play(): void {
    this.player.play(Math.min(900, Math.max(60, 12000 / this.numbers.length)));
    this.update();
  }

  private pause(): void {
    this.player.pause();
    this.update();
  }

  private choose(numbers: number[]): void {
    this.player.pause();
    this.chosen = numbers;
    this.update();
  }

  private update(): void {
    const steps = this.player.steps;
    const there = this.now.generators ?? [];
    this.chosen = this.chosen.filter((number) => there.includes(number));
    this.object.goTo(steps);
    this.drawn = drawnOf(this.object, this.places);
    this.updateTexts(steps);
    this.updateChains(steps);
    this.show();
  }

  private updateTexts(steps: number): void {
    const numbers = this.now;
    const step = steps > 0 ? stepOf(this.data.steps[steps - 1]) : null;
    const slider = get<HTMLInputElement>("slider");
    slider.value = String(this.player.position);
    slider.setAttribute("aria-valuetext", `after step ${steps}: ${groupsText(this.data.ring, numbers)}`);
    get("now").textContent = `${steps} of ${this.data.steps.length}`;
    get("operation").textContent = step ? step.text : "before the first step";
    get("groups").replaceChildren(
      ...numbers.betti.map((betti, p) => {
        const item = document.createElement("span");
        item.className = `group h${p % 8}`;
        item.textContent = `H${p} = ${groupText(this.data.ring, betti, numbers.torsion[p] ?? [])}`;
        return item;
      }),
    );
    const missing = this.drawn.missing > 0 ? ` ${this.drawn.missing} of the cells cannot be drawn.` : "";
    const unshown = missing + (this.isSlow ? " Edges are not drawn while the object turns, as there are many." : "");
    get("cells").textContent = `${cellsText(numbers.cells)}; Euler characteristic ${numbers.euler}`;
    get("unshown").textContent = unshown;
    get("canvas").setAttribute("aria-label", `The object after step ${steps}: ${cellsText(numbers.cells)}.${unshown}`);
    get("play").textContent = this.player.isPlaying ? "pause" : "play";
    get<HTMLButtonElement>("back").disabled = steps === 0;
    get<HTMLButtonElement>("forward").disabled = steps === this.data.steps.length;
    get("cell").textContent = "";
    this.timeline.setStep(steps);
    this.steps.setStep(steps);
  }

  private updateChains(steps: number): void {
    const answer = steps > 0 ? stepOf(this.data.steps[steps - 1]).answer : undefined;
    this.chains.fill(this.now.generators);
    if (this.chosen.length === 0 && answer) {
      this.chains.showAnswer(answer);
    } else {
      this.chains.choose(this.chosen, this.chosen.length === 1 ? this.explained(this.chosen[0]) : null);
    }
  }

  private explained(number: number): Chosen {
    const generator = this.data.classes[number];
    const { chain, bounds, since } = generator;
    return {
      generator,
      chain: carried(this.object, chain),
      bounds: bounds && carried(this.object, bounds),
      since,
      end: this.ends.after(this.player.steps, number),
    };
  }

  /** The chains that are laid over the object. */
  private overlays(): Overlay[] {
    const lay = (chain: Chain | undefined, colour: number, generator = -1) =>
      chain ? [overlayOf(this.object, this.drawn, chain, colour, generator)] : [];
    if (this.chosen.length > 0) {
      const all = this.chosen.map((number) => [number, this.data.classes[number]] as const);
      const bounds = this.chosen.length === 1 ? all[0][1].bounds : undefined;
      return [...all.flatMap(([number, { chain }]) => lay(carried(this.object, chain), colourOfGenerator(number), number)), ...lay(bounds && carried(this.object, bounds), 0x56b4e9)];
    }
    const steps = this.player.steps;
    const answer = steps > 0 ? stepOf(this.data.steps[steps - 1]).answer : undefined;
    return answer ? [...lay(answer.asked, 0xd55e00), ...lay(answer.bounds, 0x56b4e9)] : [];
  }

  private show(): void {
    const components = componentsOf(this.object);
    const count = new Set(components.values()).size;
    const colours = palette.map(rgb);
    const plain = rgb(this.theme.face);
    const overlays = this.overlays();
    const solid = get<HTMLInputElement>("solid").valueAsNumber / 100;
    this.picture?.show({
      drawn: this.drawn,
      colourOf: (cell) => (count > 1 ? colours[components.get(cell)! % colours.length] : plain),
      highlighted: overlays.length > 0 ? new Set() : this.object.touchedBy(this.player.before, this.player.steps),
      opacity: overlays.length > 0 ? Math.min(solid, 0.35) : solid,
      overlays,
    });
  }

  private resize(): void {
    const box = get<HTMLElement>("picture");
    const size = `${box.clientWidth} x ${box.clientHeight}`;
    if (size === this.size) {
      return; // as the observer says first of all
    }
    this.size = size;
    this.picture?.resize(box.clientWidth, box.clientHeight);
    this.fit();
    this.drawTimeline();
  }

  private drawTimeline(): void {
    const svg = get<SVGSVGElement>("timeline");
    this.timeline.draw(svg.clientWidth || 600, svg.clientHeight || 130);
    this.timeline.setStep(this.player.steps);
  }
}
