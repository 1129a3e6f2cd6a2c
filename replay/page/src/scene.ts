/** The picture in space. It knows no history: it is given what is to be drawn. */
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  InstancedMesh,
  CylinderGeometry,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  type Object3D,
  PerspectiveCamera,
  Points,
  PointsMaterial,
  Quaternion,
  Raycaster,
  Scene,
  SphereGeometry,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { ballAround, type ColourOf, type FaceBuffers, faceBuffers, lineBuffers, rgb } from "./buffers.ts";
import type { Theme } from "./colours.ts";
import type { Drawn } from "./drawn.ts";
import type { Vec } from "./vectors.ts";

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

export class Picture {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(40, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly raycaster = new Raycaster();
  private parts: Object3D[] = [];
  private faces: Mesh | null = null;
  private dots: Points | null = null;
  private faceCells: Int32Array = new Int32Array();
  private dotCells: number[] = [];
  private lines: LineMaterial[] = [];
  private ball: { middle: Vec; radius: number } = { middle: [0, 0, 0], radius: 1 };
  private isDue = false;
  /** Whether the camera was moved by hand. */
  moved = false;

  constructor(private readonly canvas: HTMLCanvasElement, private theme: Theme) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.request());
    this.controls.addEventListener("start", () => (this.moved = true));
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

  resize(width: number, height: number): void {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
    this.lines.forEach((material) => material.resolution.set(width, height));
    this.request();
  }

  /** Moves the camera so that everything is in sight, without turning it. */
  fit(): void {
    const { middle, radius } = this.ball;
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    const angle = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (1.02 * radius) / Math.sin(Math.atan(Math.tan(angle) * narrow));
    this.controls.target.set(...(middle as [number, number, number]));
    this.camera.position.copy(this.controls.target).addScaledVector(direction, distance);
    this.camera.near = distance / 200;
    this.camera.far = distance * 50;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.request();
  }

  show(view: View): void {
    for (const part of this.parts) {
      this.scene.remove(part);
      (part as Mesh).geometry?.dispose();
    }
    this.parts = [];
    this.lines = [];
    this.ball = ballAround(view.drawn);
    this.addFaces(view);
    this.addEdges(view);
    this.addVertices(view);
    view.overlays.forEach((overlay) => this.addOverlay(overlay));
    if (!this.moved) {
      this.fit();
    }
    this.request();
  }

  /** The generator that is drawn at a point of the canvas, in its own pixels, or -1. */
  generatorAt(x: number, y: number): number {
    this.aim(x, y);
    const hits = this.raycaster.intersectObjects(this.parts.filter((part) => part.userData.generator >= 0), false);
    return hits.length > 0 ? (hits[0].object.userData.generator as number) : -1;
  }

  /** The cell there: a vertex if one is near, else a face. */
  cellAt(x: number, y: number): number | null {
    this.aim(x, y);
    this.raycaster.params.Points.threshold = this.ball.radius * 0.02;
    const dot = this.dots && this.raycaster.intersectObject(this.dots)[0];
    if (dot?.index !== undefined) {
      return this.dotCells[dot.index];
    }
    const face = this.faces && this.raycaster.intersectObject(this.faces)[0];
    return face?.faceIndex !== undefined && face.faceIndex !== null ? this.faceCells[face.faceIndex] : null;
  }

  private aim(x: number, y: number): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.raycaster.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
  }

  private request(): void {
    if (!this.isDue) {
      this.isDue = true;
      requestAnimationFrame(() => {
        this.isDue = false;
        this.renderer.render(this.scene, this.camera);
      });
    }
  }

  private add(part: Object3D, order: number, generator = -1): void {
    part.renderOrder = order;
    part.userData.generator = generator;
    this.parts.push(part);
    this.scene.add(part);
  }

  private addFaces({ drawn, colourOf, highlighted, opacity }: View): void {
    this.faces = null;
    if (drawn.faces.length === 0) {
      return;
    }
    const bright = rgb(this.theme.highlight);
    const buffers = faceBuffers(drawn.faces, (cell) => (highlighted.has(cell) ? bright : colourOf(cell)));
    const geometry = faceGeometry(buffers);
    this.faceCells = buffers.cells;
    this.faces = new Mesh(geometry, surface(opacity, true));
    this.add(this.faces, 0);
  }

  private addEdges({ drawn, highlighted }: View): void {
    const plain = rgb(this.theme.edge);
    const bright = rgb(this.theme.highlight);
    const some = drawn.edges.filter(({ cell }) => highlighted.has(cell));
    const width = drawn.edges.length > 3000 ? 0.6 : drawn.edges.length > 500 ? 1 : 1.6;
    this.addLines(drawn.edges.filter(({ cell }) => !highlighted.has(cell)), () => plain, width, 1);
    this.addLines(some, () => bright, 4.5, 2);
  }

  private addLines(edges: Drawn["edges"], colourOf: ColourOf, width: number, order: number): void {
    if (edges.length === 0) {
      return;
    }
    const buffers = lineBuffers(edges, colourOf);
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(buffers.positions);
    geometry.setColors(buffers.colours);
    const thin = width < 1; // paler, or many of them are nothing but dark
    const material = new LineMaterial({ vertexColors: true, linewidth: Math.max(width, 1), transparent: thin, opacity: thin ? width : 1 });
    material.resolution.set(this.canvas.clientWidth, this.canvas.clientHeight);
    this.lines.push(material);
    this.add(new LineSegments2(geometry, material), order);
  }

  private addVertices({ drawn, highlighted }: View): void {
    this.dots = null;
    const groups: [boolean, number, number][] = [
      [false, this.theme.vertex, drawn.vertices.length > 1000 ? 1.5 : drawn.vertices.length > 200 ? 3 : 6],
      [true, this.theme.highlight, drawn.vertices.length > 1000 ? 5 : 11],
    ];
    for (const [bright, colour, size] of groups) {
      const some = drawn.vertices.filter(({ cell }) => highlighted.has(cell) === bright);
      if (some.length > 0) {
        const dots = pointsAt(some.map(({ at }) => at), colour, size * this.renderer.getPixelRatio());
        this.add(dots, 3);
      }
    }
    const all = pointsAt(drawn.vertices.map(({ at }) => at), 0, 1);
    all.updateMatrixWorld();
    this.dotCells = drawn.vertices.map(({ cell }) => cell);
    this.dots = all; // not drawn: only to be found
  }

  private addOverlay({ generator, colour, points, paths, faces }: Overlay): void {
    const radius = this.ball.radius * 0.014;
    if (faces.length > 0) {
      const buffers = faceBuffers(faces, () => rgb(colour));
      this.add(new Mesh(faceGeometry(buffers), surface(0.55, false)), 4, generator);
    }
    const segments = paths.flatMap((path) => path.slice(1).map((end, k) => [path[k], end] as const));
    this.addTubes(segments, radius, colour, generator);
    const joints = [...paths.flat(), ...points];
    this.addBalls(joints, points.length > 0 && paths.length === 0 ? radius * 2.2 : radius, colour, generator);
  }

  private addTubes(segments: (readonly [Vec, Vec])[], radius: number, colour: number, generator: number): void {
    const material = new MeshLambertMaterial({ color: colour });
    const tubes = new InstancedMesh(new CylinderGeometry(1, 1, 1, 10, 1, true), material, segments.length);
    const up = new Vector3(0, 1, 0);
    segments.forEach(([from, to], k) => {
      const [a, b] = [new Vector3(...from), new Vector3(...to)];
      const line = b.clone().sub(a);
      const size = line.length();
      const turn = new Quaternion().setFromUnitVectors(up, line.normalize());
      tubes.setMatrixAt(k, new Matrix4().compose(a.add(b).multiplyScalar(0.5), turn, new Vector3(radius, size, radius)));
    });
    this.add(tubes, 5, generator);
  }

  private addBalls(centres: readonly Vec[], radius: number, colour: number, generator: number): void {
    const balls = new InstancedMesh(new SphereGeometry(1, 12, 8), new MeshLambertMaterial({ color: colour }), centres.length);
    centres.forEach((at, k) => {
      balls.setMatrixAt(k, new Matrix4().makeScale(radius, radius, radius).setPosition(...(at as [number, number, number])));
    });
    this.add(balls, 5, generator);
  }
}

function faceGeometry({ positions, normals, colours }: FaceBuffers): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
  return geometry;
}

function surface(opacity: number, pushesBack: boolean): MeshLambertMaterial {
  return new MeshLambertMaterial({
    vertexColors: true,
    side: DoubleSide,
    transparent: opacity < 1,
    opacity,
    depthWrite: opacity >= 1,
    polygonOffset: true,
    polygonOffsetFactor: pushesBack ? 1 : -1,
    polygonOffsetUnits: pushesBack ? 1 : -1,
  });
}

function pointsAt(places: readonly Vec[], colour: number, size: number): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(places.flat()), 3));
  return new Points(geometry, new PointsMaterial({ color: colour, size, sizeAttenuation: false }));
}

