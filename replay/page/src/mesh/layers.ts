/** What the picture of a mesh is made of. */
import { BufferAttribute, type LineSegments, type Material, type Mesh as Part, type Object3D } from "three";
import { rgb } from "../buffers.ts";
import { palette, type Theme } from "../colours.ts";
import { wholes } from "../packed.ts";
import { ballsPart, dotsPart, ringsPart, setOpacity, sharedPoints, thinLinesPart, trianglesPart, tubesPart } from "../parts.ts";
import type { Ball, Picture } from "../scene.ts";
import type { Vec } from "../vectors.ts";
import { wideLines } from "../wide_lines.ts";
import { type Data, type Loop, type Mesh, type Side, type Surface } from "./data.ts";
import { dashed, dashOf } from "./loops.ts";
import { ballOf, boxOf, type Place } from "./places.ts";

/** More edges than this are not drawn until somebody asks for them: they would hide the faces. */
export const mostEdgesAtFirst = 60_000;
/** More segments of loops than this are thin lines. */
const mostWideSegments = 20_000;

const sideColours = { light: { handle: 0xc24e00, tunnel: 0x00805d, none: 0x6a3fb0 }, dark: { handle: 0xff8c42, tunnel: 0x2fc79b, none: 0xb696f0 } };
const boundaryColour = 0xe69f00;
const faultColour = 0xcc79a7;

/** Those that mesh.css has for the list, too. */
export function colourOfSide(side: Side, isDark: boolean): number {
  return sideColours[isDark ? "dark" : "light"][side ?? "none"];
}

/** Paler, so that lines of any colour can be seen on it. */
export function paler(colour: readonly [number, number, number], isDark: boolean): [number, number, number] {
  return colour.map((part) => (isDark ? 0.5 * part + 0.02 : 0.45 * part + 0.55)) as [number, number, number];
}

/** What is switched on. */
export interface Switches {
  faces: boolean;
  edges: boolean;
  boundary: boolean;
  faults: boolean;
  colours: boolean;
  opacity: number;
}

/** Cells under one number: what a click meets. */
export const cellOf = {
  vertex: (point: number) => 3 * point,
  edge: (side: number) => 3 * side + 1,
  triangle: (triangle: number) => 3 * triangle + 2,
};

export class Layers {
  readonly ball: Ball;
  private readonly points: BufferAttribute;
  private readonly all: { points: Uint32Array; sides: Uint32Array; triangles: Uint32Array };
  private faces: Part | null = null;
  private switches: Switches;

  constructor(private readonly picture: Picture, private readonly mesh: Mesh, private readonly data: Data, private theme: Theme, switches: Switches) {
    this.switches = switches;
    this.points = sharedPoints(mesh.points);
    const box = data.components.length === data.components_in_all ? data.components.map(({ box }) => box).flat() : [];
    this.ball = box.length > 0 ? ballOf(boxOf(box.map((corner) => mesh.fromFile(corner)))) : { middle: [0, 0, 0], radius: Math.sqrt(3) };
    this.ball.radius = Math.max(this.ball.radius, 1e-3);
    this.all = {
      points: Uint32Array.from({ length: mesh.points.length / 3 }, (_, k) => cellOf.vertex(k)),
      sides: Uint32Array.from({ length: mesh.sides.length / 2 }, (_, k) => cellOf.edge(k)),
      triangles: Uint32Array.from({ length: mesh.corners.length / 3 }, (_, k) => cellOf.triangle(k)),
    };
    picture.setBall(this.ball);
    this.draw();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.picture.setTheme(theme);
    this.draw();
  }

  set(switches: Switches): void {
    const before = this.switches;
    this.switches = switches;
    if (before.faces !== switches.faces || before.colours !== switches.colours) {
      this.drawFaces();
    } else if (this.faces && before.opacity !== switches.opacity) {
      setOpacity(this.faces, switches.opacity);
      this.picture.request();
    }
    if (before.edges !== switches.edges) {
      this.drawEdges();
    }
    if (before.boundary !== switches.boundary || before.faults !== switches.faults) {
      this.drawFaults();
    }
  }

  private draw(): void {
    this.drawFaces();
    this.drawEdges();
    this.drawFaults();
  }

  private drawFaces(): void {
    const { faces, colours, opacity } = this.switches;
    this.faces = null;
    const isThere = faces && this.mesh.corners.length > 0;
    if (isThere) {
      const colour = colours && this.data.components_in_all > 1 ? this.colours() : this.theme.face;
      this.faces = trianglesPart(this.points, this.mesh.corners, colour);
      setOpacity(this.faces, opacity);
    }
    this.picture.put("faces", this.faces ? [this.faces] : [], 0);
    const { points, sides, triangles } = this.all;
    const hiding = isThere ? { triangles: this.mesh.points, corners: this.mesh.corners, triangleCells: triangles } : {};
    this.picture.setTargets({ points: this.mesh.points, pointCells: points, segments: this.mesh.points, ends: this.mesh.sides, segmentCells: sides, ...hiding });
  }

  /** Of each point that of its component. */
  private colours(): BufferAttribute {
    const known = palette.map((colour) => paler(rgb(colour), this.theme.dark));
    const colours = new Float32Array(this.mesh.points.length);
    for (let k = 0; 3 * k < colours.length; ++k) {
      colours.set(known[this.mesh.componentOf(k) % known.length], 3 * k);
    }
    return new BufferAttribute(colours, 3);
  }

  private drawEdges(): void {
    const { sides, points } = this.mesh;
    const parts: Object3D[] = [];
    if (this.switches.edges && sides.length > 0) {
      // Paler the more there are, or many of them are nothing but dark.
      const opacity = Math.min(0.75, Math.max(0.18, 40 / Math.sqrt(sides.length / 2)));
      parts.push(thinLinesPart(this.points, sides, this.theme.edge, opacity));
    }
    if (this.mesh.corners.length === 0 && points.length > 0) {
      parts.push(dotsPart(points, this.theme.vertex, points.length > 3000 ? 2 : 5));
    }
    this.picture.put("edges", parts, 1, sides.length > 0);
  }

  private drawFaults(): void {
    const { places, meetings } = this.data;
    const lines = (ends: Uint32Array, colour: number, width: number) => (ends.length > 0 ? [this.lines(ends, colour, width)] : []);
    const parts: Object3D[] = [];
    if (this.switches.boundary) {
      parts.push(...lines(wholes(places.boundary), boundaryColour, 2.5));
    }
    if (this.switches.faults) {
      parts.push(...lines(wholes(places.non_manifold_edges), faultColour, 4), ...lines(wholes(places.reversed_edges), faultColour, 3));
      const points = [...wholes(places.non_manifold_vertices)].flatMap((point) => [...this.mesh.at(point)]);
      points.push(...meetings.flatMap(({ place }) => [...place]));
      parts.push(...(points.length > 0 ? [dotsPart(Float32Array.from(points), faultColour, 9)] : []));
    }
    this.picture.put("faults", parts, 2);
  }

  private lines(ends: Uint32Array, colour: number, width: number): Object3D {
    if (ends.length / 2 > mostWideSegments) {
      return thinLinesPart(this.points, ends, colour);
    }
    const positions = new Float32Array(3 * ends.length);
    ends.forEach((point, k) => positions.set(this.mesh.at(point), 3 * k));
    return wideLines(positions, colour, width);
  }

  segmentsOf(loop: Loop): (readonly [Vec, Vec])[] {
    return Array.from({ length: loop.edges.length / 2 }, (_, k) => [this.mesh.at(loop.edges[2 * k]), this.mesh.at(loop.edges[2 * k + 1])] as const);
  }

  /** A loop cut into dashes, as its side has them: at most so long, at least a dozen in the loop. */
  private dashesOf(loop: Loop, unit: number): (readonly [Vec, Vec])[] {
    const segments = this.segmentsOf(loop);
    const dash = dashOf(loop.side);
    const size = segments.reduce((sum, [from, to]) => sum + Math.hypot(...to.map((x, axis) => x - from[axis])), 0);
    const scale = Math.min(unit, size / 40);
    return dash && scale > 0 ? dashed(segments, dash[0] * scale, dash[1] * scale) : segments;
  }

  /** Draws those loops of the list, and lets them be clicked. */
  showLoops(loops: readonly Loop[], shown: readonly number[]): void {
    const ofColour = new Map<number, number[]>();
    const segments: number[] = [];
    const cells: number[] = [];
    for (const k of shown) {
      const colour = colourOfSide(loops[k].side, this.theme.dark);
      const list = ofColour.get(colour) ?? [];
      ofColour.set(colour, list);
      this.dashesOf(loops[k], 0.012 * this.ball.radius).forEach(([from, to]) => list.push(...from, ...to));
      for (const [from, to] of this.segmentsOf(loops[k])) {
        segments.push(...from, ...to);
        cells.push(k);
      }
    }
    const isMany = segments.length / 6 > mostWideSegments;
    const lines = [...ofColour].filter(([, list]) => list.length > 0);
    this.picture.put("loops", lines.map(([colour, list]) => wideLines(list, colour, isMany ? 1 : 3)), 4);
    // With a rim, as a line may be on a face of its colour.
    this.picture.put("rims", isMany ? [] : lines.map(([, list]) => underneath(wideLines(list, this.theme.background, 5.5))), 3);
    this.picture.setChains({ segments: Float32Array.from(segments), segmentCells: cells });
  }

  showLoop(loop: Loop | null): void {
    this.picture.put("bounded", loop?.bounds ? this.patch(loop.bounds, 0x56b4e9) : [], 5);
    if (!loop) {
      this.picture.put("loop", [], 6);
      return;
    }
    const segments = this.segmentsOf(loop);
    const colour = colourOfSide(loop.side, this.theme.dark);
    const ball = ballOf(boxOf(segments.flat()));
    const radius = Math.min(0.011 * this.ball.radius, 0.09 * ball.radius);
    const cut = this.dashesOf(loop, 5 * radius);
    const parts: Object3D[] = [tubesPart(cut, radius, colour)];
    if (!dashOf(loop.side)) {
      parts.push(ballsPart(segments.map(([from]) => from), radius, colour));
    }
    if (ball.radius < 0.03 * this.ball.radius) {
      parts.push(ringsPart(Float32Array.from(ball.middle), this.theme.highlight, 34));
    }
    this.picture.put("loop", parts, 6);
  }

  showSurface(surface: Surface | null): void {
    this.picture.put("surface", surface ? this.patch(surface.runs, 0xcc79a7) : [], 5);
  }

  private patch(runs: readonly number[], colour: number): Part[] {
    const part = trianglesPart(this.points, this.mesh.cornersOf(runs), colour, false);
    setOpacity(part, 0.55);
    return [part];
  }

  /** A place that somebody looks for, in front of everything. */
  mark(place: Place | null): void {
    const parts: Object3D[] = [];
    if (place && place.kind !== "component") {
      const { middle, radius } = ballOf(place.box);
      if (place.segments.length > 0) {
        parts.push(onTop(wideLines(place.segments.flatMap((point) => [...point]), this.theme.highlight, 6)));
      }
      if (place.points.length > 0) {
        parts.push(onTop(dotsPart(Float32Array.from(place.points.flatMap((point) => [...point])), this.theme.highlight, 10)));
      }
      if (radius < 0.05 * this.ball.radius) {
        parts.push(ringsPart(Float32Array.from(middle), this.theme.highlight, 44));
      }
    }
    this.picture.put("mark", parts, 7);
  }
}

/** What is drawn later at the same place is in front of it. */
function underneath(part: Part): Part {
  (part.material as Material).depthWrite = false;
  return part;
}

function onTop<T extends Part | LineSegments | Object3D>(part: T): T {
  const material = (part as unknown as { material: Material }).material;
  material.depthTest = false;
  material.transparent = true; // or it is drawn before what is seen through
  return part;
}
