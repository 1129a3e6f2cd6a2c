/** What is drawn at one moment: points, curves and triangles, each with the cell that it belongs to. */
import type { Vec } from "./vectors.ts";

/** Triangles, three points each. */
export type Triangles = Vec[];

export interface Drawn {
  /** Current vertices, and where they are. */
  vertices: { cell: number; at: Vec }[];
  /** Edges as broken lines. */
  edges: { cell: number; points: Vec[] }[];
  faces: { cell: number; triangles: Triangles }[];
  /** The diagonal of the box around all places of vertices. */
  size: number;
  /** Current cells that cannot be drawn: something that they need is not shown, or all faces of a solid are squashed. */
  missing: number;
}
