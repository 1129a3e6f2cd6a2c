"""Cells that are known by their boundaries, and cells of maps that are no balls, for the oracle.

A Bounded cell has a list of faces with coefficients. A Hollow one is the cone over a map that is no sphere, or a cone over
such a cone: its faces are all cells of the map, of every dimension, and in place of one generator it has one for each of
them and one for the tip, so that its chains are those of the cone, and no smaller model of them is asked for.
Both are seen in one way only; the shape of a value of theirs is a Whole.
"""

import collections
import functools

import gmaps

# faces: (coefficient, kind) for each.
Bounded = collections.namedtuple("Bounded", "dimension faces")
# faces: kinds. generators: (degree, terms) for each; a term is (coefficient, slot, k): with k None it is the face with
# that number, else the generator k of that; with slot None the generator k of the cell itself. incidences: (slot, which
# dart of that it is, slot of one dimension less, which dart of that it is) for each face of each face.
Hollow = collections.namedtuple("Hollow", "dimension faces generators incidences")
# The shape of a value.
Whole = collections.namedtuple("Whole", "kind")
# A cell of a canonical boundary, as its least dart sees it. indices: {dart: which dart of the kind it is}.
Slot = collections.namedtuple("Slot", "dimension root kind indices")


def dimension_of(kind):
    return kind.dimension if isinstance(kind, (Bounded, Hollow)) else gmaps.dimension_of(kind)


def is_simploid(kind):
    return not isinstance(kind, (gmaps.MapKind, Bounded, Hollow))


def sign_of_dart(kind, index):
    """In its cell. Of an edge dart 0 is at the end."""
    if isinstance(kind, gmaps.MapKind):
        return gmaps.signs(kind)[index]
    return -1 if index else 1


def slot_of(cell, q):
    root = min(cell.darts)
    first = cell.darts[root]
    if isinstance(cell.kind, gmaps.MapKind):
        order = gmaps.order_from(cell.kind, first)
        return Slot(q, root, gmaps.kind_from(cell.kind, first), {d: order.index(k) for d, k in cell.darts.items()})
    return Slot(q, root, cell.kind, {d: int(k != first) for d, k in cell.darts.items()})


@functools.lru_cache(None)
def slots_of(boundary, is_ball):
    """The cells of a map as Slots, by dimension."""
    return [slot_of(cell, q) for q, cells in enumerate(gmaps.cells_of(boundary, is_ball)) for cell in cells]


@functools.lru_cache(None)
def hollow(boundary, is_ball):
    """The kind of the cone over a map, all cells of which are balls."""
    slots = slots_of(boundary, is_ball)
    generators, incidences = [(0, ())], []
    for number, slot in enumerate(slots):
        terms = [(1, number, None)]
        if slot.dimension == 0:
            terms.append((-1, None, 0))
        else:
            below = collections.Counter()
            is_of_map = isinstance(slot.kind, gmaps.MapKind)
            for index in [root for root, _ in gmaps.faces_of_kind(slot.kind)[0]] if is_of_map else (0, 1):
                dart = next(d for d, k in slot.indices.items() if k == index)
                face, place = next((n, other.indices[dart]) for n, other in enumerate(slots)
                                   if other.dimension == slot.dimension - 1 and dart in other.indices)
                incidences.append((number, index, face, place))
                below[face] += sign_of_dart(slot.kind, index) * sign_of_dart(slots[face].kind, place)
            terms += [(-n, None, face + 1) for face, n in below.items() if n]
        generators.append((slot.dimension + 1, tuple(terms)))
    return Hollow(len(boundary), tuple(slot.kind for slot in slots), tuple(generators), tuple(incidences))


def coned_generators(kind, signs, apex, base):
    """Those of the cone over a Hollow cell, whose faces have the same numbers, each with a sign; then there are `apex` and
    `base`, which is the cell itself."""
    for k, (degree, terms) in enumerate(kind.generators):
        coned = [(n * signs[slot] if slot is not None and other is None else n, slot, other) for n, slot, other in terms]
        coned.append(((-1) ** (degree + 1), base, k))
        yield degree + 1, (*coned, *([(1, apex, None)] if degree == 0 else []))
