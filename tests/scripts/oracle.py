#!/usr/bin/env python3
"""A second, slow and plain implementation of the script semantics of sesame.

    oracle.py [--ring Z|Z/p] FILE        (FILE may be - for standard input)

Replays a script and prints one JSON object a step with the keys step, op, cells, euler, betti, torsion and, for
`class`, class.cycle and class.zero: the lines of `sesame replay --json --every 1` without times and without the sizes
of the effective complexes. It shares no idea with the engine: a step copies the whole state, and homology is computed
from scratch with a Smith form on Python's integers. Where both agree, they agree for different reasons.

Covered: simplex, simploid, complex, cone (over simplices), identify, expect, class, undo, note.
Exit status as `sesame replay`: 0 done, 1 wrong usage or unreadable file, 2 the script is wrong, 3 an expect failed.
"""

import copy
import itertools
import json
import math
import sys

LARGEST_DIMENSION = 16  # a simplex has 2^(dim+1) - 1 cells; beyond this the oracle refuses


class ScriptError(Exception):
    """The script is wrong; nothing of the step happened."""


class ExpectFailed(Exception):
    """An `expect` met a different state."""


# ------------------------------------------------------------------------------------------------ linear algebra


def invariant_factors(rows, prime=0):
    """Non-zero invariant factors of the matrix given as a list of {column: value}; over Z/prime when prime > 0.

    Plain Smith reduction: the entry of least absolute value is the pivot (of equals, the one with least fill), its
    column is cleared by row operations and its row by column operations, going over to a smaller remainder.
    """
    table = {}
    columns = {}
    for i, row in enumerate(rows):
        kept = {j: (v % prime if prime else v) for j, v in row.items()}
        kept = {j: v for j, v in kept.items() if v}
        if kept:
            table[i] = kept
            for j in kept:
                columns.setdefault(j, set()).add(i)

    def add_row(target, source, factor):
        row = table[target]
        for j, v in table[source].items():
            new = row.get(j, 0) + factor * v
            if prime:
                new %= prime
            if new:
                row[j] = new
                columns[j].add(target)
            elif j in row:
                del row[j]
                columns[j].discard(target)

    diagonal = []
    while True:
        best = None
        for i, row in table.items():
            for j, v in row.items():
                cost = (1 if prime else abs(v), (len(row) - 1) * (len(columns[j]) - 1))
                if best is None or cost < best[0]:
                    best = (cost, i, j)
            if best and best[0] == (1, 0):
                break
        if best is None:
            break
        _, i, j = best
        while True:
            pivot = table[i][j]
            smaller = None
            for k in sorted(columns[j] - {i}):
                value = table[k][j]
                factor = -value * pow(pivot, -1, prime) if prime else -(value // pivot)
                add_row(k, i, factor)
                if j in table[k]:
                    smaller = k
            if smaller is not None:
                i = smaller
                continue
            # The column holds the pivot only, so a column operation with it changes nothing but the pivot's row.
            moved = None
            if not prime:
                for c in sorted(table[i]):
                    if c != j:
                        remainder = table[i][c] % pivot
                        if remainder:
                            table[i][c] = remainder
                            moved = c
                        else:
                            del table[i][c]
                            columns[c].discard(i)
            if moved is None:
                break
            j = moved
        diagonal.append(1 if prime else abs(table[i][j]))
        for c in table.pop(i):
            columns[c].discard(i)
        for k in [k for k in table if not table[k]]:
            del table[k]
    return divisibility_chain(diagonal)


def divisibility_chain(diagonal):
    """The same group as the diagonal, with each entry dividing the next."""
    units = [d for d in diagonal if d == 1]
    rest = [d for d in diagonal if d != 1]
    for a in range(len(rest)):
        for b in range(a + 1, len(rest)):
            g = math.gcd(rest[a], rest[b])
            rest[a], rest[b] = g, rest[a] // g * rest[b]
    return units + rest


# ------------------------------------------------------------------------------------------------ cells


def is_prime(n):
    if n < 2:
        return False
    k = 2
    while k * k <= n:
        if n % k == 0:
            return False
        k += 1
    return True


def parse_ring(text):
    """The prime of Z/p, 0 for Z."""
    if text == "Z":
        return 0
    if isinstance(text, str) and text.startswith("Z/"):
        digits = text[2:]
        if digits.isascii() and digits.isdigit() and int(digits) < 2**31 and is_prime(int(digits)):
            return int(digits)
    raise ScriptError(f'ring must be "Z" or "Z/p" with p prime and below 2^31, not {json.dumps(text)}')


def is_integer(value):
    """A JSON integer of 64 bits; larger ones are written as strings of digits, see integer()."""
    return type(value) is int and -(2**63) <= value < 2**64


def integer(value, what):
    if is_integer(value):
        return value
    if isinstance(value, str) and value.isascii() and value.removeprefix("-").isdigit():
        return int(value)
    raise ScriptError(f"{what} must be an integer; beyond 64 bits, a string of digits")


def check_name(name, what):
    if not isinstance(name, str) or not name:
        raise ScriptError(f"{what} must be a non-empty string")
    if any(ord(ch) <= 32 or ord(ch) == 127 for ch in name):
        raise ScriptError(f"{what} must have neither white space nor control characters")
    return name


def check_point(point, what):
    good = isinstance(point, list) and len(point) in (2, 3)
    if not good or not all(isinstance(x, (int, float)) and not isinstance(x, bool) for x in point):
        raise ScriptError(f"{what} must be a point of two or three numbers")


def check_points(points, count):
    if not isinstance(points, list) or len(points) != count:
        raise ScriptError(f"at must list {count} points")
    for point in points:
        check_point(point, "every entry of at")


def subsets(size):
    """Non-empty subsets of {0..size} as increasing tuples, in lexicographic order."""
    found = []
    for count in range(1, size + 2):
        found.extend(itertools.combinations(range(size + 1), count))
    return sorted(found)


def face_slots(kind):
    """The (component, index) of each face, in the flattened order; both counted from 0."""
    return [(i, j) for i, a in enumerate(kind) for j in range(a + 1)]


def face_kind(kind, i):
    if kind[i] > 1:
        return kind[:i] + (kind[i] - 1,) + kind[i + 1:]
    return kind[:i] + kind[i + 1:]


class Cell:
    def __init__(self, name, kind, faces, body):
        self.name = name
        self.kind = kind  # type of the simploid; () for a vertex
        self.faces = faces  # numbers of cells, d^1_0, d^1_1, ..., d^2_0, ...; resolve before use
        self.body = body

    @property
    def dim(self):
        return sum(self.kind)


class State:
    """Cells in creation order; a merged cell points at the older one that it became part of."""

    def __init__(self):
        self.cells = []
        self.merged_into = []
        self.names = {}  # cell name -> number of the cell
        self.bodies = {}  # body name -> number of the body
        self.body_merged_into = []

    def copy(self):
        return copy.deepcopy(self)

    # -- reading

    def root(self, number):
        while self.merged_into[number] != number:
            number = self.merged_into[number]
        return number

    def body_root(self, number):
        while self.body_merged_into[number] != number:
            number = self.body_merged_into[number]
        return number

    def find(self, name):
        if not isinstance(name, str):
            raise ScriptError("a cell's name must be a string")
        if name not in self.names:
            raise ScriptError(f'no cell is called "{name}"')
        return self.root(self.names[name])

    def alive(self):
        return [c for c in range(len(self.cells)) if self.merged_into[c] == c]

    def faces(self, number):
        return [self.root(f) for f in self.cells[number].faces]

    def by_dimension(self):
        """Lists of living cells, dimension 0 up to the largest that has one."""
        alive = self.alive()
        if not alive:
            return []
        lists = [[] for _ in range(1 + max(self.cells[c].dim for c in alive))]
        for c in alive:
            lists[self.cells[c].dim].append(c)
        return lists

    def boundary(self, number):
        """Sum of (-1)^(j + a_1 + ... + a_{i-1}) d^i_j as {cell: coefficient}."""
        kind = self.cells[number].kind
        chain = {}
        for (i, j), face in zip(face_slots(kind), self.faces(number)):
            sign = -1 if (j + sum(kind[:i])) % 2 else 1
            chain[face] = chain.get(face, 0) + sign
        return {c: v for c, v in chain.items() if v}

    # -- changing

    def check_free(self, name, own_body=None):
        if name in self.names or (name in self.bodies and name != own_body):
            raise ScriptError(f'the name "{name}" is taken')

    def new_body(self, name):
        self.check_free(name)
        self.bodies[name] = len(self.body_merged_into)
        self.body_merged_into.append(len(self.body_merged_into))
        return self.bodies[name]

    def merge_bodies(self, a, b):
        a, b = self.body_root(a), self.body_root(b)
        self.body_merged_into[max(a, b)] = min(a, b)

    def add(self, name, kind, faces, body, body_name=None):
        self.check_free(name, body_name)
        number = len(self.cells)
        self.cells.append(Cell(name, kind, faces, body))
        self.merged_into.append(number)
        self.names[name] = number
        return number


def chain_rank_data(state, prime):
    lists = state.by_dimension()
    factors = [[]]
    for p in range(1, len(lists)):
        factors.append(invariant_factors([state.boundary(c) for c in lists[p]], prime))
    factors.append([])
    return lists, factors


def summary(state, prime):
    """Cells, Euler characteristic, Betti numbers and torsion, all from scratch."""
    lists, factors = chain_rank_data(state, prime)
    sizes = [len(cells) for cells in lists]
    return {
        "cells": sizes,
        "euler": sum(n if p % 2 == 0 else -n for p, n in enumerate(sizes)),
        "betti": [n - len(factors[p]) - len(factors[p + 1]) for p, n in enumerate(sizes)],
        "torsion": [[t for t in factors[p + 1] if t > 1] for p in range(len(sizes))],
    }


def boundary_of_chain(state, chain, prime):
    total = {}
    for c, v in chain.items():
        for face, sign in state.boundary(c).items():
            total[face] = total.get(face, 0) + sign * v
    return {c: (v % prime if prime else v) for c, v in total.items() if (v % prime if prime else v)}


def is_boundary(state, chain, prime):
    """Whether a cycle bounds: adding it to the boundaries must change neither their rank nor their index."""
    if not chain:
        return True
    dim = state.cells[next(iter(chain))].dim
    lists = state.by_dimension()
    above = [state.boundary(c) for c in lists[dim + 1]] if dim + 1 < len(lists) else []
    return invariant_factors(above, prime) == invariant_factors(above + [chain], prime)


def read_chain(state, chain, prime):
    """[[coefficient, name], ...] as {cell: coefficient}; one dimension only."""
    if not isinstance(chain, list):
        raise ScriptError("chain must be a list of [coefficient, cell]")
    total = {}
    dims = set()
    for term in chain:
        if not isinstance(term, list) or len(term) != 2:
            raise ScriptError("a term of a chain must be [integer, cell]")
        cell = state.find(term[1])
        dims.add(state.cells[cell].dim)
        total[cell] = total.get(cell, 0) + integer(term[0], "a coefficient")
    if len(dims) > 1:
        raise ScriptError("the cells of a chain must have one dimension")
    return {c: (v % prime if prime else v) for c, v in total.items() if (v % prime if prime else v)}


# ------------------------------------------------------------------------------------------------ operations


def fields(step, required, optional=()):
    for field in step:
        if field != "op" and field not in required and field not in optional:
            raise ScriptError(f'{step["op"]} has no field "{field}"')
    for field in required:
        if field not in step:
            raise ScriptError(f'{step["op"]} needs the field "{field}"')


def add_simploid(state, name, kind):
    """All faces by dimension, then lexicographically in the vertex subsets."""
    body = state.new_body(name)
    parts = [subsets(a) for a in kind] if kind else [[(0,)]]
    faces = sorted(itertools.product(*parts), key=lambda face: (sum(len(s) - 1 for s in face), face))
    numbers = {}
    for face in faces:
        is_top = all(len(s) == a + 1 for s, a in zip(face, kind or (0,)))
        label = "x".join("-".join(map(str, s)) for s in face)
        below = []
        for i, s in enumerate(face):
            if len(s) > 1:
                for j in range(len(s)):
                    below.append(numbers[face[:i] + (s[:j] + s[j + 1:],) + face[i + 1:]])
        own_kind = tuple(len(s) - 1 for s in face if len(s) > 1)
        cell_name = name if is_top else f"{name}.{label}"
        numbers[face] = state.add(cell_name, own_kind, below, body, name)


def op_simplex(state, step, _prime):
    fields(step, ("name", "dim"), ("at",))
    name, dim = check_name(step["name"], "name"), step["dim"]
    if not is_integer(dim) or not 0 <= dim <= LARGEST_DIMENSION:
        raise ScriptError(f"dim must be an integer from 0 to {LARGEST_DIMENSION}")
    if "at" in step:
        check_points(step["at"], dim + 1)
    add_simploid(state, name, (dim,) if dim else ())
    if dim == 0:  # the one vertex is vertex 0 as well
        state.check_free(f"{name}.0")
        state.names[f"{name}.0"] = state.names[name]


def op_simploid(state, step, _prime):
    fields(step, ("name", "type"), ("at",))
    name, kind = check_name(step["name"], "name"), step["type"]
    if not isinstance(kind, list) or not all(is_integer(a) and a >= 1 for a in kind):
        raise ScriptError("type must be a list of positive integers")
    if sum(kind) > LARGEST_DIMENSION:
        raise ScriptError(f"a simploid may have dimension {LARGEST_DIMENSION} at most")
    if "at" in step:
        check_points(step["at"], math.prod(a + 1 for a in kind))
    add_simploid(state, name, tuple(kind))


def read_complex_cell(entry):
    """(id, type, face ids) of one entry of `complex`."""
    if not isinstance(entry, dict):
        raise ScriptError("every cell must be an object")
    for field in entry:
        if field not in ("id", "type", "faces", "at"):
            raise ScriptError(f'a cell of a complex has no field "{field}"')
    if "id" not in entry:
        raise ScriptError('a cell of a complex needs the field "id"')
    ident = check_name(entry["id"], "id")
    below = entry.get("faces", [])
    if not isinstance(below, list) or not all(isinstance(f, str) for f in below):
        raise ScriptError(f'faces of "{ident}" must be a list of ids')
    if "type" in entry:
        kind = entry["type"]
        if not isinstance(kind, list) or not all(is_integer(a) and a >= 1 for a in kind):
            raise ScriptError(f'type of "{ident}" must be a list of positive integers')
        kind = tuple(kind)
    else:
        if len(below) == 1:
            raise ScriptError(f'"{ident}" has one face; an edge has two')
        kind = (len(below) - 1,) if below else ()
    if len(below) != sum(a + 1 for a in kind):
        raise ScriptError(f'"{ident}" needs {sum(a + 1 for a in kind)} faces, not {len(below)}')
    if "at" in entry:
        if kind:
            raise ScriptError(f'"{ident}" is not a vertex and takes no "at"')
        check_point(entry["at"], "at")
    return ident, kind, below


def check_face_laws(ident, kind, below, faces_of):
    """d^i_l d^i_j = d^i_{j-1} d^i_l (l < j, a_i > 1) and, for k < i, d^k_l d^i_j = d^{i'}_j d^k_l."""

    def face(cell_kind, cell_faces, i, j):
        return cell_faces[sum(a + 1 for a in cell_kind[:i]) + j]

    def second(i, j, k, m):
        first = face(kind, below, i, j)
        return face(face_kind(kind, i), faces_of(first), k, m)

    for i, a in enumerate(kind):
        for j in range(a + 1):
            if a > 1:
                for m in range(j):
                    if second(i, j, i, m) != second(i, m, i, j - 1):
                        raise ScriptError(f'"{ident}" breaks the face law of component {i + 1}, faces {m} and {j}')
            for k in range(i):
                for m in range(kind[k] + 1):
                    i_after = i if kind[k] > 1 else i - 1
                    if second(i, j, k, m) != second(k, m, i_after, j):
                        raise ScriptError(f'"{ident}" breaks the face law of components {k + 1} and {i + 1}')


def op_complex(state, step, _prime):
    fields(step, ("name", "cells"))
    name = check_name(step["name"], "name")
    if not isinstance(step["cells"], list):
        raise ScriptError("cells must be a list")
    entries = {}
    for entry in step["cells"]:
        ident, kind, below = read_complex_cell(entry)
        if ident in entries:
            raise ScriptError(f'the id "{ident}" is listed twice')
        entries[ident] = (kind, below)
    for ident, (kind, below) in entries.items():
        for (i, _), other in zip(face_slots(kind), below):
            if other not in entries:
                raise ScriptError(f'face "{other}" of "{ident}" is not listed')
            if entries[other][0] != face_kind(kind, i):
                raise ScriptError(f'face "{other}" of "{ident}" has the wrong type')
    for ident, (kind, below) in entries.items():
        check_face_laws(ident, kind, below, lambda other: entries[other][1])
    body = state.new_body(name)
    numbers = {}

    def place(ident):  # in the order of listing, but after the faces
        if ident not in numbers:
            kind, below = entries[ident]
            for face in below:
                place(face)
            numbers[ident] = state.add(f"{name}.{ident}", kind, [numbers[f] for f in below], body, name)

    for ident in entries:
        place(ident)


def cells_to_cone(state, over):
    if over is None:
        return state.alive()
    if isinstance(over, str):
        if over not in state.bodies:
            raise ScriptError(f'no body is called "{over}"')
        body = state.body_root(state.bodies[over])
        return [c for c in state.alive() if state.body_root(state.cells[c].body) == body]
    if not isinstance(over, list):
        raise ScriptError("over must be the name of a body or a list of cells")
    closure = set()
    pending = [state.find(name) for name in over]
    while pending:
        c = pending.pop()
        if c not in closure:
            closure.add(c)
            pending.extend(state.faces(c))
    return sorted(closure)


def op_cone(state, step, _prime):
    fields(step, ("apex",), ("over", "at"))
    apex = check_name(step["apex"], "apex")
    if "at" in step:
        check_point(step["at"], "at")
    if "over" in step and step["over"] is None:
        raise ScriptError("over must be the name of a body or a list of cells")
    base = cells_to_cone(state, step.get("over"))
    for c in base:
        if len(state.cells[c].kind) > 1:
            raise ScriptError(f'"{state.cells[c].name}" is not a simplex; the oracle cones simplices only')
    if base:
        body = min(state.body_root(state.cells[c].body) for c in base)
        for c in base:
            state.merge_bodies(body, state.cells[c].body)
        state.check_free(apex)
    else:
        body = state.new_body(apex)
    tip = state.add(apex, (), [], body, apex)
    coned = {}
    for c in sorted(base, key=lambda c: (state.cells[c].dim, c)):
        dim = state.cells[c].dim
        below = [coned[f] for f in state.faces(c)] + [c] if dim else [tip, c]
        coned[c] = state.add(f"{apex}*{state.cells[c].name}", (dim + 1,), below, body)


def op_identify(state, step, _prime):
    fields(step, ("pairs",))
    if not isinstance(step["pairs"], list):
        raise ScriptError("pairs must be a list")
    pending = []
    for pair in step["pairs"]:
        if not isinstance(pair, list) or len(pair) != 2:
            raise ScriptError("a pair must be a list of two cells")
        pending.append((state.find(pair[0]), state.find(pair[1])))
    while pending:
        a, b = (state.root(c) for c in pending.pop())
        if a == b:
            continue
        if state.cells[a].kind != state.cells[b].kind:
            raise ScriptError(f'"{state.cells[a].name}" and "{state.cells[b].name}" have different types')
        # The raw faces, as every member of a class must have its faces glued to those of the others.
        pending.extend(zip(state.cells[a].faces, state.cells[b].faces))
        state.merged_into[max(a, b)] = min(a, b)
        state.merge_bodies(state.cells[a].body, state.cells[b].body)


def trimmed(values, empty):
    values = list(values)
    while values and values[-1] == empty:
        values.pop()
    return values


def op_expect(state, step, prime):
    fields(step, (), ("betti", "torsion", "euler", "cells"))
    found = summary(state, prime)
    for field in ("cells", "betti"):
        if field in step:
            if not isinstance(step[field], list) or not all(is_integer(n) and n >= 0 for n in step[field]):
                raise ScriptError(f"{field} must be a list of non-negative integers")
    if "torsion" in step:
        lists = step["torsion"]
        if not isinstance(lists, list) or not all(isinstance(t, list) and all(map(is_integer, t)) for t in lists):
            raise ScriptError("torsion must be a list of lists of integers")
    if "euler" in step and not is_integer(step["euler"]):
        raise ScriptError("euler must be an integer")
    for field, empty in (("cells", 0), ("euler", None), ("betti", 0), ("torsion", [])):
        if field in step:
            wanted, seen = step[field], found[field]
            if wanted != seen if empty is None else trimmed(wanted, empty) != trimmed(seen, empty):
                raise ExpectFailed(f"{field} is {json.dumps(seen)}, expected {json.dumps(wanted)}")


def op_class(state, step, prime):
    fields(step, ("chain",))
    chain = read_chain(state, step["chain"], prime)
    cycle = not boundary_of_chain(state, chain, prime)
    return {"cycle": cycle, "zero": cycle and is_boundary(state, chain, prime)}


def op_note(_state, step, _prime):
    fields(step, ("text",))
    if not isinstance(step["text"], str):
        raise ScriptError("text must be a string")


OPERATIONS = {
    "simplex": op_simplex,
    "simploid": op_simploid,
    "complex": op_complex,
    "cone": op_cone,
    "identify": op_identify,
    "expect": op_expect,
    "class": op_class,
    "note": op_note,
}


class Oracle:
    """The state now and before every step that can be undone."""

    def __init__(self, prime=0):
        self.prime = prime
        self.state = State()
        self.history = []
        self.steps = 0

    def apply(self, step):
        """Does one step, wholly or not at all; returns its report."""
        if not isinstance(step, dict) or not isinstance(step.get("op"), str):
            raise ScriptError('a step must be an object with an "op"')
        answer = None
        if step["op"] == "undo":
            fields(step, (), ("steps",))
            count = step.get("steps", 1)
            if not is_integer(count) or count < 1:
                raise ScriptError("steps must be a positive integer")
            if count > len(self.history):
                raise ScriptError(f"cannot undo {count} steps, there are {len(self.history)}")
            self.state = self.history[-count]
            del self.history[-count:]
        elif step["op"] in OPERATIONS:
            after = self.state.copy()
            answer = OPERATIONS[step["op"]](after, step, self.prime)
            self.history.append(self.state)
            self.state = after
        else:
            raise ScriptError(f'unknown op "{step["op"]}"')
        self.steps += 1
        report = {"step": self.steps, "op": step["op"], **summary(self.state, self.prime)}
        if answer is not None:
            report["class"] = answer
        return report


# ------------------------------------------------------------------------------------------------ scripts


def refuse_constant(text):
    raise ValueError(f"{text} is not JSON")


def read_objects(data):
    """(line number, object) for every line that is neither blank nor a comment."""
    for number, raw in enumerate(data.split(b"\n"), 1):
        if not raw.strip() or raw.startswith(b"#"):
            continue
        try:
            value = json.loads(raw.decode("utf-8"), parse_constant=refuse_constant)
        except (ValueError, RecursionError) as problem:
            yield number, ScriptError(f"not a JSON object: {problem}")
            return
        yield number, value


def read_header(value):
    if isinstance(value, ScriptError):
        raise value
    if not isinstance(value, dict) or value.get("sesame") != 1 or not is_integer(value.get("sesame")):
        raise ScriptError('the first object must be {"sesame":1,...}')
    for field in value:
        if field not in ("sesame", "ring", "title"):
            raise ScriptError(f'the header has no field "{field}"')
    if not isinstance(value.get("title", ""), str):
        raise ScriptError("title must be a string")
    return parse_ring(value.get("ring", "Z"))


def replay(data, name, ring=None, report=None):
    """Replays the bytes of a script: (exit status, message, oracle). Every step's report is handed to `report`."""
    oracle = None
    line = 0
    try:
        for line, value in read_objects(data):
            if oracle is None:
                prime = read_header(value)
                oracle = Oracle(prime if ring is None else parse_ring(ring))
                continue
            if isinstance(value, ScriptError):
                raise value
            entry = oracle.apply(value)
            if report:
                report(entry)
        if oracle is None:
            raise ScriptError('the script is empty; it must begin with {"sesame":1}')
    except ScriptError as problem:
        return 2, f"{name}:{line}: {problem}", oracle
    except ExpectFailed as problem:
        return 3, f"{name}:{line}: expect failed: {problem}", oracle
    return 0, "", oracle


def main(arguments):
    ring = None
    files = []
    rest = list(arguments)
    while rest:
        word = rest.pop(0)
        if word == "--ring" and rest:
            ring = rest.pop(0)
        elif word.startswith("-") and word != "-":
            print(f"oracle.py: unknown option {word}\n{__doc__}", file=sys.stderr)
            return 1
        else:
            files.append(word)
    if len(files) != 1:
        print(__doc__, file=sys.stderr)
        return 1
    try:
        parse_ring(ring if ring is not None else "Z")
        if files[0] == "-":
            data = sys.stdin.buffer.read()
        else:
            with open(files[0], "rb") as script:
                data = script.read()
    except (OSError, ScriptError) as problem:
        print(f"oracle.py: {problem}", file=sys.stderr)
        return 1
    status, message, _ = replay(data, files[0], ring, lambda entry: print(json.dumps(entry, separators=(",", ":"))))
    if message:
        print(message, file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
