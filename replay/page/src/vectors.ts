/** Points and directions in space, as triples. */
export type Vec = readonly [number, number, number];

export const add = (a: Vec, b: Vec): Vec => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec, b: Vec): Vec => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec, s: number): Vec => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Vec): number => Math.sqrt(dot(a, a));
export const mix = (a: Vec, b: Vec, t: number): Vec => add(scale(a, 1 - t), scale(b, t));

/** Of length 1; of the null vector, the first axis. */
export function unit(a: Vec): Vec {
  const size = length(a);
  return size > 1e-12 ? scale(a, 1 / size) : [1, 0, 0];
}

/** Some direction at right angles to a. */
export function across(a: Vec): Vec {
  const [x, y, z] = a.map(Math.abs);
  const least: Vec = z <= x && z <= y ? [0, 0, 1] : y <= x ? [0, 1, 0] : [1, 0, 0];
  return unit(sub(least, scale(a, dot(least, a) / Math.max(dot(a, a), 1e-24))));
}

/** a turned about an axis of length 1. */
export function turned(a: Vec, axis: Vec, angle: number): Vec {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return add(add(scale(a, c), scale(cross(axis, a), s)), scale(axis, dot(axis, a) * (1 - c)));
}
