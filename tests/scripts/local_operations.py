"""What local operations on cells do to darts, for the oracle.

A map is a dictionary here: images[d] is the tuple of the images of dart d under alpha_0, ..., alpha_n. Each operation is
worked out in the map or, where `towards` is -1, in the dual map, where alpha_{n-k} is alpha_k: the contraction of an
i-cell is the removal of the (n-i)-cell of the dual map, and a split the insertion of one.
Each returns why it cannot be, as a string, or (the darts that go, {dart: its new images} of all that have others, the new
darts among them).

G. Damiand, P. Lienhardt, Removal and contraction for n-dimensional generalized maps, 2003; M. Baba-ali, G. Damiand,
X. Skapin, D. Marcheix, Insertion and expansion operations for n-dimensional generalized maps, 2008.
"""


def reached(images, indices, start):
    """What some involutions reach from a dart, in the order of a breadth-first search that tries them as listed."""
    found = {start: None}
    for d in (pending := [start]):
        for k in indices:
            e = images[d][k]
            if e not in found:
                found[e] = None
                pending.append(e)
    return list(found)


def without_cell(images, i, start, towards):
    """The i-cell of a dart is taken out; `towards` is 1 for a removal and -1 for a contraction."""
    n = len(images[start]) - 1
    if not 0 <= i + towards <= n or not 0 <= i <= n:
        return f"cells of dimension {i} stay"
    cell = set(reached(images, [k for k in range(n + 1) if k != i], start))
    near, far = i + towards, i + 2 * towards
    if 0 <= far <= n and any(images[images[d][near]][far] != images[images[d][far]][near] for d in cell):
        return f"alpha_{near} and alpha_{far} do not commute on it"
    outside = {images[d][i]: d for d in cell if images[d][i] not in cell}
    if not outside:
        return "nothing would be left"
    after = {}
    for d, at in outside.items():
        while at in cell:
            at = images[images[at][near]][i]
        after[d] = (*images[d][:i], at, *images[d][i + 1:])
    return cell, after


class Insertion:
    """Puts a cell into a map, or into the dual one, for which all indices here are those of that.

    The cell has dimension i there, and is made of walls: behind a dart d, and behind all that alpha_{i+2}, ..., alpha_n reach
    from it, two new darts come between the dart and its image under alpha_i, which alpha_{i+1} leads to one another.
    """

    class Impossible(Exception):
        """The sentence says why."""

    def __init__(self, images, i, towards, name):
        self.images, self.name, self.made = images, name, 0
        self.n = len(next(iter(images.values()))) - 1
        self.places = list(range(self.n + 1))[::towards]  # of alpha_k among the images
        self.i = self.places[i] if 0 <= i <= self.n else self.n
        self.after = {}
        self.walled = set()

    def before(self, k, d):
        return self.images[d][self.places[k]]

    def now(self, k, d):
        return (self.after[d] if d in self.after else self.images[d])[self.places[k]]

    def join(self, k, ones, others):
        if len(ones) != len(others):
            raise self.Impossible("what belongs to the darts is not alike")
        for one, other in zip(ones, others):
            for d, e in ((one, other), (other, one)):
                self.after.setdefault(d, list(self.images.get(d, ())))[self.places[k]] = e

    def new_darts(self, pairs):
        """(this side, the other side): lists, whose darts are numbered in turns."""
        new = [(self.name, self.made + k) for k in range(2 * pairs)]
        self.made += len(new)
        self.after.update((d, [d] * (self.n + 1)) for d in new)
        return new[::2], new[1::2]

    def wall(self, d):
        i = self.i
        base = reached(self.images, [self.places[k] for k in range(i + 2, self.n + 1)], d)
        behind = [self.now(i, e) for e in base]
        if any(e in base for e in behind) or self.walled & set(base):
            raise self.Impossible("a dart is free, or would be met twice")
        self.walled.update(base)
        side, other_side = self.new_darts(len(base))
        self.join(i, base, side)
        self.join(i + 1, side, other_side)
        self.join(i, other_side, behind)
        for k in range(i + 2, self.n + 1):
            across = [base.index(self.before(k, e)) for e in base]
            for own in (side, other_side):
                self.join(k, own, [own[w] for w in across])
        return side, other_side

    def edge_across(self, one, other):
        """From the corner of one dart to that of another one of the 2-cell: around it the darts begin and end edges in turns."""
        around, at, k = [], one, 0
        while not around or at != one:
            around.append(at)
            if self.before(k, at) == at:
                raise self.Impossible("the cell is open")
            at, k = self.before(k, at), 1 - k
        if other not in around:
            raise self.Impossible("the darts are not of one cell")
        end = other if around.index(other) % 2 else self.before(1, other)
        for near, far in zip(self.wall(one), self.wall(end)):
            self.join(0, near, far)

    def loose_edge(self, d):
        sides = self.wall(d)
        ends = self.new_darts(len(sides[0]))
        for side, end in zip(sides, ends):
            self.join(0, side, end)
            for k in range(3, self.n + 1):
                self.join(k, end, [end[side.index(self.now(k, e))] for e in side])
        self.join(1, *ends)
        self.join(2, *ends)

    def face_across(self, path):
        for d, following in zip(path, [*path[1:], path[0]]):
            if following not in reached(self.images, [self.places[1], self.places[2]], self.before(0, d)):
                raise self.Impossible("the path is not closed")
        walls = [(self.wall(d), self.wall(self.before(0, d))) for d in path]
        for (begin, end), (following, _) in zip(walls, [*walls[1:], walls[0]]):
            for side in range(2):
                self.join(0, begin[side], end[side])
                self.join(1, end[side], following[side])

    def check_laws(self):
        """As in gmaps.broken_law, where something is new."""
        for d in self.after:
            for k in range(self.n + 1):
                image = self.now(k, d)
                if self.now(k, image) != d or any(self.now(j, image) != self.now(k, self.now(j, d))
                                                  for j in range(self.n + 1) if abs(j - k) >= 2):
                    raise self.Impossible("it would be no map")

    def run(self, darts):
        if not 0 <= self.i <= min(2, self.n - 1) or not 1 <= len(darts) <= (1, 2, len(darts))[self.i]:
            raise self.Impossible("there is no such cell, or it takes other darts")
        if self.i == 0:
            self.wall(*darts)
        elif self.i == 1:
            (self.edge_across if len(darts) == 2 else self.loose_edge)(*darts)
        else:
            self.face_across(darts)
        self.check_laws()


def with_cell(images, i, darts, towards, name):
    """A new i-cell; `towards` is 1 for an insertion and -1 for a split. The new darts are (name, 0), (name, 1), ..."""
    insertion = Insertion(images, i, towards, name)
    try:
        insertion.run(darts)
    except Insertion.Impossible as problem:
        return str(problem)
    return set(), {d: tuple(own) for d, own in insertion.after.items()}
