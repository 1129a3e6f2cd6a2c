/** Chains of cells that were, as chains of the cells that these have become. */
import type { Chain, Term } from "./data.ts";
import type { ObjectState } from "./object.ts";

type Fraction = readonly [bigint, bigint];

function fraction(text: string): Fraction {
  const [above, below = "1"] = text.split("/");
  return [BigInt(above), BigInt(below)];
}

function sum([a, b]: Fraction, [c, d]: Fraction): Fraction {
  const [above, below] = [a * d + c * b, b * d];
  let [x, y] = [above < 0n ? -above : above, below];
  while (y !== 0n) {
    [x, y] = [y, x % y];
  }
  return x === 0n ? [0n, 1n] : [above / x, below / x];
}

const text = ([above, below]: Fraction) => (below === 1n ? `${above}` : `${above}/${below}`);

/** The chain in the object as it is now: cells that are one now are added up, degenerate ones are 0. */
export function carried(object: ObjectState, chain: Chain): Chain {
  const sums = new Map<number, Fraction>();
  const others: Term[] = [];
  for (const term of chain.terms) {
    const [coefficient, cell] = term;
    const found = cell >= 0 ? object.find(cell) : null;
    if (!found) {
      others.push(term);
    } else if (!found.squashed) {
      const [above, below] = fraction(coefficient);
      sums.set(found.cell, sum(sums.get(found.cell) ?? [0n, 1n], [found.turned ? -above : above, below]));
    }
  }
  const terms = [...sums].filter(([, [above]]) => above !== 0n).map(([cell, value]): Term => [text(value), cell]);
  return { ...chain, terms: [...terms, ...others] };
}
