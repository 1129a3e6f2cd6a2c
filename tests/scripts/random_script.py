#!/usr/bin/env python3
"""Prints a random legal script for `sesame replay`.

    random_script.py --seed N [--steps M] [--ring Z|Z/p] [--illegal]

Exercises simplex, simploid, complex, cone, identify, expect, class, undo and note: several bodies, self-gluings and
twisted ones (torsion), simploids of mixed types up to dimension 3, cones over bodies and over lists, classes of
boundaries, cycles and other chains. What is legal, the oracle knows. With --illegal the last step is wrong, and only
that one.
The same seed gives the same script.
"""

import argparse
import json
import random
import sys

sys.dont_write_bytecode = True
import oracle

LARGEST_STATE = 110  # living cells; above this only steps that do not add cells are drawn
TYPES = [[1], [2], [3], [1, 1], [1, 1, 1], [2, 1], [1, 2]]


class Writer:
    def __init__(self, seed, ring):
        self.random = random.Random(seed)
        self.oracle = oracle.Oracle(oracle.parse_ring(ring))
        self.lines = [{"sesame": 1, "ring": ring, "title": f"random script, seed {seed}"}]
        self.made = 0

    def fresh(self, letter):
        """A free name; sometimes one that an undo set free again."""
        state = self.oracle.state
        if self.random.random() < 0.3:
            for number in range(1, self.made + 1):
                name = f"{letter}{number}"
                if name not in state.names and name not in state.bodies:
                    return name
        self.made += 1
        return f"{letter}{self.made}"

    def attempt(self, step):
        """Applies the step if it is legal, says whether it was."""
        try:
            self.oracle.apply(step)
        except oracle.ScriptError:
            return False
        self.lines.append(step)
        return True

    def name_of(self, cell):
        """Any name of a living cell, canonical or not."""
        state = self.oracle.state
        if self.random.random() < 0.7:
            return state.cells[cell].name
        return self.random.choice([name for name in state.names if state.root(state.names[name]) == cell])

    # -- steps

    def simplex(self):
        dim = self.random.choice([0, 1, 1, 2, 2, 2, 3])
        step = {"op": "simplex", "name": self.fresh("t"), "dim": dim}
        if self.random.random() < 0.2:
            step["at"] = [[self.random.randint(-9, 9), self.random.random()] for _ in range(dim + 1)]
        return self.attempt(step)

    def simploid(self):
        return self.attempt({"op": "simploid", "name": self.fresh("q"), "type": self.random.choice(TYPES)})

    def moore(self):
        """A disc on an n-gon whose sides are one loop: Z/n, or less when some sides run backwards."""
        name, n = self.fresh("M"), self.random.randint(2, 6)
        cells = [{"id": "c"}, {"id": "p"}, {"id": "a", "faces": ["p", "p"]}]
        cells += [{"id": f"r{i}", "faces": ["c", "p"]} for i in range(n)]
        for i in range(n):
            this, after = f"r{i}", f"r{(i + 1) % n}"
            if self.random.random() < 0.8:
                this, after = after, this
            cells.append({"id": f"t{i}", "faces": [this, after, "a"]})
        self.random.shuffle(cells)
        return self.attempt({"op": "complex", "name": name, "cells": cells})

    def loops(self):
        """A wedge of loops and a few triangles and squares on them: every face law holds, any word may appear."""
        name = self.fresh("W")
        edges = [f"e{i}" for i in range(self.random.randint(1, 4))]
        cells = [{"id": "p"}] + [{"id": e, "faces": ["p", "p"]} for e in edges]
        for i in range(self.random.randint(0, 4)):
            if self.random.random() < 0.5:
                cells.append({"id": f"t{i}", "faces": [self.random.choice(edges) for _ in range(3)]})
            else:
                cells.append({"id": f"q{i}", "type": [1, 1], "faces": [self.random.choice(edges) for _ in range(4)]})
        self.random.shuffle(cells)
        return self.attempt({"op": "complex", "name": name, "cells": cells})

    def identify(self):
        state = self.oracle.state
        groups = {}
        for c in state.alive():
            groups.setdefault(state.cells[c].kind, []).append(c)
        kinds = sorted(kind for kind, members in groups.items() if len(members) > 1)
        if not kinds:
            return False
        higher = [kind for kind in kinds if kind]
        pairs = []
        for _ in range(self.random.choice([1, 1, 1, 2, 3])):
            kind = self.random.choice(higher if higher and self.random.random() < 0.85 else kinds)
            members = groups[kind]
            if self.random.random() < 0.5:  # inside one body: handles, twists and torsion come from there
                body = state.body_root(state.cells[self.random.choice(members)].body)
                members = [c for c in members if state.body_root(state.cells[c].body) == body]
            a, b = self.random.choice(members), self.random.choice(members)
            if a == b and self.random.random() < 0.9 and len(members) > 1:
                a, b = self.random.sample(members, 2)
            pairs.append([self.name_of(a), self.name_of(b)])
        return self.attempt({"op": "identify", "pairs": pairs})

    def cone(self):
        state = self.oracle.state
        alive = state.alive()
        if not alive:
            return False
        step = {"op": "cone", "apex": self.fresh("v")}
        shape = self.random.random()
        if shape < 0.5:
            simplices = [c for c in alive if len(state.cells[c].kind) <= 1]
            chosen = self.random.sample(simplices, min(len(simplices), self.random.randint(1, 4)))
            step["over"] = [self.name_of(c) for c in chosen]
        elif shape < 0.95:
            step["over"] = self.random.choice(sorted(state.bodies))
        if self.random.random() < 0.3:
            step["at"] = [0, 0, self.random.randint(1, 5)]
        return self.attempt(step)

    def chain_terms(self, chain):
        terms = [[v, self.name_of(c)] for c, v in sorted(chain.items())]
        self.random.shuffle(terms)
        return terms

    def query(self):
        state, prime = self.oracle.state, self.oracle.prime
        lists = state.by_dimension()
        if not lists:
            return False
        dim = self.random.randrange(len(lists))
        shape = self.random.random()
        chain = {}
        if shape < 0.4 and dim + 1 < len(lists):
            above = {c: self.random.choice([-3, -1, 1, 2]) for c in self.random.choices(lists[dim + 1], k=3)}
            chain = oracle.boundary_of_chain(state, above, prime)
        elif shape < 0.9:
            chain = self.cycle(lists, dim)
        if not chain:
            if not lists[dim]:
                return False
            chain = {c: self.random.choice([-2, -1, 1, 1, 3]) for c in self.random.choices(lists[dim], k=2)}
        return self.attempt({"op": "class", "chain": self.chain_terms(chain)})

    def cycle(self, lists, dim):
        """A random combination of integer cycles, found by elimination on the boundaries."""
        state = self.oracle.state
        done = {}  # pivot -> (boundary, chain with that boundary)
        cycles = []
        for c in lists[dim]:
            below, chain = state.boundary(c), {c: 1}
            while below:
                pivot = max(below)
                if pivot not in done:
                    done[pivot] = (below, chain)
                    break
                other, other_chain = done[pivot]
                a, b = below[pivot], other[pivot]
                below, chain = combine(below, b, other, -a), combine(chain, b, other_chain, -a)
            if not below:
                cycles.append(chain)
        total = {}
        for cycle in self.random.sample(cycles, min(len(cycles), 2)):
            total = combine(total, 1, cycle, self.random.choice([-2, -1, 1, 1, 2, 3]))
        return total

    def expect(self):
        found = oracle.summary(self.oracle.state, self.oracle.prime)
        picked = self.random.sample(["betti", "torsion", "euler", "cells"], self.random.randint(1, 4))
        step = {"op": "expect"}
        for field in picked:
            step[field] = found[field]
            if field != "euler" and self.random.random() < 0.5:
                step[field] = oracle.trimmed(found[field], [] if field == "torsion" else 0)
            elif field != "euler" and self.random.random() < 0.3:
                step[field] = found[field] + [[] if field == "torsion" else 0]
        return self.attempt(step)

    def undo(self):
        most = len(self.oracle.history)
        if not most:
            return False
        count = min(most, self.random.choice([1, 1, 1, 2, 2, 3, 5]))
        step = {"op": "undo"}
        if count > 1 or self.random.random() < 0.5:
            step["steps"] = count
        return self.attempt(step)

    def note(self):
        return self.attempt({"op": "note", "text": self.random.choice(["a note", "é, ∂ and \"quotes\"", ""])})

    def draw(self):
        growing = [self.simplex] * 5 + [self.simploid] * 4 + [self.moore, self.loops] + [self.cone] * 3
        gluing = [self.identify] * 14
        looking = [self.query] * 5 + [self.expect] * 2 + [self.note] + [self.undo] * 2
        size = len(self.oracle.state.alive())
        if size > LARGEST_STATE:
            return self.random.choice(gluing + looking + [self.undo] * 8)
        return self.random.choice(growing * (3 if size < 12 else 1) + gluing + looking)

    def wrong_step(self):
        name = self.oracle.state.cells[0].name if self.oracle.state.cells else "nobody"
        taken = sorted(self.oracle.state.bodies)[0] if self.oracle.state.bodies else "no body"
        return self.random.choice([
            {"op": "identify", "pairs": [[name, "nobody"]]},
            {"op": "simplex", "name": taken, "dim": 2} if self.oracle.state.bodies else {"op": "simplex", "dim": 2},
            {"op": "simplex", "name": "fresh", "dim": -1},
            {"op": "simploid", "name": "fresh", "type": [1, 0]},
            {"op": "complex", "name": "fresh", "cells": [{"id": "a"}, {"id": "e", "faces": ["a", "b"]}]},
            {"op": "complex", "name": "fresh", "cells": [
                {"id": "a"}, {"id": "b"}, {"id": "e", "faces": ["b", "a"]}, {"id": "t", "faces": ["e", "e", "e"]}]},
            {"op": "cone", "apex": "fresh", "over": "nobody"},
            {"op": "undo", "steps": len(self.oracle.history) + 1},
            {"op": "frobnicate"},
            {"op": "note", "text": "a", "txt": "b"},
            {"op": "class", "chain": [[1, "nobody"]]},
            self.mismatched_pair(name),
        ])

    def mismatched_pair(self, name):
        """Glues cells of different types beside a pair that could be glued: neither may happen."""
        state = self.oracle.state
        alive = [state.cells[c] for c in state.alive()]
        other = [c.name for c in alive if c.kind != state.cells[state.find(name)].kind]
        if not other:
            return {"op": "identify", "pairs": [[name]]}
        return {"op": "identify", "pairs": [[name, alive[-1].name], [name, other[0]]]}


def combine(a, x, b, y):
    total = {c: x * v for c, v in a.items()}
    for c, v in b.items():
        total[c] = total.get(c, 0) + y * v
    return {c: v for c, v in total.items() if v}


def write_script(seed, steps, ring="Z", illegal=False):
    """The lines of a random script, as one string."""
    writer = Writer(seed, ring)
    misses = 0
    while len(writer.lines) <= steps and misses < 1000:
        if not writer.draw()():
            misses += 1
    lines = list(writer.lines)
    if illegal:
        lines.append(writer.wrong_step())
    return "".join(json.dumps(line, ensure_ascii=False) + "\n" for line in lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--ring", default="Z")
    parser.add_argument("--illegal", action="store_true")
    options = parser.parse_args()
    sys.stdout.write(write_script(options.seed, options.steps, options.ring, options.illegal))


if __name__ == "__main__":
    main()
