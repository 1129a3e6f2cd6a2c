/** Lists of numbers as the graphics card takes them. */
import type { Drawn } from "./drawn.ts";
import { add, cross, sub, unit, type Vec } from "./vectors.ts";

export interface FaceBuffers {
  positions: Float32Array;
  normals: Float32Array;
  colours: Float32Array;
  /** The cell of each triangle. */
  cells: Int32Array;
}

export interface LineBuffers {
  positions: number[];
  colours: number[];
  cells: number[];
}

export type ColourOf = (cell: number) => readonly [number, number, number];

export function rgb(colour: number): [number, number, number] {
  // Linear, as light adds up: what the renderer turns back into what screens take.
  const linear = (part: number) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
  return [16, 8, 0].map((shift) => linear(((colour >> shift) & 0xff) / 255)) as [number, number, number];
}

/** Of each triangle, or, within a face of many, of each point: so curved faces look smooth. Lengths are any. */
function normalsOf(triangles: readonly Vec[]): Vec[] {
  const sums = new Map<string, Vec>();
  const key = (point: Vec) => point.map((x) => x.toFixed(6)).join();
  const flat: Vec[] = [];
  for (let k = 0; k < triangles.length; k += 3) {
    const normal = cross(sub(triangles[k + 1], triangles[k]), sub(triangles[k + 2], triangles[k]));
    for (const point of triangles.slice(k, k + 3)) {
      flat.push(normal);
      if (triangles.length > 6) {
        sums.set(key(point), add(sums.get(key(point)) ?? [0, 0, 0], normal));
      }
    }
  }
  return triangles.length > 6 ? triangles.map((point) => sums.get(key(point))!) : flat;
}

export function faceBuffers(faces: Drawn["faces"], colourOf: ColourOf): FaceBuffers {
  const points = faces.reduce((sum, { triangles }) => sum + triangles.length, 0);
  const positions = new Float32Array(points * 3);
  const normals = new Float32Array(points * 3);
  const colours = new Float32Array(points * 3);
  const cells = new Int32Array(points / 3);
  let next = 0;
  for (const { cell, triangles } of faces) {
    const colour = colourOf(cell);
    const ofFace = normalsOf(triangles);
    for (let k = 0; k < triangles.length; ++k) {
      positions.set(triangles[k], next * 3);
      normals.set(unit(ofFace[k]), next * 3);
      colours.set(colour, next * 3);
      cells[Math.floor(next / 3)] = cell;
      ++next;
    }
  }
  return { positions, normals, colours, cells };
}

/** Broken lines as segments. */
export function lineBuffers(edges: Drawn["edges"], colourOf: ColourOf): LineBuffers {
  const buffers: LineBuffers = { positions: [], colours: [], cells: [] };
  for (const { cell, points } of edges) {
    const colour = colourOf(cell);
    for (let k = 0; k + 1 < points.length; ++k) {
      buffers.positions.push(...points[k], ...points[k + 1]);
      buffers.colours.push(...colour, ...colour);
      buffers.cells.push(cell);
    }
  }
  return buffers;
}

/** Broken lines as pairs of points. */
export function segmentsOf(paths: readonly (readonly Vec[])[]): (readonly [Vec, Vec])[] {
  return paths.flatMap((path) => path.slice(1).map((end, k) => [path[k], end] as const));
}

/** All coordinates in a row. */
export function flatPoints(points: readonly Vec[]): Float32Array {
  const flat = new Float32Array(points.length * 3);
  points.forEach((point, k) => flat.set(point, 3 * k));
  return flat;
}

/** The middle and the radius of a ball with everything in it that is drawn. */
export function ballAround(drawn: Drawn): { middle: Vec; radius: number } {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const take = (point: Vec) => {
    for (let axis = 0; axis < 3; ++axis) {
      low[axis] = Math.min(low[axis], point[axis]);
      high[axis] = Math.max(high[axis], point[axis]);
    }
  };
  drawn.vertices.forEach(({ at }) => take(at));
  drawn.edges.forEach(({ points }) => points.forEach(take));
  drawn.faces.forEach(({ triangles }) => triangles.forEach(take));
  if (low[0] > high[0]) {
    return { middle: [0, 0, 0], radius: 1 };
  }
  const middle = low.map((x, axis) => (x + high[axis]) / 2) as unknown as Vec;
  const radius = Math.hypot(...low.map((x, axis) => (high[axis] - x) / 2));
  return { middle, radius: Math.max(radius, 1e-3) };
}
