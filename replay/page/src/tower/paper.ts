/** What pictures are drawn on: a canvas, or an SVG file. A picture does not know which. */
import type { Shape } from "./inks.ts";

export interface TextStyle {
  anchor?: "start" | "middle" | "end";
  size?: number;
  bold?: boolean;
  /** Turned to be read from below. */
  upwards?: boolean;
}

/** Shades of one colour in little squares, row by row, from 0 (nothing) to 255. */
export interface Shades {
  values: Uint8Array;
  columns: number;
  /** The side of a square, in pixels. */
  size: number;
}

/** Coordinates are pixels. Lists of them are flat. */
export interface Paper {
  rect(x: number, y: number, width: number, height: number, colour: string, alpha?: number): void;
  /** Segments: x1, y1, x2, y2 each. */
  segments(ends: readonly number[], colour: string, width: number, alpha?: number): void;
  /** A broken line: x, y each. */
  line(points: readonly number[], colour: string, width: number, dashes?: readonly number[], alpha?: number): void;
  /** Symbols: x, y, radius each. */
  symbols(shape: Shape, places: readonly number[], colour: string, alpha?: number): void;
  text(x: number, y: number, text: string, colour: string, style?: TextStyle): void;
  shades(x: number, y: number, shades: Shades, colour: string): void;
}

/** The corners of a symbol about (0, 0), of radius 1; a circle has none. */
export function cornersOfSymbol(shape: Shape): readonly number[] {
  return {
    circle: [],
    square: [-0.9, -0.9, 0.9, -0.9, 0.9, 0.9, -0.9, 0.9],
    triangle: [0, -1.15, 1.15, 0.92, -1.15, 0.92],
    diamond: [0, -1.25, 1.25, 0, 0, 1.25, -1.25, 0],
  }[shape];
}

export const family = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export class CanvasPaper implements Paper {
  constructor(private readonly context: CanvasRenderingContext2D) {}

  rect(x: number, y: number, width: number, height: number, colour: string, alpha = 1): void {
    this.set(colour, 1, alpha);
    this.context.fillRect(x, y, width, height);
  }

  segments(ends: readonly number[], colour: string, width: number, alpha = 1): void {
    this.set(colour, width, alpha);
    this.context.beginPath();
    for (let k = 0; k + 3 < ends.length; k += 4) {
      this.context.moveTo(ends[k], ends[k + 1]);
      this.context.lineTo(ends[k + 2], ends[k + 3]);
    }
    this.context.stroke();
  }

  line(points: readonly number[], colour: string, width: number, dashes: readonly number[] = [], alpha = 1): void {
    this.set(colour, width, alpha);
    this.context.setLineDash([...dashes]);
    this.context.beginPath();
    for (let k = 0; k + 1 < points.length; k += 2) {
      this.context.lineTo(points[k], points[k + 1]);
    }
    this.context.stroke();
    this.context.setLineDash([]);
  }

  symbols(shape: Shape, places: readonly number[], colour: string, alpha = 1): void {
    this.set(colour, 1, alpha);
    const corners = cornersOfSymbol(shape);
    for (let k = 0; k + 2 < places.length; k += 3) {
      const [x, y, r] = [places[k], places[k + 1], places[k + 2]];
      this.context.beginPath();
      if (shape === "circle") {
        this.context.arc(x, y, r, 0, 2 * Math.PI);
      }
      for (let c = 0; c + 1 < corners.length; c += 2) {
        this.context.lineTo(x + r * corners[c], y + r * corners[c + 1]);
      }
      this.context.fill();
    }
  }

  text(x: number, y: number, text: string, colour: string, { anchor = "start", size = 11, bold = false, upwards = false }: TextStyle = {}): void {
    this.set(colour, 1, 1);
    this.context.font = `${bold ? 600 : 400} ${size}px ${family}`;
    this.context.textAlign = anchor === "middle" ? "center" : anchor;
    this.context.save();
    this.context.translate(x, y);
    this.context.rotate(upwards ? -Math.PI / 2 : 0);
    this.context.fillText(text, 0, 0);
    this.context.restore();
  }

  shades(x: number, y: number, { values, columns, size }: Shades, colour: string): void {
    if (values.length === 0 || columns === 0) {
      return;
    }
    const rows = values.length / columns;
    const image = new ImageData(columns, rows);
    const ink = parseInt(colour.slice(1), 16);
    for (let k = 0; k < values.length; ++k) {
      image.data[4 * k] = ink >> 16;
      image.data[4 * k + 1] = (ink >> 8) & 255;
      image.data[4 * k + 2] = ink & 255;
      image.data[4 * k + 3] = values[k];
    }
    const sheet = document.createElement("canvas");
    sheet.width = columns;
    sheet.height = rows;
    sheet.getContext("2d")!.putImageData(image, 0, 0);
    this.context.globalAlpha = 1;
    this.context.imageSmoothingEnabled = false;
    this.context.drawImage(sheet, x, y, columns * size, rows * size);
  }

  private set(colour: string, width: number, alpha: number): void {
    this.context.fillStyle = colour;
    this.context.strokeStyle = colour;
    this.context.lineWidth = width;
    this.context.globalAlpha = alpha;
  }
}
