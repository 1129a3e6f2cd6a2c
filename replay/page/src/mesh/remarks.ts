/** What the page should be known for not showing, and what is to be known of what it shows. */
import type { Data } from "./data.ts";

export function remarksOf(data: Data): string[] {
  const remarks: string[] = [];
  if (data.stride > 1) {
    remarks.push(
      `The mesh has ${data.triangles_in_all} triangles, more than a page has room for: one of ${data.stride} is drawn, and of edges likewise. ` +
        "Numbers, loops and places are those of the whole mesh.",
    );
  }
  if (!data.generators) {
    remarks.push("Loops and closed surfaces were not looked for (--generators-limit 0).");
  }
  const cut = (shown: number, all: number, what: string) => {
    if (shown < all) {
      remarks.push(`${shown} of ${all} ${what} are on this page; sesame mesh --json has all of them.`);
    }
  };
  cut(data.loops.length, data.loops_in_all, "loops, the shortest ones,");
  cut(data.surfaces.length, data.surfaces_in_all, "closed surfaces");
  cut(data.components.length, data.components_in_all, "components");
  for (const kind of ["degenerate", "duplicate", "folded"] as const) {
    cut(data.bad_faces[kind].length, data.bad_faces[`${kind}_in_all`], `${kind} faces`);
  }
  if (data.polygons > 0) {
    remarks.push(`${data.polygons} of the faces have more than three corners: they were cut into triangles, whose sides inside of a face are not drawn.`);
  }
  if (data.loops.some(({ side }) => side !== null)) {
    remarks.push("A handle loop bounds inside its surface, so a disc there would cut a handle; a tunnel loop bounds outside, so a disc there would close a tunnel. Each closed surface is looked at as if it were alone.");
  }
  if (data.loops.some(({ short }) => short)) {
    remarks.push("Loops are the shortest that were found: this is a search, not a proof. Other loops through the same tunnels, and sums of them, would do as well.");
  }
  if (data.numbers === null) {
    remarks.push("Vertices are counted from 0 as the file lists them.");
  } else {
    remarks.push("Vertices are counted from 0 as the file lists them; those on no face and no line are left out.");
  }
  return [...remarks, ...data.remarks.map((remark) => `${remark[0].toUpperCase()}${remark.slice(1)}.`)];
}
