/** What the page of a mesh is given, as C++ writes it (tools/commands/mesh_page.cpp), and what follows from it at once. */
import { floats, type Packed, wholes } from "../packed.ts";
import type { Vec } from "../vectors.ts";

/** The lowest and the highest coordinates. */
export type Box = [Vec, Vec];
/** A number, or its digits where those of computers do not reach. */
export type Measure = number | string;
export type Side = "handle" | "tunnel" | null;

export interface Component {
  vertices: number;
  edges: number;
  faces: number;
  euler: number;
  boundary_loops: number;
  manifold: boolean;
  orientable: boolean;
  closed: boolean;
  genus: number | null;
  /** Why its loops have no side; null when they have, or when there are none. */
  unsorted: string | null;
  box: Box;
}

export interface Loop {
  order: string;
  side: Side;
  component: number;
  length: Measure;
  short: boolean;
  /** It is one simple loop. */
  closed: boolean;
  box: Box;
  centre: Vec;
  /** From and to, along the loop where it is one closed walk. */
  edges: number[];
  /** How often each edge is run; once if it is not there. */
  times?: (number | string)[];
  /** Runs of triangles that `order` times the loop bounds. */
  bounds?: number[];
}

export interface Surface {
  order: string;
  triangles: number;
  area: Measure;
  volume: Measure | null;
  box: Box;
  centre: Vec;
  runs: number[];
}

/** A face of the file that is no face of the mesh, or is folded; coordinates of its corners in those of the page. */
export interface BadFace {
  face: number;
  corners: number[];
  points: number[];
}

/** Two faces that have more in common than vertices and edges; corners are points of the page. */
export interface Meeting {
  faces: [number, number];
  crosses: boolean;
  place: Vec;
  corners: [number[], number[]];
}

export interface Data {
  version: string;
  source: string;
  stem: string;
  ring: string;
  points_in_file: number;
  faces_in_file: number;
  vertices: number;
  edges: number;
  faces: number;
  polygons: number;
  euler: number;
  manifold: boolean;
  closed: boolean;
  orientable: boolean;
  consistently_oriented: boolean;
  boundary_loops: number;
  remarks: string[];
  components_in_all: number;
  components: Component[];
  betti: number[];
  torsion: (number | string)[][];
  loops_tried: number;
  /** A point of the file is middle + scale * a point of the page. */
  frame: { middle: Vec; scale: number };
  points: Packed;
  numbers: Packed | null;
  part: Packed | null;
  triangles_in_all: number;
  /** Every so many triangles one is here, and edges likewise. */
  stride: number;
  triangles: Packed;
  sides: Packed;
  places: {
    lines: Packed;
    boundary: Packed;
    boundary_loop: Packed;
    non_manifold_edges: Packed;
    non_manifold_vertices: Packed;
    reversed_edges: Packed;
  };
  meetings_in_all: number;
  /** False: there were too many pairs of faces to look at. */
  meetings_complete: boolean;
  meetings: Meeting[];
  bad_faces: {
    degenerate_in_all: number;
    degenerate: BadFace[];
    duplicate_in_all: number;
    duplicate: BadFace[];
    folded_in_all: number;
    folded: BadFace[];
  };
  generators: boolean;
  shorter_than: number | null;
  loops_in_all: number;
  loops: Loop[];
  surfaces_in_all: number;
  surfaces: Surface[];
}

/** The mesh as it is drawn: points, and what is made of them by their numbers. */
export class Mesh {
  readonly points: Float32Array;
  readonly corners: Uint32Array;
  /** Edges of the faces of the file, two ends each. */
  readonly sides: Uint32Array;
  private readonly numbers: Uint32Array | null;
  private readonly part: Uint32Array | null;

  constructor(private readonly data: Data) {
    this.points = floats(data.points);
    this.corners = wholes(data.triangles);
    this.sides = wholes(data.sides);
    this.numbers = data.numbers && wholes(data.numbers);
    this.part = data.part && wholes(data.part);
  }

  at(point: number): Vec {
    return [this.points[3 * point], this.points[3 * point + 1], this.points[3 * point + 2]];
  }

  /** The number of a point in the file; of one that was made in the middle of a polygon, a number behind those. */
  inFile(point: number): number {
    return this.numbers ? this.numbers[point] : point;
  }

  isMade(point: number): boolean {
    return this.inFile(point) >= this.data.points_in_file;
  }

  componentOf(point: number): number {
    return this.part ? this.part[point] : 0;
  }

  /** From coordinates of the page to those of the file, and back. */
  toFile(point: Vec): Vec {
    const { middle, scale } = this.data.frame;
    return point.map((x, axis) => middle[axis] + scale * x) as unknown as Vec;
  }

  fromFile(point: Vec): Vec {
    const { middle, scale } = this.data.frame;
    return point.map((x, axis) => (x - middle[axis]) / scale) as unknown as Vec;
  }

  /** The corners of those triangles of some runs that are here. */
  cornersOf(runs: readonly number[]): Uint32Array {
    const { stride } = this.data;
    const found: number[] = [];
    for (let k = 0; k < runs.length; k += 2) {
      const end = runs[k] + runs[k + 1];
      for (let t = Math.ceil(runs[k] / stride); t * stride < end; ++t) {
        found.push(this.corners[3 * t], this.corners[3 * t + 1], this.corners[3 * t + 2]);
      }
    }
    return Uint32Array.from(found);
  }
}
