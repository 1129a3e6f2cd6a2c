/** The picture in space. It knows no history: it is given what is to be drawn, layer by layer. */
import {
  AmbientLight,
  Color,
  DirectionalLight,
  Matrix4,
  type Mesh,
  type Object3D,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { ballAround, type ColourOf, type FaceBuffers, faceBuffers, flatPoints, lineBuffers, rgb, segmentsOf } from "./buffers.ts";
import type { Theme } from "./colours.ts";
import { Drawing } from "./drawing.ts";
import type { Drawn } from "./drawn.ts";
import { turnedTowards } from "./flight.ts";
import { isDrawnByProcessor, Motion } from "./motion.ts";
import { ballsPart, colouredLinesPart, dotsPart, facesPart, forget, tubesPart } from "./parts.ts";
import { type Lens, pointAt, projected, segmentAt, triangleAt } from "./picking.ts";
import { add, scale, sub, type Vec } from "./vectors.ts";
import { wideLines } from "./wide_lines.ts";

/** A chain as it is laid over the object. */
export interface Overlay {
  /** The number of the generator, to be known when it is clicked; or -1. */
  generator: number;
  colour: number;
  points: Vec[];
  paths: Vec[][];
  faces: Drawn["faces"];
}

export interface View {
  drawn: Drawn;
  colourOf: ColourOf;
  highlighted: ReadonlySet<number>;
  /** Between 0 and 1. */
  opacity: number;
  overlays: Overlay[];
}

/** What can be pointed at, and the number of each: points, segments and triangles of a kind each. */
export interface Targets {
  points: ArrayLike<number>;
  pointCells: ArrayLike<number>;
  /** Two points each; `ends` are their numbers, if `segments` has them once. */
  segments: ArrayLike<number>;
  ends: ArrayLike<number> | null;
  segmentCells: ArrayLike<number>;
  triangles: ArrayLike<number>;
  corners: ArrayLike<number> | null;
  triangleCells: ArrayLike<number>;
}

export interface Ball {
  middle: Vec;
  radius: number;
}

const noTargets: Targets = { points: [], pointCells: [], segments: [], ends: null, segmentCells: [], triangles: [], corners: null, triangleCells: [] };
/** In pixels: how near a click must be to an edge, a vertex or a chain. */
const reaches = { segment: 5, point: 8, chain: 9 };
/** More edges than this are lines of one pixel: wide ones are drawn as faces, which takes many times as long. */
const mostWideEdges = 3000;

/** More points than this of a fine layer are not in the first picture, where the processor draws. */
const mostAtFirst = 20_000;

function targetsOf({ vertices, edges }: Drawn, { positions: triangles, cells: triangleCells }: FaceBuffers): Targets {
  const { positions: segments, cells: segmentCells } = lineBuffers(edges, () => [0, 0, 0]);
  return { ...noTargets, points: flatPoints(vertices.map(({ at }) => at)), pointCells: vertices.map(({ cell }) => cell), segments, segmentCells, triangles, triangleCells };
}

export class Picture {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(40, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly layers = new Map<string, Object3D[]>();
  /** Layers that are left out while the camera moves, where they make that slow; and how many points they have. */
  private readonly fine = new Map<string, number>();
  private readonly isPlain = isDrawnByProcessor();
  private readonly motion: Motion;
  private targets: () => Targets = () => noTargets;
  /** The first picture is there, with all that belongs to it. */
  private isComplete = false;
  private chains: Targets = noTargets;
  private ball: Ball = { middle: [0, 0, 0], radius: 1 };
  private isDue = false;
  /** Shaders are there as long as something is that has them. */
  private readonly prepared: Object3D[] = [];
  private hasMoved = false;
  private flight = 0;
  private readonly drawing: Drawing;
  /** Whether the camera was moved by hand. */
  moved = false;

  /** `onSlow` is called once, when it turns out that fine layers have to be left out while the camera moves. */
  constructor(private readonly canvas: HTMLCanvasElement, private theme: Theme, onSlow: () => void = () => {}) {
    // Nothing shines through, so browsers need not draw what is behind; three.js by itself would ask for a canvas that lets it.
    const context = canvas.getContext("webgl2", { alpha: false, antialias: !this.isPlain, preserveDrawingBuffer: true });
    if (!context) {
      throw new Error("no WebGL");
    }
    this.renderer = new WebGLRenderer({ canvas, context });
    const settle = () => {
      this.isComplete = true;
      this.request();
    };
    this.motion = new Motion(settle, () => this.fine.size > 0 && onSlow());
    this.drawing = new Drawing(context, () => this.motion.stir());
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => {
      this.hasMoved = true;
      this.request();
    });
    this.controls.addEventListener("start", () => {
      this.moved = true;
      ++this.flight; // whatever flies stops
    });
    const sun = new DirectionalLight(0xffffff, 1.8);
    sun.position.set(1, 2, 3);
    this.camera.add(sun);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 1.5));
    this.camera.position.set(1.1, 0.9, 2.2);
    this.setTheme(theme);
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.scene.background = new Color(theme.background);
    this.request();
  }

  /** Has the shaders of such parts made, which takes a while, beside all that is done until they are drawn. */
  prepare(parts: Object3D[]): void {
    this.scene.add(...parts);
    this.renderer.compile(this.scene, this.camera);
    this.scene.remove(...parts);
    this.prepared.push(...parts);
  }

  resize(width: number, height: number): void {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
    this.request();
  }

  /** From what is looked at to the camera. */
  get direction(): Vec {
    return sub(this.eye, this.target);
  }

  private get eye(): Vec {
    return this.camera.position.toArray();
  }

  private get target(): Vec {
    return this.controls.target.toArray();
  }

  /** Everything that there is to see. */
  setBall(ball: Ball): void {
    this.ball = ball;
  }

  /** From how far a ball of this radius is in sight as a whole. */
  distanceFor(radius: number): number {
    const angle = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(1, this.camera.aspect);
    return (1.02 * radius) / Math.sin(Math.atan(Math.tan(angle) * narrow));
  }

  /** Moves the camera so that everything is in sight, without turning it. */
  fit(): void {
    ++this.flight;
    this.look(this.ball.middle, this.direction, this.distanceFor(this.ball.radius));
  }

  /** Moves the camera, in sight of everybody who does not mind that, until it sees a ball from a direction. */
  flyTo({ middle, radius }: Ball, direction: Vec): void {
    this.moved = true;
    const here = ++this.flight;
    const [from, turned] = [this.target, this.direction];
    const [first, last] = [Math.hypot(...turned), this.distanceFor(radius)];
    const lasts = matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 600;
    const start = performance.now();
    const step = () => {
      if (here !== this.flight) {
        return;
      }
      const t = lasts > 0 ? Math.min((performance.now() - start) / lasts, 1) : 1;
      const eased = t * t * (3 - 2 * t);
      this.look(add(scale(from, 1 - eased), scale(middle, eased)), turnedTowards(turned, direction, eased), first ** (1 - eased) * last ** eased);
      if (t < 1) {
        requestAnimationFrame(step);
      }
    };
    step();
  }

  private look(target: Vec, direction: Vec, distance: number): void {
    const way = Math.hypot(...direction);
    this.controls.target.set(...(target as [number, number, number]));
    this.camera.position.set(...(add(target, scale(direction, distance / way)) as [number, number, number]));
    this.controls.update();
    this.request();
  }

  /** Replaces what a layer has in it; those of lower order are drawn first. Fine ones may be left out in motion. */
  put(layer: string, parts: Object3D[], order: number, isFine = false): void {
    const points = (parts as Mesh[]).reduce((sum, { geometry }) => sum + (geometry.index ?? geometry.getAttribute("position")).count, 0);
    isFine && points > 0 ? this.fine.set(layer, points) : this.fine.delete(layer);
    for (const part of this.layers.get(layer) ?? []) {
      this.scene.remove(part);
      forget(part as Mesh);
    }
    for (const part of parts) {
      part.renderOrder = order;
      part.frustumCulled = false; // everything is in sight as a rule, and its bounds would have to be found
      this.scene.add(part);
    }
    this.layers.set(layer, parts);
    this.motion.stir();
    this.request();
  }

  /** What `cellAt` finds, and `generatorAt`: there, cells are numbers of generators. */
  setTargets(targets: Partial<Targets>): void {
    const all = { ...noTargets, ...targets };
    this.targets = () => all;
  }

  setChains(chains: Partial<Targets>): void {
    this.chains = { ...noTargets, ...chains };
  }

  show(view: View): void {
    this.ball = ballAround(view.drawn);
    this.showFaces(view);
    this.showEdges(view);
    this.showVertices(view);
    this.showOverlays(view.overlays);
    if (!this.moved) {
      this.fit();
    }
  }

  /** The generator that is drawn at a point of the canvas, in its own pixels, or -1. */
  generatorAt(x: number, y: number): number {
    const { segments, ends, segmentCells, points, pointCells, triangles, corners, triangleCells } = this.chains;
    const lens = this.lens();
    const point = pointAt(projected(lens, points), x, y, reaches.chain);
    if (point) {
      return pointCells[point.index];
    }
    const segment = segmentAt(projected(lens, segments), ends, x, y, reaches.chain);
    if (segment) {
      return segmentCells[segment.index];
    }
    const face = triangleAt(projected(lens, triangles), corners, x, y);
    return face ? triangleCells[face.index] : -1;
  }

  /** The cell there: a vertex if one is near, else an edge, else a face; none that a face hides. */
  cellAt(x: number, y: number): number | null {
    const { segments, ends, segmentCells, points, pointCells, triangles, corners, triangleCells } = this.targets();
    const lens = this.lens();
    const face = triangleAt(projected(lens, triangles), corners, x, y);
    // A face that is seen aslant is nearer at the point than where its vertices are.
    const farthest = face ? 1 / (1 / face.nearness + 0.02 * this.ball.radius) : 0;
    const point = pointAt(projected(lens, points), x, y, reaches.point, farthest);
    if (point) {
      return pointCells[point.index];
    }
    const segment = segmentAt(projected(lens, segments), ends, x, y, reaches.segment, farthest);
    return segment ? segmentCells[segment.index] : face ? triangleCells[face.index] : null;
  }

  /** Where a point is on the canvas, in its own pixels; for tests. */
  placeOnCanvas(point: Vec): [number, number] {
    const [x, y] = projected(this.lens(), point);
    return [x, y];
  }

  private lens(): Lens {
    this.camera.updateMatrixWorld();
    const matrix = new Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
    return { matrix: matrix.elements, width: this.canvas.clientWidth, height: this.canvas.clientHeight };
  }

  /** A new frame is due. */
  request(): void {
    if (!this.isDue) {
      this.isDue = true;
      requestAnimationFrame(() => {
        this.isDue = false;
        this.render();
      });
    }
  }

  private render(): void {
    if (this.hasMoved) {
      this.motion.frame(performance.now());
    }
    this.hasMoved = false;
    const isCoarse = this.motion.isTurning && this.motion.isSlow;
    // The first picture of something large is there sooner without what follows a moment later.
    const most = isCoarse ? 0 : this.isPlain && !this.isComplete ? mostAtFirst : Infinity;
    for (const [name, parts] of this.layers) {
      parts.forEach((part) => (part.visible = (this.fine.get(name) ?? 0) <= most));
    }
    // Where lines have rough edges, twice as many pixels make them smooth, once everything rests.
    const ratio = this.isPlain ? (this.motion.isMoving ? this.motion.ratio : 2) : Math.min(window.devicePixelRatio, 2);
    if (ratio !== this.renderer.getPixelRatio()) {
      this.renderer.setPixelRatio(ratio);
    }
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = distance / 200;
    this.camera.far = this.camera.position.distanceTo(new Vector3(...this.ball.middle)) + 3 * this.ball.radius + distance;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    if (this.motion.isMoving) {
      this.drawing.begin(); // and at rest it is when this is there: what is drawn finely would wait for it, and all else on the page with that
    }
  }

  private showFaces({ drawn, colourOf, highlighted, opacity }: View): void {
    const bright = rgb(this.theme.highlight);
    const buffers = faceBuffers(drawn.faces, (cell) => (highlighted.has(cell) ? bright : colourOf(cell)));
    this.put("faces", drawn.faces.length > 0 ? [facesPart(buffers, opacity, true)] : [], 0);
    let known: Targets | null = null;
    this.targets = () => (known ??= targetsOf(drawn, buffers)); // which a click may never ask for
  }

  private showEdges({ drawn, highlighted }: View): void {
    const plain = drawn.edges.filter(({ cell }) => !highlighted.has(cell));
    const some = drawn.edges.filter(({ cell }) => highlighted.has(cell));
    const width = drawn.edges.length > 500 ? 1 : 1.6;
    const buffers = lineBuffers(plain, () => rgb(this.theme.edge));
    // Paler, or many of them are nothing but dark.
    const isMany = drawn.edges.length > mostWideEdges;
    const part = isMany ? () => colouredLinesPart(buffers, 0.6) : () => wideLines(buffers.positions, buffers.colours, width);
    this.put("edges", plain.length > 0 ? [part()] : [], 1, isMany);
    const bright = lineBuffers(some, () => [0, 0, 0]).positions;
    this.put("bright edges", some.length > 0 ? [wideLines(bright, this.theme.highlight, 4.5)] : [], 2);
  }

  private showVertices({ drawn, highlighted }: View): void {
    const count = drawn.vertices.length;
    const groups: [boolean, number, number][] = [
      [false, this.theme.vertex, count > 1000 ? 1.5 : count > 200 ? 3 : 6],
      [true, this.theme.highlight, count > 1000 ? 5 : 11],
    ];
    const parts = groups.flatMap(([bright, colour, size]) => {
      const some = drawn.vertices.filter(({ cell }) => highlighted.has(cell) === bright).map(({ at }) => at);
      return some.length > 0 ? [dotsPart(flatPoints(some), colour, size)] : [];
    });
    this.put("vertices", parts, 3);
  }

  private showOverlays(overlays: readonly Overlay[]): void {
    const radius = this.ball.radius * 0.014;
    const patches: Object3D[] = [];
    const bars: Object3D[] = [];
    for (const { colour, points, paths, faces } of overlays) {
      if (faces.length > 0) {
        patches.push(facesPart(faceBuffers(faces, () => rgb(colour)), 0.55, false));
      }
      const joints = [...paths.flat(), ...points];
      const isPoints = points.length > 0 && paths.length === 0;
      bars.push(tubesPart(segmentsOf(paths), radius, colour), ballsPart(joints, isPoints ? radius * 2.2 : radius, colour));
    }
    this.put("patches", patches, 4);
    this.put("bars", bars, 5);
    const known = overlays.filter(({ generator }) => generator >= 0);
    const of = <T>(items: (overlay: Overlay) => readonly T[]) => known.map((overlay) => [overlay.generator, items(overlay)] as const);
    const repeated = <T>(lists: (readonly [number, readonly T[]])[]) => lists.flatMap(([generator, list]) => list.map(() => generator));
    const points = of(({ points }) => points);
    const segments = of(({ paths }) => segmentsOf(paths));
    const triangles = of(({ faces }) => faces.flatMap(({ triangles }) => triangles));
    this.setChains({
      points: flatPoints(points.flatMap(([, list]) => list)),
      pointCells: repeated(points),
      segments: flatPoints(segments.flatMap(([, list]) => list).flat()),
      segmentCells: repeated(segments),
      triangles: flatPoints(triangles.flatMap(([, list]) => list)),
      triangleCells: repeated(triangles).filter((_, k) => k % 3 === 0),
    });
  }
}
