#!/usr/bin/env python3
"""The barcode of a tower by brute force: the slow twin of `sesame tower`.

    tower_oracle.py [--ring Z/p] FILE        (FILE may be - for standard input)

Reads the tower format: `[t] i v0 ... vd` includes a simplex, `[t] c u v` contracts vertex u into v. Prints one JSON
object {"ring":"Z/2","ops":N,"bars":[[dim,birth,death or null],...]}, as `sesame tower --json` but for `hidden` and
`seconds`.

For all times i <= j the rank of the map H(X_i) -> H(X_j) is found: a basis of H(X_i) is sent through the simplicial
maps in between, and counted modulo the boundaries of X_j. Operations of equal time are one map. The number of bars
[i, j) is then r(i, j-1) - r(i-1, j-1) - r(i, j) + r(i-1, j). Nothing here knows of pairs, of reductions of a filtration
or of an order of generators.

Exit status: 0 done, 1 wrong usage or unreadable file, 2 the tower is wrong.
"""

import argparse
import json
import sys


class TowerError(Exception):
    """The tower is wrong."""


# ------------------------------------------------------------------------------------------------------- the towers


class Operation:
    """An insertion of `labels`, or a contraction of labels[0] into labels[1]."""

    def __init__(self, time, kind, labels):
        self.time, self.kind, self.labels = time, kind, labels


def parse(lines):
    """The operations of a tower."""
    operations = []
    for number, line in enumerate(lines, 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        time = len(operations)
        if words[0] not in ("i", "c"):
            time = float(words.pop(0))
        kind, labels = words[0], [int(word) for word in words[1:]]
        if not labels or len(set(labels)) < len(labels) or (kind == "c" and len(labels) != 2):
            raise TowerError(f"line {number}: {line.strip()}")
        if operations and time < operations[-1].time:
            raise TowerError(f"line {number}: times should not decrease")
        operations.append(Operation(time, kind, labels))
    return operations


def after(simplices, operation):
    """The complex, a set of ascending tuples, after an operation."""
    if operation.kind == "i":
        new = tuple(sorted(operation.labels))
        if new in simplices:
            raise TowerError(f"{new} is there")
        for k in range(len(new) if len(new) > 1 else 0):
            if new[:k] + new[k + 1:] not in simplices:
                raise TowerError(f"{new} lacks a face")
        return simplices | {new}
    u, v = operation.labels
    if (u,) not in simplices or (v,) not in simplices:
        raise TowerError(f"contraction of {u} into {v}: one is not there")
    return {tuple(sorted({v if x == u else x for x in simplex})) for simplex in simplices}


def image(simplex, operation):
    """Where an operation sends a simplex: (sign, simplex); nothing where it becomes degenerate."""
    if operation.kind == "i" or operation.labels[0] not in simplex:
        return 1, simplex
    u, v = operation.labels
    if v in simplex:
        return None
    moved = [v if x == u else x for x in simplex]
    inversions = sum(moved[a] > moved[b] for b in range(len(moved)) for a in range(b))
    return (-1) ** inversions, tuple(sorted(moved))


# -------------------------------------------------------------------------------------------------- linear algebra


def add(chain, other, factor, p):
    """chain += factor * other; chains are {simplex: coefficient}, without zeros."""
    for cell, coefficient in other.items():
        value = (chain.get(cell, 0) + factor * coefficient) % p
        if value:
            chain[cell] = value
        else:
            chain.pop(cell, None)


def boundary(chain, p):
    total = {}
    for simplex, coefficient in chain.items():
        if len(simplex) > 1:
            for k in range(len(simplex)):
                add(total, {simplex[:k] + simplex[k + 1:]: 1}, coefficient * (-1) ** k, p)
    return total


class Echelon:
    """A space of chains; every member is known by its greatest simplex."""

    def __init__(self, p, members=()):
        self.p = p
        self.by_pivot = {}
        for chain in members:
            self.insert(chain)

    def reduced(self, chain):
        chain, rest = dict(chain), {}
        while chain:
            pivot = max(chain)
            if pivot in self.by_pivot:
                add(chain, self.by_pivot[pivot], -chain[pivot], self.p)
            else:
                rest[pivot] = chain.pop(pivot)
        return rest

    def insert(self, chain):
        """Whether the chain was not in the space."""
        rest = self.reduced(chain)
        if not rest:
            return False
        pivot = max(rest)
        inverse = pow(rest[pivot], -1, self.p)
        self.by_pivot[pivot] = {cell: coefficient * inverse % self.p for cell, coefficient in rest.items()}
        return True

    def extended_by(self, chains):
        """How many dimensions the space would gain."""
        larger = Echelon(self.p)
        larger.by_pivot = dict(self.by_pivot)
        return sum(larger.insert(chain) for chain in chains)


def cycles(simplices, p):
    """A basis of the cycles among chains of these simplices, which have one dimension."""
    basis, reduced = [], {}
    for simplex in sorted(simplices):
        combination, rest = {simplex: 1}, boundary({simplex: 1}, p)
        while rest and max(rest) in reduced:
            other_rest, other = reduced[max(rest)]
            factor = -rest[max(rest)] * pow(other_rest[max(rest)], -1, p)
            add(combination, other, factor, p)
            add(rest, other_rest, factor, p)
        if rest:
            reduced[max(rest)] = rest, combination
        else:
            basis.append(combination)
    return basis


# ------------------------------------------------------------------------------------------------------ the barcode


def boundaries_by_dimension(simplices, p, dimensions):
    return [Echelon(p, (boundary({s: 1}, p) for s in simplices if len(s) == d + 2)) for d in range(dimensions)]


def homology_basis(simplices, d, boundaries, p):
    """Cycles whose classes are a basis of H_d."""
    space = Echelon(p)
    space.by_pivot = dict(boundaries.by_pivot)
    return [chain for chain in cycles((s for s in simplices if len(s) == d + 1), p) if space.insert(chain)]


def pushed(chain, operation, p):
    total = {}
    for simplex, coefficient in chain.items():
        found = image(simplex, operation)
        if found:
            add(total, {found[1]: found[0]}, coefficient, p)
    return total


def moments(operations):
    """The times, ascending, and for each the operations and the complex after them."""
    found, simplices = [], set()
    for operation in operations:
        simplices = after(simplices, operation)
        if not found or found[-1][0] < operation.time:
            found.append([operation.time, [], None])
        found[-1][1].append(operation)
        found[-1][2] = simplices
    return found


def ranks(steps, d, boundaries, p):
    """ranks[i][j] of H_d(X_i) -> H_d(X_j), 0 where j < i."""
    table = [[0] * len(steps) for _ in steps]
    for i, (_, _, simplices) in enumerate(steps):
        chains = homology_basis(simplices, d, boundaries[i][d], p)
        for j in range(i, len(steps)):
            if j > i:
                for operation in steps[j][1]:
                    chains = [pushed(chain, operation, p) for chain in chains]
            table[i][j] = boundaries[j][d].extended_by(chains)
    return table


def barcode(operations, p):
    """The bars [dimension, birth, death or None] of positive length, sorted as `sesame tower` sorts them."""
    steps = moments(operations)
    dimensions = max((len(s) for _, _, simplices in steps for s in simplices), default=0)
    boundaries = [boundaries_by_dimension(simplices, p, dimensions) for _, _, simplices in steps]
    bars, last = [], len(steps) - 1
    for d in range(dimensions):
        table = ranks(steps, d, boundaries, p)

        def rank(i, j, table=table):
            return table[i][j] if i >= 0 else 0
        for i, (birth, _, _) in enumerate(steps):
            for j in range(i + 1, last + 1):
                count = rank(i, j - 1) - rank(i - 1, j - 1) - rank(i, j) + rank(i - 1, j)
                bars += [[d, birth, steps[j][0]]] * count
            bars += [[d, birth, None]] * (rank(i, last) - rank(i - 1, last))
    return sorted(bars, key=bar_order)


def bar_order(bar):
    return bar[0], bar[1], float("inf") if bar[2] is None else bar[2]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("--ring", default="Z/2")
    arguments = parser.parse_args()
    try:
        with sys.stdin if arguments.file == "-" else open(arguments.file, encoding="utf-8") as file:
            operations = parse(file)
        bars = barcode(operations, int(arguments.ring[2:]))
    except OSError as error:
        print(error, file=sys.stderr)
        return 1
    except TowerError as error:
        print(f"{arguments.file}: {error}", file=sys.stderr)
        return 2
    print(json.dumps({"ring": arguments.ring, "ops": len(operations), "bars": bars}, separators=(",", ":")))
    return 0


if __name__ == "__main__":
    sys.exit(main())
