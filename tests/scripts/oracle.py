#!/usr/bin/env python3
"""A second, slow and plain implementation of the script semantics of sesame.

    oracle.py [--ring Z|Z/p] FILE        (FILE may be - for standard input)

Replays a script and prints one JSON object a step with the keys step, op, cells, euler, betti, torsion and, for
`class`, class.cycle and class.zero: the lines of `sesame replay --json --every 1` without times and without the sizes
of the effective complexes. It shares no idea with the engine: a step copies the whole state, and homology is computed
from scratch with a Smith form on Python's integers. Where both agree, they agree for different reasons.

Covered: simplex, simploid, complex, incidence, gmap, map, polygon, chain_of_maps, cone, suspend, identify, sew, unsew, extend, remove_cell,
contract_cell, insert_cell, split_cell, degenerate, deidentify, product, insert, collapse, remove, replace, expect, class, undo, note.
Exit status as `sesame replay`: 0 done, 1 wrong usage or unreadable file, 2 the script is wrong, 3 an expect failed.

A *value* is a cell with its vertices in some order, or a degenerate cell: a pair (y, shape). The shape has one entry for
each component of the type, and in it says of each vertex to which vertex of y it goes. The cell y is not degenerate; a
component of which all vertices go to one is none of y. By the Eilenberg-Zilber lemma there is exactly one such pair for
each cell in each order, and for each degenerate one, as long as no cell is itself in another order: a gluing that would
make one so is refused. Faces of cells are values.

A simplex of an abstract complex is the frozenset of the labels that its vertices have now. The order in which its
canonical name lists them, each as the label that it has become, is that of its vertices.

A cell of a map, unless it is a vertex or an edge, has no vertices in order. A value of it is the cell as one of its darts
sees it: then the shape is a gmaps.Seen, and two cells are equated as the darts of the one see it to be like the other.
What a cell is that is known by its boundary, or is of a map and no ball, is said in boundaries.
"""

import collections
import functools
import itertools
import json
import math
import sys

sys.dont_write_bytecode = True
import boundaries
import chains
import gmaps
import local_operations
import products
from boundaries import Bounded, Hollow, Whole, dimension_of, is_simploid
from gmaps import MapKind, Seen

LEAST_HOLLOW_DIMENSION = 2  # of cells of maps that may be no balls
LARGEST_LISTED_DIMENSION = 62  # of a cell that is known by its boundary
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


def is_simplex(kind):
    return is_simploid(kind) and len(kind) <= 1


def face_slots(kind):
    """The (component, index) of each face, in the flattened order; both counted from 0. A map has one component."""
    if not is_simploid(kind):
        return [(0, k) for k in range(len(gmaps.faces_of_kind(kind)[0] if isinstance(kind, MapKind) else kind.faces))]
    return [(i, j) for i, a in enumerate(kind) for j in range(a + 1)]


def face_kind(kind, i):
    if kind[i] > 1:
        return kind[:i] + (kind[i] - 1,) + kind[i + 1:]
    return kind[:i] + kind[i + 1:]


def law_pairs(kind):
    """The face laws, each as two ways to the same face of a face: ((component, index), (component, index)) twice.

    d^i_m d^i_j = d^i_{j-1} d^i_m (m < j, a_i > 1) and, for k < i, d^k_m d^i_j = d^{i'}_j d^k_m.
    """
    for i, a in enumerate(kind):
        for j in range(a + 1):
            if a > 1:
                for m in range(j):
                    yield ((i, j), (i, m)), ((i, m), (i, j - 1))
            for k in range(i):
                for m in range(kind[k] + 1):
                    yield ((i, j), (k, m)), ((k, m), (i if kind[k] > 1 else i - 1, j))


def slot_sign(kind, i, j):
    """Of a face in the boundary."""
    if isinstance(kind, MapKind):
        return gmaps.signs(kind)[gmaps.faces_of_kind(kind)[0][j][0]]
    if isinstance(kind, Bounded):
        return kind.faces[j][0]
    return (-1) ** (j + sum(kind[:i]))


def slot_number(kind, i, j):
    return j if not is_simploid(kind) else sum(a + 1 for a in kind[:i]) + j


# ------------------------------------------------------------------------------------------------ values


def whole(kind):
    """The shape of a cell itself."""
    if isinstance(kind, (Bounded, Hollow)):
        return Whole(kind)
    return Seen(kind, 0) if isinstance(kind, MapKind) else tuple(tuple(range(a + 1)) for a in kind)


def squashed(kind):
    """The shape that sends everything to one vertex."""
    return tuple((0,) * (a + 1) for a in kind)


def type_of(shape):
    if isinstance(shape, Whole):
        return shape.kind
    return gmaps.kind_from(*shape) if isinstance(shape, Seen) else tuple(len(part) - 1 for part in shape)


def is_degenerate(value):
    return not isinstance(value[1], (Seen, Whole)) and any(len(set(part)) < len(part) for part in value[1])


def is_monotone(shape):
    return isinstance(shape, (Seen, Whole)) or all(part == tuple(sorted(part)) for part in shape)


def orientation(shape):
    """The sign of a shape that is a permutation in every component, or of the dart that sees the cell."""
    if isinstance(shape, Seen):
        return gmaps.signs(shape.kind)[shape.dart]
    if isinstance(shape, Whole):
        return 1
    return math.prod(sign_between(part, sorted(part)) for part in shape)


def fill(outer, inner):
    """The shape of a value (y, outer) when y itself is a value of the shape inner."""
    if isinstance(outer, Whole):
        return outer
    if isinstance(outer, Seen):
        return Seen(inner.kind, gmaps.order_from(*inner)[outer.dart])
    entries = iter(inner)
    filled = tuple(part if max(part) == 0 else tuple(map(next(entries).__getitem__, part)) for part in outer)
    assert next(entries, None) is None
    return filled


def reordered(shape, order):
    """The shape whose vertex k is vertex order[k] of another one, in every component."""
    if isinstance(shape, (Seen, Whole)):
        return fill(order, shape)
    return tuple(tuple(part[k] for k in places) for part, places in zip(shape, order))


def inverse(order):
    if isinstance(order, Whole):
        return order
    if isinstance(order, Seen):
        return Seen(type_of(order), gmaps.order_from(*order).index(0))
    return tuple(tuple(map(part.index, range(len(part)))) for part in order)


def face_at_dart(kind, faces, dart):
    """The face of a cell of a map that a dart of the cell belongs to, as that dart sees it."""
    faces_of_kind, places = gmaps.faces_of_kind(kind)
    number, place = places[dart]
    inner_cell, inner = faces[number]
    return inner_cell, fill(gmaps.shape_from(faces_of_kind[number][1], place), inner)


def face_of(value, i, j, faces_of):
    """d^i_j of a value; faces_of gives the faces (values) of a nondegenerate cell."""
    cell, shape = value
    if isinstance(shape, Whole):
        return faces_of(cell)[j]
    if isinstance(shape, Seen):  # the dart from which the face is seen is a dart of a face of the cell
        dart = gmaps.order_from(*shape)[gmaps.faces_of_kind(type_of(shape))[0][j][0]]
        return face_at_dart(shape.kind, faces_of(cell), dart)
    part = shape[i]
    vertex, rest = part[j], part[:j] + part[j + 1:]
    loses = vertex not in rest
    if loses:
        rest = tuple(v - (v > vertex) for v in rest)
    after = shape[:i] + ((rest,) if len(rest) > 1 else ()) + shape[i + 1:]
    if not loses:
        return cell, after
    inner_cell, inner = faces_of(cell)[sum(max(p) + 1 for p in shape[:i] if max(p)) + vertex]
    return inner_cell, fill(after, inner)


def collapse(value, i, j, vanished):
    """s^i_j of a value: vertex j of component i twice, of a new one if it had vanished."""
    cell, shape = value
    if vanished:
        return cell, shape[:i] + ((0, 0),) + shape[i:]
    return cell, shape[:i] + (shape[i][:j + 1] + shape[i][j:],) + shape[i + 1:]


def cone_shape(shape, simplicial):
    """One more vertex, the last: of the only component, or of a component of its own."""
    if isinstance(shape, (Seen, Whole)):  # the cone over a cell that is no simploid has one orientation
        return None
    if simplicial:
        part = shape[0] if shape else (0,)
        return (part + (max(part) + 1,),)
    return shape + ((0, 1),)


def restrict(value, kept, faces_of):
    """The face of a value on the listed vertices, one list for each component."""
    for i in reversed(range(len(kept))):
        for j in reversed(range(len(value[1][i]))):
            if j not in kept[i]:
                value = face_of(value, i, j, faces_of)
    return value


def sections(shape):
    """Every choice of one vertex from each set of vertices that are sent to one."""
    choices = [list(itertools.product(*([j for j, v in enumerate(part) if v == image] for image in sorted(set(part)))))
               for part in shape]
    return itertools.product(*choices)


def double_faces(kind, faces, faces_of):
    """(value, value, what they are) of every two ways to a face of a face of a cell with these faces.

    Of one that is known by its boundary there is nothing to say but that this is a cycle.
    """
    if isinstance(kind, (Bounded, Hollow)):
        return
    if isinstance(kind, MapKind):  # the face that has dart 0 of another one has number 0
        last = kind.alpha[-1]
        for d in range(len(last)):
            if d < last[d]:
                yield (*(face_of(face_at_dart(kind, faces, x), 0, 0, faces_of) for x in (d, last[d])),
                       f"of the faces at the darts {d} and {last[d]}")
        return
    for (first, then), (other, last) in law_pairs(kind):
        one = face_of(faces[slot_number(kind, *first)], *then, faces_of)
        two = face_of(faces[slot_number(kind, *other)], *last, faces_of)
        yield one, two, f"of the faces {first[1]} of component {first[0] + 1} and {other[1]} of component {other[0] + 1}"


def broken_law(kind, faces, faces_of):
    """A face law that a cell with these faces breaks, or None."""
    if isinstance(kind, Bounded):
        itself = {None: faces}
        breaks = is_no_cycle((None, whole(kind)), lambda c: itself[c] if c in itself else faces_of(c))
        return "that its boundary is a cycle" if breaks else None
    if isinstance(kind, Hollow):
        for number, index, other, place in kind.incidences:
            cell, shape = faces[number]
            value = cell, fill(gmaps.shape_from(kind.faces[number], index), shape)
            sees = faces[other][0], fill(gmaps.shape_from(kind.faces[other], place), faces[other][1])
            if face_of(value, *face_slots(kind.faces[number])[0], faces_of) != sees:
                return f"that what a dart sees in dimension {dimension_of(kind.faces[other])} is a face of what it sees above"
        breaks = any(is_no_cycle(Generator("new", kind, faces, k), faces_of) for k in range(len(kind.generators)))
        return "that boundaries of its generators are cycles" if breaks else None
    return next((what for one, two, what in double_faces(kind, faces, faces_of) if one != two), None)


# A generator of a Hollow cell: the number of the cell, its kind and faces, and which one.
Generator = collections.namedtuple("Generator", "owner kind faces k")


def boundary_of(item, faces_of):
    """The boundary of a value that is not degenerate, or of a Generator, as (coefficient, such) without those that are 0."""
    if isinstance(item, Generator):
        for n, slot, k in item.kind.generators[item.k][1]:
            if slot is None:
                yield n, item._replace(k=k)
            elif k is not None:
                cell, shape = item.faces[slot]
                yield n, Generator(cell, shape.kind, faces_of(cell), k)
            elif not is_degenerate(item.faces[slot]):
                yield n, item.faces[slot]
        return
    kind = type_of(item[1])
    for i, j in face_slots(kind):
        face = face_of(item, i, j, faces_of)
        if not is_degenerate(face):
            yield slot_sign(kind, i, j), face


def as_chain(terms):
    """{number: coefficient}; of generators of Hollow cells the numbers are negative, or tuples."""
    chain = {}
    for n, item in terms:
        if isinstance(item, Generator):
            key = (item.owner, item.k) if not isinstance(item.owner, int) else -1 - (item.owner << 20) - item.k
        else:
            key, n = item[0], n * orientation(item[1])
        chain[key] = chain.get(key, 0) + n
    return {key: n for key, n in chain.items() if n}


def is_no_cycle(item, faces_of):
    return bool(as_chain((n * m, of_face) for n, face in boundary_of(item, faces_of)
                         for m, of_face in boundary_of(face, faces_of)))


# ------------------------------------------------------------------------------------------------ the state

# What a name stands for: a key of State.names, and the shape of a value of what that is (None: this itself).
Reading = collections.namedtuple("Reading", "key shape")

# A cone: of what it is the cone, by canonical names of the time, oldest first; and for each key of State.names that v*key
# may be made of, whose cone that is and how: (canonical name, shape). Those in `late` came to it after the step.
Cone = collections.namedtuple("Cone", "simplicial coned table late")

# A map. texts: what its darts are called after "m:", one for each. glued: None, or of a map by simplices {(i, number of
# a dart): name of the simplex that is glued when that dart is i-sewn}.
MadeMap = collections.namedtuple("MadeMap", "dimension texts glued")

# kind is the type of the simploid, () for a vertex; faces are values: d^1_0, d^1_1, ..., d^2_0, ...
Cell = collections.namedtuple("Cell", "name kind faces body")


class State:
    """The nondegenerate cells as they are now, by age, and what every name ever given means now."""

    def __init__(self):
        self.cells = {}  # number -> Cell; of cells that became one, the older number is left
        self.created = 0
        self.names = {}  # cell name -> value, or None when its body was consumed by a product
        self.bodies = {}  # body name -> number of the body
        self.body_merged_into = []
        self.consumed = set()  # numbers of bodies
        self.labels = {}  # of a vertex of an abstract complex, as inserted -> the label that the vertex has now
        self.gone = {}  # label of a vertex that was removed -> number of its body
        self.orders = {}  # frozenset of labels -> tuple of them; a simplex is a name as well: its frozenset
        self.standard = {}  # name of a simplex or simploid -> its type
        self.cones = {}  # apex -> Cone
        # name -> (simplicial, left table, right table, shapes), tables as those of cones; shapes: None, or of cells of maps
        # {canonical name: its shape}
        self.products = {}
        self.levels = {}  # name of a chain of maps by cells -> the numbers of darts of its levels
        self.made_for = {}  # name of a cell of a product of maps -> (dimension, the least dart that saw it then)
        self.abstract = set()  # numbers of abstract bodies, of their roots
        self.maps = {}  # name -> MadeMap, in the order in which they were made
        self.alpha = {}  # dart, as (name of its map, number) -> the tuple of its images
        self.mapped = set()  # numbers of bodies that have, or had, cells of maps that are no simplices
        self.places = {}  # dart of a largest cell that is no ball -> (canonical boundary, which dart of that it is)
        self.disordered = set()  # numbers of bodies where cells and faces have come to order their vertices differently

    def copy(self):
        other = State()
        other.cells = dict(self.cells)
        other.created = self.created
        other.names = dict(self.names)
        other.bodies = dict(self.bodies)
        other.body_merged_into = list(self.body_merged_into)
        other.consumed = set(self.consumed)
        other.labels = dict(self.labels)
        other.gone = dict(self.gone)
        other.orders = dict(self.orders)
        other.standard = dict(self.standard)
        other.cones = dict(self.cones)
        other.products = dict(self.products)
        other.levels = dict(self.levels)
        other.made_for = dict(self.made_for)
        other.abstract = set(self.abstract)
        other.maps = dict(self.maps)
        other.alpha = dict(self.alpha)
        other.mapped = set(self.mapped)
        other.places = dict(self.places)
        other.disordered = set(self.disordered)
        return other

    # -- reading

    def body_root(self, number):
        while self.body_merged_into[number] != number:
            number = self.body_merged_into[number]
        return number

    def find_body(self, name):
        if not isinstance(name, str) or name not in self.bodies:
            raise ScriptError(f"no body is called {json.dumps(name)}")
        body = self.body_root(self.bodies[name])
        if body in self.consumed:
            raise ScriptError(f'the body "{name}" is a factor of a product now')
        return body

    def cells_of_body(self, body):
        return [c for c in self.alive() if self.body_root(self.cells[c].body) == body]

    def value(self, name):
        """What a name denotes; it may be degenerate."""
        if not isinstance(name, str):
            raise ScriptError("a cell's name must be a string")
        reading = self.reading(name)
        if reading is None:
            raise ScriptError(f'no cell is called "{name}"')
        value = self.names[reading.key]
        if value is None:
            raise ScriptError(f'"{name}" is a cell of a factor of a product')
        return value if reading.shape is None else (value[0], fill(reading.shape, value[1]))

    def sign(self, name):
        """The orientation that a name stands for, against that of the cell."""
        return orientation(self.value(name)[1])

    def listed(self, name):
        """The labels that a name {a,b,...} lists, as what they have become; empty when they are none."""
        labels = name[1:-1].split(",") if name[:1] + name[-1:] == "{}" and name[1:-1] else []
        known = all(label in self.labels for label in labels) and len(set(labels)) == len(labels)
        return [self.labels[label] for label in labels] if known else []

    def reading(self, name):
        """What a name stands for, or None."""
        if name in self.names:
            return Reading(name, None)
        labels = self.listed(name)
        key = frozenset(labels)
        if key in self.orders:
            return Reading(key, (places(labels, self.orders[key]),) if len(labels) > 1 else None)
        return self.standard_reading(name) or self.derived_reading(name)

    def standard_reading(self, name):
        """Vertices of a simplex or simploid in any order, or all of them."""
        base, _, rest = name.rpartition(".")
        kind = self.standard.get(base, ())
        lists = [part.split("-") for part in rest.split("x")]
        if len(lists) != len(kind):
            return None
        for size, vertices in zip(kind, lists):
            if not set(vertices) <= {str(x) for x in range(size + 1)} or len(set(vertices)) < len(vertices):
                return None
        ordered = [sorted(vertices, key=int) for vertices in lists]
        is_top = all(len(vertices) == size + 1 for size, vertices in zip(kind, ordered))
        shape = tuple(places(one, other) for one, other in zip(lists, ordered) if len(one) > 1)
        text = "x".join("-".join(vertices) for vertices in ordered)
        return Reading(base if is_top else f"{base}.{text}", shape or None)

    def derived_reading(self, name):
        """v*c and P.(a|b)."""
        for k in range(1, len(name)):
            if name[:k] in self.cones and name[k] == "*":
                return self.coned_reading(name[:k], name[k + 1:])
            if name[:k] in self.products and name[k:k + 2] == ".(" and name[-1] == ")":
                return self.pair_reading(name[:k], name[k + 2:-1])
        return None

    def read_in(self, name, table):
        """(canonical name, shape, key) of what a name stands for, by a table, or None."""
        reading = self.reading(name)
        if reading is None or reading.key not in table:
            return None
        called, shape = table[reading.key]
        return called, fill(reading.shape, shape) if reading.shape else shape, reading.key

    def coned_reading(self, apex, base):
        cone = self.cones[apex]
        found = self.read_in(base, cone.table)
        if found is None or (found[2] in cone.late and is_degenerate(found[:2])):
            return None
        return Reading(f"{apex}*{found[0]}", cone_shape(found[1], cone.simplicial))

    def pair_reading(self, product, inside):
        simplicial, *tables, shapes = self.products[product]

        def part(text, table):
            found = self.read_in(text, table)
            before, mark, after = text.rpartition("^")
            if found or not mark or not simplicial or not all(x.isdigit() for x in after.split(",")):
                return found
            found = self.read_in(before, table)
            collapsed = {int(x) for x in after.split(",")}
            size = found and sum(type_of(found[1])) + len(collapsed)
            if not found or max(collapsed) >= size:
                return None
            shape = (tuple(itertools.accumulate((k not in collapsed for k in range(size)), initial=0)),)
            return found[0], fill(shape, found[1]), found[2]

        for k, letter in enumerate(inside):
            left = part(inside[:k], tables[0]) if letter == "|" else None
            right = left and part(inside[k + 1:], tables[1])
            if not right or (simplicial and type_of(left[1]) != type_of(right[1])):
                continue
            (a, mine, _), (b, other, _) = left, right
            key = f"{product}.({a}|{b})"
            if shapes is not None:
                seen = products.shape_of_pair(mine, other)
                return Reading(key, fill(seen, inverse(shapes[key])) if seen else None)
            if not simplicial:
                return Reading(f"{product}.({a}|{b})", mine + other)
            pairs = list(zip(sum(mine, ()), sum(other, ())))
            increasing = sorted(set(pairs))
            if any(x[1] > y[1] for x, y in zip(increasing, increasing[1:])):
                return None
            masks = [[str(n) for n, (x, y) in enumerate(zip(increasing, increasing[1:])) if x[side] == y[side]]
                     for side in (0, 1)]
            ends = ["^" + ",".join(mask) if mask else "" for mask in masks]
            shape = (tuple(map(increasing.index, pairs)),) if pairs else None
            return Reading(f"{product}.({a}{ends[0]}|{b}{ends[1]})", shape)
        return None

    def names_meet(self):
        """Keys that have come to denote what a coned cell denotes make names of its cone from now on."""

        def sorted_value(value):
            if value and isinstance(value[1], (Seen, Whole)):
                return value[0], None
            return value and (value[0], tuple(tuple(sorted(part)) for part in value[1]))

        def over(shape, other):
            """A shape that is another one in some order, as that order."""
            if isinstance(shape, (Seen, Whole)):
                return shape
            ranks = [[sorted(range(len(part)), key=part.__getitem__) for part in parts] for parts in (shape, other)]
            return tuple(tuple(theirs[mine.index(k)] for k in range(len(mine))) for mine, theirs in zip(*ranks))

        for apex, cone in self.cones.items():
            first = {}
            for called in cone.coned:
                if self.names[called]:
                    first.setdefault(sorted_value(self.names[called]), called)
            late = {}
            for key, value in self.names.items():
                if key not in cone.table and sorted_value(value) in first:
                    called = first[sorted_value(value)]
                    late[key] = called, over(value[1], self.names[called][1])
            if late:
                self.cones[apex] = cone._replace(table={**cone.table, **late}, late=cone.late | set(late))

    def check_prefix(self, name):
        """No apex or product may have a name that could begin the name of another's cell."""
        for other in [*self.cones, *self.products]:
            for one, two in ((name, other), (other, name)):
                if one.startswith(two) and (one[len(two):][:1] == "*" or one[len(two):][:2] == ".("):
                    raise ScriptError(f'names of cells of "{name}" and of "{other}" could be mistaken for one another')

    def find(self, name):
        """The number of a cell that is not degenerate."""
        value = self.value(name)
        if is_degenerate(value):
            raise ScriptError(f'"{name}" is degenerate')
        return value[0]

    def plain(self, number):
        """A cell as a value."""
        return number, whole(self.cells[number].kind)

    def dim(self, number):
        return dimension_of(self.cells[number].kind)

    def alive(self):
        return sorted(self.cells)

    def faces(self, number):
        """Values."""
        return self.cells[number].faces

    def face(self, value, i, j):
        return face_of(value, i, j, self.faces)

    def by_dimension(self):
        """Lists of cells, dimension 0 up to the largest that has one."""
        lists = []
        for c in self.alive():
            while len(lists) <= self.dim(c):
                lists.append([])
            lists[self.dim(c)].append(c)
        return lists

    def simplices_of(self, body):
        """The simplices of an abstract body, oldest first, as {frozenset of labels: number}."""
        found = {key: self.names[key][0] for key in self.orders if self.names[key]}
        return dict(sorted(((key, number) for key, number in found.items()
                            if self.body_root(self.cells[number].body) == body), key=lambda entry: entry[1]))

    def faces_by_order(self, order):
        """The faces of a simplex with this order, values: what is opposite to each of its vertices."""
        for k in range(len(order) if len(order) > 1 else 0):
            rest = order[:k] + order[k + 1:]
            key = frozenset(rest)
            yield self.names[key][0], ((places(rest, self.orders[key]),) if len(rest) > 1 else ())

    def boundary(self, number):
        """Sum of (-1)^(j + a_1 + ... + a_{i-1}) d^i_j as {cell: coefficient}; degenerate faces count as 0.

        Of a cell of a map each face, as its first dart sees it, has the sign of that dart. A generator of a Hollow cell
        has a negative number, see as_chain.
        """
        if number < 0:
            return as_chain(boundary_of(self.generator(*divmod(-1 - number, 1 << 20)), self.faces))
        return as_chain(boundary_of(self.plain(number), self.faces))

    def generator(self, number, k):
        return Generator(number, self.cells[number].kind, self.faces(number), k)

    def generators(self):
        """Like by_dimension, but with all generators of cells that have several."""
        lists = [[c for c in cells if not self.is_hollow(c)] for cells in self.by_dimension()]
        for c in filter(self.is_hollow, self.alive()):
            for k, (degree, _) in enumerate(self.cells[c].kind.generators):
                lists[degree].append(-1 - (c << 20) - k)
        return lists

    def is_hollow(self, number):
        return isinstance(self.cells[number].kind, Hollow)

    def closure(self, numbers):
        """The cells and all nondegenerate cells that their faces are made of, by age."""
        found = set()
        pending = list(numbers)
        while pending:
            c = pending.pop()
            if c not in found:
                found.add(c)
                pending.extend(face[0] for face in self.faces(c))
        return sorted(found)

    def broken_law(self):
        """The first cell that breaks a face law, as a sentence, or None."""
        for c in self.alive():
            problem = broken_law(self.cells[c].kind, self.faces(c), self.faces)
            if problem:
                return f'"{self.cells[c].name}" breaks the face law {problem}'
        return None

    # -- changing

    def check_free(self, name, own_body=None):
        if self.reading(name) or (name in self.bodies and name != own_body):
            raise ScriptError(f'the name "{name}" is taken')

    def new_body(self, name):
        self.check_free(name)
        self.bodies[name] = len(self.body_merged_into)
        self.body_merged_into.append(len(self.body_merged_into))
        return self.bodies[name]

    def merge_bodies(self, a, b):
        a, b = sorted((self.body_root(a), self.body_root(b)))
        if a != b:
            self.body_merged_into[b] = a
            are_abstract = {a, b} <= self.abstract
            self.abstract -= {a, b}
            self.abstract |= {a} if are_abstract else set()
            self.disordered |= {a} if b in self.disordered else set()
            self.mapped |= {a} if b in self.mapped else set()

    def add(self, name, kind, faces, body, body_name=None):
        self.check_free(name, body_name)
        number = self.created
        self.created += 1
        self.cells[number] = Cell(name, kind, tuple(faces), body)
        self.names[name] = self.plain(number)
        return number

    def equate(self, equations):
        """The quotient by the least congruence that contains these equations between values.

        Whatever is done to one side, a face or a restriction, is done to the other, until nothing new follows.
        """
        became = {}  # number -> value
        folded = {}  # number -> orders in which the cell would be itself

        def now(value):
            while value[0] in became:
                other, inner = became[value[0]]
                value = other, fill(value[1], inner)
            return value

        def settled():
            """Equations of cells that were folded before they became degenerate."""
            for c in [c for c in folded if is_degenerate(now(self.plain(c)))]:
                for order in folded.pop(c):
                    yield self.plain(c), (c, order)

        asserted = []
        pending = list(equations)
        while pending or (pending := list(settled())):
            asserted.append(pending.pop())
            left, right = map(now, asserted[-1])
            if left == right:
                continue
            if type_of(left[1]) != type_of(right[1]):
                names = " and ".join(f'"{self.cells[value[0]].name}"' for value in (left, right))
                raise ScriptError(f"{names} have different types")
            self.merge_bodies(self.cells[left[0]].body, self.cells[right[0]].body)
            if is_degenerate(left) and is_degenerate(right):
                for section in [*sections(left[1]), *sections(right[1])]:
                    pending.append((restrict(left, section, self.faces), restrict(right, section, self.faces)))
                continue
            if is_degenerate(left) or (not is_degenerate(right) and left[0] < right[0]):
                left, right = right, left
            # The left one goes: it is no degenerate cell, and the younger of two that are not.
            left, right = self.plain(left[0]), (right[0], reordered(right[1], inverse(left[1])))
            if left[0] == right[0]:
                if right[1] in folded.setdefault(left[0], set()):
                    continue
                folded[left[0]].add(right[1])
                asserted.pop()
            else:
                became[left[0]] = right
                if not is_monotone(right[1]):
                    self.disordered.add(self.body_root(self.cells[left[0]].body))
            for i, j in face_slots(type_of(left[1])):
                pending.append((self.face(left, i, j), self.face(right, i, j)))
        if folded:
            raise ScriptError("a cell would be glued to itself in another order of its vertices")
        assert all(now(left) == now(right) for left, right in asserted)
        self.cells = {c: cell._replace(faces=tuple(map(now, cell.faces)))
                      for c, cell in self.cells.items() if c not in became}
        self.names = {name: value and now(value) for name, value in self.names.items()}


def chain_rank_data(state, prime):
    lists = state.generators()
    factors = [[]]
    for p in range(1, len(lists)):
        factors.append(invariant_factors([state.boundary(c) for c in lists[p]], prime))
    factors.append([])
    return lists, factors


def summary(state, prime):
    """Cells, Euler characteristic, Betti numbers and torsion, all from scratch."""
    lists, factors = chain_rank_data(state, prime)
    sizes = [len(generators) for generators in lists]
    return {
        "cells": [len(cells) for cells in state.by_dimension()],
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
    lists = state.generators()
    dim = next(p for p, generators in enumerate(lists) if next(iter(chain)) in generators)
    above = [state.boundary(c) for c in lists[dim + 1]] if dim + 1 < len(lists) else []
    return invariant_factors(above, prime) == invariant_factors(above + [chain], prime)


def read_chain(state, chain, prime):
    """[[coefficient, name], ...] as {cell: coefficient}; one dimension only. A degenerate cell counts as 0."""
    if not isinstance(chain, list):
        raise ScriptError("chain must be a list of [coefficient, cell]")
    total = {}
    dims = set()
    for term in chain:
        if not isinstance(term, list) or len(term) != 2:
            raise ScriptError("a term of a chain must be [integer, cell]")
        value, factor = state.value(term[1]), integer(term[0], "a coefficient")
        if isinstance(value[1], Whole) and isinstance(value[1].kind, Hollow):
            raise ScriptError(f'the oracle does not know which generators "{term[1]}" is')
        dims.add(dimension_of(type_of(value[1])))
        if not is_degenerate(value):
            total[value[0]] = total.get(value[0], 0) + factor * state.sign(term[1])
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
                    below.append(state.plain(numbers[face[:i] + (s[:j] + s[j + 1:],) + face[i + 1:]]))
        own_kind = tuple(len(s) - 1 for s in face if len(s) > 1)
        cell_name = name if is_top else f"{name}.{label}"
        numbers[face] = state.add(cell_name, own_kind, below, body, name)
    if kind:
        state.standard[name] = kind


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
        if field not in ("id", "type", "faces", "at", "dim", "boundary"):
            raise ScriptError(f'a cell of a complex has no field "{field}"')
    if "id" not in entry:
        raise ScriptError('a cell of a complex needs the field "id"')
    ident = check_name(entry["id"], "id")
    if "dim" in entry or "boundary" in entry:
        return ident, None, read_listed_boundary(entry, ident)
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


def read_listed_boundary(entry, ident):
    """The dimension, and [coefficient, id] for each term."""
    dim, boundary = entry.get("dim"), entry.get("boundary", [])
    if "type" in entry or "faces" in entry:
        raise ScriptError(f'"{ident}" has a dim or a boundary, and takes neither type nor faces')
    if not is_integer(dim) or not 0 <= dim <= LARGEST_LISTED_DIMENSION:
        raise ScriptError(f'"{ident}" needs a dim from 0 to {LARGEST_LISTED_DIMENSION}')
    good = isinstance(boundary, list) and all(
        isinstance(term, list) and len(term) == 2 and is_integer(term[0]) and isinstance(term[1], str) for term in boundary)
    if not good or any(n == 0 for n, _ in boundary) or sum(abs(n) for n, _ in boundary) > 10**9:
        raise ScriptError(f'boundary of "{ident}" must be a list of terms, with coefficients that are not 0')
    if dim == 0 and boundary:
        raise ScriptError(f'"{ident}" has the dimension 0 and a boundary')
    if dim == 1 and sorted(n for n, _ in boundary) != [-1, 1]:
        raise ScriptError(f'the boundary of the edge "{ident}" must be its end less its beginning')
    if "at" in entry:
        if dim:
            raise ScriptError(f'"{ident}" is not a vertex and takes no "at"')
        check_point(entry["at"], "at")
    return dim, boundary


def declared(listed):
    """{id: (kind, ids of the faces)} of what read_complex_cell read. Of an edge the end comes first."""
    entries = {}

    def dimension(ident):
        if ident not in listed:
            raise ScriptError(f'"{ident}" is not listed')
        kind, below = listed[ident]
        return below[0] if kind is None else sum(kind)

    def entry(ident):
        if ident not in entries:
            kind, below = listed[ident]
            if kind is None:
                dim, boundary = below
                if any(dimension(face) != dim - 1 for _, face in boundary):
                    raise ScriptError(f'the faces of "{ident}" must have the dimension {dim - 1}')
                faces = tuple((n, entry(face)[0]) for n, face in boundary)
                kind = () if dim == 0 else (1,) if dim == 1 else Bounded(dim, faces)
                below = [face for n, face in (sorted(boundary, reverse=True) if dim == 1 else boundary)]
            entries[ident] = kind, below
        return entries[ident]

    for ident in listed:
        entry(ident)
    return entries


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
    order_of_listing = {ident: below if kind is not None else [face for _, face in below[1]]
                        for ident, (kind, below) in entries.items()}
    entries = declared(entries)
    for ident, (kind, below) in entries.items():
        for (i, _), other in zip(face_slots(kind), below):
            if other not in entries:
                raise ScriptError(f'face "{other}" of "{ident}" is not listed')
            if is_simploid(kind) and entries[other][0] != face_kind(kind, i):
                raise ScriptError(f'face "{other}" of "{ident}" has the wrong type')

    def value_of(ident):
        return ident, whole(entries[ident][0])

    for ident, (kind, below) in entries.items():
        problem = broken_law(kind, [value_of(f) for f in below], lambda f: [value_of(g) for g in entries[f][1]])
        if problem:
            raise ScriptError(f'"{ident}" breaks the face law {problem}')
    body = state.new_body(name)
    numbers = {}

    def place(ident):  # in the order of listing, but after the faces
        if ident not in numbers:
            kind, below = entries[ident]
            for face in order_of_listing[ident]:
                place(face)
            numbers[ident] = state.add(f"{name}.{ident}", kind, [state.plain(numbers[f]) for f in below], body, name)

    for ident in entries:
        place(ident)
    if not all(is_simploid(kind) for kind, _ in entries.values()):
        state.mapped.add(body)


def cells_to_cone(state, over):
    if over is None:
        return state.alive()
    if isinstance(over, str):
        return state.cells_of_body(state.find_body(over))
    if not isinstance(over, list):
        raise ScriptError("over must be the name of a body or a list of cells")
    return state.closure([state.value(name)[0] for name in over])


def add_cones(state, apexes, over):
    """The cones from each apex over the same cells, one after the other."""
    base = cells_to_cone(state, over)
    simplicial = all(is_simplex(state.cells[c].kind) for c in base)
    if base:
        body = min(state.body_root(state.cells[c].body) for c in base)
        for c in base:
            state.merge_bodies(body, state.cells[c].body)
        state.check_free(apexes[0])
    else:
        body = state.new_body(apexes[0])
    for apex in apexes:
        add_cone(state, apex, base, simplicial, body)


def add_cone(state, apex, base, simplicial, body):
    state.check_prefix(apex)
    tip = state.add(apex, (), [], body, apex)
    coned, kinds = {}, {}
    named = {c: state.value(state.cells[c].name)[1] for c in base}  # what the names v*c are made after
    table = {key: (state.cells[value[0]].name, fill(value[1], inverse(named[value[0]])))
             for key, value in state.names.items() if value and value[0] in named}

    def cone_of(value):
        return coned[value[0]], cone_shape(value[1], simplicial)

    for c in sorted(base, key=lambda c: (state.dim(c), c)):
        kind = state.cells[c].kind
        if not is_simploid(kind):
            kinds[c], below = cone_by_boundary(state, (c, named[c]), (coned, kinds, named), cone_of, tip)
            coned[c] = state.add(f"{apex}*{state.cells[c].name}", kinds[c], below, body)
            continue
        below = [cone_of(face) for face in state.faces(c)]
        if simplicial:
            below += [] if kind else [state.plain(tip)]
            own_kind = (sum(kind) + 1,)
        else:  # a product with an edge, whose far end is squashed
            below.append((tip, squashed(kind)))
            own_kind = kind + (1,)
        coned[c] = state.add(f"{apex}*{state.cells[c].name}", own_kind, below + [state.plain(c)], body)
        state.names[f"{apex}*{state.cells[c].name}"] = cone_of((c, named[c]))
    names = [state.cells[c].name for c in sorted(base)]
    state.cones[apex] = Cone(simplicial, names, table, frozenset())


def cone_by_boundary(state, value, made, cone_of, tip):
    """(kind, faces) of the cone over a cell that is no simploid. It has one orientation, that of the cell as it is called.

    made: the cones over its faces, the kinds of those that are over no simploids, and the shapes of what cells are called.
    """
    coned, kinds, named = made
    kind = type_of(value[1])
    own = [state.face(value, i, j) for i, j in face_slots(kind)]
    signs, faces = [], []  # of all faces, and the cones over them
    for face in own:
        is_plain = is_simploid(type_of(face[1]))
        signs.append(1 if is_plain else orientation(face[1]) * orientation(named[face[0]]))
        faces.append(cone_of(face) if is_plain else (coned[face[0]], whole(kinds[face[0]])))
    if isinstance(kind, Hollow):
        faces += [(tip, ()), value]
        generators = tuple(boundaries.coned_generators(kind, signs, len(faces) - 2, len(faces) - 1))
        return Hollow(kind.dimension + 1, tuple(type_of(face[1]) for face in faces), generators, ()), faces
    terms = []
    for sign, face, coned_face, (i, j) in zip(signs, faces, own, face_slots(kind)):
        if not is_degenerate(coned_face):
            terms.append((sign * slot_sign(kind, i, j), face))
    terms.append(((-1) ** (dimension_of(kind) + 1), value))
    of_faces = tuple((n, type_of(face[1])) for n, face in terms)
    return Bounded(dimension_of(kind) + 1, of_faces), [face for _, face in terms]


def read_over(step):
    if "over" in step and step["over"] is None:
        raise ScriptError("over must be the name of a body or a list of cells")
    return step.get("over")


def op_cone(state, step, _prime):
    fields(step, ("apex",), ("over", "at"))
    if "at" in step:
        check_point(step["at"], "at")
    add_cones(state, [check_name(step["apex"], "apex")], read_over(step))


def op_suspend(state, step, _prime):
    fields(step, ("apexes",), ("over", "at"))
    if not isinstance(step["apexes"], list) or len(step["apexes"]) != 2:
        raise ScriptError("apexes must be a list of two names")
    if "at" in step:
        check_points(step["at"], 2)
    add_cones(state, [check_name(apex, "an apex") for apex in step["apexes"]], read_over(step))


def read_vertex_map(entries, kind):
    """A permutation of the vertices for each component; that of a simplex may stand alone."""
    if not is_simploid(kind):
        raise ScriptError("only simploids have vertex maps")
    if not isinstance(entries, list) or not entries:
        raise ScriptError("a vertex map must be a list of vertices, or a list of such lists")
    if not isinstance(entries[0], list):
        entries = [entries]
    if kind == () and entries == [[0]]:
        return ()
    if [sorted(part) if isinstance(part, list) and all(map(is_integer, part)) else None for part in entries] != [
            list(range(a + 1)) for a in kind]:
        raise ScriptError("a vertex map must have a permutation of the vertices for each component")
    return tuple(map(tuple, entries))


def op_identify(state, step, _prime):
    fields(step, ("pairs",))
    if not isinstance(step["pairs"], list):
        raise ScriptError("pairs must be a list")
    equations = []
    for pair in step["pairs"]:
        if not isinstance(pair, list) or len(pair) not in (2, 3):
            raise ScriptError("a pair must be a list of two cells, and perhaps a vertex map")
        left, right = state.value(pair[0]), state.value(pair[1])
        if type_of(left[1]) != type_of(right[1]):
            raise ScriptError(f'"{pair[0]}" and "{pair[1]}" have different types')
        if len(pair) == 3:
            right = right[0], reordered(right[1], read_vertex_map(pair[2], type_of(right[1])))
        equations.append((left, right))
    state.equate(equations)


def op_degenerate(state, step, _prime):
    fields(step, ("cell", "along"))
    value, along = state.value(step["cell"]), step["along"]
    kind = type_of(value[1])
    if not is_simploid(kind):
        raise ScriptError(f'"{step["cell"]}" is no simploid, and has no directions')
    if isinstance(along, list) and len(along) == 2 and all(map(is_integer, along)):
        i, j = along[0] - 1, along[1]
    elif is_integer(along) and len(kind) <= 1:
        i, j = 0, along
    else:
        raise ScriptError("along must be an index, for a simploid [component, index]")
    if not 0 <= i < len(kind) or not 0 <= j < kind[i]:
        raise ScriptError(f'"{step["cell"]}" has no direction {json.dumps(along)}')
    state.equate([(value, collapse(state.face(value, i, j), i, j, kind[i] == 1))])


def read_split(state, entry):
    """(cell, name of the copy, moves) of one entry of `deidentify`."""
    if not isinstance(entry, dict):
        raise ScriptError("every entry of split must be an object")
    for field in entry:
        if field not in ("cell", "as", "moves"):
            raise ScriptError(f'an entry of split has no field "{field}"')
    for field in ("cell", "as", "moves"):
        if field not in entry:
            raise ScriptError(f'an entry of split needs the field "{field}"')
    if not isinstance(entry["moves"], list):
        raise ScriptError("moves must be a list of [cell, face number]")
    if state.is_hollow(state.find(entry["cell"])):
        raise ScriptError(f'"{entry["cell"]}" is no ball, and is not split')
    return state.value(entry["cell"]), check_name(entry["as"], "as"), entry["moves"]


def slot_in_order(shape, number):
    """The number of a face of a cell, counted as a name for it has its vertices."""
    i, j = face_slots(type_of(shape))[number]
    if isinstance(shape, Whole):
        return number
    if isinstance(shape, Seen):
        faces, _ = gmaps.faces_of_kind(type_of(shape))
        return gmaps.faces_of_kind(shape.kind)[1][gmaps.order_from(*shape)[faces[j][0]]][0]
    return slot_number(type_of(shape), i, shape[i][j])


def op_deidentify(state, step, _prime):
    fields(step, ("split",))
    if not isinstance(step["split"], list):
        raise ScriptError("split must be a list")
    splits = [read_split(state, entry) for entry in step["split"]]
    copies = []  # with their vertices in the order of the name of the cell that is split
    for value, name, _ in splits:
        faces = [state.face(value, i, j) for i, j in face_slots(type_of(value[1]))]
        copies.append(state.add(name, type_of(value[1]), faces, state.cells[value[0]].body))
    moved = {}  # (cell, face number) -> the copy that the face becomes
    for ((x, order), _, moves), twin in zip(splits, copies):
        for move in moves:
            if not isinstance(move, list) or len(move) != 2 or not is_integer(move[1]):
                raise ScriptError("a move must be [cell, face number]")
            cell, number = state.find(move[0]), move[1]
            if state.is_hollow(cell):
                raise ScriptError(f'the oracle does not know the faces of "{move[0]}"')
            if not 0 <= number < len(state.faces(cell)):
                raise ScriptError(f'"{move[0]}" has no face {number}')
            number = slot_in_order(state.value(move[0])[1], number)
            face = state.faces(cell)[number]
            if face[0] != x or is_degenerate(face):
                raise ScriptError(f'face {number} of "{move[0]}" is not "{state.cells[x].name}"')
            if (cell, number) in moved:
                raise ScriptError(f'face {number} of "{move[0]}" is moved twice')
            moved[cell, number] = twin, fill(face[1], inverse(order))
    for (cell, number), face in moved.items():
        faces = list(state.faces(cell))
        faces[number] = face
        state.cells[cell] = state.cells[cell]._replace(faces=tuple(faces))
    problem = state.broken_law()
    if problem:
        raise ScriptError(problem)


def simploidal_product(state, first, second):
    """The cells of the product as (key, type, faces, label of two names), faces as values of keys."""
    for a in first:
        for b in second:
            kinds = state.cells[a].kind, state.cells[b].kind
            below = [((x, b), shape + whole(kinds[1])) for x, shape in state.faces(a)]
            below += [((a, y), whole(kinds[0]) + shape) for y, shape in state.faces(b)]
            yield (a, b), kinds[0] + kinds[1], below, "({}|{})".format


def disjoint_masks(p, q):
    """All ways to make a p-simplex and a q-simplex degenerate simplices of one dimension, without a common direction.

    Ordered by the masks as integers.
    """
    found = []
    for n in range(max(p, q), p + q + 1):
        for mine in itertools.combinations(range(n), n - p):
            for other in itertools.combinations(sorted(set(range(n)) - set(mine)), n - q):
                found.append((sum(2**k for k in mine), sum(2**k for k in other), n, mine, other))
    return [(n, mine, other) for _, _, n, mine, other in sorted(found)]


def simplicial_product(state, first, second):
    """The same of the triangulated product. A key is (a, collapsed directions, b, collapsed directions)."""

    def directions(shape):
        """Per step from a vertex to the next, whether it is collapsed."""
        return [x == y for part in shape for x, y in zip(part, part[1:])]

    def monotone(collapsed):
        return tuple(itertools.accumulate((not c for c in collapsed), initial=0))

    def value_of_pair(left, right):
        """Directions that are collapsed on both sides are collapsed in the pair."""
        (a, mine), (b, other) = left, right
        both = list(zip(directions(mine), directions(other)))
        kept = [pair for pair in both if pair != (True, True)]
        common = (monotone([x and y for x, y in both]),) if both else ()
        return (a, tuple(x for x, _ in kept), b, tuple(y for _, y in kept)), common

    def label(mine, other):
        suffix = [("^" + ",".join(map(str, mask)) if mask else "") for mask in (mine, other)]
        return lambda a, b: f"({a}{suffix[0]}|{b}{suffix[1]})"

    for a in first:
        for b in second:
            for n, mine, other in disjoint_masks(state.dim(a), state.dim(b)):
                left = tuple(k in mine for k in range(n))
                right = tuple(k in other for k in range(n))
                sides = (a, (monotone(left),)), (b, (monotone(right),))
                below = [value_of_pair(state.face(sides[0], 0, k), state.face(sides[1], 0, k))
                         for k in range(n + 1)] if n else []
                yield (a, left, b, right), (n,) if n else (), below, label(mine, other)


def product_body(state, name, bodies, cells):
    """A new body in the place of those that are multiplied, which go with their cells."""
    for alias, value in state.names.items():
        if value and value[0] in cells:
            state.names[alias] = None
    for c in cells:
        del state.cells[c]
    state.consumed.update(bodies)
    return state.new_body(name)


def op_product(state, step, _prime):
    fields(step, ("name", "left", "right"), ("kind",))
    name, kind = check_name(step["name"], "name"), step.get("kind", "simploidal")
    if kind not in ("simploidal", "simplicial"):
        raise ScriptError('kind must be "simploidal" or "simplicial"')
    state.check_prefix(name)
    bodies = [state.find_body(step["left"]), state.find_body(step["right"])]
    if not state.mapped.isdisjoint(bodies):
        if kind == "simplicial":
            raise ScriptError("there is no simplicial product of cells of maps")
        product_of_maps(state, name, bodies)
        return
    first, second = map(state.cells_of_body, bodies)
    if kind == "simplicial":
        if not state.disordered.isdisjoint(bodies):
            raise ScriptError("the vertices of a factor are not in the same order in cells and their faces")
        for c in first + second:
            if not is_simplex(state.cells[c].kind):
                raise ScriptError(f'"{state.cells[c].name}" is not a simplex; the product must be simploidal')
    made = list((simplicial_product if kind == "simplicial" else simploidal_product)(state, first, second))
    aliases = {c: [] for c in first + second}
    for alias, value in state.names.items():
        if value and value[0] in aliases and not is_degenerate(value) and isinstance(alias, str):
            aliases[value[0]].append((alias, value[1]))
    canonical = {c: (state.cells[c].name, whole(state.cells[c].kind)) for c in aliases}
    tables = [{key: (state.cells[value[0]].name, value[1]) for key, value in state.names.items()
               if value and value[0] in set(side)} for side in (first, second)]
    body = product_body(state, name, bodies, aliases)
    if not state.disordered.isdisjoint(bodies):
        state.disordered.add(body)
    numbers = {key: state.created + n for n, (key, _, _, _) in enumerate(made)}
    for key, own_kind, below, label in made:
        a, b = key[0], key[len(key) // 2]
        faces = [(numbers[other], shape) for other, shape in below]
        state.add(f"{name}.{label(canonical[a][0], canonical[b][0])}", own_kind, faces, body)
    for key, _, _, label in made:
        a, b = key[0], key[len(key) // 2]
        for pair in itertools.product(aliases[a], aliases[b]):
            if pair != (canonical[a], canonical[b]):
                alias = f"{name}.{label(pair[0][0], pair[1][0])}"
                state.check_free(alias)
                cell = state.plain(numbers[key])
                state.names[alias] = cell if kind == "simplicial" else (cell[0], pair[0][1] + pair[1][1])
    state.products[name] = (kind == "simplicial", *tables, None)


def product_of_maps(state, name, bodies):
    """The product of bodies with cells of maps: a map again, where both have darts."""
    first, second = map(state.cells_of_body, bodies)
    for c in first + second:
        kind = state.cells[c].kind
        if not isinstance(kind, MapKind) and kind not in ((), (1,)):
            raise ScriptError(f'"{state.cells[c].name}" is no cell of a map that is a ball')
        if isinstance(kind, MapKind) and any(map(is_degenerate, state.faces(c))):
            raise ScriptError(f'"{state.cells[c].name}" has a degenerate face')
    factors = [darts_of_factor(state, body) for body in bodies]
    aliases = {c: {} for c in first + second}
    for alias, value in state.names.items():
        if value and value[0] in aliases and not is_degenerate(value) and isinstance(alias, str):
            aliases[value[0]][alias] = value[1]
    tables = [{key: (state.cells[value[0]].name, value[1]) for key, value in state.names.items()
               if value and value[0] in set(side)} for side in (first, second)]
    cells = dict(state.cells)
    body = product_body(state, name, bodies, aliases)
    state.mapped.add(body)
    numbers, shapes = {}, {}
    pairs = sorted(itertools.product(first, second), key=lambda pair: pair)
    numbers.update((pair, state.created + n) for n, pair in enumerate(pairs))

    def face_at(pair, side, dart):
        cell = cells[pair[side]]
        if isinstance(cell.kind, MapKind):
            return face_at_dart(cell.kind, cell.faces, dart)
        return cell.faces[dart]

    for a, b in pairs:
        kinds = cells[a].kind, cells[b].kind
        kind, _ = products.kind_of_pair(*kinds)
        faces = []
        if kind != ():
            for left, right, word in products.faces_of_pair(*kinds, functools.partial(face_at, (a, b)), roots_of_faces):
                over = a if left[0] is None else left[0], b if right[0] is None else right[0]
                faces.append((numbers[over], products.shape_of_pair(left[1], right[1], word)))
        key = f"{name}.({cells[a].name}|{cells[b].name})"
        number = state.add(key, kind, faces, body)
        shapes[key] = products.shape_of_pair(aliases[a][cells[a].name], aliases[b][cells[b].name])
        for (one, mine), (other, theirs) in itertools.product(aliases[a].items(), aliases[b].items()):
            alias = f"{name}.({one}|{other})"
            if alias != key:
                state.check_free(alias)
            state.names[alias] = number, products.shape_of_pair(mine, theirs)
    state.products[name] = (False, *tables, shapes)
    if factors[0] and factors[1] and factors[0].alpha is None and factors[1].alpha is None:
        add_levels_of_product(state, name, numbers, factors)
    elif factors[0] and factors[1] and factors[0].alpha and factors[1].alpha:
        add_darts_of_product(state, name, numbers, factors)


# seen: by dimension what each dart sees, a value, or None where that is gone. alpha: lists of images; None of a chain.
Factor = collections.namedtuple("Factor", "seen alpha")


def darts_of_factor(state, body):
    """Those of the maps of a body, or of its chains of maps, one after the other; None where it has none, or several kinds."""

    def seen(name, i, text):
        value = state.names.get(dart_cell_name(name, i, text))
        return value if value and not is_degenerate(value) else None

    def is_here(name, dimension, texts):
        cells = (seen(name, i, text) for i in range(dimension + 1) for text in texts(i))
        cell = next((value[0] for value in cells if value), None)
        return cell is not None and state.body_root(state.cells[cell].body) == body

    maps = [name for name, made in state.maps.items()
            if made.glued is None and is_here(name, made.dimension, lambda _, made=made: made.texts)]
    levels = [name for name, sizes in state.levels.items() if is_here(name, len(sizes) - 1, lambda i, s=sizes: range(s[i]))]
    if bool(maps) == bool(levels) or len({state.maps[name].dimension for name in maps}) > 1:
        return None
    if levels:
        largest = max(len(state.levels[name]) for name in levels)
        return Factor([[seen(name, i, d) for name in levels if i < len(state.levels[name])
                        for d in range(state.levels[name][i])] for i in range(largest)], None)
    n = state.maps[maps[0]].dimension
    darts = [(name, k) for name in maps for k in range(len(state.maps[name].texts)) if (name, k) in state.alpha]
    if not darts:
        return None
    number = {d: k for k, d in enumerate(darts)}
    alpha = [[number.get(state.alpha[d][i], number[d]) for d in darts] for i in range(n + 1)]
    return Factor([[seen(name, i, state.maps[name].texts[k]) for name, k in darts] for i in range(n + 1)], alpha)


def pair_at(numbers, left, right, word):
    """What a dart of a product sees, of what darts of the factors see."""
    if left is None or right is None:
        return None
    return numbers[left[0], right[0]], products.shape_of_pair(left[1], right[1], word)


def add_darts_of_product(state, name, numbers, factors):
    darts, alpha = products.product(factors[0].alpha, factors[1].alpha)
    for i in range(len(alpha)):
        for k in range(len(darts)):
            state.check_free(dart_cell_name(name, i, k))
    keys = {}  # of the cells made
    for key, value in state.names.items():
        if isinstance(key, str) and key.startswith(name + ".(") and value:
            keys.setdefault(value[0], []).append(key)
    state.alpha.update({(name, d): tuple((name, images[d]) for images in alpha) for d in range(len(darts))})
    for i in range(len(alpha)):
        for k, (d, e, word) in enumerate(darts):
            a = sum(word[:i])
            value = pair_at(numbers, factors[0].seen[a][d], factors[1].seen[i - a][e], word[:i])
            if value is not None:
                state.names[dart_cell_name(name, i, k)] = value
                for key in keys[value[0]]:
                    state.made_for.setdefault(key, (i, (name, k)))
    state.maps[name] = MadeMap(len(alpha) - 1, tuple(map(str, range(len(darts)))), None)


def add_levels_of_product(state, name, numbers, factors):
    left, right = (factor.seen for factor in factors)
    sizes = []
    for n in range(len(left) + len(right) - 1):
        k = 0
        for a in range(max(0, n - len(right) + 1), min(n, len(left) - 1) + 1):
            for d, e, word in products.darts(len(left[a]), a, len(right[n - a]), n - a):
                state.check_free(dart_cell_name(name, n, k))
                value = pair_at(numbers, left[a][d], right[n - a][e], word)
                if value is not None:
                    state.names[dart_cell_name(name, n, k)] = value
                k += 1
        sizes.append(k)
    state.levels[name] = tuple(sizes)


# ------------------------------------------------------------------------------------------------ maps


@functools.lru_cache(None)
def is_ball(boundary):
    """Whether the simplicial analogue of a canonical boundary has the homology of a sphere, and its cells are balls.

    An edge is a ball over two points. A free dart makes the boundary a surface with boundary, or the like: then it has no
    class of its own dimension. Where a side is sewn to itself it may be a sphere, but the side is no edge.
    """
    if len(boundary) == 1:
        return boundary == ((1, 0),)
    if any(cell is None for cells in gmaps.cells_of(boundary, is_ball) for cell in cells):
        return False
    simplices = list(gmaps.analogue(boundary))
    number = {(numbers, least): k for k, (numbers, least, _, _) in enumerate(simplices)}
    lists = [[] for _ in boundary]
    for numbers, _, _, below in simplices:
        chain = {}
        for k, face in enumerate(below):
            chain[number[face]] = chain.get(number[face], 0) + (-1) ** k
        lists[len(numbers) - 1].append(chain)
    factors = [invariant_factors(rows) for rows in lists] + [[]]
    betti = [len(rows) - len(factors[p]) - len(factors[p + 1]) for p, rows in enumerate(lists)]
    return betti == [1, *[0] * (len(lists) - 2), 1] and all(factor == 1 for found in factors for factor in found)


def read_images(value, what, with_free=False):
    """Lists of darts; some may be None, for darts that are free."""
    if not isinstance(value, list) or not all(isinstance(images, list) for images in value):
        raise ScriptError(f"{what} must be a list of lists")
    for images in value:
        if not all((with_free and d is None) or (is_integer(d) and 0 <= d < 2**32 - 1) for d in images):
            raise ScriptError(f"{what} must have darts, which are counted from 0")
    return value


def read_as(step):
    if step.get("as", "simplices") != "simplices":
        raise ScriptError('as must be "simplices", or left out')
    return "as" in step


def op_gmap(state, step, _prime):
    fields(step, ("name", "alpha"), ("as", "at"))
    name, alpha = check_name(step["name"], "name"), read_images(step["alpha"], "alpha")
    by_simplices = read_as(step)
    problem = gmaps.broken_law(alpha)
    if problem:
        raise ScriptError(f'"{name}" is no G-map: {problem}')
    add_map(state, name, alpha, [str(d) for d in range(len(alpha[0]))], by_simplices)
    check_points_of_vertices(step, alpha)


def op_map(state, step, _prime):
    fields(step, ("name", "beta"), ("as", "at"))
    name, beta = check_name(step["name"], "name"), read_images(step["beta"], "beta", True)
    by_simplices = read_as(step)
    problem = gmaps.broken_law_of_nmap(beta)
    if problem:
        raise ScriptError(f'"{name}" is no map: {problem}')
    darts = range(len(beta[0]))
    add_map(state, name, gmaps.gmap_of(beta), [*map(str, darts), *(f"{d}'" for d in darts)], by_simplices)
    check_points_of_vertices(step, gmaps.gmap_of(beta))


def op_polygon(state, step, _prime):
    fields(step, ("name", "sides"), ("as", "at"))
    name, sides = check_name(step["name"], "name"), step["sides"]
    by_simplices = read_as(step)
    if not is_integer(sides) or not 1 <= sides <= 10**8:
        raise ScriptError("sides must be a number, 1 or more")
    texts = [str(d) for d in range(2 * sides)]
    add_map(state, name, gmaps.polygon(sides), texts, by_simplices, None if by_simplices else name)
    check_points_of_vertices(step, gmaps.polygon(sides))


def check_points_of_vertices(step, alpha):
    """One for each, in the order of their least darts."""
    if "at" in step:
        check_points(step["at"], len(gmaps.orbits(alpha, gmaps.all_but(alpha, 0))))


def dart_cell_name(name, i, text):
    return f"{name}.{i}:{text}"


def add_map(state, name, alpha, texts, by_simplices, top_name=None):
    if not texts:
        raise ScriptError(f'"{name}" has no darts')
    body = state.new_body(name)
    for i in range(len(alpha)):
        for text in texts:
            state.check_free(dart_cell_name(name, i, text))
    state.alpha.update({(name, d): tuple((name, images[d]) for images in alpha) for d in range(len(texts))})
    glued = None
    if by_simplices:
        glued = add_simplices_of_map(state, name, alpha, texts, body)
    else:
        add_cells_of_map(state, name, alpha, texts, body, top_name)
        state.mapped.add(body)
    state.maps[name] = MadeMap(len(alpha) - 1, tuple(texts), glued)


def add_cells_of_map(state, name, alpha, texts, body, top_name):
    layers = gmaps.cells_of(alpha, is_ball)
    largest = len(layers) - 1
    if any(cell is None for cells in layers[:None if largest < LEAST_HOLLOW_DIMENSION else largest] for cell in cells):
        raise ScriptError(f'"{name}" has a cell that is no ball')
    components = gmaps.orbits(alpha, range(largest))
    for i, cells in enumerate(layers):
        for number_of_cell, cell in enumerate(cells):
            if cell is None:
                add_hollow(state, name, alpha, components[number_of_cell], texts, body)
                continue
            faces = {}
            if i > 0:
                at = {place: d for d, place in sorted(cell.darts.items(), reverse=True)}
                for number, root in enumerate(roots_of_faces(cell.kind)):
                    faces[number] = state.names[dart_cell_name(name, i - 1, texts[at[root]])]
            called = dart_cell_name(name, i, texts[cell.root])
            top = called if top_name is None or i < len(layers) - 1 else top_name
            number = state.add(top, cell.kind, faces.values(), body, name)
            for d, place in cell.darts.items():
                state.names[dart_cell_name(name, i, texts[d])] = number, gmaps.shape_from(cell.kind, place)


def add_hollow(state, name, alpha, darts, texts, body):
    """The largest cell of some darts, which is no ball. Its darts are numbered from the first of those from which it looks
    least."""
    n = len(alpha) - 1
    own = gmaps.renumbered(alpha[:-1], darts)
    order = [darts[k] for k in gmaps.walk(own, gmaps.canonical_root(own))]
    boundary = gmaps.renumbered(alpha[:-1], order)
    faces = [state.names[dart_cell_name(name, slot.dimension, texts[order[slot.root]])]
             for slot in boundaries.slots_of(boundary, is_ball)]
    kind = boundaries.hollow(boundary, is_ball)
    number = state.add(dart_cell_name(name, n, texts[order[0]]), kind, faces, body, name)
    for place, d in enumerate(order):
        state.names[dart_cell_name(name, n, texts[d])] = number, whole(kind)
        state.places[name, d] = boundary, place


def roots_of_faces(kind):
    """The darts from which the faces of a cell of a map are seen, in order. An edge has one at either end."""
    return [root for root, _ in gmaps.faces_of_kind(kind)[0]] if isinstance(kind, MapKind) else range(len(kind) * 2)


def add_simplices_of_map(state, name, alpha, texts, body):
    """Returns the names of what sewing glues: an i-sewing the simplices with all numbers but i."""
    called, glued = {}, {}
    for numbers, least, darts, below in gmaps.analogue(alpha):
        called[numbers, least] = f"{name}.<{'-'.join(map(str, numbers))}>:{texts[least]}"
        faces = [state.plain(state.find(called[face])) for face in below]
        state.add(called[numbers, least], (len(numbers) - 1,) if below else (), faces, body, name)
        missing = set(range(len(alpha))) - set(numbers)
        if len(missing) == 1:
            glued.update(((min(missing), d), called[numbers, least]) for d in darts)
    return glued


# ------------------------------------------------------------------------------------------------ local operations on cells

# An i-cell of some darts as it was: its number, the darts, and whether it stays.
OldCell = collections.namedtuple("OldCell", "number darts stays")


def dart_by_cells(state, text):
    dart = read_dart(state, text)
    if state.maps[dart[0]].glued is not None:
        raise ScriptError(f'"{text}" is a dart of a map by simplices')
    return dart


def read_cell_of_map(state, text, name):
    """(dimension, dart). The face of a polygon has the name of that."""
    if not isinstance(text, str) or (name is not None and not isinstance(name, str)):
        raise ScriptError("a cell and a map must be strings")
    if text in state.maps and text in state.names:
        called, i, dart = text, 2, "0"
    else:
        base, _, dart = text.rpartition(":")
        called, _, number = base.rpartition(".")
        if not number.isdigit() or str(int(number)) != number:
            raise ScriptError(f'no cell of a map is called "{text}"')
        i = int(number)
    if name is not None and name != called:
        raise ScriptError(f'"{text}" is no cell of "{name}"')
    found = dart_by_cells(state, f"{called}:{dart}")
    if i > state.maps[called].dimension:
        raise ScriptError(f'"{called}" has no cells of dimension {i}')
    return i, found


def darts_around(state, dimension):
    """The maps of one dimension that have darts of their own."""
    return {d: images for d, images in state.alpha.items() if len(images) == dimension + 1}


def op_remove_cell(state, step, _prime):
    fields(step, ("cell",), ("map",))
    take_cell_out(state, step, 1)


def op_contract_cell(state, step, _prime):
    fields(step, ("cell",), ("map",))
    take_cell_out(state, step, -1)


def take_cell_out(state, step, towards):
    i, dart = read_cell_of_map(state, step["cell"], step.get("map"))
    images = darts_around(state, len(state.alpha[dart]) - 1)
    rewire(state, i, local_operations.without_cell(images, i, dart, towards))


def op_insert_cell(state, step, _prime):
    put_cell_in(state, step, 1)


def op_split_cell(state, step, _prime):
    put_cell_in(state, step, -1)


def put_cell_in(state, step, towards):
    fields(step, ("name", "dim", "darts"), ("at",))
    name, i = check_name(step["name"], "name"), step_dimension(step)
    if not isinstance(step["darts"], list) or not step["darts"]:
        raise ScriptError("darts must be a list of darts, not empty")
    if "at" in step:
        check_point(step["at"], "at")
    darts = [dart_by_cells(state, text) for text in step["darts"]]
    n = state.maps[darts[0][0]].dimension
    if any(state.maps[d[0]].dimension != n for d in darts):
        raise ScriptError("the darts are of maps of several dimensions")
    body = state.new_body(name)
    surgery = local_operations.with_cell(darts_around(state, n), i, darts, towards, name)
    made = sorted(d for d in ({} if isinstance(surgery, str) else surgery[1]) if d not in state.alpha)
    for d in made:
        for k in range(n + 1):
            state.check_free(dart_cell_name(name, k, d[1]))
    state.maps[name] = MadeMap(n, tuple(str(k) for k in range(len(made))), None)
    before = state.created
    rewire(state, i, surgery, body)
    if "at" in step and not (before in state.cells and state.dim(before) == 0):
        raise ScriptError("no vertex is new, so none can have a position")


def rewire(state, i, surgery, body=None):
    """Darts go, come, or have other images under alpha_i. The cells that they belong to are looked at again, and what they
    are is worked out from the map as it is then; `body` is one to which the new cells belong, too."""
    if isinstance(surgery, str):
        raise ScriptError(surgery)
    gone, changed = surgery
    rewiring = Rewiring(state, i, gone, changed)
    for q in range(rewiring.n + 1):
        rewiring.look_at(q)
    rewiring.finish(body)


class Rewiring:
    """Cells are gone through by dimension. One stays if its darts see the same boundary and faces as before, though some may be
    others; all others that are looked at go, and there are new ones in their place."""

    def __init__(self, state, i, gone, changed):
        self.state, self.i, self.gone, self.changed = state, i, gone, changed
        self.n = len(next(iter(changed.values()))) - 1
        self.before = darts_around(state, self.n)
        self.after = {d: images for d, images in {**self.before, **changed}.items() if d not in gone}
        self.rank = {name: k for k, name in enumerate(state.maps)}
        self.sees_others = set()  # darts, in the dimension below
        self.sees = []  # of each dimension {dart: value} where cells were looked at
        self.new, self.bodies, self.taken, self.kept = [], [], set(), set()

    def order(self, d):
        return self.rank[d[0]], d[1]

    def sees_now(self, q, d):
        return self.sees[q][d] if d in self.sees[q] else seen_by(self.state, q, d)

    def look_at(self, q):
        others = {d for d in self.changed if q != self.i or d not in self.before}
        looked_at = sorted(self.gone | others | self.sees_others, key=self.order)
        old = {}  # dart -> OldCell, of all darts of those
        in_order = []
        for d in looked_at:
            if d in self.before and d not in old:
                cell = self.old_cell(q, d)
                in_order.append(cell)
                old.update(dict.fromkeys(cell.darts, cell))
        self.sees.append({})
        for d in looked_at:
            if d not in self.gone and d not in self.sees[q]:
                part = sorted(orbit_of(self.after, d, q), key=self.order)
                candidates = [cell for cell in in_order if not cell.stays and cell.darts & set(part)]
                candidates.sort(key=lambda cell: -len(cell.darts & set(part)))
                if not any(self.keep(q, part, cell) for cell in candidates):
                    self.make(q, part)
        self.sees_others = {d for d, value in self.sees[q].items()
                            if d not in old or seen_by(self.state, q, d) != value}
        for cell in in_order:
            self.bodies.append(self.state.cells[cell.number].body)
            if cell.stays:
                self.kept.add(cell.number)
            else:
                self.check_alone(q, cell)
                self.taken.add(cell.number)

    def old_cell(self, q, start):
        """It must be as its darts say."""
        darts = orbit_of(self.before, start, q)
        number = seen_by(self.state, q, start)[0]
        for d in darts:
            value = seen_by(self.state, q, d)
            is_whole = value[0] == number and not is_degenerate(value)
            if is_whole and q > 0 and not self.state.is_hollow(number):
                is_whole = self.state.face(value, *first_face(value)) == seen_by(self.state, q - 1, d)
            if not is_whole:
                raise ScriptError(f"a cell of dimension {q} has been split, or is degenerate")
        return OldCell(number, frozenset(darts), [])

    def boundary_of(self, q, part):
        """The cell of some darts: gmaps.CellOfMap, with darts as they are here; or None."""
        place = {d: k for k, d in enumerate(part)}
        alpha = [[place[d] if k == q else place[self.after[d][k]] for d in part] for k in range(self.n + 1)]
        return gmaps.cell_of(alpha, q, 0, is_ball)

    def keep(self, q, part, cell):
        state, name = self.state, state_name(self.state, q, cell)
        if state.is_hollow(cell.number) or (name in cell.darts and name not in self.gone and name not in part):
            return False
        own = self.boundary_of(q, part)
        if own is None:
            return False
        first = next(k for k, d in enumerate(part) if d in cell.darts)
        value = seen_by(state, q, part[first])
        if isinstance(own.kind, MapKind):
            kind = gmaps.kind_from(own.kind, own.darts[first])
            places = {k: gmaps.order_from(own.kind, own.darts[first]).index(place) for k, place in own.darts.items()}
        else:
            kind, places = own.kind, {k: int(place != own.darts[first]) for k, place in own.darts.items()}
        if kind != (value[1].kind if isinstance(value[1], Seen) else type_of(value[1])):
            return False
        sees = {d: (cell.number, fill(gmaps.shape_from(kind, places[k]), value[1])) for k, d in enumerate(part)}
        for d, seen in sees.items():
            if d in cell.darts and seen != seen_by(state, q, d):
                return False
            if q > 0 and state.face(seen, *first_face(seen)) != self.sees_now(q - 1, d):
                return False
        cell.stays.append(True)
        self.sees[q].update(sees)
        return True

    def make(self, q, part):
        own = self.boundary_of(q, part)
        number = self.state.created
        self.state.created += 1
        if own is None:
            self.make_hollow(q, part, number)
            return
        root = part[own.root]
        at = {place: part[k] for k, place in sorted(own.darts.items(), reverse=True)}
        faces = [self.sees_now(q - 1, at[place]) for place in roots_of_faces(own.kind)] if q > 0 else []
        if any(type_of(value[1]) != (face.kind if isinstance(face, Seen) else face)
               for value, face in zip(faces, kinds_of_faces(own.kind))):
            raise ScriptError("a face has been split")
        self.add(number, q, root, own.kind, faces)
        for k, place in own.darts.items():
            self.sees[q][part[k]] = number, gmaps.shape_from(own.kind, place)

    def add(self, number, q, root, kind, faces):
        texts = self.state.maps[root[0]].texts
        self.state.cells[number] = Cell(dart_cell_name(root[0], q, texts[root[1]]), kind, tuple(faces), None)
        self.new.append((number, q, root))

    def make_hollow(self, q, part, number):
        if q < self.n or q < LEAST_HOLLOW_DIMENSION:
            raise ScriptError(f"a cell of dimension {q} would be no ball")
        place = {d: k for k, d in enumerate(part)}
        alpha = [[place[self.after[d][k]] for d in part] for k in range(self.n)]
        order = gmaps.walk(alpha, gmaps.canonical_root(alpha))
        boundary = gmaps.renumbered(alpha, order)
        slots = boundaries.slots_of(boundary, is_ball)
        faces = [self.sees_now(slot.dimension, part[order[slot.root]]) for slot in slots]
        kind = boundaries.hollow(boundary, is_ball)
        if tuple(type_of(face[1]) for face in faces) != kind.faces:
            raise ScriptError("a cell below the new one has been split")
        self.add(number, q, part[order[0]], kind, faces)
        for k, d in enumerate(order):
            self.sees[q][part[d]] = number, whole(kind)
            self.state.places[part[d]] = boundary, k

    def check_alone(self, q, cell):
        """Whether all that the cell is called by are darts of it, or such as see others by now."""
        for name, value in self.state.names.items():
            if value and value[0] == cell.number and not is_degenerate(value):
                d = dart_of_name(self.state, q, name)
                if d is None or (d in self.state.alpha and d not in cell.darts):
                    raise ScriptError(f'a cell of dimension {q} is "{name}", too')

    def finish(self, body):
        state = self.state
        taken = self.taken - self.kept
        new = {number for number, _, _ in self.new}
        for c in state.alive():
            if c not in taken and any(face[0] in taken for face in state.faces(c)):
                raise ScriptError(f'"{state.cells[c].name}" would lose a face')
        all_bodies = [*self.bodies, *([] if body is None else [body])]
        for other in all_bodies:
            state.merge_bodies(all_bodies[0], other)
        for number in new:
            state.cells[number] = state.cells[number]._replace(body=state.body_root(all_bodies[0]))
        take_away(state, taken)
        state.alpha.update(self.after)
        for d in self.gone:
            del state.alpha[d]
        for q, sees in enumerate(self.sees):
            for d, value in sees.items():
                state.names[dart_cell_name(d[0], q, dart_text(state, d))] = value
        problem = state.broken_law()
        if problem:
            raise ScriptError(f"other steps have split what is changed: {problem}")


def first_face(value):
    """The number of the face that dart 0 of a value belongs to, as face_of takes it."""
    return face_slots(type_of(value[1]))[0]


def kinds_of_faces(kind):
    return [face for _, face in gmaps.faces_of_kind(kind)[0]] if isinstance(kind, MapKind) else [()] * 2 * len(kind)


def dart_of_name(state, q, name):
    """The dart after which a name calls a q-cell, or None; perhaps one that went."""
    if name in state.maps and q == 2:
        return name, 0
    base, _, text = name.rpartition(":") if isinstance(name, str) else ("", "", "")
    called, _, number = base.rpartition(".")
    if called not in state.maps or number != str(q) or text not in state.maps[called].texts:
        return None
    return called, state.maps[called].texts.index(text)


def state_name(state, q, cell):
    return dart_of_name(state, q, state.cells[cell.number].name)


# ------------------------------------------------------------------------------------------------ levels of darts


def read_level(entry, i):
    if not isinstance(entry, dict):
        raise ScriptError("levels must be objects")
    names = ("darts", "alpha", "sigma") if i == 0 else ("alpha", "sigma")
    if any(field not in names for field in entry) or (i > 0 and len(entry) < 2):
        raise ScriptError("a level has alpha and sigma, level 0 a number of darts")
    if i == 0:
        if entry.get("alpha", []) != [] or entry.get("sigma", []) != []:
            raise ScriptError("level 0 has neither alpha nor sigma")
        return chains.Level([], [], read_images([[entry["darts"]]], "darts")[0][0] if "darts" in entry else None)
    alpha, sigma = read_images(entry["alpha"], "alpha"), read_images([entry["sigma"]], "sigma")[0]
    return chains.Level(alpha, sigma, len(sigma))


def op_chain_of_maps(state, step, _prime):
    fields(step, ("name", "levels"), ("as", "at"))
    name, entries = check_name(step["name"], "name"), step["levels"]
    by_simplices = read_as(step)
    if not isinstance(entries, list) or not entries:
        raise ScriptError("levels must be a list that is not empty")
    levels = [read_level(entry, i) for i, entry in enumerate(entries)]
    if levels[0].size is None:
        if len(levels) == 1 or not levels[1].sigma:
            raise ScriptError("level 0 needs a number of darts")
        levels[0] = levels[0]._replace(size=max(levels[1].sigma) + 1)
    problem = chains.broken_law(levels)
    if problem:
        raise ScriptError(f'"{name}" is no chain of maps: {problem}')
    if "at" in step and step["at"] != []:
        check_points(step["at"], levels[0].size)
    body = state.new_body(name)
    for i, level in enumerate(levels):
        for d in range(level.size):
            state.check_free(dart_cell_name(name, i, d))
    if not by_simplices:
        add_cells_of_levels(state, name, levels, body, lambda i, cell: dart_cell_name(name, i, cell.root))
        return
    called = {}
    for numbers, least, below in chains.analogue(levels):
        called[numbers, least] = f"{name}.<{'-'.join(map(str, numbers))}>:{least}"
        faces = [state.plain(state.find(called[face])) for face in below]
        state.add(called[numbers, least], (len(numbers) - 1,) if below else (), faces, body, name)


def add_cells_of_levels(state, name, levels, body, called, order_of=lambda i, cell: cell.root):
    """The cells of a chain of maps, each layer sorted by `order_of`."""
    for i in range(len(levels)):
        layer = chains.cells(levels, i, is_ball)
        if None in layer:
            raise ScriptError(f'"{name}" has a cell that is no ball')
        for cell in sorted(layer, key=lambda cell: order_of(i, cell)):
            at = {place: d for d, place in cell.darts.items()}
            roots = roots_of_faces(cell.kind)
            faces = [state.names[dart_cell_name(name, i - 1, levels[i].sigma[at[root]])] for root in roots if i > 0]
            number = state.add(called(i, cell), cell.kind, faces, body, name)
            for d, place in cell.darts.items():
                state.names[dart_cell_name(name, i, d)] = number, gmaps.shape_from(cell.kind, place)
    state.mapped.add(body)
    state.levels[name] = tuple(level.size for level in levels)


def op_incidence(state, step, _prime):
    fields(step, ("name", "cells"), ("as",))
    name, entries = check_name(step["name"], "name"), step["cells"]
    by_simplices = read_as(step)
    if not isinstance(entries, list) or not entries:
        raise ScriptError("cells must be a list that is not empty")
    listed = {}
    for entry in entries:
        if not isinstance(entry, dict) or any(field not in ("id", "faces", "at") for field in entry):
            raise ScriptError("a cell of an incidence graph has an id, faces, and a point when it has no faces")
        ident, own = check_name(entry.get("id"), "id"), entry.get("faces", [])
        if ident in listed or not isinstance(own, list) or ("at" in entry and own):
            raise ScriptError(f'the cell "{ident}" is listed twice, or its faces are no list, or it has a point')
        if "at" in entry:
            check_point(entry["at"], "at")
        listed[ident] = own
    ids = list(listed)
    if any(not isinstance(face, str) or face not in listed for own in listed.values() for face in own):
        raise ScriptError("a face is not listed")
    faces = [[ids.index(face) for face in listed[ident]] for ident in ids]
    rank = chains.ranks(faces)
    if rank is None:
        raise ScriptError(f'"{name}" is no incidence graph')
    body = state.new_body(name)
    if by_simplices:
        add_chains(state, name, ids, faces, body)
    else:
        add_cells_of_graph(state, name, ids, faces, rank, body)


def add_chains(state, name, ids, faces, body):
    if any("<" in ident for ident in ids):
        raise ScriptError('an id has a "<"')

    def called(chain):
        return f"{name}.<{'<'.join(ids[x] for x in chain)}>"

    for chain in chains.chains_of(faces):
        below = [state.plain(state.find(called(chain[:k] + chain[k + 1:]))) for k in range(len(chain)) if len(chain) > 1]
        state.add(called(chain), (len(chain) - 1,) if below else (), below, body, name)


def add_cells_of_graph(state, name, ids, faces, rank, body):
    flags = chains.tuples(faces, max(rank))
    levels = chains.levels_of(faces, flags)
    whole_cells = levels and all(len({level[d][-1] for d in part}) == 1 and len(part) == sum(
        flag[-1] == level[part[0]][-1] for flag in level) for i, level in enumerate(flags) if i > 0
        for part in gmaps.orbits(levels[i].alpha, range(i)))
    if not whole_cells:
        raise ScriptError(f'"{name}" has a cell over no surface')
    names_of_darts = {dart_cell_name("", i, d)[1:] for i, level in enumerate(flags) for d in range(len(level))}
    if any(ident in names_of_darts for ident in ids):
        raise ScriptError("an id is that of a dart")
    for text in names_of_darts:
        state.check_free(f"{name}.{text}")

    def cell_of(i, cell):
        return flags[i][cell.root][-1]

    add_cells_of_levels(state, name, levels, body, lambda i, cell: f"{name}.{ids[cell_of(i, cell)]}", cell_of)
    for x, ident in enumerate(ids):
        flag = chains.first_flag(faces, x)
        state.names[f"{name}.{ident}"] = state.names[dart_cell_name(name, rank[x], flags[rank[x]].index(flag))]


def read_dart(state, text):
    """(name of its map, number)."""
    if not isinstance(text, str):
        raise ScriptError("a dart must be a string")
    name, _, dart = text.rpartition(":")
    if name not in state.maps or dart not in state.maps[name].texts:
        raise ScriptError(f'there is no dart "{text}"')
    found = name, state.maps[name].texts.index(dart)
    if found not in state.alpha:
        raise ScriptError(f'"{text}" went with a cell')
    return found


def dart_text(state, dart):
    return state.maps[dart[0]].texts[dart[1]]


def seen_by(state, i, dart):
    """The i-cell of a dart as the dart sees it. By simplices: what is glued when it is (i+1)-sewn."""
    made = state.maps[dart[0]]
    name = made.glued[i + 1, dart[1]] if made.glued is not None else dart_cell_name(dart[0], i, dart_text(state, dart))
    return state.value(name)


def reached(state, i, dart):
    """The darts that are i-sewn with a dart, each as the list of indices that lead there."""
    indices = [j for j in range(len(state.alpha[dart])) if abs(j - i) >= 2]
    found, pending = {dart: ()}, [dart]
    while pending:
        d = pending.pop()
        for j in indices:
            if state.alpha[d][j] not in found:
                found[state.alpha[d][j]] = (*found[d], j)
                pending.append(state.alpha[d][j])
    return found


def step_dimension(step):
    if not is_integer(step["dim"]) or step["dim"] < 0:
        raise ScriptError("dim must be a dimension")
    return step["dim"]


def op_sew(state, step, _prime):
    fields(step, ("dim", "pairs"))
    i = step_dimension(step)
    if not isinstance(step["pairs"], list):
        raise ScriptError("pairs must be a list of pairs of darts")
    sewn, equations = {}, []
    for pair in step["pairs"]:
        if not isinstance(pair, list) or len(pair) != 2:
            raise ScriptError("a pair must be a list of two darts")
        one, other = (read_dart(state, text) for text in pair)
        made = [state.maps[dart[0]] for dart in (one, other)]
        if made[0].dimension != made[1].dimension or i > made[0].dimension:
            raise ScriptError("there is no such sewing in the dimension of the maps")
        if sewn.get(one) == other:
            continue
        if one == other:
            raise ScriptError("a dart cannot be sewn to itself")
        if (made[0].glued is None) != (made[1].glued is None):
            raise ScriptError("maps by cells and by simplices cannot be sewn")
        if made[0].glued is None and i < made[0].dimension:
            raise ScriptError("maps by cells are sewn in their own dimension only")
        sew_orbits(state, i, one, other, sewn)
        if made[0].dimension > 0:
            orbit = [one] if made[0].glued is None else reached(state, i, one)
            equations += [(seen_by(state, i - 1, d), seen_by(state, i - 1, sewn[d])) for d in orbit]
    for d, image in sewn.items():
        state.alpha[d] = (*state.alpha[d][:i], image, *state.alpha[d][i + 1:])
    state.equate(equations)


def sew_orbits(state, i, one, other, sewn):
    """Notes the images of an orbit, and back; only an isomorphism will do."""
    image = {}
    for d, way in reached(state, i, one).items():
        image[d] = functools.reduce(lambda at, j: state.alpha[at][j], way, other)
    for d, e in list(image.items()):
        if image.setdefault(e, d) != d:
            raise ScriptError("what belongs to the darts is not alike")
    if set(image) != {*reached(state, i, one), *reached(state, i, other)}:
        raise ScriptError("what belongs to the darts is not alike")
    for d, e in image.items():
        for j in range(len(state.alpha[d])):
            if abs(j - i) >= 2 and image[state.alpha[d][j]] != state.alpha[e][j]:
                raise ScriptError("what belongs to the darts is not alike")
        if state.alpha[d][i] != d or d in sewn:
            raise ScriptError(f"a dart is {i}-sewn already")
    sewn.update(image)


def orbit_of(alpha, dart, left_out):
    """The darts of a cell."""
    found, pending = {dart}, [dart]
    while pending:
        d = pending.pop()
        for j, e in enumerate(alpha[d]):
            if j != left_out and e not in found:
                found.add(e)
                pending.append(e)
    return found


def op_unsew(state, step, _prime):
    fields(step, ("dim", "darts"))
    n = step_dimension(step)
    if not isinstance(step["darts"], list):
        raise ScriptError("darts must be a list of darts")
    if step["darts"] and state.maps[read_dart(state, step["darts"][0])[0]].glued is not None:
        unsew_simplices(state, n, step["darts"])
        return
    free = set()
    for text in step["darts"]:
        dart = read_dart(state, text)
        made = state.maps[dart[0]]
        if made.glued is not None or made.dimension != n:
            raise ScriptError("maps by cells are unsewn in their own dimension only")
        if state.alpha[dart][n] == dart:
            raise ScriptError(f'"{text}" is free')
        free |= {e for d in reached(state, n, dart) for e in (d, state.alpha[d][n])}
    before = dict(state.alpha)
    for d in free:
        state.alpha[d] = (*state.alpha[d][:n], d)
    rank = {name: k for k, name in enumerate(state.maps)}
    copies = {}  # of the dimension below: dart -> (what it saw, what it sees)
    for i in range(n + 1):
        here = split_cells(state, i, before, free, copies, rank) if i < n else {}
        move_faces(state, i, here, copies)
        move_faces_of_hollow(state, n, i, here)
        copies = here
    problem = state.broken_law()
    if problem:
        raise ScriptError(f"other steps have split what is unsewn: {problem}")


def split_cells(state, i, before, free, below, rank):
    """Gives each part of a cell a cell of its own, but that which has the dart by which the cell is called."""
    copies, done = {}, set()
    for dart in sorted(free, key=lambda d: (rank[d[0]], d[1])):
        if dart in done:
            continue
        darts = orbit_of(before, dart, i)
        done |= darts
        whole = seen_by(state, i, dart)
        if any(seen_by(state, i, d)[0] != whole[0] for d in darts):
            raise ScriptError("other steps have split what is unsewn")
        for above in (seen_by(state, i + 1, d) for d in darts):
            if is_degenerate(above) or (not state.is_hollow(above[0]) and state.face(above, *first_face(above))[0] != whole[0]):
                raise ScriptError("other steps have split what is unsewn, or it is degenerate")
        names = {dart_cell_name(d[0], i, dart_text(state, d)): d for d in darts}
        others = set()
        called = state.cells[whole[0]].name
        above = {seen_by(state, i + 1, d)[0] for d in darts}
        if any(c not in above and not state.is_hollow(c) and any(face[0] == whole[0] for face in cell.faces)
               for c, cell in state.cells.items()):
            raise ScriptError(f'"{called}" is a face of what is no cell of its map')
        for name, (dimension, d) in state.made_for.items():  # cells of products are called in two ways
            is_name = dimension == i and state.names[name] and state.names[name][0] == whole[0]
            if is_name and (d in darts or seen_by(state, i, d)[0] != whole[0]):
                others.add(name)
        # A polygon gives its face one more name.
        names.update((d[0], d) for d in darts if i == 2 and d[1] == 0 and d[0] in state.names)
        if is_degenerate(whole) or any(value and value[0] == whole[0] and not is_degenerate(value) and key not in names
                                       and key not in others for key, value in state.names.items()):
            raise ScriptError(f'"{called}" is glued to other cells, and not only by sewing')
        parts = []
        for d in sorted(darts, key=lambda d: (rank[d[0]], d[1])):
            if not any(d in part for part in parts):
                parts.append(orbit_of(state.alpha, d, i))
        naming = names.get(called, state.made_for.get(called, (i, None))[1])
        naming = naming if naming in darts else min(darts, key=lambda d: (rank[d[0]], d[1]))
        for part in parts:
            if naming not in part:
                add_part(state, i, whole[0], sorted(part, key=lambda d: (rank[d[0]], d[1])), names, copies)
    return copies


def add_part(state, i, cell, part, names, copies):
    """A copy of a cell for some of its darts. Its faces are those of the cell, until they are moved."""
    seen = {d: seen_by(state, i, d) for d in part}
    root = next(d for d in part if seen[d] == state.plain(cell))
    called = dart_cell_name(root[0], i, dart_text(state, root))
    for name, d in names.items():
        if d in seen:
            del state.names[name]
    for apex, cone in state.cones.items():  # what v*m.1:0 was, the cone over the cell, is none over this one
        table = {key: of for key, of in cone.table.items() if key not in names or names[key] not in seen}
        state.cones[apex] = cone._replace(table=table)
    own = state.cells[cell]
    number = state.add(called, own.kind, own.faces, own.body)
    for name, d in names.items():
        if d in seen:
            state.names[name] = number, seen[d][1]
            copies[d] = seen[d], state.names[name]


def move_faces(state, i, here, below):
    """Where a dart sees a copy as a face of its i-cell, that is the face now."""
    for d, (saw, sees) in below.items():
        cell, shape = here[d][1] if d in here else seen_by(state, i, d)
        if state.is_hollow(cell):
            continue
        if is_degenerate((cell, shape)):
            raise ScriptError("the oracle does not unsew at edges that became degenerate")
        kind = state.cells[cell].kind
        if isinstance(kind, MapKind):
            number, place = gmaps.faces_of_kind(kind)[1][shape.dart]
            other = gmaps.shape_from(gmaps.faces_of_kind(kind)[0][number][1], place)
        else:
            number, other = shape[0][0], ()
        faces = list(state.faces(cell))
        if (faces[number][0], fill(other, faces[number][1])) not in (saw, sees):
            raise ScriptError(f'"{state.cells[saw[0]].name}" is no face of "{state.cells[cell].name}" any more')
        faces[number] = sees[0], fill(inverse(other), sees[1])
        state.cells[cell] = state.cells[cell]._replace(faces=tuple(faces))


def move_faces_of_hollow(state, n, q, copies):
    """The same of largest cells that are no balls, which have the cells of dimension q as faces."""
    for d, (saw, sees) in copies.items():
        cell = seen_by(state, n, d)[0]
        if not state.is_hollow(cell):
            continue
        boundary, place = state.places[d]
        number, slot = next((number, slot) for number, slot in enumerate(boundaries.slots_of(boundary, is_ball))
                            if slot.dimension == q and place in slot.indices)
        other = gmaps.shape_from(slot.kind, slot.indices[place])
        faces = list(state.faces(cell))
        if (faces[number][0], fill(other, faces[number][1])) not in (saw, sees):
            raise ScriptError(f'"{state.cells[saw[0]].name}" is no face of "{state.cells[cell].name}" any more')
        faces[number] = sees[0], fill(inverse(other), sees[1])
        state.cells[cell] = state.cells[cell]._replace(faces=tuple(faces))


def op_extend(state, step, _prime):
    fields(step, ("maps",))
    if not isinstance(step["maps"], list) or not step["maps"]:
        raise ScriptError("maps must be a list of maps, not empty")
    chosen = []
    for name in step["maps"]:
        if not isinstance(name, str) or name not in state.maps:
            raise ScriptError(f"there is no map {json.dumps(name)}")
        if (state.maps[name].glued is None) != (state.maps[step["maps"][0]].glued is None):
            raise ScriptError("maps by cells and by simplices cannot be extended in one step")
        chosen.append(name)
    n = state.maps[chosen[0]].dimension
    if any(state.maps[name].dimension != n for name in chosen) or n == gmaps.LARGEST_MAP_DIMENSION:
        raise ScriptError("the dimensions of the maps cannot be extended")
    while met := {e[0] for (name, _), images in state.alpha.items() if name in chosen for e in images} - {*chosen}:
        chosen += met
    chosen = [name for name in state.maps if name in chosen]
    darts = [(name, k) for name in chosen for k in range(len(state.maps[name].texts)) if (name, k) in state.alpha]
    if not darts:
        raise ScriptError("no dart is left")
    number = {d: k for k, d in enumerate(darts)}
    alpha = [[number[state.alpha[d][i]] for d in darts] for i in range(n + 1)] + [list(range(len(darts)))]
    if state.maps[chosen[0]].glued is not None:
        extend_simplices(state, alpha, chosen, darts)
        return
    if any(image == d for images in alpha[:-1] for d, image in enumerate(images)):
        raise ScriptError("what is extended is open")
    components = gmaps.orbits(alpha, range(n + 1))
    cells = [gmaps.cell_of(alpha, n + 1, part[0], is_ball) for part in components]
    for cell, component in zip(cells, components):
        if cell is None:
            extend_over(state, alpha, component, darts)
            continue
        at = {place: d for d, place in sorted(cell.darts.items(), reverse=True)}
        faces = [seen_by(state, n, darts[at[root]]) for root in roots_of_faces(cell.kind)]
        problem = broken_law(cell.kind, faces, state.faces)
        if problem:
            raise ScriptError(f"other steps have split what the cell is over: {problem}")
        for face in faces:
            state.merge_bodies(state.cells[faces[0][0]].body, state.cells[face[0]].body)
        texts = {d: dart_cell_name(darts[d][0], n + 1, dart_text(state, darts[d])) for d in cell.darts}
        new = state.add(texts[cell.root], cell.kind, faces, state.body_root(state.cells[faces[0][0]].body))
        for d, place in cell.darts.items():
            if state.reading(texts[d]) is None or d == cell.root:
                state.names[texts[d]] = new, gmaps.shape_from(cell.kind, place)
    for d, e in ((d, state.alpha[d]) for d in darts):
        state.alpha[d] = (*e, d)
    for name in chosen:  # a new map of the same name
        made = state.maps.pop(name)
        state.maps[name] = made._replace(dimension=n + 1)


def extend_over(state, alpha, component, darts):
    """The cell over a component that is no sphere."""
    n = len(alpha) - 2
    largest = [seen_by(state, n, darts[d])[0] for d in component]
    if n + 1 < LEAST_HOLLOW_DIMENSION or any(map(state.is_hollow, largest)):
        raise ScriptError("the new cell is no ball")
    if any(cell is None for cells in gmaps.cells_of(alpha[:-1], is_ball) for cell in cells):
        raise ScriptError("the new cell would be over one that is no ball")
    order = gmaps.walk(alpha, component[0])
    seen = gmaps.renumbered(alpha[:-1], order)
    order = [order[k] for k in gmaps.walk(seen, gmaps.canonical_root(seen))]
    boundary = gmaps.renumbered(alpha[:-1], order)
    faces = [seen_by(state, slot.dimension, darts[order[slot.root]]) for slot in boundaries.slots_of(boundary, is_ball)]
    kind = boundaries.hollow(boundary, is_ball)
    if tuple(type_of(face[1]) for face in faces) != kind.faces or broken_law(kind, faces, state.faces):
        raise ScriptError("other steps have split what the cell is over")
    for face in faces:
        state.merge_bodies(state.cells[faces[0][0]].body, state.cells[face[0]].body)
    called = [dart_cell_name(darts[d][0], n + 1, dart_text(state, darts[d])) for d in order]
    new = state.add(called[0], kind, faces, state.body_root(state.cells[faces[0][0]].body))
    for place, d in enumerate(order):
        if state.reading(called[place]) is None or place == 0:
            state.names[called[place]] = new, whole(kind)
        state.places[darts[d]] = boundary, place


# ------------------------------------------------------------------------------------------------ maps by simplices


def simplex_name(state, numbers, dart):
    return f"{dart[0]}.<{'-'.join(map(str, numbers))}>:{dart_text(state, dart)}"


def simplex_seen(state, numbers, dart):
    """The simplex of a dart with some numbers, as a face of the largest one."""
    largest = range(state.maps[dart[0]].dimension + 1)
    value = state.value(simplex_name(state, largest, dart))
    for i in reversed(largest):
        if i not in numbers:
            value = state.face(value, 0, i)
    return value


def orbit_without(alpha, dart, numbers):
    """The darts of a simplex with some numbers."""
    found, pending = {dart}, [dart]
    while pending:
        d = pending.pop()
        for j, e in enumerate(alpha[d]):
            if j not in numbers and e not in found:
                found.add(e)
                pending.append(e)
    return found


def seen_by_all(state, numbers, darts):
    """The simplex that some darts see, which is glued to nothing else."""
    seen = {simplex_seen(state, numbers, d) for d in darts}
    if len(seen) > 1 or any(value != state.plain(value[0]) for value in seen):
        raise ScriptError("other steps have split, squashed or turned what is unsewn")
    number = seen.pop()[0]
    names = {simplex_name(state, numbers, d) for d in darts}
    if any(value and value[0] == number and not is_degenerate(value) and key not in names
           for key, value in state.names.items()):
        raise ScriptError("what is unsewn is glued to other cells, and not only by sewing")
    return number


def unsew_simplices(state, i, texts):
    sewn = set()
    n = state.maps[read_dart(state, texts[0])[0]].dimension
    for text in texts:
        dart = read_dart(state, text)
        made = state.maps[dart[0]]
        if made.glued is None or made.dimension != n or i > n:
            raise ScriptError("such darts are not unsewn in one step, or not in this dimension")
        if state.alpha[dart][i] == dart:
            raise ScriptError(f'"{text}" is free')
        sewn |= {e for d in reached(state, i, dart) for e in (d, state.alpha[d][i])}
    before = dict(state.alpha)
    for d in sewn:
        state.alpha[d] = (*state.alpha[d][:i], d, *state.alpha[d][i + 1:])
    rank = {name: k for k, name in enumerate(state.maps)}
    sets = [numbers for size in range(1, n + 2) for numbers in itertools.combinations(range(n + 1), size)]
    sets.sort(key=lambda numbers: (len(numbers), sum(1 << k for k in numbers)))
    wholes = {}  # (numbers, dart) -> what it sees, until faces are moved
    copies = {}  # (numbers, dart) -> the number of the copy that it sees instead
    for numbers in (numbers for numbers in sets if i not in numbers):
        for dart in sorted(sewn, key=lambda d: (rank[d[0]], d[1])):
            if (numbers, dart) in wholes:
                continue
            darts = sorted(orbit_without(before, dart, numbers), key=lambda d: (rank[d[0]], d[1]))
            wholes.update(((numbers, d), None) for d in darts)
            parts = []
            for d in darts:
                if not any(d in part for part in parts):
                    parts.append(orbit_without(state.alpha, d, numbers))
            if len(parts) > 1:
                split_simplex(state, numbers, darts, parts, before, copies)
    above = [(numbers, d, k) for face, d in copies for k in set(range(n + 1)) - {*face}
             for numbers in [tuple(sorted((*face, k)))] if (numbers, d) not in copies]
    seen = {(numbers, d): seen_by_all(state, numbers, orbit_without(before, d, numbers)) for numbers, d, _ in above}
    for numbers, d, k in above:
        cell = seen[numbers, d]
        faces = list(state.faces(cell))
        faces[numbers.index(k)] = state.plain(copies[tuple(x for x in numbers if x != k), d])
        state.cells[cell] = state.cells[cell]._replace(faces=tuple(faces))
    point_names_at_copies(state, copies)
    problem = state.broken_law()
    if problem:
        raise ScriptError(f"other steps have split what is unsewn: {problem}")


def split_simplex(state, numbers, darts, parts, before, copies):
    """Each part of a simplex gets a copy, but that which has the dart by which the simplex is called. Names are those
    that they were, until all is done."""
    whole = seen_by_all(state, numbers, darts)
    own = state.cells[whole]
    beside = {simplex_seen(state, (*numbers, k), d)[0]
              for d in darts for k in set(range(len(before[d]))) - {*numbers}}
    if any(c not in beside and any(face[0] == whole for face in cell.faces) for c, cell in state.cells.items()):
        raise ScriptError(f'"{own.name}" is a face of what is no simplex of its map')
    for part in parts:
        least = next(d for d in darts if d in part)
        called = simplex_name(state, numbers, least)
        if own.name in {simplex_name(state, numbers, d) for d in part}:
            called = own.name
        else:
            if called not in state.names:
                state.check_free(called)
            faces = [state.plain(copies[below, least]) if (below, least) in copies else face
                     for below, face in zip((numbers[:k] + numbers[k + 1:] for k in range(len(numbers))), own.faces)]
            copies.update(((numbers, d), state.created) for d in part)
            state.cells[state.created] = Cell(called, own.kind, tuple(faces), own.body)
            state.created += 1
        missing = {*range(len(before[least]))} - {*numbers}
        if len(missing) == 1:
            index = min(missing)
            for d in part:
                made = state.maps[d[0]]
                state.maps[d[0]] = made._replace(glued={**made.glued, (index, d[1]): called})


def point_names_at_copies(state, copies):
    for (numbers, d), copy in copies.items():
        name = simplex_name(state, numbers, d)
        if name in state.names or state.cells[copy].name == name:
            state.names[name] = state.plain(copy)
            for apex, cone in state.cones.items():
                table = {key: of for key, of in cone.table.items() if key != name}
                state.cones[apex] = cone._replace(table=table)


def extend_simplices(state, alpha, chosen, darts):
    """The cones over the components of maps: their simplices with one number more, and the apexes alone."""
    n = len(alpha) - 1
    new = [entry for entry in gmaps.analogue(alpha) if n in entry[0]]
    called = {(numbers, least): simplex_name(state, numbers, darts[least]) for numbers, least, _, _ in new}
    for name in called.values():
        state.check_free(name)
    glued = {name: {} for name in chosen}
    seen = {}
    for numbers, least, orbit, below in new:
        values = {simplex_seen(state, numbers[:-1], darts[d]) for d in orbit if below}
        if len(values) > 1:
            raise ScriptError("other steps have split what is extended")
        seen[numbers, least] = [*values]
    bodies = [state.cells[value[0]].body for values in seen.values() for value in values]
    for body in bodies:
        state.merge_bodies(bodies[0], body)
    for numbers, least, orbit, below in new:
        faces = [state.plain(state.find(called[face])) for face in below[:-1]] + seen[numbers, least]
        state.add(called[numbers, least], (len(numbers) - 1,) if below else (), faces, state.body_root(bodies[0]))
        missing = set(range(n)) - set(numbers)
        for d in orbit:
            if len(missing) == 1:
                glued[darts[d][0]][min(missing), darts[d][1]] = called[numbers, least]
            elif not missing:
                glued[darts[d][0]][n, darts[d][1]] = simplex_name(state, range(n), darts[d])
    for d in darts:
        state.alpha[d] = (*state.alpha[d], d)
    for name in chosen:  # a new map of the same name
        state.maps[name] = state.maps.pop(name)._replace(dimension=n, glued=glued[name])


def label_key(label):
    """Integers numerically, before other labels bytewise."""
    is_number = label.isascii() and label.isdigit() and (label == "0" or label[0] != "0")
    return (0, int(label), b"") if is_number else (1, 0, label.encode("utf-8"))


def places(one, other):
    return tuple(map(list(other).index, one))


def sign_between(one, other):
    at = places(one, other)
    return (-1) ** sum(a > b for k, a in enumerate(at) for b in at[k + 1:])


def read_label(value):
    if type(value) is int and 0 <= value < 2**64:
        return str(value)
    check_name(value, "a label")
    if any(ch in "{}," for ch in value):
        raise ScriptError(f'the label "{value}" has one of the characters {{}},')
    return value


def usable_body(state, label):
    """The body of a vertex that insert or collapse may change."""
    if state.labels[label] != label:
        raise ScriptError(f'"{label}" was collapsed into "{state.labels[label]}"')
    if frozenset([label]) in state.names:
        vertex = state.names[frozenset([label])]
        body = None if vertex is None else state.body_root(state.cells[vertex[0]].body)
    else:
        body = state.body_root(state.gone[label])
    if body not in state.abstract:
        raise ScriptError(f'the body of "{label}" is no abstract complex any more')
    return body


def refresh_faces(state, body):
    """Writes the faces of the simplices out, as for other cells."""
    for key, number in state.simplices_of(body).items():
        faces = tuple(state.faces_by_order(state.orders[key]))
        state.cells[number] = state.cells[number]._replace(faces=faces)


def read_simplex(value):
    """The labels of a simplex, sorted."""
    if not isinstance(value, list) or not value:
        raise ScriptError("a simplex must be a list of labels, not empty")
    labels = sorted(map(read_label, value), key=label_key)
    if len(set(labels)) < len(labels):
        raise ScriptError("the labels of a simplex must differ")
    if len(labels) > LARGEST_DIMENSION + 1:
        raise ScriptError(f"a simplex has at most {LARGEST_DIMENSION + 1} vertices")
    return labels


def op_insert(state, step, _prime):
    is_list = "simplices" in step
    fields(step, ("simplices" if is_list else "simplex",), ("exist_ok",))
    simplices = [read_simplex(value) for value in (step["simplices"] if is_list else [step["simplex"]])]
    for label in {label for labels in simplices for label in labels} & state.labels.keys():
        usable_body(state, label)
    new = {tuple(labels) for labels in simplices if frozenset(labels) not in state.orders}
    if len(new) < len(simplices) and not step.get("exist_ok", is_list):
        raise ScriptError("a simplex is there already")
    faces = {face for labels in new for size in range(1, len(labels) + 1)
             for face in itertools.combinations(labels, size)}
    missing = sorted((face for face in faces if frozenset(face) not in state.orders),
                     key=lambda face: (len(face), *map(label_key, face)))
    if not missing:
        return
    labels = sorted({label for face in missing for label in face}, key=label_key)
    bodies = sorted({usable_body(state, label) for label in labels if label in state.labels})
    first = "{" + labels[0] + "}"
    if bodies:
        body = bodies[0]
        for other in bodies[1:]:
            state.merge_bodies(body, other)
    else:
        body = state.new_body(first)
        state.abstract.add(body)
    for face in missing:
        name = "{" + ",".join(face) + "}"
        own = first
        if name in state.names and state.names[name] is None:  # it was removed, and comes again
            del state.names[name]
            own = name
        number = state.add(name, (len(face) - 1,) if len(face) > 1 else (), (), body, own)
        state.orders[frozenset(face)] = face
        state.names[frozenset(face)] = state.plain(number)
        for k in range(len(face) if len(face) > 1 else 0):
            rest = face[:k] + face[k + 1:]
            if state.orders[frozenset(rest)] != rest:
                state.disordered.add(body)
    state.labels.update((label, label) for label in labels)
    refresh_faces(state, body)


def op_collapse(state, step, _prime):
    fields(step, ("from", "to"))
    u, v = read_label(step["from"]), read_label(step["to"])
    for label in (u, v):
        if label not in state.labels:
            raise ScriptError(f'there is no vertex "{label}"')
    bodies = [usable_body(state, label) for label in (u, v)]
    if u == v:
        raise ScriptError("a vertex cannot be collapsed into itself")
    for label in (u, v):
        if frozenset([label]) not in state.names:
            raise ScriptError(f'the vertex "{label}" was removed')
    state.merge_bodies(*bodies)
    body = state.body_root(bodies[0])
    became = {}  # number of a cell that goes -> value
    for key in sorted((key for key in state.orders if u in key), key=len):
        order, number = state.orders.pop(key), state.names.pop(key)[0]
        image = key - {u} | {v}
        if v in key:
            onto = tuple(v if label == u else label for label in order)
            became[number] = state.names[image][0], (places(onto, state.orders[image]),)
            continue
        order = tuple(v if label == u else label for label in order)
        if image in state.orders:
            there, other = state.orders[image], state.names[image][0]
            gone = number, order
            if number > other:
                number, order = other, there
            else:
                gone = other, there
            became[gone[0]] = number, ((places(gone[1], order),) if len(order) > 1 else ())
        state.orders[image] = order
        state.names[image] = state.plain(number)

    def now(value):
        while value[0] in became:
            other, inner = became[value[0]]
            value = other, fill(value[1], inner)
        return value

    state.names = {name: value and now(value) for name, value in state.names.items()}
    for number, value in became.items():
        if not is_monotone(value[1]):
            state.disordered.add(body)
        del state.cells[number]
    state.labels = {label: v if at == u else at for label, at in state.labels.items()}
    refresh_faces(state, body)


def op_remove(state, step, _prime):
    fields(step, ("cells",), ("cofaces",))
    if not isinstance(step["cells"], list):
        raise ScriptError("cells must be a list of cells")
    with_cofaces = step.get("cofaces", False)
    if not isinstance(with_cofaces, bool):
        raise ScriptError("cofaces must be true or false")
    gone = {state.find(name) for name in step["cells"]}
    star = open_star(state, gone)
    if star != gone and not with_cofaces:
        raise ScriptError(f'"{state.cells[min(star - gone)].name}" would stay without a face of it')
    take_away(state, star)


def open_star(state, cells):
    """The cells, and all that has one of them as a face, or something degenerate over it."""
    star = set(cells)
    while above := {c for c in state.alive() if c not in star and any(face[0] in star for face in state.faces(c))}:
        star |= above
    return star


def take_away(state, gone):
    for key, value in list(state.names.items()):
        if value is None or value[0] not in gone:
            continue
        if isinstance(key, frozenset):
            if len(key) == 1:
                state.gone[min(key)] = state.cells[value[0]].body
            del state.names[key]
            del state.orders[key]
        else:
            state.names[key] = None
    for number in gone:
        del state.cells[number]


def proper_subsets(items, itself=False):
    """Sorted lists, the smaller ones first, then by bits."""
    items = sorted(items)
    masks = sorted(range(2 ** len(items) - (0 if itself else 1)), key=lambda mask: (mask.bit_count(), mask))
    return [[x for k, x in enumerate(items) if mask >> k & 1] for mask in masks]


def replaced_abstractly(state, move, star, by, has_at, fills):
    """The new simplices of an abstract complex, as lists of labels, of which all faces are meant as well."""
    keys = {value[0]: key for key, value in state.names.items() if isinstance(key, frozenset) and value}
    own, links = keys[star[0]], [keys[c] - keys[star[0]] for c in star]
    if move == "flip" and len(star) > 1:
        other = frozenset().union(*links)
        if len(other) < 2 or {*links} != {frozenset(part) for part in proper_subsets(other)}:
            raise ScriptError("the link is no boundary of a simplex")
        if by is not None or has_at:
            raise ScriptError("there is no new vertex")
        if other in state.orders:
            raise ScriptError("the new simplex is there already")
        return [own | other] if fills else [own - {label} | other for label in own]
    if by is None:
        raise ScriptError("the new vertex needs a label")
    if by in state.labels and frozenset([state.labels[by]]) in state.orders:
        raise ScriptError(f'there is a vertex "{by}" already')
    return [keys[c] | {by} for c in star] if fills else [keys[c] - {label} | {by} for c in star for label in own]


class Star:
    """The cells around one, with their faces by their vertices, which are numbered as their names have them."""

    def __init__(self, state, star):
        self.state, self.cells, self.faces, self.own = state, star, {}, {}
        for c in star:
            named = state.value(state.cells[c].name)
            vertices = range(state.dim(c) + 1)
            found = {part: restrict(named, [part], state.faces) if len(vertices) > 1 else named
                     for size in vertices for part in itertools.combinations(vertices, size + 1)}
            places = [part for part, value in found.items() if value[0] == star[0]]
            if len(places) != 1:
                raise ScriptError(f'"{state.cells[c].name}" has the cell more than once')
            self.faces[c], self.own[c] = found, places[0]

    def others(self, c):
        return [k for k in range(self.state.dim(c) + 1) if k not in self.own[c]]

    def named_places(self, value):
        """Which vertices of a cell, by its name, those of a value are."""
        if not value[1]:
            return [0]
        named = self.state.value(self.state.cells[value[0]].name)[1][0]
        return [named.index(k) for k in value[1][0]]

    def with_order(self, number, order):
        order = list(order)
        return number, ((tuple(sorted(order).index(k) for k in order),) if len(order) > 1 else ())

    def add(self, name, faces, body):
        number = self.state.add(name, (len(faces) - 1,) if faces else (), faces, body)
        if any(not is_monotone(face[1]) for face in faces):
            self.state.disordered.add(self.state.body_root(body))
        return number

    def flip(self, name, fills):
        state, body = self.state, self.state.cells[self.cells[0]].body
        around = [c for c in self.cells if len(self.others(c)) == 1]
        links = {}
        for c in self.cells:
            beside = [around.index(self.faces[c][tuple(sorted({*self.own[c], k}))][0]) for k in self.others(c)]
            links.setdefault(frozenset(beside) if len({*beside}) == len(beside) else None, []).append((c, beside))
        expected = {frozenset(part) for part in proper_subsets(range(len(around)))} if around else {frozenset()}
        if len(around) == 1 or {*links} != expected or any(len(found) > 1 for found in links.values()):
            raise ScriptError("the link is no boundary of a simplex")
        size, count = state.dim(self.cells[0]) + 1, max(len(around), 1)
        new = {}
        for kept in proper_subsets(range(size), fills):
            numbers = [*kept, *range(size, size + count)]
            faces = [state.plain(new[tuple(k for k in kept if k != left_out)]) for left_out in kept]
            for j in range(count if len(numbers) > 1 else 0):
                c, beside = links[frozenset(range(count)) - {j}][0]
                own_places = self.named_places(self.faces[c][self.own[c]])
                place = {k: own_places[n] for n, k in enumerate(self.own[c])}
                place.update({k: size + beside[n] for n, k in enumerate(self.others(c))})
                part = [k for k in sorted(place) if place[k] >= size or place[k] in kept]
                value = self.faces[c][tuple(part)]
                order = sorted(range(len(part)), key=lambda n: place[part[n]])
                faces.append((value[0], reordered_by(value[1], order)))
            called = name + "." + "-".join(map(str, numbers)) if kept else name
            new[tuple(kept)] = self.add(called, faces, body)

    def subdivide(self, vertex, fills):
        state, body = self.state, self.state.cells[self.cells[0]].body
        keys = [(c, tuple(sorted([*part, *self.others(c)])))
                for c in self.cells for part in proper_subsets(self.own[c], fills)]
        keys.sort(key=lambda key: len(key[1]))
        new = {}
        for c, kept in keys:
            faces = []
            for left_out in kept:
                rest = tuple(k for k in kept if k != left_out)
                if left_out in self.own[c]:
                    faces.append(state.plain(new[c, rest]))
                    continue
                all_but = tuple(k for k in range(state.dim(c) + 1) if k != left_out)
                value = self.faces[c][all_but]
                image = dict(zip(all_but, self.named_places(value)))
                onto = [image[k] for k in rest]
                faces.append(self.with_order(new[value[0], tuple(sorted(onto))], [*onto, len(image)]))
            if kept:
                faces.append(self.faces[c][kept])
            called = f"{vertex}*{state.cells[c].name}." + "-".join(map(str, kept)) if kept else vertex
            new[c, kept] = self.add(called, faces, body)


def reordered_by(shape, order):
    """A shape with vertex k where vertex order[k] was."""
    return (tuple(shape[0][k] for k in order),) if shape else ()


def check_link(state, u, v):
    for key in state.orders:
        is_of_both = u in key and v not in key and len(key) > 1 and key - {u} | {v} in state.orders
        if is_of_both and key | {v} not in state.orders:
            raise ScriptError("the link condition does not hold")


def op_replace(state, step, prime):
    moves = [move for move in ("flip", "subdivide", "contract") if move in step]
    if len(moves) != 1:
        raise ScriptError("one of flip, subdivide and contract")
    move = moves[0]
    if move == "contract":
        fields(step, ("contract",), ("link_condition",))
        if not isinstance(step["contract"], list) or len(step["contract"]) != 2:
            raise ScriptError("contract must be a list of two labels")
        u, v = map(read_label, step["contract"])
        checks = step.get("link_condition", True)
        if not isinstance(checks, bool):
            raise ScriptError("link_condition must be true or false")
        before = state.copy()
        op_collapse(state, {"op": "collapse", "from": u, "to": v}, prime)
        if frozenset([u, v]) not in before.orders:
            raise ScriptError("there is no such edge")
        if checks:
            check_link(before, u, v)
        return
    fields(step, (move, "by") if move == "subdivide" else (move,),
           ("at", "fills") if move == "subdivide" else ("by", "at", "fills"))
    fills = step.get("fills", False)
    if not isinstance(fills, bool):
        raise ScriptError("fills must be true or false")
    by = read_by(step["by"]) if "by" in step else None
    if "at" in step:
        check_point(step["at"], "at")
    star = sorted(open_star(state, {state.find(step[move])}), key=lambda c: (state.dim(c), c))
    if move == "subdivide" and state.dim(star[0]) == 0:
        raise ScriptError("a vertex is not subdivided")
    body = state.body_root(state.cells[star[0]].body)
    if body in state.abstract:
        simplices = replaced_abstractly(state, move, star, by, "at" in step, fills)
        op_insert(state, {"op": "insert", "simplices": [sorted(simplex) for simplex in simplices]}, prime)
    else:
        if any(not is_simplex(state.cells[c].kind) for c in star):
            raise ScriptError("only simplices are replaced")
        if by is None:
            raise ScriptError("what is new needs a name")
        if move == "flip" and "at" in step and len(star) > 1:
            raise ScriptError("there is no new vertex")
        check_name(by, "by")
        state.check_free(by)
        state.check_prefix(by)
        around = Star(state, star)
        (around.flip if move == "flip" else around.subdivide)(by, fills)
    if not fills:
        take_away(state, star)


def read_by(value):
    """A name or a label, not empty."""
    if is_integer(value) and value >= 0:
        return str(value)
    if not isinstance(value, str) or not value:
        raise ScriptError("by must be a name or a label")
    return value


def leave_abstract(before, after):
    """The abstract bodies that another operation has changed are abstract no more."""
    for body in list(after.abstract):
        was = {c: cell for c, cell in before.cells.items() if after.body_root(cell.body) == body}
        if body in after.consumed or was != {c: after.cells[c] for c in after.cells_of_body(body)}:
            after.abstract.discard(body)


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
    "chain_of_maps": op_chain_of_maps,
    "incidence": op_incidence,
    "gmap": op_gmap,
    "map": op_map,
    "polygon": op_polygon,
    "cone": op_cone,
    "suspend": op_suspend,
    "identify": op_identify,
    "sew": op_sew,
    "unsew": op_unsew,
    "extend": op_extend,
    "remove_cell": op_remove_cell,
    "contract_cell": op_contract_cell,
    "insert_cell": op_insert_cell,
    "split_cell": op_split_cell,
    "degenerate": op_degenerate,
    "deidentify": op_deidentify,
    "product": op_product,
    "insert": op_insert,
    "collapse": op_collapse,
    "remove": op_remove,
    "replace": op_replace,
    "expect": op_expect,
    "class": op_class,
    "note": op_note,
}


def carried_out(state, step, prime):
    """The state after a step, and the answer to it."""
    after = state.copy()
    answer = OPERATIONS[step["op"]](after, step, prime)
    after.names_meet()
    if step["op"] not in ("insert", "collapse", "remove", "replace"):
        leave_abstract(state, after)
    return after, answer


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
            after, answer = carried_out(self.state, step, self.prime)
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
