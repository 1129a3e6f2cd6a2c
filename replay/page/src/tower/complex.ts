/** The complex of a tower at any moment, and what chains of one moment have become at a later one. */
import type { Drawn } from "../drawn.ts";
import type { Overlay } from "../scene.ts";
import type { Vec } from "../vectors.ts";
import type { ComplexData, Label, Term } from "./data.ts";

/** A simplex by its labels, in increasing order. */
export interface Moment {
  simplices: Label[][];
  /** How many there are, by dimension. */
  counts: number[];
}

/** Numbers as numbers; texts are the larger numbers. */
export function isBefore(a: Label, b: Label): boolean {
  return typeof a === "number" && typeof b === "number" ? a < b : BigInt(a) < BigInt(b);
}

/** Sorted, and whether that takes an odd number of exchanges. */
export function sortedLabels(labels: readonly Label[]): { sorted: Label[]; odd: boolean } {
  const sorted = [...labels];
  let odd = false;
  for (let k = 1; k < sorted.length; ++k) {
    for (let at = k; at > 0 && isBefore(sorted[at], sorted[at - 1]); --at) {
      [sorted[at], sorted[at - 1]] = [sorted[at - 1], sorted[at]];
      odd = !odd;
    }
  }
  return { sorted, odd };
}

const hasTwice = (sorted: readonly Label[]) => sorted.some((label, k) => k > 0 && label === sorted[k - 1]);

/** Vertices from their inclusions on, and which others they have become. */
class Vertices {
  private readonly parents: number[] = [];
  private readonly labels: Label[] = [];
  private readonly current = new Map<Label, number>();

  include(label: Label): void {
    this.current.set(label, this.labels.push(label) - 1);
    this.parents.push(this.labels.length - 1);
  }

  contract(u: Label, v: Label): void {
    this.parents[this.current.get(u)!] = this.current.get(v)!;
    this.current.delete(u);
  }

  node(label: Label): number {
    return this.current.get(label) ?? -1;
  }

  labelOf(node: number): Label {
    let root = node;
    while (this.parents[root] !== root) {
      root = this.parents[root];
    }
    while (this.parents[node] !== root) {
      [this.parents[node], node] = [root, this.parents[node]];
    }
    return this.labels[root];
  }
}

export class TowerComplex {
  constructor(private readonly data: ComplexData) {}

  /** After how many operations the most vertices are there, the last time that they are. */
  get fullest(): number {
    let [vertices, most, found] = [0, 0, 0];
    this.data.dims.forEach((dim, k) => {
      vertices += dim === 0 ? 1 : dim < 0 ? -1 : 0;
      if (vertices >= most) {
        [most, found] = [vertices, k + 1];
      }
    });
    return found;
  }

  /** After so many operations. Cost: the operations. */
  at(operations: number): Moment {
    const vertices = new Vertices();
    const included: number[][] = [];
    let contracts = false;
    this.visit(operations, (dim, labels) => {
      if (dim < 0) {
        vertices.contract(labels[0], labels[1]);
        contracts = true;
      } else {
        if (dim === 0) {
          vertices.include(labels[0]);
        }
        included.push(labels.map((label) => vertices.node(label)));
      }
    });
    const counts: number[] = [];
    const simplices: Label[][] = [];
    const met = new Set<string>();
    for (const nodes of included) {
      const { sorted } = sortedLabels(nodes.map((node) => vertices.labelOf(node)));
      if (contracts) {
        const key = sorted.join();
        if (hasTwice(sorted) || met.has(key)) {
          continue; // squashed, or merged with one that is there
        }
        met.add(key);
      }
      simplices.push(sorted);
      counts[sorted.length - 1] = (counts[sorted.length - 1] ?? 0) + 1;
    }
    return { simplices, counts: Array.from(counts, (count) => count ?? 0) };
  }

  /** What a chain that was there after `from` operations is after `to` of them; over Z/p, or with p = 0 over Q. */
  image(chain: readonly Term[], from: number, to: number, p: number): Term[] {
    const vertices = new Vertices();
    let nodes: number[][] = [];
    const take = (operations: number) => operations === from && (nodes = chain.map(([, labels]) => labels.map((label) => vertices.node(label))));
    take(0);
    let met = 0;
    this.visit(to, (dim, labels) => {
      if (dim < 0) {
        vertices.contract(labels[0], labels[1]);
      } else if (dim === 0) {
        vertices.include(labels[0]);
      }
      take(++met);
    });
    const sums = new Map<string, { labels: Label[]; sum: number }>();
    chain.forEach(([coefficient], k) => {
      const { sorted, odd } = sortedLabels(nodes[k].map((node) => vertices.labelOf(node)));
      if (!hasTwice(sorted)) {
        const key = sorted.join();
        const entry = sums.get(key) ?? { labels: sorted, sum: 0 };
        entry.sum += (odd ? -1 : 1) * valueOf(coefficient);
        sums.set(key, entry);
      }
    });
    const left = p > 0 ? (sum: number) => ((sum % p) + p) % p : (sum: number) => (Math.abs(sum) < 1e-9 ? 0 : sum);
    return [...sums.values()].flatMap(({ labels, sum }) => (left(sum) !== 0 ? [[left(sum), labels] as Term] : []));
  }

  place(label: Label): Vec {
    const k = 3 * Number(label);
    const { points } = this.data;
    return [points[k] ?? 0, points[k + 1] ?? 0, points[k + 2] ?? 0];
  }

  /** Calls visit(dimension or -1, labels) for the first operations. */
  private visit(operations: number, visit: (dim: number, labels: Label[]) => void): void {
    let first = 0;
    for (let k = 0; k < operations; ++k) {
      const dim = this.data.dims[k];
      const size = dim < 0 ? 2 : dim + 1;
      visit(dim, this.data.labels.slice(first, first + size));
      first += size;
    }
  }
}

/** Of a number, or of a fraction as a text. */
function valueOf(coefficient: number | string): number {
  const [above, below] = String(coefficient).split("/").map(Number);
  return above / (below ?? 1);
}

/** Its vertices, edges and triangles; each has its place in the list of simplices as its number. */
export function drawnOf(complex: TowerComplex, { simplices }: Moment): Drawn {
  const drawn: Drawn = { vertices: [], edges: [], faces: [], size: 1, missing: 0 };
  simplices.forEach((labels, cell) => {
    const places = labels.map((label) => complex.place(label));
    if (labels.length === 1) {
      drawn.vertices.push({ cell, at: places[0] });
    } else if (labels.length === 2) {
      drawn.edges.push({ cell, points: places });
    } else if (labels.length === 3) {
      drawn.faces.push({ cell, triangles: places });
    }
  });
  const extent = [0, 1, 2].map((axis) => {
    const all = drawn.vertices.map(({ at }) => at[axis]);
    return all.reduce((high, x) => Math.max(high, x), -Infinity) - all.reduce((low, x) => Math.min(low, x), Infinity);
  });
  drawn.size = drawn.vertices.length > 0 ? Math.hypot(...extent) || 1 : 1;
  return drawn;
}

/** A chain as it is laid over the complex; simplices of more than two dimensions by their triangles. */
export function overlayOf(complex: TowerComplex, chain: readonly Term[], colour: number): Overlay {
  const overlay: Overlay = { generator: -1, colour, points: [], paths: [], faces: [] };
  for (const [, labels] of chain) {
    const places = labels.map((label) => complex.place(label));
    if (places.length === 1) {
      overlay.points.push(places[0]);
    } else if (places.length === 2) {
      overlay.paths.push(places);
    } else {
      for (let a = 0; a < places.length; ++a) {
        for (let b = a + 1; b < places.length; ++b) {
          for (let c = b + 1; c < places.length; ++c) {
            overlay.faces.push({ cell: -1, triangles: [places[a], places[b], places[c]] });
          }
        }
      }
    }
  }
  return overlay;
}
