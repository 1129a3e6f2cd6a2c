/** What there is to say of a mesh. */
import type { Box, Component, Data, Loop, Measure, Mesh } from "./data.ts";
import type { Vec } from "../vectors.ts";

/** What coordinates of the page, which are floats, may be off by. */
export const roundingOfPage = 2e-7;

export function counted(count: number, one: string, many: string): string {
  return `${count} ${count === 1 ? one : many}`;
}

/** Six digits, as the table of the program has them. */
export function numberText(x: Measure): string {
  return typeof x === "string" ? x : String(Number(x.toPrecision(6)));
}

/** Coordinates that are zero but for rounding, measured by `size`, read 0. */
export function pointText(point: Vec, size: number, rounding = 1e-12): string {
  return `(${point.map((x) => numberText(Math.abs(x) < rounding * size ? 0 : Number(x.toPrecision(5)))).join(", ")})`;
}

/** The largest coordinate of a box. */
export function sizeOfBox(box: Box): number {
  return Math.max(...box.flat().map(Math.abs));
}

export function boxText(box: Box, rounding = 1e-12): string {
  const size = sizeOfBox(box);
  return `${pointText(box[0], size, rounding)} to ${pointText(box[1], size, rounding)}`;
}

export function verdictText(data: Data): string {
  const what = !data.manifold ? "Not a surface" : data.closed ? "A closed surface" : "A surface with boundary";
  return `${what}, ${counted(data.components_in_all, "component", "components")}.`;
}

export function meetingsText(data: Data): string {
  const { meetings_in_all: count, meetings_complete: isComplete } = data;
  if (data.faces === 0) {
    return "";
  }
  if (count === 0) {
    return isComplete ? "It does not meet itself." : "Whether it meets itself is not known: too many faces are near each other.";
  }
  return `It meets itself: ${isComplete ? "" : "at least "}${counted(count, "pair of faces has", "pairs of faces have")} more in common than vertices and edges.`;
}

export function orientationText(data: Data, reversed: number): string {
  if (data.faces === 0) {
    return "";
  }
  if (!data.orientable) {
    return "Not orientable.";
  }
  return data.consistently_oriented
    ? "Orientable, and the faces agree."
    : `Orientable, but the faces disagree across ${counted(reversed, "edge", "edges")}.`;
}

export function componentText(component: Component): string {
  const { vertices, edges, faces, euler, closed, boundary_loops, orientable, manifold, genus } = component;
  const parts = [counted(vertices, "vertex", "vertices"), counted(edges, "edge", "edges"), counted(faces, "face", "faces"), `Euler characteristic ${euler}`];
  if (faces === 0) {
    parts.push(edges === 0 ? "a point" : "lines only");
  } else {
    parts.push(closed ? "closed" : counted(boundary_loops, "boundary loop", "boundary loops"));
    parts.push(...(orientable ? [] : ["not orientable"]), ...(manifold ? [] : ["not a surface"]), ...(genus === null ? [] : [`genus ${genus}`]));
  }
  return parts.join(", ");
}

/** What a group means, in a few words. */
export function meaningText(data: Data, degree: number): string {
  const betti = data.betti[degree] ?? 0;
  const torsion = (data.torsion[degree] ?? []).length;
  if (degree === 0) {
    return counted(betti, "connected piece", "connected pieces");
  }
  if (degree === 2) {
    return betti === 0 ? "no cavities" : counted(betti, "cavity: a closed surface that encloses space", "cavities: closed surfaces that enclose space");
  }
  const free = betti === 0 ? (torsion > 0 ? "no tunnels" : "no tunnels: every loop is filled in") : counted(betti, "independent loop that nothing fills in", "independent loops that nothing fills in");
  return torsion > 0 ? `${free}; torsion: loops that are filled in only when they are run several times` : free;
}

export function sideText({ side }: Pick<Loop, "side">): string {
  return side ?? "no side";
}

/** What it means that a loop is on this side. */
export function sideMeaning(loop: Loop, components: readonly Component[]): string {
  if (loop.side === "handle") {
    return "It bounds inside its surface: a disc across it would cut a handle.";
  }
  if (loop.side === "tunnel") {
    return "It bounds outside its surface: a disc across it would close a tunnel.";
  }
  const why = components[loop.component]?.unsorted;
  return why ? `It has no side: ${why}.` : "It has no side.";
}

export function orderText(order: string): string {
  return order === "0" ? "" : `${order} times it bounds`;
}

/** The vertices along a loop, by their numbers in the file; the two ends of each edge where it is not one walk. */
export function verticesText(loop: Loop, mesh: Mesh): string {
  const ends = loop.edges.map((point) => mesh.inFile(point));
  if (loop.closed) {
    return ends.filter((_, k) => k % 2 === 0).join(" ");
  }
  return Array.from({ length: ends.length / 2 }, (_, k) => `${ends[2 * k]}-${ends[2 * k + 1]}`).join(" ");
}

/** Which row of the table of vertices a click meets. */
export function vertexText(point: number, mesh: Mesh): string {
  const place = mesh.toFile(mesh.at(point));
  const size = Math.max(...place.map(Math.abs));
  const name = mesh.isMade(point) ? "point in the middle of a polygon" : `vertex ${mesh.inFile(point)}`;
  return `${name} at ${pointText(place, size, roundingOfPage)}`;
}
