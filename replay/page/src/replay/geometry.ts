/** What is to be drawn of the object at one moment. */
import type { Drawn } from "../drawn.ts";
import { curvesOf, type Curves } from "./curves.ts";
import type { ObjectState } from "./object.ts";
import { patchOf, type Twins } from "./patches.ts";
import type { Vec } from "../vectors.ts";

export type Places = Map<number, Vec>;

export function placesOf(cells: readonly number[], points: readonly number[]): Places {
  return new Map(cells.map((cell, k) => [cell, [points[3 * k], points[3 * k + 1], points[3 * k + 2]] as Vec]));
}

function sizeOf(points: readonly Vec[]): number {
  let squares = 0;
  for (const axis of [0, 1, 2]) {
    let [low, high] = [Infinity, -Infinity];
    for (const point of points) {
      low = Math.min(low, point[axis]);
      high = Math.max(high, point[axis]);
    }
    squares += high > low ? (high - low) ** 2 : 0;
  }
  return Math.sqrt(squares);
}

/** Parts of a curved side, fewer the more faces are to be cut up. */
function partsFor(faces: number): number {
  return faces <= 60 ? 14 : faces <= 600 ? 8 : faces <= 4000 ? 4 : 2;
}

export function drawnOf(object: ObjectState, places: Places): Drawn {
  const cells = object.currentCells();
  const ofDimension = (p: number) => cells.filter((cell) => object.dimension(cell) === p);
  const vertices = ofDimension(0).map((cell) => ({ cell, at: places.get(object.oldest(cell)) ?? ([0, 0, 0] as Vec) }));
  const where = new Map(vertices.map(({ cell, at }) => [cell, at]));
  const placeOf = (cell: number): Vec => where.get(cell) ?? places.get(object.oldest(cell)) ?? [0, 0, 0];
  const size = sizeOf(vertices.map(({ at }) => at)) || 1;
  const listed = ofDimension(1);
  const curves: Curves = curvesOf(object, listed, placeOf, size);
  let missing = listed.length - curves.of.size;
  const edges = [...curves.of].map(([cell, curve]) => {
    const parts = curve.straight ? 1 : curve.loop ? 40 : 14;
    return { cell, points: Array.from({ length: parts + 1 }, (_, k) => curve.at(k / parts)) };
  });
  const faces: Drawn["faces"] = [];
  const twins: Twins = new Map();
  const listedFaces = ofDimension(2);
  const parts = partsFor(listedFaces.length);
  for (const cell of listedFaces) {
    const triangles = patchOf(object, curves, placeOf, cell, parts, twins, size);
    triangles ? faces.push({ cell, triangles }) : ++missing;
  }
  missing += cells.filter((cell) => object.dimension(cell) > 2 && skeletonOf(object, cell).size === 0).length;
  return { vertices, edges, faces, size, missing };
}

/** The faces of a cell of more than two dimensions that are of two, each once; of others, itself. */
export function skeletonOf(object: ObjectState, cell: number, into: Set<number> = new Set()): Set<number> {
  if (object.dimension(cell) <= 2) {
    into.add(cell);
    return into;
  }
  for (let k = 0; k < object.faceCount(cell); ++k) {
    const face = object.face(cell, k);
    if (face && !face.squashed && !into.has(face.cell)) {
      skeletonOf(object, face.cell, into);
    }
  }
  return into;
}

/** The connected components: for each current cell a number, that of the largest component being 0. */
export function componentsOf(object: ObjectState): Map<number, number> {
  const cells = object.currentCells();
  const parent = new Int32Array(cells.length > 0 ? cells[cells.length - 1] + 1 : 0).fill(-1);
  for (const cell of cells) {
    parent[cell] = cell;
  }
  const find = (cell: number): number => {
    while (parent[cell] !== cell) {
      parent[cell] = parent[parent[cell]];
      cell = parent[cell];
    }
    return cell;
  };
  for (const cell of cells) {
    for (let k = 0; k < object.faceCount(cell); ++k) {
      const face = object.face(cell, k);
      if (face && parent[face.cell] >= 0) {
        parent[find(face.cell)] = find(cell);
      }
    }
  }
  const sizes = new Map<number, number>();
  cells.forEach((cell) => sizes.set(find(cell), (sizes.get(find(cell)) ?? 0) + 1));
  const order = [...sizes].sort((a, b) => b[1] - a[1]).map(([root]) => root);
  const rank = new Map(order.map((root, k) => [root, k]));
  return new Map(cells.map((cell) => [cell, rank.get(find(cell))!]));
}
