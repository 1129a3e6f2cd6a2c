/** A line as loops of a side are drawn: its colour, and its dashes. */
import type { Side } from "./data.ts";
import { dashOf } from "./loops.ts";

const svgName = "http://www.w3.org/2000/svg";

export function lineSwatch(side: Side): SVGSVGElement {
  const picture = document.createElementNS(svgName, "svg");
  picture.setAttribute("class", `swatch-line ${side ?? "none"}`);
  picture.setAttribute("viewBox", "0 0 40 10");
  picture.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(svgName, "line");
  const dash = dashOf(side);
  const attributes = { x1: 1, x2: 39, y1: 5, y2: 5, "stroke-width": 5, "stroke-dasharray": dash ? dash.map((part) => part * 4).join(" ") : "none" };
  Object.entries(attributes).forEach(([name, value]) => line.setAttribute(name, String(value)));
  picture.append(line);
  return picture;
}
