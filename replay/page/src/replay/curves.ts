/** Edges as curves: straight ones, several between the same ends bent apart, and loops as circles. */
import type { ObjectState } from "./object.ts";
import { across, add, cross, length, mix, scale, sub, turned, unit, type Vec } from "../vectors.ts";

export interface Curve {
  from: Vec;
  to: Vec;
  straight: boolean;
  loop: boolean;
  /** From 0 at `from` to 1 at `to`. */
  at(t: number): Vec;
}

/** A loop: the circle through a point, with a direction to its centre and one along which it starts. */
export interface Circle {
  base: Vec;
  towards: Vec;
  along: Vec;
  radius: number;
}

export function straightCurve(from: Vec, to: Vec): Curve {
  return { from, to, straight: true, loop: false, at: (t) => mix(from, to, t) };
}

export function pointCurve(at: Vec): Curve {
  return { from: at, to: at, straight: true, loop: false, at: () => at };
}

export function circleCurve({ base, towards, along, radius }: Circle): Curve {
  const at = (t: number) => {
    const angle = 2 * Math.PI * t;
    return add(base, add(scale(towards, radius * (1 - Math.cos(angle))), scale(along, radius * Math.sin(angle))));
  };
  return { from: base, to: base, straight: false, loop: true, at };
}

export function reversed(curve: Curve): Curve {
  return { ...curve, from: curve.to, to: curve.from, at: (t) => curve.at(1 - t) };
}

/** One of `count` curves between two points, spread around the line. */
export function bentCurve(from: Vec, to: Vec, index: number, count: number): Curve {
  const line = sub(to, from);
  const side = turned(across(line), unit(line), (2 * Math.PI * index) / count);
  const height = 0.3 * length(line);
  const at = (t: number) => add(mix(from, to, t), scale(side, height * 4 * t * (1 - t)));
  return { from, to, straight: false, loop: false, at };
}

/** The circle of one of `count` loops at a point; the first two are at right angles, as a torus has them. */
export function circleAt(base: Vec, index: number, size: number): Circle {
  const radius = size * (index === 0 ? 0.5 : 0.22 + 0.2 / (index + 1));
  if (index < 2) {
    return index === 0
      ? { base, towards: [1, 0, 0], along: [0, 1, 0], radius }
      : { base, towards: [-1, 0, 0], along: [0, 0, 1], radius };
  }
  // Further ones point everywhere, by steps of the golden angle.
  const z = 1 - ((index * 0.618) % 1) * 2;
  const flat = Math.sqrt(1 - z * z);
  const towards: Vec = [flat * Math.cos(2.4 * index), flat * Math.sin(2.4 * index), z];
  return { base, towards, along: unit(cross(towards, [0.3, 0.5, 0.81])), radius };
}

/** All edges of the object, by cell. */
export interface Curves {
  of: Map<number, Curve>;
  circles: Map<number, Circle>;
}

/** `placeOf`: where a current vertex is; `size`: of the object, by which loops are drawn. */
export function curvesOf(object: ObjectState, edges: readonly number[], placeOf: (vertex: number) => Vec, size: number): Curves {
  const classes = new Map<number, number[]>();
  const ends = new Map<number, [number, number]>();
  for (const edge of edges) {
    const head = object.face(edge, 0);
    const tail = object.face(edge, 1);
    if (head && tail) {
      const key = Math.min(tail.cell, head.cell) * 2 ** 26 + Math.max(tail.cell, head.cell); // pages have fewer cells
      ends.set(edge, [tail.cell, head.cell]);
      const known = classes.get(key);
      known ? known.push(edge) : classes.set(key, [edge]);
    }
  }
  const curves: Curves = { of: new Map(), circles: new Map() };
  for (const members of classes.values()) {
    members.forEach((edge, index) => {
      const [tail, head] = ends.get(edge)!;
      const [from, to] = [placeOf(tail), placeOf(head)];
      const coincide = length(sub(to, from)) < 1e-6 * size;
      if (tail === head || coincide) {
        const circle = circleAt(from, index, size);
        curves.circles.set(edge, circle);
        curves.of.set(edge, circleCurve(circle));
      } else if (members.length === 1) {
        curves.of.set(edge, straightCurve(from, to));
      } else {
        // All from the smaller end, or those that run the other way would be bent to where another one is.
        const curve = bentCurve(...(tail < head ? ([from, to] as const) : ([to, from] as const)), index, members.length);
        curves.of.set(edge, tail < head ? curve : reversed(curve));
      }
    });
  }
  return curves;
}
