/** Faces as surfaces: flat ones as they are, others spanned between the curves of their sides. */
import type { Curve, Circle } from "./curves.ts";
import { pointCurve, reversed } from "./curves.ts";
import type { Curves } from "./curves.ts";
import type { Triangles } from "../drawn.ts";
import type { ObjectState } from "./object.ts";
import { across, add, cross, dot, length, mix, scale, sub, turned, unit, type Vec } from "../vectors.ts";

interface Side {
  edge: number; // -1: a point
  turned: boolean;
  curve: Curve;
}

/** The side k of a face, from the smaller vertex to the larger one; nothing when it is not shown. */
function sideOf(object: ObjectState, curves: Curves, placeOf: (v: number) => Vec, face: number, k: number): Side | null {
  const found = object.face(face, k);
  if (!found) {
    return null;
  }
  if (found.squashed) {
    return object.dimension(found.cell) === 0
      ? { edge: -1, turned: false, curve: pointCurve(placeOf(found.cell)) }
      : null;
  }
  const curve = curves.of.get(found.cell);
  return curve ? { edge: found.cell, turned: found.turned, curve: found.turned ? reversed(curve) : curve } : null;
}

/** A surface between three curves that it contains: 0 to 1, 1 to 2, 0 to 2. */
export function trianglePoint(c01: Curve, c12: Curve, c02: Curve, a: number, b: number, c: number): Vec {
  const corner = (at: Vec, one: Vec, other: Vec): Vec => sub(add(one, other), at);
  return add(
    add(scale(corner(c01.from, c01.at(b), c02.at(c)), a), scale(corner(c01.to, c12.at(c), c01.at(1 - a)), b)),
    scale(corner(c02.to, c02.at(1 - a), c12.at(1 - b)), c),
  );
}

/** A surface between four curves that it contains; bottom and top run along u, left and right along w. */
export function squarePoint(bottom: Curve, top: Curve, left: Curve, right: Curve, u: number, w: number): Vec {
  const corners = mix(mix(bottom.from, bottom.to, u), mix(top.from, top.to, u), w);
  return sub(add(mix(bottom.at(u), top.at(u), w), mix(left.at(w), right.at(w), u)), corners);
}

/**
 * A square whose opposite sides are one loop each: the second loop is led along the first, and turns with it, so that it
 * is a torus; where a pair of sides is turned round it makes half a turn more on the way, so it is a Klein bottle.
 */
function ringPoint(along: Circle, around: Circle, flips: boolean, u: number, w: number): Vec {
  const angle = 2 * Math.PI * u;
  const axis = unit(cross(along.towards, along.along));
  const turn = 2 * Math.PI * w;
  let spoke = add(
    scale(around.towards, around.radius * (1 - Math.cos(turn))),
    scale(around.along, around.radius * Math.sin(turn)),
  );
  if (flips) {
    spoke = turned(spoke, around.towards, Math.PI * u);
  }
  const base = add(
    along.base,
    add(scale(along.towards, along.radius * (1 - Math.cos(angle))), scale(along.along, along.radius * Math.sin(angle))),
  );
  // The circle starts towards its centre, so the frame turns the other way round the axis.
  return add(base, turned(spoke, axis, -angle));
}

function grid(point: (u: number, w: number) => Vec, n: number): Triangles {
  const triangles: Triangles = [];
  const at: Vec[][] = [];
  for (let i = 0; i <= n; ++i) {
    at.push(Array.from({ length: n + 1 }, (_, j) => point(i / n, j / n)));
  }
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < n; ++j) {
      triangles.push(at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j], at[i + 1][j + 1], at[i][j + 1]);
    }
  }
  return triangles;
}

function triangleGrid(point: (a: number, b: number, c: number) => Vec, n: number): Triangles {
  const triangles: Triangles = [];
  const at = (i: number, j: number) => point(1 - (i + j) / n, i / n, j / n);
  for (let i = 0; i < n; ++i) {
    for (let j = 0; i + j < n; ++j) {
      triangles.push(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i + j + 1 < n) {
        triangles.push(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return triangles;
}

/** A direction out of a closed curve of sides. */
function normalOf(sides: readonly Curve[]): Vec {
  const points = sides.flatMap((side) => [0, 0.25, 0.5, 0.75].map((t) => side.at(t)));
  const middle = scale(points.reduce(add), 1 / points.length);
  let sum: Vec = [0, 0, 0];
  points.forEach((point, k) => {
    sum = add(sum, cross(sub(point, middle), sub(points[(k + 1) % points.length], middle)));
  });
  return length(sum) > 1e-9 ? unit(sum) : [0.31, 0.42, 0.85];
}

/** A face all of whose sides are one point: a sphere through it, one of several to each side of the point. */
function bubble(base: Vec, index: number, size: number, n: number): Triangles {
  const towards: Vec = unit([Math.cos(2.4 * index), Math.sin(2.4 * index), 0.5 - (index % 2)]);
  const radius = 0.25 * size;
  const centre = add(base, scale(towards, radius));
  const start = scale(towards, -radius);
  const axis = across(towards);
  return grid((u, w) => add(centre, turned(turned(start, axis, Math.PI * w), towards, 2 * Math.PI * u)), Math.max(2 * n, 6));
}

/** The surface between sides that follow one another and a point in their middle, which may be raised. */
function fan(sides: readonly Curve[], bulge: number, n: number): Triangles {
  const points = sides.flatMap((side) => {
    const parts = side.straight ? 1 : n;
    return Array.from({ length: parts }, (_, k) => side.at(k / parts));
  });
  const middle = add(scale(points.reduce(add), 1 / points.length), scale(normalOf(sides), bulge));
  return points.flatMap((point, k) => [middle, point, points[(k + 1) % points.length]]);
}

/** Faces with the same sides in the same object get different bulges; how many there were so far. */
export type Twins = Map<string, number>;

/** How a face bulges: not at all when it is alone between sides that are all different. */
function bulgeOf(sides: readonly Side[], twins: Twins): number {
  const edges = sides.map((side) => side.edge).filter((edge) => edge >= 0);
  const key = [...edges].sort((a, b) => a - b).join(",");
  const index = twins.get(key) ?? 0;
  twins.set(key, index + 1);
  const repeats = new Set(edges).size < edges.length;
  const step = repeats || edges.length < 3 ? index + 1 : index;
  return (step % 2 === 1 ? 1 : -1) * Math.ceil(step / 2) * 0.28;
}

function ringOf([right, left, top, bottom]: readonly Side[], curves: Curves): ((u: number, w: number) => Vec) | null {
  const along = curves.circles.get(bottom.edge);
  const around = curves.circles.get(left.edge);
  if (!along || !around || bottom.edge !== top.edge || left.edge !== right.edge || bottom.edge === left.edge) {
    return null;
  }
  const turns = [bottom.turned !== top.turned, left.turned !== right.turned];
  if (turns[0] && turns[1]) {
    return null; // a projective plane, which no ring is
  }
  const u = (x: number) => (bottom.turned ? 1 - x : x);
  const w = (x: number) => (left.turned ? 1 - x : x);
  return turns[0]
    ? (x, y) => ringPoint(around, along, true, w(y), u(x))
    : (x, y) => ringPoint(along, around, turns[1], u(x), w(y));
}

/** The triangles of a face, or nothing when a side is not shown. `n`: into how many parts a curved side is cut. */
export function patchOf(object: ObjectState, curves: Curves, placeOf: (v: number) => Vec, face: number, n: number, twins: Twins, size: number): Triangles | null {
  if (object.hasNoShape(face)) {
    return null;
  }
  const count = object.faceCount(face);
  const sides: Side[] = [];
  for (let k = 0; k < count; ++k) {
    const side = sideOf(object, curves, placeOf, face, k);
    if (!side) {
      return null;
    }
    sides.push(side);
  }
  if (sides.every((side) => side.edge < 0)) {
    const base = sides[0].curve.from;
    const key = `at ${base.join()}`;
    const index = twins.get(key) ?? 0;
    twins.set(key, index + 1);
    return bubble(base, index, size, n);
  }
  const bulge = bulgeOf(sides, twins) * size;
  const [c0, c1, c2, c3] = sides.map((side) => side.curve);
  const flat = bulge === 0 && sides.every((side) => side.curve.straight);
  if (object.isPolygon(face)) {
    return fan(sides.map((side) => reversed(side.curve)), bulge, n);
  }
  if (count === 3) {
    if (flat) {
      return [c2.from, c2.to, c0.to];
    }
    const normal = normalOf([c2, c0, reversed(c1)]);
    return triangleGrid(
      (a, b, c) => add(trianglePoint(c2, c0, c1, a, b, c), scale(normal, bulge * 27 * a * b * c)),
      n,
    );
  }
  if (count !== 4) {
    return null;
  }
  const ring = ringOf(sides, curves);
  if (ring) {
    return grid(ring, Math.max(n * 2, 4));
  }
  const normal = normalOf([c3, c0, reversed(c2), reversed(c1)]);
  const isPlane = flat && Math.abs(dot(sub(c0.to, c3.from), normal)) < 1e-3 * size;
  return grid(
    (u, w) => add(squarePoint(c3, c2, c1, c0, u, w), scale(normal, bulge * 16 * u * (1 - u) * w * (1 - w))),
    isPlane ? 1 : n,
  );
}
