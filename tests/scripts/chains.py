"""Chains of maps and incidence graphs, for the oracle: levels of darts, and cells with their faces.

A chain of maps is a list of levels: level i has i lists of images of its darts, and one of their images in the level
below, which is empty for level 0; how many darts it has is said beside it. See gmaps for what a cell looks like.
"""

import collections

import gmaps

# alpha: i lists of images on level i. sigma: images in the level below. size: how many darts.
Level = collections.namedtuple("Level", "alpha sigma size")


def broken_law(levels):
    """Why levels are no chain of maps, or None."""
    if not levels[0].size or len(levels) > gmaps.LARGEST_MAP_DIMENSION + 1:
        return "no darts, or too many levels"
    for i, (alpha, sigma, size) in enumerate(levels[1:], 1):
        below = levels[i - 1]
        if len(alpha) != i or len(alpha[0]) != size or gmaps.broken_law(alpha):
            return f"level {i} is no map with {i} involutions"
        if len(sigma) != size or any(not 0 <= image < below.size for image in sigma):
            return f"sigma_{i} leads to no dart"
        if i == 1:
            continue
        for d in range(size):
            if any(sigma[alpha[j][d]] != below.alpha[j][sigma[d]] for j in range(i - 1)):
                return f"sigma_{i} does not go with the involutions"
            if below.sigma[sigma[d]] != below.sigma[sigma[alpha[i - 1][d]]]:
                return f"neighbouring faces have no face in common at dart {d} of level {i}"
        for face in gmaps.orbits(alpha, range(i - 1)):
            if len({sigma[d] for d in face}) < len(face):
                return f"a face on level {i} is folded"
    return None


def cells(levels, i, is_ball):
    """The i-cells in the order of their least darts, with None for those that are no balls."""
    alpha, _, size = levels[i]
    if i == 0:
        return [gmaps.CellOfMap(d, (), {d: 0}) for d in range(size)]
    return [cell_of(alpha, darts, is_ball) for darts in gmaps.orbits(alpha, range(i))]


def cell_of(alpha, darts, is_ball):
    order = gmaps.walk(alpha, darts[0])
    boundary = gmaps.renumbered(alpha, order)
    if not is_ball(boundary):
        return None
    if len(alpha) > 1:
        turned = gmaps.walk(boundary, gmaps.canonical_root(boundary))
        order, boundary = [order[k] for k in turned], gmaps.renumbered(boundary, turned)
    return gmaps.CellOfMap(order[0], gmaps.kind_over(boundary), {d: k for k, d in enumerate(order)})


def lowered(levels, d, start, end):
    for i in range(start, end, -1):
        d = levels[i].sigma[d]
    return d


def analogue(levels):
    """(numbers, least dart, the (numbers, least dart) of the faces), as in gmaps.analogue. Darts are of the level of the
    largest number."""
    first = {}
    sets = sorted(range(1, 2 ** len(levels)), key=lambda bits: (bits.bit_count(), bits))
    for bits in sets:
        numbers = tuple(i for i in range(len(levels)) if bits >> i & 1)
        top = numbers[-1]
        alpha, _, size = levels[top]
        others = [j for j in range(top) if j not in numbers]
        parts = gmaps.orbits(alpha, others) if top else [[d] for d in range(size)]
        first[numbers] = {d: darts[0] for darts in parts for d in darts}
        for darts in parts:
            faces = []
            for k in range(len(numbers) if len(numbers) > 1 else 0):
                rest = numbers[:k] + numbers[k + 1:]
                faces.append((rest, first[rest][lowered(levels, darts[0], top, rest[-1])]))
            yield numbers, darts[0], faces


# ------------------------------------------------------------------------------------------------ incidence graphs


def ranks(faces):
    """The dimensions of cells, by the lists of their faces; None where they are no closed order without jumps."""
    found, visiting = {}, set()

    def rank(x):
        if x in visiting:
            return None
        if x not in found:
            visiting.add(x)
            below = {rank(y) for y in faces[x]}
            visiting.discard(x)
            if None in below or len(below) > 1 or len({*faces[x]}) < len(faces[x]):
                return None
            found[x] = max(below) + 1 if below else 0
        return found[x]

    if any(rank(x) is None for x in range(len(faces))) or max(found.values(), default=0) > gmaps.LARGEST_MAP_DIMENSION:
        return None
    return [found[x] for x in range(len(faces))]


def below(faces, x):
    """x and all cells below."""
    found, pending = {x}, [x]
    while pending:
        for y in faces[pending.pop()]:
            if y not in found:
                found.add(y)
                pending.append(y)
    return found


def tuples(faces, dimension):
    """The cell-tuples by their length less one, each level in lexicographic order."""
    levels = [sorted((x,) for x in range(len(faces)) if not faces[x])]
    cofaces = collections.defaultdict(list)
    for x, own in enumerate(faces):
        for y in own:
            cofaces[y].append(x)
    for _ in range(dimension):
        levels.append(sorted((*flag, x) for flag in levels[-1] for x in cofaces[flag[-1]]))
    return levels


def levels_of(faces, flags):
    """The chain of maps of the cell-tuples, or None where a cell is not the one of two between its neighbours."""
    number = [{flag: k for k, flag in enumerate(level)} for level in flags]
    levels = []
    for i, level in enumerate(flags):
        alpha = []
        for j in range(i):
            images = []
            for flag in level:
                beside = [x for x in faces[flag[j + 1]] if j == 0 or flag[j - 1] in faces[x]]
                if len(beside) != 2:
                    return None
                other = beside[0] if beside[1] == flag[j] else beside[1]
                images.append(number[i][(*flag[:j], other, *flag[j + 1:])])
            alpha.append(images)
        levels.append(Level(alpha, [number[i - 1][flag[:-1]] for flag in level] if i else [], len(level)))
    return levels


def first_flag(faces, x):
    """The cell-tuple of first faces."""
    flag = [x]
    while faces[flag[0]]:
        flag.insert(0, faces[flag[0]][0])
    return tuple(flag)


def chains_of(faces):
    """All non-empty sets of cells that lie below one another, as tuples from below."""
    under = [below(faces, x) - {x} for x in range(len(faces))]
    chains = [(x,) for x in range(len(faces))]
    while chains:
        yield from sorted(chains)
        chains = [(y, *chain) for chain in chains for y in under[chain[0]]]
