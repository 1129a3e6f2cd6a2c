"""Products of cells of maps, for the oracle.

A dart of a cell stands for a chain of cells in it, one of each dimension. Such a chain of pairs of cells is a chain in the
one cell, a chain in the other, and a word that says from pair to pair whether the left cell (1) or the right one (0) becomes
the next one.
"""

import functools
import itertools

import gmaps


@functools.lru_cache(None)
def words(k, l):
    """All with k steps to the left and l to the right, in their order, where a step to the right comes first."""
    places = itertools.combinations(range(k + l), k)
    return sorted(tuple(int(step in left) for step in range(k + l)) for left in places)


def darts(left, k, right, l):
    """All (dart, dart, word), in their order."""
    return list(itertools.product(range(left), range(right), words(k, l)))


def image(dart, i, left, right):
    """Where alpha_i leads. left and right are lists of images; one index beyond those of a factor fixes all."""
    d, e, word = dart
    n = len(word)
    if n == 0:
        return dart
    if 0 < i < n and word[i - 1] != word[i]:
        return d, e, word[:i - 1] + (word[i], word[i - 1]) + word[i + 1:]
    a = sum(word[:i])
    if word[min(i, n - 1)]:
        return left[a][d], e, word
    return d, right[i - a][e], word


def product(left, right):
    """The product of two G-maps as lists of images."""
    k, l = len(left) - 1, len(right) - 1
    all_of_them = darts(len(left[0]), k, len(right[0]), l)
    number = {dart: n for n, dart in enumerate(all_of_them)}
    return all_of_them, [[number[image(dart, i, left, right)] for dart in all_of_them] for i in range(k + l + 1)]


def images_of_kind(kind):
    """The canonical boundary of a cell."""
    return kind.alpha if isinstance(kind, gmaps.MapKind) else ((1, 0),) * len(kind)


def size_of_kind(kind):
    return len(kind.alpha[0]) if isinstance(kind, gmaps.MapKind) else len(kind) + 1


@functools.lru_cache(None)
def kind_of_pair(left, right):
    """(the kind of the product of two cells, {(dart, dart, word): which dart of that it is})."""
    one, other = images_of_kind(left), images_of_kind(right)
    all_of_them = darts(size_of_kind(left), len(one), size_of_kind(right), len(other))
    number = {dart: n for n, dart in enumerate(all_of_them)}
    n = len(one) + len(other)
    boundary = [[number[image(dart, i, one, other)] for dart in all_of_them] for i in range(n)]
    order = gmaps.walk(boundary, 0)
    assert len(order) == len(all_of_them), "what a product of balls is over is connected"
    if n > 1:
        seen = gmaps.renumbered(boundary, order)
        order = [order[k] for k in gmaps.walk(seen, gmaps.canonical_root(seen))]
    kind = gmaps.kind_over(gmaps.renumbered(boundary, order))
    return kind, {all_of_them[d]: place for place, d in enumerate(order)}


def dart_of(shape):
    """The dart from which a cell is seen."""
    if isinstance(shape, gmaps.Seen):
        return shape.dart
    return shape[0][0] if shape else 0


def kind_of(shape):
    """The kind of the cell itself."""
    return shape.kind if isinstance(shape, gmaps.Seen) else (1,) * len(shape)


def shape_of_pair(left, right, word=None):
    """How a product of two cells is seen from the darts of two shapes and a word; without one from the first word."""
    mine, other = kind_of(left), kind_of(right)
    kind, places = kind_of_pair(mine, other)
    word = words(len(images_of_kind(mine)), len(images_of_kind(other)))[0] if word is None else word
    return gmaps.shape_from(kind, places[dart_of(left), dart_of(right), word])


def faces_of_pair(left, right, face_at, roots):
    """The faces of the product of two cells, as ((left value, right value), word). face_at(side, dart): the face of the left
    (0) or right (1) cell at a dart, as that sees it; roots(kind): the darts from which faces are seen."""
    kind, places = kind_of_pair(left, right)
    at = {place: dart for dart, place in places.items()}
    for root in roots(kind):
        d, e, word = at[root]
        if word[-1]:
            yield face_at(0, d), (None, gmaps.shape_from(right, e)), word[:-1]
        else:
            yield (None, gmaps.shape_from(left, d)), face_at(1, e), word[:-1]
