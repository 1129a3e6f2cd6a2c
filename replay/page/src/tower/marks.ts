/** The symbol of a dimension in texts, as in the diagram. */
import { shapeOf } from "./inks.ts";

const signs = { circle: "\u25cf", square: "\u25a0", triangle: "\u25b2", diamond: "\u25c6" };

export function dimensionMark(dim: number): HTMLSpanElement {
  const mark = document.createElement("span");
  mark.className = `sign h${dim % 8}`;
  mark.setAttribute("aria-hidden", "true");
  mark.textContent = signs[shapeOf(dim)];
  return mark;
}
