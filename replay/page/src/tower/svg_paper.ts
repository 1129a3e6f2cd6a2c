/** A picture as an SVG file, for papers. */
import type { Shape } from "./inks.ts";
import { cornersOfSymbol, family, type Paper, type Shades, type TextStyle } from "./paper.ts";

export function escaped(text: string): string {
  const entities: Record<string, string> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return text.replace(/[&<>"]/g, (c) => entities[c]).replace(/[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ufffe\uffff]/g, "\ufffd");
}

const px = (x: number) => String(Math.round(x * 100) / 100);

/** Shades that are told apart; more would make files large and show nothing. */
const levels = 12;

export class SvgPaper implements Paper {
  private readonly parts: string[] = [];

  rect(x: number, y: number, width: number, height: number, colour: string, alpha = 1): void {
    this.parts.push(`<rect x="${px(x)}" y="${px(y)}" width="${px(width)}" height="${px(height)}" fill="${colour}"${opacity("fill", alpha)}/>`);
  }

  segments(ends: readonly number[], colour: string, width: number, alpha = 1): void {
    let path = "";
    for (let k = 0; k + 3 < ends.length; k += 4) {
      path += `M${px(ends[k])} ${px(ends[k + 1])}L${px(ends[k + 2])} ${px(ends[k + 3])}`;
    }
    this.stroke(path, colour, width, [], alpha);
  }

  line(points: readonly number[], colour: string, width: number, dashes: readonly number[] = [], alpha = 1): void {
    let path = "";
    for (let k = 0; k + 1 < points.length; k += 2) {
      path += `${k === 0 ? "M" : "L"}${px(points[k])} ${px(points[k + 1])}`;
    }
    this.stroke(path, colour, width, dashes, alpha);
  }

  symbols(shape: Shape, places: readonly number[], colour: string, alpha = 1): void {
    const corners = cornersOfSymbol(shape);
    const style = `fill="${colour}"${opacity("fill", alpha)}`;
    for (let k = 0; k + 2 < places.length; k += 3) {
      const [x, y, r] = [places[k], places[k + 1], places[k + 2]];
      if (shape === "circle") {
        this.parts.push(`<circle cx="${px(x)}" cy="${px(y)}" r="${px(r)}" ${style}/>`);
      } else {
        const points = corners.map((c, at) => px((at % 2 === 0 ? x : y) + r * c));
        this.parts.push(`<polygon points="${points.join(" ")}" ${style}/>`);
      }
    }
  }

  text(x: number, y: number, text: string, colour: string, { anchor = "start", size = 11, bold = false, upwards = false }: TextStyle = {}): void {
    const turn = upwards ? ` transform="rotate(-90 ${px(x)} ${px(y)})"` : "";
    const style = `font-size="${size}"${bold ? ' font-weight="600"' : ""}${anchor === "start" ? "" : ` text-anchor="${anchor}"`}`;
    this.parts.push(`<text x="${px(x)}" y="${px(y)}" fill="${colour}" ${style}${turn}>${escaped(text)}</text>`);
  }

  /** A path for each of a few shades, of runs along the rows. */
  shades(x: number, y: number, { values, columns, size }: Shades, colour: string): void {
    const paths: string[] = new Array(levels + 1).fill("");
    const levelOf = (value: number) => Math.ceil((value * levels) / 255);
    for (let begin = 0; begin < values.length; ) {
      const row = Math.floor(begin / columns);
      const level = levelOf(values[begin]);
      let end = begin + 1;
      while (end < (row + 1) * columns && levelOf(values[end]) === level) {
        ++end;
      }
      if (level > 0) {
        paths[level] += `M${px(x + (begin - row * columns) * size)} ${px(y + row * size)}h${px((end - begin) * size)}v${px(size)}h${px((begin - end) * size)}z`;
      }
      begin = end;
    }
    paths.forEach((path, level) => {
      if (path) {
        this.parts.push(`<path d="${path}" fill="${colour}"${opacity("fill", level / levels)}/>`);
      }
    });
  }

  /** The whole file. What the description says is not drawn. */
  file(width: number, height: number, title: string, description = ""): string {
    return (
      `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${px(width)} ${px(height)}" width="${px(width)}" ` +
      `height="${px(height)}" font-family="${escaped(family)}" role="img">\n<title>${escaped(title)}</title>\n${description ? `<desc>${escaped(description)}</desc>\n` : ""}${this.parts.join("\n")}\n</svg>\n`
    );
  }

  private stroke(path: string, colour: string, width: number, dashes: readonly number[], alpha: number): void {
    if (path) {
      const dash = dashes.length > 0 ? ` stroke-dasharray="${dashes.join(" ")}"` : "";
      this.parts.push(`<path d="${path}" fill="none" stroke="${colour}" stroke-width="${px(width)}"${dash}${opacity("stroke", alpha)}/>`);
    }
  }
}

function opacity(what: string, alpha: number): string {
  return alpha < 1 ? ` ${what}-opacity="${Math.round(alpha * 1000) / 1000}"` : "";
}
