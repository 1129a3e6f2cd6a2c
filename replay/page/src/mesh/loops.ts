/** Which loops are listed, and how they are drawn. */
import type { Loop, Measure, Side } from "./data.ts";
import { length, mix, sub, type Vec } from "../vectors.ts";

/** As a number; of what is beyond those, infinity or 0. */
export function lengthOf({ length }: { length: Measure }): number {
  return Number(length);
}

/** The numbers of the loops, the shortest first. */
export function byLength(loops: readonly Loop[]): number[] {
  return loops.map((_, k) => k).sort((a, b) => lengthOf(loops[a]) - lengthOf(loops[b]) || a - b);
}

/** As `--shorter-than` has it: loops of that length are left out. */
export function shorterThan(loops: readonly Loop[], order: readonly number[], limit: number): number[] {
  return order.filter((k) => lengthOf(loops[k]) < limit);
}

/** A slider for lengths has so many steps, spread over their powers: what is noise may be a thousand times as short. */
export const sliderSteps = 200;

/** Limits of lengths from just above nothing to all. */
export class LengthScale {
  private readonly low: number;
  private readonly high: number;

  constructor(lengths: readonly number[]) {
    const known = lengths.filter((x) => x > 0 && Number.isFinite(x));
    this.low = known.length > 0 ? Math.min(...known) : 1;
    this.high = known.length > 0 ? Math.max(...known) * 1.01 : 1;
  }

  /** At the last step all loops are listed. */
  limitAt(step: number): number {
    return step >= sliderSteps ? Infinity : this.low * (this.high / this.low) ** (step / (sliderSteps - 1));
  }

  stepOf(limit: number): number {
    if (!(limit < this.high)) {
      return sliderSteps;
    }
    const part = Math.log(limit / this.low) / Math.log(this.high / this.low || 1);
    return Math.min(Math.max(Math.round(part * (sliderSteps - 1)), 0), sliderSteps - 1);
  }
}

/** Lengths of dashes and gaps, as parts of a unit; an unbroken line has none. So sides differ without colour. */
export const dashes: Record<"handle" | "tunnel" | "none", [number, number] | null> = { handle: null, tunnel: [2.4, 1.4], none: [0.5, 1.3] };

export function dashOf(side: Side): [number, number] | null {
  return dashes[side ?? "none"];
}

/**
 * The segments of a line that is cut into dashes, so long each with gaps so long between them: along the segments as they
 * follow, whatever their own lengths.
 */
export function dashed(segments: readonly (readonly [Vec, Vec])[], dash: number, gap: number): (readonly [Vec, Vec])[] {
  const cut: (readonly [Vec, Vec])[] = [];
  let done = 0;
  for (const [from, to] of segments) {
    const size = length(sub(to, from));
    for (let at = 0; at < size; ) {
      const phase = (done + at) % (dash + gap);
      const isDrawn = phase < dash;
      const rest = Math.max(isDrawn ? dash - phase : dash + gap - phase, 1e-6 * (dash + gap));
      const end = Math.min(at + rest, size);
      if (isDrawn) {
        cut.push([mix(from, to, at / size), mix(from, to, end / size)]);
      }
      at = end;
    }
    done += size;
  }
  return cut;
}
