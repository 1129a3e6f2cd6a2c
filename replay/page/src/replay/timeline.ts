/** Betti numbers, torsion and the Euler characteristic over the steps, as a picture that can be clicked. */
import type { Numbers } from "./data.ts";

const svgName = "http://www.w3.org/2000/svg";
/** The margins, for marks. */
const left = 46;
const right = 20;
const dashes = ["", "7 3", "2 3", "9 3 2 3", "1 2"];

function element<K extends keyof SVGElementTagNameMap>(name: K, attributes: Record<string, string | number>, text = ""): SVGElementTagNameMap[K] {
  const made = document.createElementNS(svgName, name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, String(value));
  }
  made.textContent = text;
  return made;
}

/**
 * The corners of a curve of levels, each from one step to the next one that is listed, the last one to `end`: only where
 * the value changes, so long histories are short paths.
 */
export function stepPath(values: readonly number[], steps: readonly number[], end: number, x: (step: number) => number, y: (value: number) => number): string {
  let path = "";
  let last: number | null = null;
  const round = (v: number) => Math.round(v * 10) / 10;
  values.forEach((value, k) => {
    const at = round(x(steps[k]));
    if (last === null) {
      path = `M${at},${round(y(value))}`;
    } else if (value !== last) {
      path += `H${at}V${round(y(value))}`;
    }
    last = value;
  });
  return values.length > 0 ? `${path}H${round(x(end))}` : "";
}

/** Round values at which an axis has marks, some four of them. */
export function marksOf(low: number, high: number): number[] {
  const span = Math.max(high - low, 1);
  const power = 10 ** Math.floor(Math.log10(span / 4 || 1));
  const step = Math.max(1, [1, 2, 5, 10].map((m) => m * power).find((s) => span / s <= 5) ?? span);
  const marks = [];
  for (let value = Math.ceil(low / step) * step; value <= high; value += step) {
    marks.push(value);
  }
  return marks;
}

/** Runs of steps with torsion, and what it is. */
export function torsionRuns(numbers: readonly Numbers[]): { from: number; to: number; text: string }[] {
  const runs: { from: number; to: number; text: string }[] = [];
  let open: { from: number; to: number; text: string } | null = null;
  numbers.forEach(({ torsion, steps }) => {
    const parts = torsion.flatMap((orders, p) => (orders.length > 0 ? [`H${p}: ${orders.map((t) => `Z/${t}`).join(" + ")}`] : []));
    const text = parts.join(", ");
    if (open && open.text === text) {
      open.to = steps;
    } else {
      open = text ? { from: steps, to: steps, text } : null;
      if (open) {
        runs.push(open);
      }
    }
  });
  return runs;
}

export class Timeline {
  private cursor: SVGElement | null = null;
  private x: (step: number) => number = () => 0;
  private now = 0;

  constructor(private readonly svg: SVGSVGElement, private numbers: readonly Numbers[], onJump: (step: number) => void) {
    let isDown = false;
    const jump = (event: PointerEvent) => {
      const box = this.svg.getBoundingClientRect();
      const share = (event.clientX - box.left - left) / Math.max(box.width - left - right, 1);
      onJump(Math.floor(Math.min(Math.max(share, 0), 0.999999) * this.count));
    };
    this.svg.addEventListener("pointerdown", (event) => {
      isDown = true;
      this.svg.setPointerCapture(event.pointerId);
      jump(event);
    });
    this.svg.addEventListener("pointermove", (event) => isDown && jump(event));
    this.svg.addEventListener("pointerup", () => (isDown = false));
  }

  /** The levels, from that before the first step to that after the last one. */
  private get count(): number {
    return this.numbers[this.numbers.length - 1].steps + 1;
  }

  setNumbers(numbers: readonly Numbers[]): void {
    this.numbers = numbers;
  }

  draw(width: number, height: number): void {
    this.svg.replaceChildren();
    this.svg.classList.toggle("dense", this.count > width); // several steps to a pixel
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const count = this.count;
    const steps = this.numbers.map((numbers) => numbers.steps);
    const runs = torsionRuns(this.numbers);
    const bottom = height - 16 - (runs.length > 0 ? 14 : 0);
    this.x = (step) => left + (step / count) * (width - left - right);
    const dimensions = this.numbers.reduce((most, { betti }) => Math.max(most, betti.length), 0);
    const curves = Array.from({ length: dimensions }, (_, p) => this.numbers.map(({ betti }) => betti[p] ?? 0));
    const euler = this.numbers.map((numbers) => numbers.euler);
    let [low, high] = [0, 1];
    for (const curve of [...curves, euler]) {
      for (const value of curve) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    const y = (value: number) => 8 + ((high - value) / (high - low)) * (bottom - 8);
    for (const value of marksOf(low, high)) {
      this.svg.append(
        element("line", { class: "grid", x1: left, x2: width - right, y1: y(value), y2: y(value) }),
        element("text", { class: "mark", x: left - 5, y: y(value) + 3.5, "text-anchor": "end" }, String(value)),
      );
    }
    for (const value of marksOf(0, count - 1)) {
      this.svg.append(element("text", { class: "mark", x: this.x(value + 0.5), y: height - 3, "text-anchor": "middle" }, String(value)));
    }
    for (const { from, to, text } of runs) {
      const bar = element("rect", { class: "torsion", x: this.x(from), y: bottom + 4, width: this.x(to + 1) - this.x(from), height: 8, rx: 2 });
      bar.append(element("title", {}, `torsion from step ${from} to ${to}: ${text}`));
      this.svg.append(bar);
    }
    this.svg.append(element("path", { class: "euler", d: stepPath(euler, steps, count, this.x, y) }));
    curves.forEach((curve, p) => {
      const apart = (value: number) => y(value) + 1.6 * (p - (dimensions - 1) / 2); // or equal ones would hide each other
      this.svg.append(element("path", { class: `betti h${p % 8}`, d: stepPath(curve, steps, count, this.x, apart), "stroke-dasharray": dashes[p % dashes.length] }));
    });
    this.cursor = element("rect", { class: "cursor", y: 1, height: bottom + 13 });
    this.svg.prepend(this.cursor);
    this.setStep(this.now);
  }

  setStep(step: number): void {
    this.now = step;
    this.cursor?.setAttribute("x", String(this.x(step)));
    this.cursor?.setAttribute("width", String(Math.max(this.x(step + 1) - this.x(step), 2)));
  }
}
