"""Generalized maps, for the oracle: lists of images of darts, their cells, and how a map looks from one of its darts.

A map of dimension n is a sequence of n + 1 lists, alpha[i][d] the image of dart d under alpha_i. The kind of a cell that
is no simplex is the map that it is a cone over, its canonical boundary, numbered from one of its darts: the root, which
has number 0, then the others as a depth-first search meets them that tries alpha_0 first. So two cells are glued as two
of their darts see them exactly if their boundaries look alike from there. Vertices and edges, which are cones over a
point and over two, are simplices: the kinds () and (1,).
"""

import collections
import functools

# alpha_0, ..., alpha_{p-1} of the canonical boundary of a p-cell, p >= 2, as tuples.
MapKind = collections.namedtuple("MapKind", "alpha")
# A cell of a map as one of its darts sees it, where the kind has dart 0: the shape of a value of it.
Seen = collections.namedtuple("Seen", "kind dart")

LARGEST_MAP_DIMENSION = 30


def broken_law(alpha):
    """Why lists of images are no G-map, or None."""
    if not alpha or len(alpha) > LARGEST_MAP_DIMENSION + 1:
        return f"it has {len(alpha)} involutions"
    for i, images in enumerate(alpha):
        if len(images) != len(alpha[0]):
            return f"alpha_{i} has not as many images as alpha_0"
        if any(not 0 <= image < len(images) for image in images):
            return f"alpha_{i} leads to no dart"
        if any(images[image] != d for d, image in enumerate(images)):
            return f"alpha_{i} is no involution"
        for j in range(i - 1):
            if any(images[alpha[j][d]] != alpha[j][images[d]] for d in range(len(images))):
                return f"alpha_{j} alpha_{i} is no involution"
    return None


def polygon(sides):
    """Side s has the darts 2s and 2s + 1; it follows side s - 1. All are 2-free."""
    darts = range(2 * sides)
    return [[d ^ 1 for d in darts], [(d + (1 if d % 2 else -1)) % (2 * sides) for d in darts], list(darts)]


def broken_law_of_nmap(beta):
    """Why lists of images, None where a dart is free, are no n-map, or None."""
    if not 0 < len(beta) <= LARGEST_MAP_DIMENSION:
        return f"it has {len(beta)} lists of images"
    size = len(beta[0])
    for i, images in enumerate(beta, 1):
        there = [image for image in images if image is not None]
        if len(images) != size or any(not 0 <= image < size for image in there):
            return f"beta_{i} has not one image for every dart"
        if len(set(there)) < len(there):
            return f"beta_{i} leads from two darts to one"
        if i > 1 and any(image == d or images[image] != d for d, image in enumerate(images) if image is not None):
            return f"beta_{i} is no involution, or fixes a dart"
    back = [None] * size
    for d, image in enumerate(beta[0]):
        if image is not None:
            back[image] = d
    all_of_them = [back, *beta]
    for j in range(3, len(all_of_them)):
        for i in range(j - 1):
            both = [None if d is None else all_of_them[i][d] for d in all_of_them[j]]
            if any(image is not None and both[image] != d for d, image in enumerate(both)):
                return f"beta_{i} after beta_{j} is no involution"
    return None


def gmap_of(beta):
    """The G-map of an n-map of size N: dart k begins the edge of the dart k of that, dart k + N ends it."""
    size = len(beta[0])
    alpha = [[*range(size, 2 * size), *range(size)]]
    for i, images in enumerate(beta, 1):
        own = list(range(2 * size))
        for d, image in enumerate(images):
            if image is not None:
                own[size + d], own[image] = image, size + d
        alpha.append(own)
    return alpha


# ------------------------------------------------------------------------------------------------ orbits


def orbit(alpha, indices, start):
    """What some of the involutions reach from a dart, as a set."""
    found, pending = {start}, [start]
    while pending:
        d = pending.pop()
        for i in indices:
            if alpha[i][d] not in found:
                found.add(alpha[i][d])
                pending.append(alpha[i][d])
    return found


def orbits(alpha, indices):
    """All orbits of some of the involutions, each sorted, in the order of their least darts."""
    found, met = [], set()
    for d in range(len(alpha[0])):
        if d not in met:
            found.append(sorted(orbit(alpha, indices, d)))
            met.update(found[-1])
    return found


def all_but(alpha, *left_out):
    return [i for i in range(len(alpha)) if i not in left_out]


def walk(alpha, root, indices=None):
    """The darts that are reached from one, in the order of a depth-first search."""
    indices = list(range(len(alpha))) if indices is None else indices
    found, order, path = {root}, [root], [(root, iter(indices))]
    while path:
        d, untried = path[-1]
        i = next(untried, None)
        if i is None:
            path.pop()
        elif alpha[i][d] not in found:
            found.add(alpha[i][d])
            order.append(alpha[i][d])
            path.append((alpha[i][d], iter(indices)))
    return order


def renumbered(alpha, order):
    """The map on some darts, numbered as they are listed."""
    place = {d: k for k, d in enumerate(order)}
    return tuple(tuple(place[images[d]] for d in order) for images in alpha)


def canonical_root(alpha):
    """The dart from which a connected map looks least; of several the one with the least number.

    How it looks are the images of dart 0 under alpha_0, alpha_1, ..., then those of dart 1, and so on, when darts are
    numbered in the order in which these images meet them.
    """
    if len(alpha) == 2:
        return 0  # a circle looks alike from everywhere

    def look(root):
        order, place = [root], {root: 0}
        for d in order:
            for images in alpha:
                if images[d] not in place:
                    place[images[d]] = len(order)
                    order.append(images[d])
        return [place[images[d]] for d in order for images in alpha]

    return min(range(len(alpha[0])), key=lambda d: (look(d), d))


# ------------------------------------------------------------------------------------------------ kinds of cells


def dimension_of(kind):
    return len(kind.alpha) if isinstance(kind, MapKind) else sum(kind)


@functools.lru_cache(None)
def order_from(kind, dart):
    return tuple(walk(kind.alpha, dart))


@functools.lru_cache(None)
def kind_from(kind, dart):
    """The kind as another dart sees it."""
    return MapKind(renumbered(kind.alpha, order_from(kind, dart)))


@functools.lru_cache(None)
def signs(kind):
    """Of the darts: each involution changes them, and dart 0 has +1."""
    found = {0: 1}
    for d in order_from(kind, 0):
        for images in kind.alpha:
            found.setdefault(images[d], -found[d])
            assert found[images[d]] == -found[d], "a ball has an orientation"
    return [found[d] for d in range(len(found))]


@functools.lru_cache(None)
def faces_of_kind(kind):
    """(the least dart of each face, its kind as seen from there), and for each dart (face, which dart of that it is)."""
    within = range(len(kind.alpha) - 1)
    faces, place = [], {}
    for number, darts in enumerate(orbits(kind.alpha, within)):
        order = walk(kind.alpha, darts[0], list(within))
        faces.append((darts[0], kind_over(renumbered(kind.alpha[:-1], order))))
        place.update((d, (number, k)) for k, d in enumerate(order))
    return faces, [place[d] for d in range(len(place))]


def kind_over(boundary):
    """The kind of the cone over a map whose dart 0 is the root. A point has no involutions."""
    if not boundary:
        return ()
    return (1,) if len(boundary) == 1 else MapKind(tuple(map(tuple, boundary)))


def shape_from(kind, dart):
    """The shape of a value that is a cell as one of its darts sees it. An edge has two: it, and it backwards."""
    if isinstance(kind, MapKind):
        return Seen(kind, dart)
    return () if kind == () else (((1, 0),) if dart else ((0, 1),))


# ------------------------------------------------------------------------------------------------ cells of a map

# root: the dart by which the cell is called. darts: {dart: which dart of the kind it is}.
CellOfMap = collections.namedtuple("CellOfMap", "root kind darts")


def cell_of(alpha, i, start, is_ball):
    """The i-cell of a dart, or None if it is no ball."""
    darts = sorted(orbit(alpha, all_but(alpha, i), start))
    above = range(i + 1, len(alpha))
    stands_for = {}  # the least dart that is the same one of the boundary
    for d in darts:
        if d not in stands_for:
            stands_for.update(dict.fromkeys(orbit(alpha, above, d), d))
    own = sorted(set(stands_for.values()))
    number = {d: k for k, d in enumerate(own)}
    boundary = [[number[stands_for[alpha[j][d]]] for d in own] for j in range(i)]
    if i == 0:
        order = [0]
    else:
        order = walk(boundary, 0)
        boundary = renumbered(boundary, order)
        if not is_ball(boundary):
            return None
        if i > 1:
            root = canonical_root(boundary)
            turned = walk(boundary, root)
            order, boundary = [order[k] for k in turned], renumbered(boundary, turned)
    place = {own[d]: k for k, d in enumerate(order)}
    seen = {d: place[stands_for[d]] for d in darts}
    return CellOfMap(min(d for d, k in seen.items() if k == 0), kind_over(boundary), seen)


def cells_of(alpha, is_ball):
    """The cells of each dimension in the order of their least darts; None where one is no ball."""
    return [[cell_of(alpha, i, darts[0], is_ball) for darts in orbits(alpha, all_but(alpha, i))]
            for i in range(len(alpha))]


def analogue(alpha):
    """The simplices of the simplicial analogue: (numbers, least dart, all darts, the least darts of the faces).

    There is one for each set of numbers and each orbit of the involutions whose numbers are not in it; face k is that
    without the k-th number. By size of the set, then by the number that has the members as its bits.
    """
    found = {}
    sets = sorted(range(1, 2 ** len(alpha)), key=lambda bits: (bits.bit_count(), bits))
    for bits in sets:
        numbers = tuple(i for i in range(len(alpha)) if bits >> i & 1)
        others = all_but(alpha, *numbers)
        first = {d: darts[0] for darts in orbits(alpha, others) for d in darts}
        found[numbers] = first
        for darts in orbits(alpha, others):
            below = [numbers[:k] + numbers[k + 1:] for k in range(len(numbers))] if len(numbers) > 1 else []
            yield numbers, darts[0], darts, [(face, found[face][darts[0]]) for face in below]
