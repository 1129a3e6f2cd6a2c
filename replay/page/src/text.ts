/** Groups and counts of cells as people write them. */

/** Z, Z^2, Z/2 + Z/4, 0; over a field K^n is written with its name. */
export function groupText(ring: string, betti: number, torsion: readonly (number | string)[]): string {
  const parts = torsion.map((order) => `Z/${order}`);
  if (betti > 0) {
    const name = ring.startsWith("Z/") && betti > 1 ? `(${ring})` : ring;
    parts.unshift(betti === 1 ? name : `${name}^${betti}`);
  }
  return parts.length > 0 ? parts.join(" + ") : "0";
}

const kinds = [
  ["vertex", "vertices"],
  ["edge", "edges"],
  ["face", "faces"],
];

/** "1 vertex, 2 edges, 1 face, 3 cells of dimension 4". */
export function cellsText(cells: readonly number[]): string {
  const parts = cells.map((count, p) => {
    const [one, many] = kinds[p] ?? [`cell of dimension ${p}`, `cells of dimension ${p}`];
    return `${count} ${count === 1 ? one : many}`;
  });
  return parts.length > 0 ? parts.join(", ") : "no cells";
}
