/** From where a place can be seen. */
import { add, cross, dot, length, scale, sub, unit, type Vec } from "./vectors.ts";

/** Directions all round, evenly spread, the nearest to the first one first. */
export function directionsAround(first: Vec, count = 40): Vec[] {
  const all: Vec[] = Array.from({ length: count }, (_, k) => {
    const z = 1 - (2 * k + 1) / count;
    const flat = Math.sqrt(1 - z * z);
    const angle = k * 2.399963; // the golden angle
    return [flat * Math.cos(angle), flat * Math.sin(angle), z];
  });
  const start = unit(first);
  return [start, ...all.sort((a, b) => dot(b, start) - dot(a, start))];
}

/** Whether a triangle stands between an eye and a place; those that the place is on do not count. */
export function isHidden(eye: Vec, place: Vec, points: ArrayLike<number>, corners: ArrayLike<number>): boolean {
  const way = sub(place, eye);
  for (let k = 0; k + 2 < corners.length; k += 3) {
    const [a, b, c] = [3 * corners[k], 3 * corners[k + 1], 3 * corners[k + 2]];
    const [e1x, e1y, e1z] = [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
    const [e2x, e2y, e2z] = [points[c] - points[a], points[c + 1] - points[a + 1], points[c + 2] - points[a + 2]];
    // After T. Moeller and B. Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
    const [px, py, pz] = [way[1] * e2z - way[2] * e2y, way[2] * e2x - way[0] * e2z, way[0] * e2y - way[1] * e2x];
    const determinant = e1x * px + e1y * py + e1z * pz;
    if (determinant === 0) {
      continue;
    }
    const [sx, sy, sz] = [eye[0] - points[a], eye[1] - points[a + 1], eye[2] - points[a + 2]];
    const u = (sx * px + sy * py + sz * pz) / determinant;
    if (u < 0 || u > 1) {
      continue;
    }
    const [qx, qy, qz] = [sy * e1z - sz * e1y, sz * e1x - sx * e1z, sx * e1y - sy * e1x];
    const v = (way[0] * qx + way[1] * qy + way[2] * qz) / determinant;
    const t = (e2x * qx + e2y * qy + e2z * qz) / determinant;
    if (v >= 0 && u + v <= 1 && t > 0 && t < 0.995) {
      return true;
    }
  }
  return false;
}

/** The direction nearest to `first` from which a place is in sight at this distance; `first` when there is none. */
export function directionTo(place: Vec, distance: number, first: Vec, points: ArrayLike<number>, corners: ArrayLike<number>): Vec {
  const found = directionsAround(first).find((way) => !isHidden(add(place, scale(way, distance)), place, points, corners));
  return found ?? unit(first);
}

/** Part t of the way from one direction to another, around the middle; the long way is never taken. */
export function turnedTowards(from: Vec, to: Vec, t: number): Vec {
  const [a, b] = [unit(from), unit(to)];
  const angle = Math.acos(Math.min(Math.max(dot(a, b), -1), 1));
  if (angle < 1e-4) {
    return b;
  }
  // Opposite directions have no shortest way: any across will do.
  const axis = cross(a, b);
  const across = length(axis) > 1e-6 ? unit(cross(axis, a)) : unit(cross(Math.abs(a[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], a));
  return add(scale(a, Math.cos(angle * t)), scale(across, Math.sin(angle * t)));
}
