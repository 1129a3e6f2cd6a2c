#!/usr/bin/env python3
"""Prints the script that builds a Menger sponge from unit cubes: replay/examples/menger_sponge.jsonl is its level 1.

    make_menger.py [--level L]

One `simploid` [1,1,1] a cube, then one `identify` that glues it to every cube that is there already and shares a square
with it: two steps a cube, so the construction can be watched. The sponge is a handlebody, connected and without closed
surfaces inside, so its first Betti number is 1 - euler; cells and Euler characteristic are counted on the grid.
"""

import argparse
import itertools
import json

HEADER = """\
# The Menger sponge of level 1: a block of 3 x 3 x 3 unit cubes without the centre of each face and without the
# centre of the block: 20 cubes. The cube at (x,y,z) is called cXYZ. Every cube is glued, face to face, to those
# that are there already. A cube that joins two arms closes a loop: after the first layer (x = 0) there is one, with
# the last cubes there are five.
# Expected: layer x = 0 a square ring, (1,1); with the four posts of x = 1 still (1,1); in the end 64 vertices, 144
# edges, 96 squares and 20 cubes with Betti numbers 1, 5, 0, 0 and no torsion.
# Printed by tests/scripts/make_menger.py.
"""


def in_sponge(cube, level):
    """Whether no scale has two or more middle digits in base 3."""
    for _ in range(level):
        if sum(x % 3 == 1 for x in cube) >= 2:
            return False
        cube = tuple(x // 3 for x in cube)
    return True


def name(cube):
    separator = "" if max(cube) < 10 else "_"
    return "c" + separator.join(map(str, cube))


def face(cube, axis, side):
    parts = ["0-1"] * 3
    parts[axis] = str(side)
    return f"{name(cube)}.{'x'.join(parts)}"


def grid_cells(cubes):
    """Cells by dimension: a cell is named by doubled coordinates, odd along the axes that it spans."""
    cells = {tuple(2 * x + 1 + d for x, d in zip(cube, delta))
             for cube in cubes for delta in itertools.product((-1, 0, 1), repeat=3)}
    counts = [0, 0, 0, 0]
    for cell in cells:
        counts[sum(x % 2 for x in cell)] += 1
    return counts


def expect(cubes):
    """What holds of connected cubes without closed surfaces inside."""
    cells = grid_cells(cubes)
    euler = cells[0] - cells[1] + cells[2] - cells[3]
    return {"op": "expect", "cells": cells, "euler": euler, "betti": [1, 1 - euler], "torsion": []}


def steps(level):
    size = 3**level
    placed = set()
    for cube in itertools.product(range(size), repeat=3):
        if not in_sponge(cube, level):
            continue
        corners = [[x + d for x, d in zip(cube, delta)] for delta in itertools.product((0, 1), repeat=3)]
        yield {"op": "simploid", "name": name(cube), "type": [1, 1, 1], "at": corners}
        pairs = []
        for axis in range(3):
            for side in (0, 1):
                other = cube[:axis] + (cube[axis] + 2 * side - 1,) + cube[axis + 1:]
                if other in placed:
                    pairs.append([face(other, axis, 1 - side), face(cube, axis, side)])
        if pairs:
            yield {"op": "identify", "pairs": pairs}
        placed.add(cube)
        if level == 1 and cube in ((0, 2, 2), (1, 2, 2)):  # a layer is complete, and connected
            yield expect(placed)
    yield expect(placed)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--level", type=int, default=1, choices=range(0, 4))
    level = parser.parse_args().level
    if level == 1:
        print(HEADER, end="")
    print(json.dumps({"sesame": 1, "ring": "Z", "title": f"Menger sponge, level {level}"}, separators=(",", ":")))
    for step in steps(level):
        print(json.dumps(step, separators=(",", ":")))


if __name__ == "__main__":
    main()
