/** Chains, cells and what there is to say of a replay. */
import { groupText } from "../text.ts";
import { type Chain, type Data, type Numbers, stepOf } from "./data.ts";
import type { ObjectState } from "./object.ts";

export function groupsText(ring: string, numbers: Numbers): string {
  if (numbers.betti.length === 0) {
    return "nothing there";
  }
  return numbers.betti.map((betti, p) => `H${p} = ${groupText(ring, betti, numbers.torsion[p] ?? [])}`).join(", ");
}

/** What a type is called that one points at. */
export function typeText(type: readonly number[]): string {
  if (type[0] === 0) {
    return type[1] === 2 ? `polygon with ${type[2]} ${type[2] === 1 ? "side" : "sides"}` : `cell of dimension ${type[1]}`;
  }
  if (type[0] < 0) {
    return `cell of dimension ${type[1]}, known by its boundary`;
  }
  const dimension = type.reduce((sum, part) => sum + part, 0);
  if (dimension === 0) {
    return "vertex";
  }
  if (type.length === 1) {
    return ["", "edge", "triangle", "tetrahedron"][dimension] ?? `simplex of dimension ${dimension}`;
  }
  if (type.every((part) => part === 1)) {
    return ["", "", "square", "cube"][dimension] ?? `cube of dimension ${dimension}`;
  }
  return type.join(",") === "2,1" || type.join(",") === "1,2" ? "prism" : `simploid [${type.join(",")}]`;
}

/** A chain as a `class` step takes it. */
export function chainJson(chain: Chain, nameOf: (cell: number) => string): string {
  const terms = chain.terms.map(([coefficient, cell, name]) => {
    const number = /^-?\d{1,15}$/.test(coefficient) ? Number(coefficient) : coefficient;
    return JSON.stringify([number, name ?? nameOf(cell)]);
  });
  return `[${terms.join(",")}]`;
}

/** "a - 2 b + c"; nothing is "0". */
export function chainSum(chain: Chain, nameOf: (cell: number) => string, most = 40): string {
  if (chain.length !== undefined) {
    return `a chain of ${chain.length} terms, which is too long for this page`;
  }
  if (chain.length_at_most !== undefined) {
    return `a chain of at most ${chain.length_at_most} terms, which is too long for this page`;
  }
  let text = "";
  for (const [coefficient, cell, name] of chain.terms.slice(0, most)) {
    const minus = coefficient.startsWith("-");
    const size = minus ? coefficient.slice(1) : coefficient;
    text += text === "" ? (minus ? "-" : "") : minus ? " - " : " + ";
    text += (size === "1" ? "" : `${size} `) + (name ?? nameOf(cell));
  }
  const more = chain.terms.length - most;
  return (text || "0") + (more > 0 ? ` + ... (${more} more terms)` : "");
}

/** What the page should be known for not showing, a sentence each. */
export function remarksOf(data: Data, object: ObjectState): string[] {
  const { counts } = data.places;
  const remarks: string[] = [];
  if (data.notes) {
    remarks.push(data.notes);
  }
  if (data.left_out > 0) {
    remarks.push(
      `${data.left_out} cells are not shown: the page has the first ${data.limits.cells} that were made. Numbers and ` +
        "groups are those of the whole object.",
    );
  }
  if (data.families_left_out > 0) {
    remarks.push(
      `${data.families_left_out} products or large cones have more than ${data.limits.cells_of_family} cells and are ` +
        "not shown. Numbers and groups are those of the whole object.",
    );
  }
  if (data.stride > 1) {
    remarks.push(`There are ${data.steps.length} steps, more than ${data.limits.steps}: the page stops at every ${data.stride}th, and says nothing of the others but what has changed until the next stop.`);
  }
  if (data.generators_until !== undefined) {
    remarks.push(`Generators are those of the first ${data.generators_until} steps and of the last one: to follow them through all ${data.steps.length} takes too long.`);
  }
  if (object.topDimension > 3) {
    remarks.push("The object has more than three dimensions at times: its vertices, edges and faces are drawn.");
  }
  if (counts.computed > 0) {
    remarks.push(
      counts.given > 0
        ? `${counts.computed} of the vertices have no position in the script: their places are computed.`
        : "The script gives no positions: those here are computed from what is joined to what.",
    );
  }
  if (counts.sum > 0) {
    remarks.push("Vertices of a product are at the sum of the places of their factors.");
  }
  if (counts.beside > 0) {
    remarks.push("A vertex that is split off is drawn a little beside the one that it was split from.");
  }
  if (data.steps.some((step) => (stepOf(step).removed?.length ?? 0) > 0)) {
    remarks.push("What is glued together is drawn where its oldest vertex is, which also keeps its name.");
  }
  return remarks;
}
