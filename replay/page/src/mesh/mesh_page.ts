/** Puts the page of a mesh together. */
import { dark, light, type Theme } from "../colours.ts";
import { get, paragraph } from "../elements.ts";
import { directionTo } from "../flight.ts";
import { wholes } from "../packed.ts";
import { Picture } from "../scene.ts";
import { cellsText, groupText } from "../text.ts";
import { type Data, Mesh } from "./data.ts";
import { loopDetails, placeDetails, surfaceDetails } from "./details.ts";
import { Layers, mostEdgesAtFirst, type Switches } from "./layers.ts";
import { Listing } from "./listing.ts";
import { LoopsPanel } from "./loops_panel.ts";
import { counted, meaningText, meetingsText, numberText, orientationText, vertexText, verdictText } from "./mesh_text.ts";
import { ballOf, boxOf, type Place, placeGroups } from "./places.ts";
import { PlacesPanel } from "./places_panel.ts";
import { remarksOf } from "./remarks.ts";

type Chosen = { kind: "loop" | "surface" | "place"; index: number } | null;

export class MeshPage {
  private readonly mesh: Mesh;
  private readonly picture: Picture | null;
  private readonly layers: Layers | null;
  private readonly loops: LoopsPanel;
  private readonly surfaces: Listing;
  private readonly places: PlacesPanel;
  private chosen: Chosen = null;

  constructor(private readonly data: Data) {
    this.mesh = new Mesh(data);
    const scheme = matchMedia("(prefers-color-scheme: dark)");
    const theme = () => (scheme.matches ? dark : light);
    this.prepareSwitches();
    this.picture = this.makePicture(theme());
    this.layers = this.picture && new Layers(this.picture, this.mesh, data, theme(), this.switches());
    scheme.addEventListener("change", () => {
      this.layers?.setTheme(theme());
      this.showChosen();
    });
    this.loops = new LoopsPanel(data, {
      onChoose: (index) => this.choose(index < 0 ? null : { kind: "loop", index }),
      onOpen: (index) => this.flyToLoop(index),
      onList: (listed) => this.showLoops(listed),
    });
    this.places = new PlacesPanel(get("places"), placeGroups(data, this.mesh), {
      onChoose: (index) => this.choose(index < 0 ? null : { kind: "place", index }, true),
      onOpen: (index) => this.flyToPlace(this.places.at(index)),
    });
    this.surfaces = new Listing(get("surfaces"), (index) => this.choose(index < 0 ? null : { kind: "surface", index }), (index) => this.flyToSurface(index));
    this.fillTexts();
    this.listen();
    new ResizeObserver(() => this.resize()).observe(get("picture"));
    this.resize();
  }

  private makePicture(theme: Theme): Picture | null {
    try {
      return new Picture(get("canvas"), theme, () => (get("edges-note").textContent = " (not while it moves)"));
    } catch {
      get<HTMLElement>("nopicture").hidden = false;
      return null; // all else works without
    }
  }

  private prepareSwitches(): void {
    const { data } = this;
    const hide = (id: string, isHidden: boolean) => (get<HTMLElement>(id).hidden = isHidden);
    const { places } = data;
    hide("boundary-label", data.boundary_loops === 0);
    hide("faults-label", [places.non_manifold_edges, places.non_manifold_vertices, places.reversed_edges].every(({ data }) => data === "") && data.meetings.length === 0);
    hide("loops-label", data.loops.length === 0);
    hide("colours-label", data.components_in_all < 2);
    get<HTMLInputElement>("show-edges").checked = this.mesh.sides.length / 2 <= mostEdgesAtFirst;
  }

  private switches(): Switches {
    const isOn = (id: string) => get<HTMLInputElement>(id).checked;
    const solid = get<HTMLInputElement>("solid").valueAsNumber / 100;
    return {
      faces: isOn("show-faces") && solid > 0,
      edges: isOn("show-edges"),
      boundary: isOn("show-boundary"),
      faults: isOn("show-faults"),
      colours: isOn("show-colours"),
      // What is chosen can be behind faces.
      opacity: this.chosen && this.chosen.kind !== "place" ? Math.min(solid, 0.4) : solid,
    };
  }

  private fillTexts(): void {
    const { data } = this;
    document.title = `${data.source} - sesame mesh`;
    get("title").textContent = data.source;
    const cells = cellsText([data.vertices, data.edges, data.faces]);
    get("facts").textContent = `${cells}; Euler characteristic ${data.euler}; homology over ${data.ring}, sesame ${data.version}`;
    get("canvas").setAttribute("aria-label", `The mesh in space: ${cells}.`);
    get("groups").replaceChildren(
      ...data.betti.map((betti, p) => {
        const item = paragraph("", `meaning h${p}`);
        const name = document.createElement("b");
        name.textContent = `H${p} = ${groupText(data.ring, betti, data.torsion[p] ?? [])}`;
        item.append(name, meaningText(data, p));
        return item;
      }),
    );
    const reversed = wholes(data.places.reversed_edges).length / 2;
    get("verdict").textContent = `${verdictText(data)} ${orientationText(data, reversed)} ${meetingsText(data)}`;
    get<HTMLElement>("surfaces-section").hidden = data.surfaces.length === 0;
    this.surfaces.fill(
      data.surfaces.map(({ triangles, area, volume }, k) => ({
        parts: [
          span("what", `surface ${k + 1}`),
          span("rest", `${counted(triangles, "triangle", "triangles")}, ${volume === null ? `area ${numberText(area)}` : `volume ${numberText(volume)}`}`),
        ],
      })),
    );
    for (const remark of remarksOf(data)) {
      const item = document.createElement("li");
      item.textContent = remark;
      get("remarks").append(item);
    }
    get<HTMLElement>("notes").hidden = get("remarks").childElementCount === 0;
  }

  private listen(): void {
    for (const id of ["show-faces", "show-edges", "show-boundary", "show-faults", "show-colours", "solid"]) {
      get(id).addEventListener("input", () => this.layers?.set(this.switches()));
    }
    get("show-loops").addEventListener("input", () => this.showLoops(this.loops.listed));
    get("fit").addEventListener("click", () => this.fit());
    document.addEventListener("keydown", (event) => {
      const isTyping = (event.target as Element).matches("input, textarea");
      if (!isTyping && !event.ctrlKey && !event.metaKey && !event.altKey && event.key === "f") {
        this.fit();
      }
    });
    const canvas = get<HTMLCanvasElement>("canvas");
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
    canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 5) {
        this.point(event.offsetX, event.offsetY);
      }
    });
  }

  /** Says what is there, and chooses a loop that goes through it. */
  private point(x: number, y: number): void {
    const loop = this.picture?.generatorAt(x, y) ?? -1;
    if (loop >= 0) {
      this.loops.mark(loop);
      this.choose({ kind: "loop", index: loop });
    }
    const cell = this.picture?.cellAt(x, y) ?? null;
    get("cell").textContent = cell === null ? "" : this.cellText(cell);
  }

  private cellText(cell: number): string {
    const { mesh } = this;
    const [index, kind] = [Math.floor(cell / 3), cell % 3];
    if (kind === 0) {
      return vertexText(index, mesh);
    }
    const [from, count] = kind === 1 ? [mesh.sides, 2] : [mesh.corners, 3];
    const points = [...from.slice(count * index, count * (index + 1))];
    const component = this.data.components_in_all > 1 ? `, component ${mesh.componentOf(points[0])}` : "";
    return `${kind === 1 ? "edge" : "triangle"} ${points.map((point) => mesh.inFile(point)).join("-")}${component}`;
  }

  private choose(chosen: Chosen, flies = false): void {
    this.chosen = chosen;
    if (chosen?.kind !== "loop") {
      this.loops.mark(-1);
    }
    if (chosen?.kind !== "surface") {
      this.surfaces.mark(-1);
    }
    if (chosen?.kind !== "place") {
      this.places.mark(-1);
    }
    this.showChosen();
    if (chosen?.kind === "place" && flies) {
      this.flyToPlace(this.places.at(chosen.index));
    }
  }

  private showChosen(): void {
    const { chosen, data, mesh } = this;
    const of = <T>(kind: string, from: (index: number) => T): T | null => (chosen?.kind === kind ? from(chosen.index) : null);
    const loop = of("loop", (index) => data.loops[index]);
    const surface = of("surface", (index) => data.surfaces[index]);
    const place = of("place", (index) => this.places.at(index));
    this.layers?.showLoop(loop);
    this.layers?.showSurface(surface);
    this.layers?.mark(place);
    this.layers?.set(this.switches());
    const index = chosen?.index ?? -1;
    get("chosen").replaceChildren(
      ...(loop ? loopDetails(loop, this.loops.numberOf(index), mesh, data.components, () => this.flyToLoop(index)) : []),
      ...(surface ? surfaceDetails(surface, index, () => this.flyToSurface(index)) : []),
      ...(place ? placeDetails(place, mesh, () => this.flyToPlace(place)) : []),
    );
  }

  private showLoops(listed: readonly number[]): void {
    const isOn = get<HTMLInputElement>("show-loops").checked;
    this.layers?.showLoops(this.data.loops, isOn ? listed : []);
  }

  private fit(): void {
    if (this.picture) {
      this.picture.moved = false;
      this.picture.fit();
    }
  }

  private flyToLoop(index: number): void {
    const loop = this.data.loops[index];
    const points = loop.edges.map((point) => this.mesh.at(point));
    const { middle, radius } = ballOf(boxOf(points));
    this.picture?.flyTo({ middle, radius: Math.max(1.6 * radius, 1e-6) }, this.picture.direction);
  }

  private flyToSurface(index: number): void {
    const { box } = this.data.surfaces[index];
    this.picture?.flyTo(ballOf(box.map((corner) => this.mesh.fromFile(corner)) as Place["box"]), this.picture.direction);
  }

  /** To where a place can be seen, with what is around it. */
  private flyToPlace(place: Place): void {
    if (!this.picture || !this.layers) {
      return;
    }
    const { middle, radius } = ballOf(place.box);
    const isLarge = radius > 0.3 * this.layers.ball.radius;
    const near = Math.max(isLarge ? 1.1 * radius : 3 * radius, place.kind === "component" ? 1e-6 : 0.06 * this.layers.ball.radius);
    const distance = this.picture.distanceFor(near);
    const eye = place.points[0] ?? place.segments[0];
    const direction = eye && !isLarge ? directionTo(eye, distance, this.picture.direction, this.mesh.points, this.mesh.corners) : this.picture.direction;
    this.picture.flyTo({ middle, radius: near }, direction);
  }

  private resize(): void {
    const box = get<HTMLElement>("picture");
    this.picture?.resize(box.clientWidth, box.clientHeight);
    if (this.picture && !this.picture.moved) {
      this.picture.fit();
    }
  }
}

function span(name: string, text: string): HTMLElement {
  const made = document.createElement("span");
  [made.className, made.textContent] = [name, text];
  return made;
}
