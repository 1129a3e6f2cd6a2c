#!/usr/bin/env python3
"""Prints a random legal script for `sesame replay`.

    random_script.py --seed N [--steps M] [--ring Z|Z/p] [--ops basic|all|tear|nest|abstract|maps|boundaries] [--weight NAME=N]...
                     [--illegal]

basic: simplex, simploid, complex, cone, suspend, identify, expect, class, undo and note: several bodies, self-gluings and
twisted ones (torsion), simploids of mixed types up to dimension 3, cones over bodies and over lists, classes of
boundaries, cycles and other chains.
all: cones over simploids, degenerate cells, products of both kinds, remove, replace, deidentify as well (cells cut off or torn out,
cells split along their links, gluings taken back), and in most scripts maps, in any order and on top of each other. --weight makes a step more
or less frequent (0: never); a wrong NAME is answered with the names that there are.
tear: a random complex is glued from simploids and torn apart again, cell by cell, to isolated ones. It may need more
steps than asked for.
abstract: simplices on labelled vertices are inserted and replaced, any two vertices are collapsed, and now and then a body is
changed by one of the other operations.
maps: polygons, solids and other maps by their cells, few by their simplices, are sewn, unsewn and extended, and cells of
them removed, contracted, inserted and split; in most scripts all other operations come between. Some maps have cells that are no balls.
boundaries: complexes of cells that are known by their boundaries, and all other operations.
What is legal, the oracle knows. With --illegal the last step is wrong, and only that one.
The same options give the same script.
"""

import argparse
import json
import random
import sys

sys.dont_write_bytecode = True
import boundaries
import gmaps
import local_operations
import oracle
import split_plans

LARGEST_STATE = 110  # living cells; above this only steps that do not add cells are drawn
LARGEST_RESULT = 150  # cells; with all operations no step may end with more
TYPES = [[1], [2], [3], [1, 1], [1, 1, 1], [2, 1], [1, 2]]


class Writer:
    vertex_maps = 0.15  # how many pairs have one

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
        return self.random.choice([name for name, value in state.names.items() if isinstance(name, str)
                                   and value and value[0] == cell and not oracle.is_degenerate(value)])

    def another(self, name):
        """A name made of names or of vertices for the same cell, perhaps with its vertices in another order."""
        state = self.oracle.state
        for apex, cone in state.cones.items():
            called = name[len(apex) + 1:]
            if name.startswith(f"{apex}*") and called in cone.coned:
                keys = [key for key, (other, shape) in cone.table.items()
                        if other == called and isinstance(key, str) and not oracle.is_degenerate((other, shape))]
                return f"{apex}*{self.another(self.random.choice(keys))}"
        if self.random.random() < 0.5:
            return name
        if state.listed(name):
            labels = name[1:-1].split(",")
            self.random.shuffle(labels)
            return "{" + ",".join(labels) + "}"
        base, _, vertices = name.rpartition(".")
        if name in state.standard:
            base, lists = name, [[str(x) for x in range(size + 1)] for size in state.standard[name]]
        elif base in state.standard:
            lists = [part.split("-") for part in vertices.split("x")]
        else:
            return name
        for part in lists:
            self.random.shuffle(part)
        return f"{base}.{'x'.join('-'.join(part) for part in lists)}"

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
        kinds = sorted((kind for kind, members in groups.items() if len(members) > 1),
                       key=lambda kind: (isinstance(kind, oracle.MapKind), kind) if not is_by_boundary(kind)
                       else (2, str(kind)))
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
            pair = [self.name_of(a), self.name_of(b)]
            pairs.append([self.another(name) for name in pair] if self.random.random() < 0.1 else pair)
            if self.random.random() < self.vertex_maps and oracle.is_simploid(kind):
                pairs[-1].append(self.vertex_map(kind))
        return self.attempt({"op": "identify", "pairs": pairs})

    def vertex_map(self, kind):
        """A random one, in any form."""
        parts = [self.random.sample(range(a + 1), a + 1) for a in kind or (0,)]
        return parts[0] if len(parts) == 1 and self.random.random() < 0.8 else parts

    def cone(self):
        state = self.oracle.state
        alive = state.alive()
        if not alive:
            return False
        step = {"op": "cone", "apex": self.fresh("v")}
        shape = self.random.random()
        if shape < 0.5:
            simplices = [c for c in alive if oracle.is_simplex(state.cells[c].kind)]
            chosen = self.random.sample(simplices, min(len(simplices), self.random.randint(1, 4)))
            step["over"] = [self.name_of(c) for c in chosen]
        elif shape < 0.95:
            step["over"] = self.random.choice(sorted(state.bodies))
        if self.random.random() < 0.3:
            step["at"] = [0, 0, self.random.randint(1, 5)]
        if self.random.random() < 0.25:
            step["op"] = "suspend"
            step["apexes"] = [step.pop("apex"), self.fresh("s")]
            if "at" in step:
                step["at"] = [step["at"], [0, 0, -1]]
        return self.attempt_cone(step)

    def attempt_cone(self, step):
        """Simplicial cones only."""
        state = self.oracle.state
        kinds = [state.cells[c].kind for c in oracle.cells_to_cone(state, step.get("over"))]
        return all(map(oracle.is_simplex, kinds)) and self.attempt(step)

    def chain_terms(self, chain):
        """A name may stand for the opposite orientation."""
        terms = [[v, self.another(self.name_of(c))] for c, v in sorted(chain.items())]
        terms = [[v * self.oracle.state.sign(name), name] for v, name in terms]
        self.random.shuffle(terms)
        return terms

    def query(self):
        state, prime = self.oracle.state, self.oracle.prime
        lists = [[c for c in cells if not state.is_hollow(c)] for cells in state.by_dimension()]
        if not lists:
            return False
        dim = self.random.randrange(len(lists))
        shape = self.random.random()
        chain = {}
        if shape < 0.4 and dim + 1 < len(lists) and lists[dim + 1]:
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

    def write(self, steps):
        misses = 0
        while len(self.lines) <= steps and misses < 1000:
            if not self.draw()():
                misses += 1

    def wrong_step(self):
        return self.random.choice(self.wrong_steps())

    def wrong_steps(self):
        alive = self.oracle.state.alive()
        name = self.oracle.state.cells[alive[0]].name if alive else "nobody"
        taken = sorted(self.oracle.state.bodies)[0] if self.oracle.state.bodies else "no body"
        return [
            {"op": "identify", "pairs": [[name, "nobody"]]},
            {"op": "simplex", "name": taken, "dim": 2} if self.oracle.state.bodies else {"op": "simplex", "dim": 2},
            {"op": "simplex", "name": "fresh", "dim": -1},
            {"op": "simploid", "name": "fresh", "type": [1, 0]},
            {"op": "complex", "name": "fresh", "cells": [{"id": "a"}, {"id": "e", "faces": ["a", "b"]}]},
            {"op": "complex", "name": "fresh", "cells": [
                {"id": "a"}, {"id": "b"}, {"id": "e", "faces": ["b", "a"]}, {"id": "t", "faces": ["e", "e", "e"]}]},
            {"op": "cone", "apex": "fresh", "over": "nobody"},
            {"op": "suspend", "apexes": ["fresh", "fresh"]},
            {"op": "suspend", "apexes": ["fresh", name]},
            {"op": "identify", "pairs": [[name, name, [1]]]},
            {"op": "identify", "pairs": [[name, name, []]]},
            {"op": "identify", "pairs": [[name, name, 0]]},
            {"op": "undo", "steps": len(self.oracle.history) + 1},
            {"op": "frobnicate"},
            {"op": "note", "text": "a", "txt": "b"},
            {"op": "class", "chain": [[1, "nobody"]]},
            self.mismatched_pair(name),
        ]

    def mismatched_pair(self, name):
        """Glues cells of different types beside a pair that could be glued: neither may happen."""
        state = self.oracle.state
        alive = [state.cells[c] for c in state.alive()]
        other = [c.name for c in alive if c.kind != state.cells[state.find(name)].kind]
        if not other:
            return {"op": "identify", "pairs": [[name]]}
        return {"op": "identify", "pairs": [[name, alive[-1].name], [name, other[0]]]}


class WriterOfAll(Writer):
    """All operations."""

    weights = {
        "simplex": 5, "simploid": 4, "moore": 1, "loops": 1, "cone": 4, "product": 6,
        "identify": 12, "identify_degenerate": 2, "degenerate": 5, "isolate": 2, "tear_out": 2, "split": 5, "unglue": 4,
        "remove": 4, "replace": 4, "query": 6, "expect": 2, "note": 1, "undo": 3,
    }
    growing = ("simplex", "simploid", "moore", "loops", "cone", "product")

    def __init__(self, seed, ring):
        super().__init__(seed, ring)
        self.gluings = []

    def draw(self):
        size = len(self.oracle.state.cells)
        weights = dict(self.weights)
        for name in weights.keys() & {*self.growing}:
            weights[name] *= 0 if size > LARGEST_STATE else 3 if size < 12 else 1
        return getattr(self, self.random.choices(list(weights), list(weights.values()))[0])

    def attempt(self, step):
        """Refuses as well what grows too much and, mostly, what collapses most of the object."""
        if step["op"] not in ("undo", "expect", "class", "note"):
            before = self.oracle.state
            try:
                after, _ = oracle.carried_out(before, step, self.oracle.prime)
            except oracle.ScriptError:
                return False
            if len(after.cells) > max(LARGEST_RESULT, len(before.cells)):
                return False
            if 2 * len(after.cells) < len(before.cells) and self.random.random() < 0.9:
                return False
            if step["op"] == "identify":
                self.gluings.append(split_plans.Gluing(before, after))
        return super().attempt(step)

    def attempt_cone(self, step):
        over = step.get("over")
        if isinstance(over, list):
            step["over"] = [self.name_of(c) for c in self.some_cells(len(over)) if not self.oracle.state.is_hollow(c)]
        elif over is not None:
            bodies = self.usable_bodies()
            if not bodies:
                return False
            step["over"] = self.random.choice(bodies)
        return self.attempt(step)

    def usable_bodies(self):
        state = self.oracle.state
        return sorted(n for n, body in state.bodies.items() if state.body_root(body) not in state.consumed)

    def some_cells(self, count):
        alive = self.oracle.state.alive()
        return self.random.sample(alive, min(len(alive), count))

    def fresh_copy(self):
        """A callable for split_plans: names that are free and differ within the step."""
        given = set()

        def fresh():
            name = self.fresh("x")
            while name in given:
                name = self.fresh("x")
            given.add(name)
            return name

        return fresh

    # -- steps

    def cw(self):
        """A complex of cells that are known by their boundaries, and edges and triangles."""
        points = [f"p{k}" for k in range(self.random.choice([1, 1, 1, 2, 3]))]
        cells = [{"id": point, **({"dim": 0} if self.random.random() < 0.5 else {})} for point in points]
        layer = {point: {} for point in points}  # {id: boundary}
        for dim in range(1, self.random.choice([2, 3, 3, 4, 4, 5])):
            below, layer = layer, {}
            cycles = [] if dim == 1 else cycles_of(below)
            for k in range(self.random.choice([0, 1, 1, 2, 3])):
                ident, cell = f"c{dim}-{k}", {"dim": dim}
                ends = [self.random.choice(points) for _ in range(2)]
                if dim == 1 and self.random.random() < 0.3:
                    cell, terms = {"faces": ends}, [[1, ends[0]], [-1, ends[1]]]
                elif dim == 1:
                    terms = [[1, ends[0]], [-1, ends[1]]]
                elif dim == 2 and len(points) == 1 and below and self.random.random() < 0.3:
                    sides = [self.random.choice(sorted(below)) for _ in range(3)]
                    cell, terms = {"faces": sides}, [[(-1) ** n, side] for n, side in enumerate(sides)]
                else:
                    terms = self.boundary_of_cycles(cycles, sorted(below))
                layer[ident] = {}
                for n, face in terms:
                    layer[ident][face] = layer[ident].get(face, 0) + n
                if "dim" in cell:
                    self.random.shuffle(terms)
                    cell.update({"boundary": terms} if terms or self.random.random() < 0.3 else {})
                cells.append({"id": ident, **cell})
        self.random.shuffle(cells)
        return self.attempt({"op": "complex", "name": self.fresh("k"), "cells": cells})

    def boundary_of_cycles(self, cycles, faces):
        """Terms of a sum of some cycles, in parts; perhaps a face there and back."""
        total, terms = {}, []
        for cycle in self.random.sample(cycles, self.random.randint(0, min(len(cycles), 2))):
            total = combine(total, 1, cycle, self.random.choice([-2, -1, 1, 1, 2, 3]))
        for face, n in total.items():
            part = self.random.randint(-1, 2)
            terms += [[m, face] for m in ((part, n - part) if self.random.random() < 0.3 else (n,)) if m]
        if faces and self.random.random() < 0.2:
            face = self.random.choice(faces)
            terms += [[1, face], [-1, face]]
        return terms

    def product(self):
        state = self.oracle.state
        sizes = {name: len(state.cells_of_body(state.find_body(name))) for name in self.usable_bodies()}
        most = self.random.choice([7, 20, 50, 150])
        pairs = [(left, right) for left in sizes for right in sizes if 0 < sizes[left] * sizes[right] <= most]
        if self.random.random() < 0.3:
            pairs = [pair for pair in pairs if state.find_body(pair[0]) == state.find_body(pair[1])]
        if not pairs:
            return False
        left, right = self.random.choice(pairs)
        cells = [state.cells_of_body(state.find_body(name)) for name in (left, right)]
        names = [sum(1 for value in state.names.values() if value and value[0] in set(side)) for side in cells]
        step = {"op": "product", "name": self.fresh("P"), "left": left, "right": right}
        kind = self.random.choice(["simplicial", "simplicial", "simploidal", None])
        if kind:
            step["kind"] = kind
        size = len(cells[0]) * len(cells[1])
        if kind == "simplicial":
            size = sum(len(oracle.disjoint_masks(state.dim(a), state.dim(b))) for a in cells[0] for b in cells[1])
        return size <= LARGEST_RESULT and names[0] * names[1] <= 3000 and self.attempt(step)

    def identify_degenerate(self):
        """A pair of names of one type, at least one of them of a degenerate cell."""
        state = self.oracle.state
        names = {}
        for name, value in state.names.items():
            if value:
                names.setdefault(oracle.type_of(value[1]), []).append(name)
        degenerate = [name for name, value in state.names.items() if value and oracle.is_degenerate(value)]
        if not degenerate:
            return False
        name = self.random.choice(degenerate)
        pair = [name, self.random.choice(names[oracle.type_of(state.names[name][1])])]
        self.random.shuffle(pair)
        return self.attempt({"op": "identify", "pairs": [pair]})

    def degenerate(self):
        state = self.oracle.state
        cells = [c for c in state.alive() if state.dim(c) and oracle.is_simploid(state.cells[c].kind)]
        if not cells:
            return False
        cell = self.random.choices(cells, [4 ** -state.dim(c) for c in cells])[0]
        kind = state.cells[cell].kind
        i = self.random.randrange(len(kind))
        along = [i + 1, self.random.randrange(kind[i])]
        if len(kind) == 1 and self.random.random() < 0.8:
            along = along[1]
        return self.attempt({"op": "degenerate", "cell": self.name_of(cell), "along": along})

    def remove(self):
        """Open stars, or cells with all their cofaces by name; now and then nothing."""
        state = self.oracle.state
        cells = state.alive()
        if not cells:
            return False
        chosen = set(self.random.choices(cells, [4 ** state.dim(c) for c in cells], k=self.random.choice([0, 1, 1, 1, 2])))
        step = {"op": "remove", "cells": [self.another(self.name_of(c)) for c in sorted(chosen)]}
        if self.random.random() < 0.5:
            return self.attempt({**step, "cofaces": True})
        for c in cells:  # younger cells are no faces of older ones, but after gluings
            if c not in chosen and any(face[0] in chosen for face in state.faces(c)):
                chosen.add(c)
                step["cells"].append(self.name_of(c))
        return self.attempt(step)

    def replace(self):
        """A flip or a subdivision of any cell, tried on some."""
        state = self.oracle.state
        for _ in range(6):
            cells = state.alive()
            if not cells:
                return False
            cell = self.random.choice(cells)
            move = "flip" if self.random.random() < 0.7 else "subdivide"
            step = {"op": "replace", move: self.another(self.name_of(cell))}
            is_abstract = state.body_root(state.cells[cell].body) in state.abstract
            if move == "subdivide" or not is_abstract or self.random.random() < 0.5:
                step["by"] = self.fresh("r")
            if self.random.random() < 0.1:
                step["fills"] = True
            if self.attempt(step):
                return True
        return False

    def deidentify(self, split):
        """The step, with any names of the cells and in any order."""
        if not split or self.tears_hollow_cells(split):
            return False
        for entry in split:
            entry["cell"] = self.name_of(self.oracle.state.find(entry["cell"]))
            self.random.shuffle(entry["moves"])
        self.random.shuffle(split)
        return self.attempt({"op": "deidentify", "split": split})

    def tears_hollow_cells(self, split):
        """Whether incidences move that are in the boundaries of cones over cells that are no balls: these have other faces in
        the program, which does not know what they are attached along but by their boundaries."""
        state = self.oracle.state
        hollow = set(state.closure(c for c in state.alive() if state.is_hollow(c) and not state.cells[c].kind.incidences))
        moved = [name for entry in split for name, _ in entry["moves"] if name in state.names]
        return any(state.is_hollow(state.find(entry["cell"])) for entry in split) or any(
            state.find(name) in hollow for name in moved)

    def isolate(self):
        cell = self.some_cells(1)
        outside = self.random.random() < 0.4
        return bool(cell) and self.deidentify(
            split_plans.isolate(self.oracle.state, cell[0], self.fresh_copy(), outside))

    def tear_out(self):
        cell = self.some_cells(1)
        return bool(cell) and self.deidentify(split_plans.tear_out(self.oracle.state, cell[0], self.fresh_copy()))

    def split(self):
        """One or two cells, mostly along their links; else by any subset, which the laws may refuse."""
        state, fresh = self.oracle.state, self.fresh_copy()
        split = []
        for cell in self.some_cells(self.random.choice([1, 1, 2])):
            parts = split_plans.link_classes(state, cell)
            if self.random.random() < 0.2:
                parts = [[move] for part in parts for move in part]
            if parts:
                chosen = self.random.sample(parts, self.random.randint(1, max(1, len(parts) - 1)))
                split += split_plans.split_cell(state, cell, [move for part in chosen for move in part], fresh)
        return self.deidentify(split)

    def unglue(self):
        if not self.gluings:
            return False
        gluing = self.gluings[-1] if self.random.random() < 0.4 else self.random.choice(self.gluings)
        return self.deidentify(gluing.undone(self.oracle.state, self.fresh_copy()))

    def chain_terms(self, chain):
        """Sometimes with a term on a degenerate cell, which counts 0."""
        terms = super().chain_terms(chain)
        state = self.oracle.state
        dim = state.dim(next(iter(chain))) if chain else 0
        zeros = [name for name, value in state.names.items() if value and isinstance(name, str)
                 and oracle.is_degenerate(value) and oracle.dimension_of(oracle.type_of(value[1])) == dim]
        if zeros and self.random.random() < 0.3:
            terms.append([self.random.choice([-1, 2]), self.random.choice(zeros)])
        return terms

    def wrong_steps(self):
        state = self.oracle.state
        steps = super().wrong_steps() + [
            {"op": "product", "name": "fresh", "left": "nobody", "right": "nobody"},
            {"op": "deidentify", "split": [{"cell": "nobody", "as": "fresh", "moves": []}]},
            {"op": "degenerate", "cell": "nobody", "along": 0},
        ]
        for c in self.some_cells(3):
            cell = state.cells[c]
            split = [{"cell": cell.name, "as": "fresh", "moves": [[cell.name, 0]]}]
            steps.append({"op": "deidentify", "split": split})
            steps.append({"op": "deidentify", "split": [{"cell": cell.name, "as": cell.name, "moves": []}]})
            if oracle.is_simploid(cell.kind):
                steps.append({"op": "degenerate", "cell": cell.name, "along": [1, (cell.kind or (0,))[0]]})
            parts = split_plans.link_classes(state, c)
            if any(len(part) > 1 for part in parts):
                longest = max(parts, key=len)
                split = split_plans.split_cell(state, c, longest[1:], lambda: "fresh")
                steps.append({"op": "deidentify", "split": split})
        bodies = self.usable_bodies()
        if bodies:
            body = bodies[0]
            steps.append({"op": "product", "name": body, "left": body, "right": body})
            steps.append({"op": "product", "name": "fresh", "left": body, "right": body, "kind": "cubical"})
        used_up = sorted(set(state.bodies) - set(bodies))
        if used_up:
            steps.append({"op": "cone", "apex": "fresh", "over": used_up[0]})
            steps.append({"op": "product", "name": "fresh", "left": used_up[0], "right": used_up[0]})
            gone = [name for name, value in state.names.items() if value is None]
            if gone:
                steps.append({"op": "identify", "pairs": [[gone[0], gone[0]]]})
                steps.append({"op": "simplex", "name": gone[-1], "dim": 1})
        return steps


class WriterOfTearing(WriterOfAll):
    """First growing and gluing, then tearing apart until only standard simploids are left."""

    weights = {**{name: 0 for name in WriterOfAll.weights}, "simplex": 4, "simploid": 1, "identify": 9, "query": 1}

    def write(self, steps):
        super().write(steps // 2)
        misses = 0
        while misses < 1000:
            state = self.oracle.state
            used_by = split_plans.users(state)
            tops = [c for c in state.alive() if state.dim(c) and not used_by[c]]
            plans = [split for split in (split_plans.tear_out(state, c, self.fresh_copy()) for c in tops) if split]
            if not plans:
                break
            turn = self.random.random()
            if turn < 0.1 and len(self.lines) < steps:
                self.undo()
            elif turn < 0.2:
                self.query()
            elif not self.deidentify(self.random.choice(plans)):
                misses += 1
        self.expect()


class WriterOfNests(WriterOfAll):
    """Products of products and cones of products first, then mostly questions, splits and undos: what is lazy in the
    program is asked for, forgotten and asked for again."""

    weights = {**WriterOfAll.weights, "simplex": 1, "simploid": 0, "moore": 0, "product": 2, "cone": 1, "query": 14,
               "undo": 9, "identify": 6, "split": 8, "isolate": 3, "degenerate": 4, "note": 3}

    def write(self, steps):
        for k in range(self.random.choice([2, 3, 3, 4])):
            name, dim = f"b{k}", self.random.choice([0, 1, 1, 1, 2])
            self.attempt({"op": "simplex", "name": name, "dim": dim})
            if dim > 0 and self.random.random() < 0.6:
                ends = [f"{name}.0", f"{name}.1"] if dim == 1 else [f"{name}.0-1", f"{name}.1-2"]
                self.attempt({"op": "identify", "pairs": [ends]})
        for k in range(self.random.choice([2, 3, 4])):
            bodies = self.usable_bodies()
            if self.random.random() < 0.3:
                self.attempt({"op": "cone", "apex": f"w{k}", "over": self.random.choice(bodies)})
            else:
                left, right = self.random.choices(bodies, k=2)
                state = self.oracle.state
                sizes = [len(state.cells_of_body(state.find_body(body))) for body in (left, right)]
                if sizes[0] * sizes[1] <= 90:
                    self.attempt({"op": "product", "name": f"Q{k}", "left": left, "right": right,
                                  "kind": self.random.choice(["simplicial", "simploidal"])})
            if self.random.random() < 0.4:
                self.query()
        super().write(steps)


class WriterOfAbstract(WriterOfAll):
    """Insertions and collapses; other operations only now and then, since they end a body's being abstract."""

    weights = {
        **{name: 0 for name in WriterOfAll.weights},
        "insert": 20, "insert_many": 5, "collapse": 12, "query": 8, "expect": 2, "note": 1, "undo": 4,
        "simplex": 1, "identify": 1, "degenerate": 1, "cone": 1, "product": 1, "isolate": 1, "split": 1, "unglue": 1,
        "remove": 5, "replace": 7, "contract": 4,
    }
    growing = ("insert", "insert_many", "simplex", "cone", "product")
    pool = [*range(9), "10", "a", "b", "B", "é", "u*v", "w.(x|y)", "z^0"]

    def as_label(self, text):
        return int(text) if text.isdigit() and self.random.random() < 0.7 else text

    def live_labels(self, same_body=False):
        """Those that may be used, or those of one body."""
        state = self.oracle.state
        by_body = {}
        for label in sorted({*state.labels.values()}):
            try:
                by_body.setdefault(oracle.usable_body(state, label), []).append(label)
            except oracle.ScriptError:
                pass
        if same_body and by_body:
            return self.random.choice(list(by_body.values()))
        return [label for labels in by_body.values() for label in labels]

    def insert(self):
        size = self.random.choice([1, 2, 2, 3, 3, 3, 3, 4, 4, 5])
        known = self.live_labels(self.random.random() < 0.6)
        fresh = [str(x) for x in self.pool if str(x) not in self.oracle.state.labels]
        count = min(len(known), size if self.random.random() < 0.6 else size - 1)
        labels = self.random.sample(known, count)
        labels += self.random.sample(fresh, min(len(fresh), size - count))
        self.random.shuffle(labels)
        return bool(labels) and self.attempt({"op": "insert", "simplex": [self.as_label(x) for x in labels]})

    def insert_many(self):
        """A list of simplices, of which some may be there already."""
        labels = self.random.sample(self.pool, min(len(self.pool), 5))
        usable = [x for x in labels if str(x) in self.live_labels() or str(x) not in self.oracle.state.labels]
        if len(usable) < 2:
            return False
        simplices = [self.random.sample(usable, self.random.randint(1, min(len(usable), 4)))
                     for _ in range(self.random.randint(1, 4))]
        if self.random.random() < 0.3:
            return self.attempt({"op": "insert", "simplex": simplices[0], "exist_ok": True})
        return self.attempt({"op": "insert", "simplices": simplices})

    def projective_plane(self):
        """On six vertices; what is left of it after collapses may keep its torsion."""
        fresh = [str(x) for x in self.pool if str(x) not in self.oracle.state.labels]
        if len(fresh) < 6:
            return False
        labels = self.random.sample(fresh, 6)
        for triangle in ("012", "013", "024", "035", "045", "125", "134", "145", "234", "235"):
            self.attempt({"op": "insert", "simplex": [self.as_label(labels[int(k)]) for k in triangle]})
        return True

    def write(self, steps):
        if self.random.random() < 0.25:
            self.projective_plane()
        super().write(steps)

    def collapse(self):
        known = self.live_labels(self.random.random() < 0.9)
        if len(known) < 2:
            return False
        u, v = self.random.sample(known, 2)
        edges = [sorted(key) for key in self.oracle.state.orders if len(key) == 2 and key <= {*known}]
        if edges and self.random.random() < 0.6:
            u, v = self.random.sample(self.random.choice(sorted(edges)), 2)
        return self.attempt({"op": "collapse", "from": self.as_label(u), "to": self.as_label(v)})

    def contract(self):
        """An edge, with its links looked at or not."""
        edges = sorted(sorted(key) for key in self.oracle.state.orders if len(key) == 2)
        if not edges:
            return False
        u, v = self.random.sample(self.random.choice(edges), 2)
        step = {"op": "replace", "contract": [self.as_label(u), self.as_label(v)]}
        return self.attempt({**step, "link_condition": False} if self.random.random() < 0.3 else step)

    def name_of(self, cell):
        state = self.oracle.state
        if self.random.random() < 0.4:
            return state.cells[cell].name
        names = [name for name, value in state.names.items() if isinstance(name, str)
                 and value and value[0] == cell and not oracle.is_degenerate(value)]
        by_labels = ["{" + ",".join(sorted(key, key=oracle.label_key)) + "}" for key in state.orders
                     if state.names[key] and state.names[key][0] == cell and not oracle.is_degenerate(state.names[key])]
        names += [name for name in by_labels if state.names.get(name, ()) is not None]  # else one that was removed has it
        return self.random.choice(names)

    def wrong_steps(self):
        state = self.oracle.state
        known = self.live_labels()
        steps = [{"op": "insert", "simplex": []}, {"op": "insert", "simplex": [3, "3"]},
                 {"op": "insert", "simplex": ["a,b"]}, {"op": "insert", "simplex": [-1]},
                 {"op": "collapse", "from": "nobody", "to": "nobody else"}]
        steps += [{"op": "collapse", "from": label, "to": label} for label in known[:1]]
        steps += [{"op": "insert", "simplex": [label]} for label in known[:1]]
        steps += [{"op": "insert", "simplices": [["fresh"], [label]], "exist_ok": False} for label in known[:1]]
        steps += [{"op": "insert", "simplices": [["fresh"], []]}, {"op": "insert", "simplices": [["x", "x"]]}]
        dead = [label for label, now in state.labels.items() if label != now]
        left = [label for label, now in state.labels.items() if label == now and label not in known]
        for label in self.random.sample(dead, min(len(dead), 2)) + left[:2]:
            steps.append({"op": "insert", "simplex": [label, "fresh"]})
            steps.append({"op": "collapse", "from": label, "to": known[0] if known else "0"})
        return steps


class WriterOfBoundaries(WriterOfAll):
    """Cells that are known by their boundaries, and all that others do."""

    weights = {**WriterOfAll.weights, "simplex": 3, "simploid": 2, "product": 2, "cw": 8}
    growing = (*WriterOfAll.growing, "cw")

    def write(self, steps):
        self.cw()
        super().write(steps)

    def wrong_steps(self):
        edges = [{"id": "v"}, {"id": "w", "dim": 0}, {"id": "a", "dim": 1, "boundary": [[1, "w"], [-1, "v"]]}]
        wrong = [{"dim": 2, "boundary": [[1, "a"]]}, {"dim": 2, "boundary": [[1, "v"]]}, {"dim": 2, "boundary": [[1, "x"]]},
                 {"dim": 1, "boundary": [[1, "v"]]}, {"dim": 1}, {"dim": 0, "boundary": [[1, "v"]]}, {"dim": 63},
                 {"dim": 3, "boundary": [[1, "f"]]}, {"dim": 2, "boundary": [[0, "a"]]}, {"dim": -1},
                 {"dim": 2, "boundary": [[10**9, "a"], [-(10**9), "a"]]}, {"dim": 2, "faces": ["a", "a"]},
                 {"dim": 2, "type": [2]}, {"boundary": [[1, "a"], [-1, "a"]]}, {"dim": 2, "boundary": [["a", 1]]},
                 {"dim": 2, "boundary": [[2, "a"], [-1, "a"]]}]
        steps = [{"op": "complex", "name": "fresh", "cells": [*edges, {"id": "f", **cell}]} for cell in wrong]
        steps.append({"op": "complex", "name": "fresh", "cells": [{"id": "s", "dim": 2}, {"id": "t", "faces": ["s"] * 4}]})
        state = self.oracle.state
        for c in state.alive():
            if is_by_boundary(state.cells[c].kind):
                name = state.cells[c].name
                steps.append({"op": "identify", "pairs": [[name, name, [0, 1, 2]]]})
                steps.append({"op": "degenerate", "cell": name, "along": 0})
                steps.append({"op": "replace", "subdivide": name, "by": "fresh"})
                others = [b for b in state.alive() if state.dim(b) == state.dim(c) and state.cells[b].kind != state.cells[c].kind]
                steps += [{"op": "identify", "pairs": [[name, state.cells[b].name]]} for b in others[:2]]
                body = next(n for n, b in state.bodies.items() if state.body_root(b) == state.body_root(state.cells[c].body))
                steps.append({"op": "product", "name": "fresh", "left": body, "right": body})
        return steps + self.random.sample(super().wrong_steps(), 5)


SOLIDS = {
    "tetrahedron": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    "cube": [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
    "prism": [[2, 1, 0], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
    "pyramid": [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
}


def map_of_faces(faces):
    """The 2-G-map of polygons, given by their corners, that are sewn where two have a side in common.

    Side s of a polygon has its darts 2s and 2s + 1, like that of a step `polygon`; those of the polygons before come
    first.
    """
    alpha, ends = [[], [], []], {}
    for corners in faces:
        first = len(alpha[0])
        own = gmaps.polygon(len(corners))
        for i in range(3):
            alpha[i] += [first + image for image in own[i]]
        for s in range(len(corners)):
            side = corners[s], corners[(s + 1) % len(corners)]
            for d, corner in ((first + 2 * s, side[0]), (first + 2 * s + 1, side[1])):
                other = ends.setdefault((frozenset(side), corner), d)
                alpha[2][d], alpha[2][other] = other, d
    return alpha


class WriterOfMaps(WriterOfAll):
    """Maps are made and sewn, unsewn and extended, beside all that others do."""

    of_maps = {"polygon": 8, "solid": 3, "surface": 2, "closed_surface": 4, "closed_solid": 1, "small_map": 2, "nmap": 2, "chain": 3,
               "incidence": 3, "sew": 22, "unsew": 8, "extend": 5, "map_product": 4, "take_cell_out": 10, "put_cell_in": 10}
    weights = {**WriterOfAll.weights, "product": 1, "simploid": 1, "loops": 0, "moore": 0, "simplex": 2, "cw": 1, **of_maps}
    growing = (*WriterOfAll.growing, "cw", "polygon", "solid", "surface", "closed_surface", "closed_solid", "small_map", "nmap",
               "chain", "incidence", "map_product", "put_cell_in")
    last_surface = None

    def write(self, steps):
        if self.random.random() < 0.3:  # nothing else
            self.weights = {**self.of_maps, "query": 5, "expect": 1, "undo": 3}
        for _ in range(self.random.randint(1, 3)):
            self.random.choice([self.polygon, self.polygon, self.solid, self.surface, self.closed_surface])()
        super().write(steps)

    def make(self, step):
        """By cells, seldom by simplices."""
        if step["op"] == "polygon" and self.random.random() < 0.2:
            step = {**step, "at": [[k, self.random.random()] for k in range(step["sides"])]}
        return self.attempt({**step, "as": "simplices"} if self.random.random() < 0.1 else step)

    def polygon(self):
        sides = self.random.choice([1, 2, 3, 3, 4, 4, 5, 6])
        return self.make({"op": "polygon", "name": self.fresh("p"), "sides": sides})

    def solid(self):
        alpha = map_of_faces(SOLIDS[self.random.choice(sorted(SOLIDS))])
        return self.make({"op": "gmap", "name": self.fresh("s"), "alpha": [*alpha, list(range(len(alpha[0])))]})

    def surface(self):
        """Some or all faces of a solid."""
        faces = SOLIDS[self.random.choice(sorted(SOLIDS))]
        count = self.random.choice([1, 2, 3, len(faces), len(faces)])
        return self.make({"op": "gmap", "name": self.fresh("f"), "alpha": map_of_faces(faces[:count])})

    def closed_surface(self):
        """Polygons whose sides are sewn in pairs, in any way; with a cell over it, or none; often the same once more."""
        alpha = self.last_surface
        if alpha is None or self.random.random() < 0.5:
            alpha = [[], [], []]
            sizes = self.random.choice([[2], [2], [4], [4], [6], [3, 3], [4, 4], [2, 4], [3, 4, 3]])
            for size in sizes:
                first = len(alpha[0])
                for images, own in zip(alpha, gmaps.polygon(size)):
                    images += [first + d for d in own]
            sides = self.random.sample(range(sum(sizes)), sum(sizes))
            for one, other in zip(sides[::2], sides[1::2]):
                turned = self.random.random() < 0.4
                for k in range(2):
                    alpha[2][2 * one + k], alpha[2][2 * other + (k ^ 1 ^ turned)] = (
                        2 * other + (k ^ 1 ^ turned), 2 * one + k)
            self.last_surface = alpha
        if self.random.random() < 0.7:
            alpha = [*alpha, list(range(len(alpha[0])))]
        return self.attempt({"op": "gmap", "name": self.fresh("u"), "alpha": alpha})

    def closed_solid(self):
        """Two solids, or cells over surfaces without boundary, sewn to one another along all faces: dimension 3, no free darts."""
        if self.last_surface is None or self.random.random() < 0.5:
            alpha = map_of_faces(SOLIDS[self.random.choice(["tetrahedron", "pyramid"])])
        else:
            alpha = self.last_surface[:3]
        size = len(alpha[0])
        alpha = [[*images, *(size + d for d in images)] for images in alpha]
        return self.attempt({"op": "gmap", "name": self.fresh("o"),
                             "alpha": [*alpha, [*range(size, 2 * size), *range(size)]]})

    def small_map(self):
        """Dimension 0 or 1: points, which may be in pairs, paths and circles. By cells no edge may lack an end."""
        pairs = self.random.randint(1, 4)
        darts = range(2 * pairs)
        alpha = [[d ^ 1 for d in darts]]
        if self.random.random() < 0.7:
            alpha.append(gmaps.polygon(pairs)[1])
            if self.random.random() < 0.3:
                alpha[1][0], alpha[1][-1] = 0, darts[-1]
        elif self.random.random() < 0.5:
            alpha = [[*darts]]
        return self.make({"op": "gmap", "name": self.fresh("c"), "alpha": alpha})

    def nmap(self):
        """Polygons, or what is left of some, with sides sewn so that the orientations agree."""
        sizes = self.random.choices([1, 2, 3, 4], k=self.random.randint(1, 3))
        beta = [[], []]
        for size in sizes:
            first = len(beta[0])
            beta[0] += [first + (k + 1) % size for k in range(size)]
            beta[1] += [None] * size
        darts = list(range(len(beta[0])))
        self.random.shuffle(darts)
        for one, other in zip(darts[::2], darts[1::2]):
            if self.random.random() < 0.5:
                beta[1][one], beta[1][other] = other, one
        step = {"op": "map", "name": self.fresh("n"), "beta": beta}
        if self.random.random() < 0.15:  # open faces are no discs
            beta[0][self.random.choice(darts)] = None
            return self.attempt({**step, "as": "simplices"})
        return self.make(step)

    def chain(self):
        """Polygons, some of which have sides in common, and edges: of each the least darts of sides are the same."""
        sizes = self.random.choices([1, 2, 3, 4], k=self.random.randint(1, 3))
        points, edges, sides = 0, [], []  # edges by their ends, sides of polygons by the edges that they go along
        for size in sizes:
            shared = self.random.random() < 0.5
            corners = [0 if shared and k == 0 else points + k for k in range(size)]
            points += size
            for k in range(size):
                ends = [corners[k], corners[(k + 1) % size]]
                number = edges.index(ends) if ends in edges and self.random.random() < 0.5 else len(edges)
                edges[number:number + 1] = [ends]
                sides.append(number)
        edges += [[self.random.randrange(points) for _ in range(2)] for _ in range(self.random.randint(0, 1))]
        darts, alpha, first = range(2 * len(sides)), [], 0
        for size in sizes:
            alpha += [2 * first + image for image in gmaps.polygon(size)[1]]
            first += size
        levels = [{"darts": points}, {"alpha": [[d ^ 1 for d in range(2 * len(edges))]], "sigma": sum(edges, [])},
                  {"alpha": [[d ^ 1 for d in darts], alpha], "sigma": [2 * sides[d // 2] + d % 2 for d in darts]}]
        step = {"op": "chain_of_maps", "name": self.fresh("h"), "levels": levels[:self.random.choice([1, 2, 3, 3, 3, 3])]}
        if self.random.random() < 0.1:
            spoilt = self.random.choice(step["levels"][1:] or [{"sigma": [0]}])["sigma"]
            spoilt[self.random.randrange(len(spoilt))] = self.random.randrange(len(spoilt))
        return self.make(step)

    def incidence(self):
        """A solid, its surface, or some of its faces, listed in any order."""
        polygons = SOLIDS[self.random.choice(sorted(SOLIDS))]
        polygons = polygons[:self.random.choice([1, 2, len(polygons), len(polygons)])]
        cells, edges = {f"v{corner}": [] for corners in polygons for corner in corners}, {}
        for k, corners in enumerate(polygons):
            below = []
            for one, other in zip(corners, [*corners[1:], corners[0]]):
                ident = edges.setdefault(frozenset((one, other)), f"e{min(one, other)}{max(one, other)}")
                cells[ident] = [f"v{one}", f"v{other}"]
                below.append(ident)
            cells[f"f{k}"] = below
        if self.random.random() < 0.6:  # where some faces are missing there is no ball
            cells["w"] = [f"f{k}" for k in range(len(polygons))]
        listed = list(cells.items())
        self.random.shuffle(listed)
        for _, below in listed:
            self.random.shuffle(below)
        return self.make({"op": "incidence", "name": self.fresh("g"),
                          "cells": [{"id": ident, **({"faces": below} if below else {})} for ident, below in listed]})

    def map_product(self):
        """Of two bodies with cells of maps, or of one and a circle or a segment that is made for it."""
        state = self.oracle.state
        if self.random.random() < 0.5:
            size, closed = self.random.choice([1, 1, 2, 3]), self.random.random() < 0.5
            pairs = [d ^ 1 for d in range(2 * size)]
            turns = gmaps.polygon(size)[1]
            if not closed:
                turns[0], turns[-1] = 0, 2 * size - 1
            step = {"op": "gmap", "name": self.fresh("g"), "alpha": [pairs, turns]}
            if self.random.random() < 0.2:  # with levels
                vertices = [(d + 1) // 2 % size if closed else (d + 1) // 2 for d in range(2 * size)]
                levels = [{"darts": size if closed else size + 1}, {"alpha": [pairs], "sigma": vertices}]
                step = {"op": "chain_of_maps", "name": step["name"], "levels": levels}
            self.attempt(step)
        state = self.oracle.state
        sizes = {}
        for name in self.usable_bodies():
            body = state.find_body(name)
            if body in state.mapped or len(state.cells_of_body(body)) < 4:
                factor = oracle.darts_of_factor(state, body)
                sizes[name] = max(len(factor.seen[-1]), 1) if factor else 1, len(state.cells_of_body(body))
        pairs = [(left, right) for left, (darts, cells) in sizes.items() for right, (others, more) in sizes.items()
                 if darts * others <= 160 and 0 < cells * more <= 60]
        if not pairs:
            return False
        left, right = self.random.choice(pairs)
        names = [sum(1 for value in state.names.values()
                     if value and state.body_root(state.cells[value[0]].body) == state.find_body(name)) for name in (left, right)]
        return names[0] * names[1] <= 3000 and self.attempt(
            {"op": "product", "name": self.fresh("P"), "left": left, "right": right})

    def dart_text(self, dart):
        return f"{dart[0]}:{oracle.dart_text(self.oracle.state, dart)}"

    def sew(self):
        """One pair or two; many would fold something, or are not alike."""
        state = self.oracle.state
        names = [name for name in state.maps if any(d[0] == name and d in images
                                                    for d, images in state.alpha.items())]
        for _ in range(8 if names else 0):
            n = state.maps[self.random.choice(names)].dimension
            i = n if self.random.random() < 0.95 else self.random.randint(0, n)
            free = [d for d, images in state.alpha.items() if state.maps[d[0]].dimension == n and images[i] == d]
            if self.random.random() < 0.5 and free:  # within one map
                name = self.random.choice(free)[0]
                free = [d for d in free if d[0] == name]
            pairs = [[self.dart_text(self.random.choice(free)) for _ in range(2)]
                     for _ in range(self.random.choice([1, 1, 1, 2])) if free]
            if pairs and self.attempt({"op": "sew", "dim": i, "pairs": pairs}):
                return True
        return False

    def unsew(self):
        state = self.oracle.state
        sewn = [(d, i) for d, images in state.alpha.items() for i, image in enumerate(images)
                if image != d and (i == len(images) - 1 or state.maps[d[0]].glued is not None)]
        if not sewn:
            return False
        first, i = self.random.choice(sewn)
        if self.random.random() < 0.4:  # of a map by simplices, if there is one
            first, i = self.random.choice([(d, j) for d, j in sewn if state.maps[d[0]].glued is not None] or [(first, i)])
        also = [d for d, j in sewn if j == i and (state.maps[d[0]].glued is None) == (state.maps[first[0]].glued is None)]
        chosen = [first, *self.random.choices(also, k=self.random.choice([0, 0, 0, 1]))]
        return self.attempt({"op": "unsew", "dim": i, "darts": [self.dart_text(d) for d in chosen]})

    def extend(self):
        """Any map; those that bound nothing are rare."""
        names = sorted(self.oracle.state.maps)
        self.random.shuffle(names)
        return any(self.attempt({"op": "extend", "maps": [name]}) for name in names[:6])

    def dart_by_cells(self):
        """Any, and the dimension of its map; or None."""
        state = self.oracle.state
        darts = [d for d in state.alpha if state.maps[d[0]].glued is None]
        if not darts:
            return None
        dart = self.random.choice(darts)
        if self.random.random() < 0.5:  # largest maps are made of many darts, and sewn ones
            n = self.random.choice(sorted({state.maps[d[0]].dimension for d in darts}))
            dart = self.random.choice([d for d in darts if state.maps[d[0]].dimension == n])
        return dart, state.maps[dart[0]].dimension

    def take_cell_out(self):
        """A removal or a contraction."""
        for _ in range(8):
            found = self.dart_by_cells()
            if not found:
                return False
            dart, n = found
            op, i = self.random.choice([("remove_cell", self.random.randint(0, n)), ("contract_cell", self.random.randint(0, n))])
            step = {"op": op, "cell": oracle.dart_cell_name(dart[0], i, oracle.dart_text(self.oracle.state, dart))}
            if i == 2 and dart[1] == 0 and dart[0] in self.oracle.state.names and self.random.random() < 0.5:
                step["cell"] = dart[0]
            if self.random.random() < 0.1:
                step["map"] = dart[0]
            if self.attempt(step):
                return True
        return False

    def put_cell_in(self):
        """An insertion or a split: with one dart, two of a cell, or a path."""
        for _ in range(8):
            found = self.dart_by_cells()
            if not found:
                return False
            dart, n = found
            low = self.random.choice([0, 1, 1, 2, 2])
            op, i, order = self.random.choice([("insert_cell", low, range(n + 1)), ("split_cell", n - low, range(n, -1, -1))])
            darts = [dart]
            if low == 1 and n > 0 and self.random.random() < 0.7:
                images = self.oracle.state.alpha
                darts.append(self.random.choice(local_operations.reached(images, order[:2], dart)))
            elif low == 2 and n > 2:
                darts = self.closed_path(dart, order)
            step = {"op": op, "name": self.fresh("k"), "dim": max(i, 0), "darts": [self.dart_text(d) for d in darts]}
            if self.random.random() < 0.1:
                step["at"] = [1, 2.5]
            if self.attempt(step):
                return True
        return False

    def closed_path(self, start, order):
        """Edge after edge, without a dart that was met, until one ends where the first begins; or around a face."""
        images, path = self.oracle.state.alpha, [start]
        around_face = self.random.random() < 0.3
        while len(path) < 8:
            end = images[path[-1]][order[0]]
            vertex = local_operations.reached(images, order[1:3], end)
            if start in vertex and (not around_face or start == images[end][order[1]]):
                break
            path.append(images[end][order[1]] if around_face else self.random.choice(vertex))
        return path

    def wrong_steps(self):
        state = self.oracle.state
        steps = super().wrong_steps() + [
            {"op": "polygon", "name": "fresh", "sides": 0},
            {"op": "remove_cell", "cell": "nobody.1:0"},
            {"op": "contract_cell", "cell": "nobody"},
            {"op": "insert_cell", "name": "fresh", "dim": 1, "darts": []},
            {"op": "split_cell", "name": "fresh", "dim": 1, "darts": ["nobody:0"]},
            {"op": "gmap", "name": "fresh", "alpha": [[1, 0], [0]]},
            {"op": "gmap", "name": "fresh", "alpha": [[0]] * 2},
            {"op": "gmap", "name": "fresh", "alpha": []},
            {"op": "gmap", "name": "fresh", "alpha": [[1, 0], [1, 0], [0, 1]], "as": "cells"},
            {"op": "map", "name": "fresh", "beta": [[0], [0]]},
            {"op": "chain_of_maps", "name": "fresh", "levels": [{"darts": 0}]},
            {"op": "chain_of_maps", "name": "fresh", "levels": [{}, {"alpha": [[0, 1]], "sigma": [0, 1]}]},
            {"op": "chain_of_maps", "name": "fresh", "levels": [{}, {"alpha": [[1, 0]], "sigma": [0, 1]},
                                                                {"alpha": [[1, 0], [1, 0]], "sigma": [0, 0]}]},
            {"op": "incidence", "name": "fresh", "cells": []},
            {"op": "incidence", "name": "fresh", "cells": [{"id": "a"}, {"id": "e", "faces": ["a"]}]},
            {"op": "incidence", "name": "fresh", "cells": [{"id": "a"}, {"id": "b"}, {"id": "c"},
                                                           {"id": "e", "faces": ["a", "b"]}, {"id": "f", "faces": ["e", "c"]}]},
            {"op": "map", "name": "fresh", "beta": [[1, 1], [None, None]]},
            {"op": "sew", "dim": 2, "pairs": [["nobody:0", "nobody:1"]]},
            {"op": "unsew", "dim": 2, "darts": ["nobody:0"]},
            {"op": "extend", "maps": []},
            {"op": "extend", "maps": ["nobody"]},
        ]
        for d in self.random.sample(list(state.alpha), min(len(state.alpha), 3)):
            dart, n = self.dart_text(d), state.maps[d[0]].dimension
            steps.append({"op": "sew", "dim": n, "pairs": [[dart, dart]]})
            steps.append({"op": "sew", "dim": n + 1, "pairs": [[dart, dart]]})
            steps.append({"op": "unsew", "dim": n + 1, "darts": [dart]})
            steps.append({"op": "insert_cell", "name": "fresh", "dim": n, "darts": [dart]})
            steps.append({"op": "split_cell", "name": "fresh", "dim": 0, "darts": [dart]})
            for i in range(n + 2):
                cell = oracle.dart_cell_name(d[0], i, oracle.dart_text(state, d))
                steps += [{"op": op, "cell": cell} for op in ("remove_cell", "contract_cell")]
            steps.append({"op": "polygon", "name": d[0], "sides": 2})
            if state.alpha[d][n] == d:
                steps.append({"op": "unsew", "dim": n, "darts": [dart]})
            else:
                steps.append({"op": "sew", "dim": n, "pairs": [[dart, self.dart_text(state.alpha[d][n])]]})
            if state.maps[d[0]].glued is None:
                steps.append({"op": "simplex", "name": oracle.dart_cell_name(d[0], 0, "0"), "dim": 0})
            else:
                steps.append({"op": "simplex", "name": f"{d[0]}.<0>:0", "dim": 0})
        return steps


class WriterOfEverything(WriterOfMaps):
    """All operations; in some scripts no maps, as these are no factors of products."""

    weights = {**WriterOfAll.weights, "cw": 1, "polygon": 2, "solid": 1, "surface": 1, "closed_surface": 1, "closed_solid": 1,
               "small_map": 1, "nmap": 1, "chain": 1, "incidence": 1, "sew": 7, "unsew": 3, "extend": 2, "take_cell_out": 4,
               "put_cell_in": 4}

    def write(self, steps):
        if self.random.random() < 0.4:
            self.weights = {name: weight for name, weight in self.weights.items() if name in WriterOfAll.weights}
        WriterOfAll.write(self, steps)


WRITERS = {"basic": Writer, "all": WriterOfEverything, "tear": WriterOfTearing, "nest": WriterOfNests,
           "abstract": WriterOfAbstract, "maps": WriterOfMaps, "boundaries": WriterOfBoundaries}


def is_by_boundary(kind):
    return isinstance(kind, (boundaries.Bounded, boundaries.Hollow))


def cycles_of(chains):
    """A basis of the combinations, with rational coefficients, of cells with these boundaries that have none."""
    done, cycles = {}, []
    for cell, below in chains.items():
        chain = {cell: 1}
        while below:
            pivot = max(below)
            if pivot not in done:
                done[pivot] = below, chain
                break
            other, other_chain = done[pivot]
            a, b = below[pivot], other[pivot]
            below, chain = combine(below, b, other, -a), combine(chain, b, other_chain, -a)
        if not below:
            cycles.append(chain)
    return cycles


def combine(a, x, b, y):
    total = {c: x * v for c, v in a.items()}
    for c, v in b.items():
        total[c] = total.get(c, 0) + y * v
    return {c: v for c, v in total.items() if v}


def write_script(seed, steps, ring="Z", illegal=False, operations="basic", weights=None):
    """The lines of a random script, as one string."""
    writer = WRITERS[operations](seed, ring)
    if weights:
        writer.weights = {**writer.weights, **weights}
    writer.write(steps)
    lines = list(writer.lines)
    if illegal:
        lines.append(writer.wrong_step())
    return "".join(json.dumps(line, ensure_ascii=False) + "\n" for line in lines)


def read_weights(options):
    """The arguments of --weight as a dictionary."""
    known = WRITERS[options.ops].weights if options.ops in ("all", "maps", "boundaries") else {}
    weights = {}
    for text in options.weight:
        name, _, number = text.partition("=")
        if name not in known or not number.isdigit():
            sys.exit(f"random_script.py: --weight takes NAME=N with --ops all, maps or boundaries, NAME one of {', '.join(known) or '-'}")
        weights[name] = int(number)
    return weights


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--ring", default="Z")
    parser.add_argument("--ops", choices=WRITERS, default="basic")
    parser.add_argument("--weight", action="append", default=[], metavar="NAME=N")
    parser.add_argument("--illegal", action="store_true")
    options = parser.parse_args()
    weights = read_weights(options)
    sys.stdout.write(
        write_script(options.seed, options.steps, options.ring, options.illegal, options.ops, weights))


if __name__ == "__main__":
    main()
