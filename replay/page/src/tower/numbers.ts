/** Numbers as people read them, ranges and marks of axes. */

/** "1,234,567". */
export function withSeparators(n: number): string {
  return String(n).replace(/\B(?=(\d{3})+$)/g, ",");
}

/** "1 bar", "1,234 bars". */
export function counted(n: number, thing: string): string {
  return `${withSeparators(n)} ${thing}${n === 1 ? "" : "s"}`;
}

/** To six digits; whole numbers in full. */
export function shortNumber(x: number): string {
  if (Math.abs(x) === Infinity) {
    return x > 0 ? "\u221e" : "-\u221e";
  }
  return Number.isInteger(x) && Math.abs(x) < 2 ** 53 ? String(x) : String(Number(x.toPrecision(6)));
}

/** How times are read and written that are counted from an origin. */
export class Times {
  private readonly origin: bigint;

  constructor(origin: string) {
    this.origin = /^-?\d+$/.test(origin) ? BigInt(origin) : 0n;
  }

  text(x: number): string {
    return this.origin !== 0n && Number.isInteger(x) ? String(this.origin + BigInt(x)) : shortNumber(x);
  }

  /** Of a place that somebody points at, which is no time of the input. */
  near(x: number): string {
    return this.origin !== 0n ? this.text(Math.floor(x)) : shortNumber(Number(x.toPrecision(6)));
  }

  /** "[2, 7)". */
  interval(birth: number, death: number): string {
    return `[${this.text(birth)}, ${this.text(death)})`;
  }

  length(birth: number, death: number): string {
    return shortNumber(death - birth);
  }

  /** What was typed, "inf" too; null when it is no number. */
  read(text: string): number | null {
    const word = text.trim().replace(/,/g, "");
    if (this.origin !== 0n && /^[+-]?\d+$/.test(word)) {
      return Number(BigInt(word) - this.origin);
    }
    if (/^[+-]?(inf|infinity|\u221e)$/i.test(word)) {
      return word.startsWith("-") ? -Infinity : Infinity;
    }
    const number = Number(word);
    return word !== "" && !Number.isNaN(number) ? number : null;
  }

  /** The name of an axis, which says from where it counts. */
  axis(name: string): string {
    return this.origin !== 0n ? `${name}, counted from ${this.origin}` : name;
  }
}

/** Never of length 0. */
export interface Range {
  low: number;
  high: number;
}

/** With a part of its length more on both sides, as far as there are numbers whose differences are numbers. */
export function widened(ends: readonly [number, number], part: number): Range {
  const [low, high] = ends.map((x) => Math.min(Math.max(x, -8e307), 8e307));
  const more = (high - low) * part || Math.max(Math.abs(low) * 1e-9, 0.5);
  return { low: low - more, high: high + more };
}

/** Round numbers in a range, about as many as `most` at most. */
export function marksIn({ low, high }: Range, most: number): { value: number; text: string }[] {
  const exact = Math.max(Math.abs(low), Math.abs(high)) * 2 ** -50; // finer ones are no numbers of their own
  const least = Math.max((high - low) / Math.max(most, 1), exact, 1e-300);
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((size) => size >= least * 0.999)!;
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; ++k) {
    const value = k * step + 0; // no -0
    const text = Math.abs(value) >= 1e15 || decimals > 7 ? shortNumber(Number(value.toPrecision(12))) : value.toFixed(decimals);
    marks.push({ value, text: Math.abs(value) >= 10000 && !text.includes("e") ? text.replace(/^-?\d+/, (whole) => whole.replace(/\B(?=(\d{3})+$)/g, ",")) : text });
  }
  return marks;
}
