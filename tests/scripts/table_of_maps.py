#!/usr/bin/env python3
"""Five objects with as many cells as those of a published table have, as scripts: by cells and by simplices.

    table_of_maps.py --out FOLDER      writes NAME.cells.jsonl and NAME.simplices.jsonl for each
    table_of_maps.py --measure SESAME  replays all of them and prints what they take, as a table

The table is that of S. Alayrangues, G. Damiand, P. Lienhardt, S. Peltier, "A boundary operator for computing the homology
of cellular structures" (2015), table 3.1 of S. Peltier's habilitation (2023): a two-holed torus (with 295 edges; it has
294, with which the Euler characteristic would be odd), a Klein bottle, a gear, a tower of four volumes, a Menger sponge of 20
cubes. It has their numbers of cells and of simplices, which its pictures show in other ways: the objects here have these
numbers, and the kind of shape.

Surfaces are made polygon by polygon, solids one by one, and each is sewn to those that are there already, one side or face
a step.
"""

import argparse
import collections
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import gmaps

# cells and simplices: how many of each dimension there are in the end.
Object = collections.namedtuple("Object", "name title pieces cells simplices betti torsion")


# ------------------------------------------------------------------------------------------------ shapes
# A piece of a surface is a polygon, a list of corners; a solid is a list of polygons. What has the same corners is sewn.


def with_halved(polygons, edges):
    """The polygons with a vertex in the middle of some edges."""
    middles = {frozenset(edge): ("middle", *edge) for edge in edges}
    return [[corner for a, b in zip(polygon, polygon[1:] + polygon[:1])
             for corner in (a, middles.get(frozenset((a, b)))) if corner is not None] for polygon in polygons]


def square_of_cube(cube, axis, side):
    """The corners of a face of a unit cube, in order around it."""
    around = [(0, 0), (0, 1), (1, 1), (1, 0)]
    corners = []
    for a, b in around:
        moved = [a, b]
        moved.insert(axis, side)
        corners.append(tuple(x + d for x, d in zip(cube, moved)))
    return corners


def skin(cubes):
    """The squares between some unit cubes and what is outside."""
    squares = []
    for cube in cubes:
        for axis in range(3):
            for side in (0, 1):
                beside = tuple(x + (2 * side - 1) * (k == axis) for k, x in enumerate(cube))
                if beside not in cubes:
                    squares.append(square_of_cube(cube, axis, side))
    return squares


def two_holed_torus():
    """A plate of 9 x 6 cubes without two of them: 142 squares, 140 corners. Eleven edges of its rim are halved."""
    plate = sorted((x, y, 0) for x in range(9) for y in range(6) if (x, y) not in ((2, 2), (6, 3)))
    return with_halved(skin(plate), [((x, 0, 0), (x + 1, 0, 0)) for x in range(9)]
                       + [((x, 6, 0), (x + 1, 6, 0)) for x in range(2)])


def klein_bottle(size=18):
    """A grid whose upper side is the lower one turned round."""
    def corner(x, y):
        return ((-x) % size, 0) if y == size else (x % size, y)
    return [[corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)]
            for y in range(size) for x in range(size)]


def gear(teeth=47):
    """A ring with teeth: each has four corners outside and one in the hole, below and above.

    Below and above it is cut in two, from the hole outwards, since a ring is no disc. In the hole eight walls are twice
    as wide as others, so that eight corners have two edges only.
    """
    def outside(k, z):
        return ("outside", k % (4 * teeth), z)

    def hole(k, z):
        return ("hole", k % teeth, z)
    polygons = [[outside(k, 0), outside(k + 1, 0), outside(k + 1, 1), outside(k, 1)] for k in range(4 * teeth)]
    first = 0
    while first < teeth:
        last = first + (2 if first < 16 else 1)
        polygons.append([hole(k, 0) for k in range(first, last + 1)] + [hole(k, 1) for k in range(last, first - 1, -1)])
        first = last
    for z in (0, 1):
        for first, last in ((0, teeth // 2), (teeth // 2, teeth)):
            polygons.append([outside(k, z) for k in range(4 * first, 4 * last + 1)]
                            + [hole(k, z) for k in range(last, first - 1, -1)])
    return polygons


def storey(low, high, beam, cut):
    """Two pillars with eight sides and a beam between them, of some segments. `cut`: heights at which ends are two faces."""
    def ring(pillar, height):
        return [(pillar, height, k) for k in range(8)]

    def side(pillar, height, k):
        below, above = ring(pillar, height), ring(pillar, height + 1)
        return [below[k], below[(k + 1) % 8], above[(k + 1) % 8], above[k]]
    middle = low + 1
    faces = []
    for pillar in (0, 1):
        for height in (low, high):
            end = ring(pillar, height)
            faces += [end[:5], end[4:] + end[:1]] if height in cut else [end]
        faces += [side(pillar, height, k) for height in range(low, high) for k in range(8)
                  if (height, k) != (middle, 0)]
    rings = [side(0, middle, 0), *([("beam", low, t, k) for k in range(4)] for t in range(1, beam)), side(1, middle, 0)]
    for here, there in zip(rings, rings[1:]):
        faces += [[here[k], here[(k + 1) % 4], there[(k + 1) % 4], there[k]] for k in range(4)]
    return with_halved(faces, [((pillar, low + 1, 2), (pillar, low + 2, 2)) for pillar in (0, 1)])


def tower():
    """Four storeys, each on the two pillars of the one below: four balls, and six discs in which they meet.

    So it is, up to homotopy, a graph of four vertices and six edges. Of the discs four are two faces each.
    """
    return [storey(3 * k, 3 * k + 3, beam, cut=(3, 6)) for k, beam in enumerate((2, 2, 2, 1))]


def menger_sponge():
    cubes = [(x, y, z) for x in range(3) for y in range(3) for z in range(3) if (x, y, z).count(1) < 2]
    return [[square_of_cube(cube, axis, side) for axis in range(3) for side in (0, 1)] for cube in cubes]


def objects():
    return [
        Object("two_holed_torus", "two-holed torus", two_holed_torus(), [151, 295, 142], [588, 1770, 1180],
               [1, 4, 1], []),
        Object("klein_bottle", "Klein bottle", klein_bottle(), [324, 648, 324], [1296, 3888, 2592], [1, 1, 0],
               [[], [2]]),
        Object("gear", "gear", gear(), [470, 701, 231], [1402, 4206, 2804], [1, 2, 1], []),
        Object("tower", "tower", tower(), [228, 452, 226, 4], [910, 3824, 4928, 2016], [1, 3, 0, 0], []),
        Object("menger_sponge", "Menger sponge", menger_sponge(), [64, 144, 96, 20], [324, 1576, 2208, 960],
               [1, 5, 0, 0], []),
    ]


# ------------------------------------------------------------------------------------------------ scripts


def darts_of(polygon, first=0):
    """The darts of the sides of a polygon: (the corner where it is, the other corner of the side) -> dart."""
    darts = {}
    for k, (corner, after) in enumerate(zip(polygon, polygon[1:] + polygon[:1])):
        darts[corner, after], darts[after, corner] = first + 2 * k, first + 2 * k + 1
    return darts


def surface_steps(polygons, how):
    """Each polygon, and then a sewing for each of its sides that is there already."""
    free = {}
    for number, polygon in enumerate(polygons):
        yield {"op": "polygon", "name": f"f{number}", "sides": len(polygon), **how}
        for (corner, after), dart in darts_of(polygon).items():
            if dart % 2:
                continue
            name = f"f{number}:{dart}"
            if (corner, after) in free:
                yield {"op": "sew", "dim": 2, "pairs": [[name, free.pop((corner, after))]]}
                del free[after, corner]
            else:
                free[corner, after], free[after, corner] = name, f"f{number}:{dart + 1}"


def solid_map(faces):
    """The map of a solid, and for each face its darts."""
    alpha, numbered, at = [[], [], []], [], {}
    for face in faces:
        first = len(alpha[0])
        own = gmaps.polygon(len(face))
        for i in (0, 1):
            alpha[i] += [first + image for image in own[i]]
        numbered.append(darts_of(face, first))
        for key, dart in numbered[-1].items():
            at.setdefault(key, []).append(dart)
    alpha[2] = [None] * len(alpha[0])
    for one, other in at.values():
        alpha[2][one], alpha[2][other] = other, one
    return [*alpha, list(range(len(alpha[0])))], numbered


def solid_steps(solids, how):
    """Each solid, and then a sewing for each of its faces that is there already."""
    free = {}
    for number, faces in enumerate(solids):
        alpha, numbered = solid_map(faces)
        yield {"op": "gmap", "name": f"c{number}", "alpha": alpha, **how}
        for face, darts in zip(faces, numbered):
            if frozenset(face) in free:
                other, other_darts = free.pop(frozenset(face))
                key = face[0], face[1]
                yield {"op": "sew", "dim": 3, "pairs": [[f"c{number}:{darts[key]}", f"c{other}:{other_darts[key]}"]]}
            else:
                free[frozenset(face)] = number, darts


def script(thing, simplices):
    """The lines of a script that ends with what is expected."""
    how = {"as": "simplices"} if simplices else {}
    is_solid = len(thing.cells) == 4
    steps = (solid_steps if is_solid else surface_steps)(thing.pieces, how)
    counts = thing.simplices if simplices else thing.cells
    euler = sum((-1) ** p * count for p, count in enumerate(counts))
    yield {"sesame": 1, "ring": "Z", "title": f"{thing.title}, by {'simplices' if simplices else 'cells'}"}
    yield from steps
    yield {"op": "expect", "cells": counts, "euler": euler, "betti": thing.betti, "torsion": thing.torsion}


def write_scripts(folder):
    """Returns (object, path of the script by cells, path of that by simplices) for each."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for thing in objects():
        paths = [folder / f"{thing.name}.{kind}.jsonl" for kind in ("cells", "simplices")]
        for path, simplices in zip(paths, (False, True)):
            path.write_text("".join(json.dumps(line, separators=(",", ":")) + "\n" for line in script(thing, simplices)))
        written.append((thing, *paths))
    return written


# ------------------------------------------------------------------------------------------------ what it takes


def replayed(sesame, path, *options):
    """The report of each step."""
    run = subprocess.run([sesame, "replay", "--json", "--every", "1", *options, path], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"table_of_maps.py: {path.name}: {run.stderr.strip()}")
    return [report for report in map(json.loads, run.stdout.splitlines()) if "step" in report]


def measured(sesame, path, runs):
    """(cells, generators of B and of S in the end, us of a sewing: the median, the mean), each time of the run in which it
    is least: what others take of the machine is not meant."""
    times = []
    for _ in range(runs):
        steps = replayed(sesame, path)
        sewings = [step["us"] for step in steps if step["op"] == "sew"]
        times.append((statistics.median(sewings), statistics.mean(sewings)))
    last = steps[-1]
    return sum(last["cells"]), sum(last["big"]), sum(last["small"]), *map(min, zip(*times))


def print_table(sesame, runs):
    print("| object | sewings | as | cells in the end | generators of B | of S | a sewing, median | mean |")
    print("|---|" + "---|" * 7)
    with tempfile.TemporaryDirectory() as folder:
        for thing, *paths in write_scripts(pathlib.Path(folder)):
            sewings = paths[0].read_text().count('"op":"sew"')
            for path, kind in zip(paths, ("cells", "simplices")):
                cells, big, small, median, mean = measured(sesame, path, runs)
                first = f"{thing.title} | {sewings}" if kind == "cells" else " | "
                print(f"| {first} | {kind} | {cells:,} | {big:,} | {small:,} | {median:.0f} µs | {mean:.0f} µs |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--out", type=pathlib.Path, help="the folder that scripts are written to")
    what.add_argument("--measure", metavar="SESAME", help="the program that replays them")
    parser.add_argument("--runs", type=int, default=5, help="of which the least times are taken")
    options = parser.parse_args()
    if options.out:
        write_scripts(options.out)
    else:
        print_table(options.measure, options.runs)


if __name__ == "__main__":
    main()
