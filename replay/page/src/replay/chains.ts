/** Chains as they are laid over what is drawn. */
import type { Chain } from "./data.ts";
import type { Drawn } from "../drawn.ts";
import { skeletonOf } from "./geometry.ts";
import type { ObjectState } from "./object.ts";
import type { Overlay } from "../scene.ts";

/** The cells of a chain that are current, drawn in a colour. Of cells of more than two dimensions, their faces. */
export function overlayOf(object: ObjectState, drawn: Drawn, chain: Chain, colour: number, generator = -1): Overlay {
  const cells = new Set<number>();
  for (const [, cell] of chain.terms) {
    const found = cell >= 0 ? object.find(cell) : null;
    if (found && object.isCurrent(found.cell)) {
      skeletonOf(object, found.cell, cells);
    }
  }
  return {
    generator,
    colour,
    points: drawn.vertices.filter(({ cell }) => cells.has(cell)).map(({ at }) => at),
    paths: drawn.edges.filter(({ cell }) => cells.has(cell)).map(({ points }) => points),
    faces: drawn.faces.filter(({ cell }) => cells.has(cell)),
  };
}
