/**
 * What is drawn at a point of the screen. All is projected at once, in plain loops over lists of numbers: that takes
 * milliseconds for 100,000 triangles, and reaches are in pixels, so that points and edges can be met however far they are.
 */

/** A camera: the matrix from space to clip coordinates, column by column, and the size of the screen in pixels. */
export interface Lens {
  matrix: ArrayLike<number>;
  width: number;
  height: number;
}

/** Points on the screen, three numbers each: x, y, and 1 / distance from the camera, which is 0 for what is behind it. */
export type Screen = Float32Array;

export interface Hit {
  index: number;
  /** 1 / distance from the camera: larger is nearer. */
  nearness: number;
}

export function projected({ matrix: m, width, height }: Lens, points: ArrayLike<number>): Screen {
  const screen = new Float32Array(points.length);
  for (let k = 0; k < points.length; k += 3) {
    const [x, y, z] = [points[k], points[k + 1], points[k + 2]];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w > 1e-12) {
      screen[k] = (((m[0] * x + m[4] * y + m[8] * z + m[12]) / w + 1) * width) / 2;
      screen[k + 1] = ((1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * height) / 2;
      screen[k + 2] = 1 / w;
    }
  }
  return screen;
}

/** The nearest triangle that covers a point. `corners`: numbers of points, three for each; or all points in a row. */
export function triangleAt(screen: Screen, corners: ArrayLike<number> | null, x: number, y: number): Hit | null {
  let found: Hit | null = null;
  const count = corners ? corners.length : screen.length / 3;
  for (let k = 0; k + 2 < count; k += 3) {
    const a = 3 * (corners ? corners[k] : k);
    const b = 3 * (corners ? corners[k + 1] : k + 1);
    const c = 3 * (corners ? corners[k + 2] : k + 2);
    if (screen[a + 2] === 0 || screen[b + 2] === 0 || screen[c + 2] === 0) {
      continue;
    }
    const [ax, ay, bx, by, cx, cy] = [screen[a] - x, screen[a + 1] - y, screen[b] - x, screen[b + 1] - y, screen[c] - x, screen[c + 1] - y];
    const [u, v, w] = [bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx];
    const area = u + v + w;
    if (area === 0 || Math.min(u, v, w) * Math.max(u, v, w) < 0) {
      continue;
    }
    const nearness = (u * screen[a + 2] + v * screen[b + 2] + w * screen[c + 2]) / area;
    if (!found || nearness > found.nearness) {
      found = { index: k / 3, nearness };
    }
  }
  return found;
}

/** The segment that passes nearest to a point, within `reach` pixels, and no farther away than `farthest` allows. */
export function segmentAt(screen: Screen, ends: ArrayLike<number> | null, x: number, y: number, reach: number, farthest = 0): Hit | null {
  let found: Hit | null = null;
  let best = reach;
  const count = ends ? ends.length : screen.length / 3;
  for (let k = 0; k + 1 < count; k += 2) {
    const a = 3 * (ends ? ends[k] : k);
    const b = 3 * (ends ? ends[k + 1] : k + 1);
    if (screen[a + 2] === 0 || screen[b + 2] === 0) {
      continue;
    }
    const [dx, dy, px, py] = [screen[b] - screen[a], screen[b + 1] - screen[a + 1], x - screen[a], y - screen[a + 1]];
    const t = Math.min(Math.max((px * dx + py * dy) / (dx * dx + dy * dy || 1), 0), 1);
    const distance = Math.hypot(px - t * dx, py - t * dy);
    const nearness = screen[a + 2] * (1 - t) + screen[b + 2] * t;
    if (distance < best && nearness >= farthest) {
      best = distance;
      found = { index: k / 2, nearness };
    }
  }
  return found;
}

/** The point nearest to a place on the screen, in the same way. */
export function pointAt(screen: Screen, x: number, y: number, reach: number, farthest = 0): Hit | null {
  let found: Hit | null = null;
  let best = reach;
  for (let k = 0; k < screen.length; k += 3) {
    if (screen[k + 2] > 0 && screen[k + 2] >= farthest) {
      const distance = Math.hypot(screen[k] - x, screen[k + 1] - y);
      if (distance < best) {
        best = distance;
        found = { index: k / 3, nearness: screen[k + 2] };
      }
    }
  }
  return found;
}
