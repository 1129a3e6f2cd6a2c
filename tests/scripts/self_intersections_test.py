#!/usr/bin/env python3
"""Where meshes meet themselves, beside exact rationals: self_intersections_test.py SESAME [--random N] [--seed S].

Soups of triangles with small whole coordinates, or a few bits behind the point, so that many touch, lie in one plane or on
one line; sesame's pairs of faces are compared with those of clipping each triangle of a pair by the planes of the other
in fractions. And shapes of which it is known.
"""
import argparse
import json
import random
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path


def minus(p, q):
    return tuple(a - b for a, b in zip(p, q))


def dot(p, q):
    return sum(a * b for a, b in zip(p, q))


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


NULL = (0, 0, 0)


def half_spaces(triangle):
    """Pairs (n, c): the hull of three points is where n . x >= c for all of them."""
    a, b, c = triangle
    normal = cross(minus(b, a), minus(c, a))
    if normal != NULL:
        spaces = [(normal, dot(normal, a)), (minus(NULL, normal), -dot(normal, a))]
        for p, q in ((a, b), (b, c), (c, a)):
            inwards = cross(normal, minus(q, p))
            spaces.append((inwards, dot(inwards, p)))
        return spaces
    low, high = min(triangle), max(triangle)
    along = minus(high, low)
    if along == NULL:
        across = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    else:
        first = next(v for v in (cross(along, e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))) if v != NULL)
        across = [first, cross(along, first)]
    spaces = [(n, dot(n, low)) for n in across] + [(minus(NULL, n), -dot(n, low)) for n in across]
    return spaces + [(along, dot(along, low)), (minus(NULL, along), -dot(along, high))]


def clipped(points, normal, level):
    """The corners of a convex polygon, a segment or a point, cut off where normal . x < level."""
    heights = [dot(normal, p) - level for p in points]
    kept = []
    for k, (p, h) in enumerate(zip(points, heights)):
        q, g = points[k - 1], heights[k - 1]
        if (h > 0 > g) or (h < 0 < g):
            t = Fraction(h, 1) / (h - g)
            kept.append(tuple(x + t * (y - x) for x, y in zip(p, q)))
        if h >= 0:
            kept.append(p)
    return kept


def common(one, other):
    points = list(one)
    for normal, level in half_spaces(other):
        if not points:
            break
        points = clipped(points, normal, level)
    return points


def is_in_hull(point, hull):
    if not hull:
        return False
    return all(dot(n, point) >= c for n, c in half_spaces([hull[0], hull[len(hull) // 2], hull[-1]]))


def meetings(points, faces):
    found = set()
    for i, one in enumerate(faces):
        for j in range(i):
            other = faces[j]
            shared = [points[v] for v in one if v in other]
            if len(shared) == 3:
                continue
            both = common([points[v] for v in one], [points[v] for v in other])
            if any(not is_in_hull(p, shared) for p in both):
                found.add((j, i))
    return found


def run(sesame, points, faces):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "mesh.off"
        lines = ["OFF", f"{len(points)} {len(faces)} 0"]
        lines += [" ".join(repr(float(x)) for x in p) for p in points]
        lines += [" ".join(map(str, (len(f), *f))) for f in faces]
        path.write_text("\n".join(lines) + "\n")
        out = subprocess.run([sesame, "mesh", "--json", "--generators-limit", "0", path], capture_output=True, text=True, check=True)
    return json.loads(out.stdout)["validity"]


def soup(rng):
    """Few places, so that points of different numbers meet; all faces are different."""
    kind = rng.randrange(4)
    size = rng.choice([1, 2, 3, 6])
    scale = rng.choice([1, Fraction(1, 8), Fraction(3, 1 << 40), 1 << 30])
    offset = rng.choice([0, 1 << 20]) if kind != 3 else 0
    flat = rng.random() < 0.25
    points = []
    for _ in range(rng.randrange(4, 11)):
        p = [rng.randrange(-size, size + 1) for _ in range(3)]
        if flat:
            p[2] = p[0] + p[1]
        points.append(tuple((x + offset) * scale for x in p))
    faces = set()
    for _ in range(rng.randrange(2, 7)):
        faces.add(tuple(sorted(rng.sample(range(len(points)), 3))))
    faces = [rng.sample(f, 3) for f in sorted(faces)]
    return [tuple(Fraction(float(x)) for x in p) for p in points], faces


def tetrahedron(shift, first=0):
    points = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    return [tuple(a + b for a, b in zip(p, shift)) for p in points], [tuple(v + first for v in f) for f in faces]


def two_tetrahedra(shift):
    points, faces = tetrahedron((0, 0, 0))
    more, others = tetrahedron(shift, 4)
    return points + more, faces + others


def grid(n, flat):
    points = [(x, y, 0 if flat else (x * y) % 3) for x in range(n) for y in range(n)]
    faces = []
    for x in range(n - 1):
        for y in range(n - 1):
            a, b, c, d = x * n + y, (x + 1) * n + y, (x + 1) * n + y + 1, x * n + y + 1
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def check_known(sesame):
    cases = {
        "a tetrahedron": (tetrahedron((0, 0, 0)), 0, 0),
        "two of them apart": (two_tetrahedra((9, 0, 0)), 0, 0),
        "a flat grid": (grid(12, True), 0, 0),
        "a grid that is not flat": (grid(12, False), 0, 0),
    }
    wrong = 0
    for name, ((points, faces), count, crossing) in cases.items():
        said = run(sesame, points, faces)
        if (said["self_intersections"], said["self_intersections_crossing"]) != (count, crossing):
            print(f"{name}: {said['self_intersections']} and {said['self_intersections_crossing']}")
            wrong += 1
    for name, shift, crosses in (("crossing", (1, 1, 1), True), ("touching at a vertex", (4, 0, 0), False),
                                 ("touching at a corner on a face", (-4, 1, 1), False), ("in one place", (0, 0, 0), False)):
        points, faces = two_tetrahedra(shift)
        said = run(sesame, points, faces)
        wanted = meetings([tuple(map(Fraction, p)) for p in points], faces)
        if said["self_intersections"] != len(wanted) or not wanted or (said["self_intersections_crossing"] > 0) != crosses:
            print(f"two tetrahedra {name}: {said['self_intersections']}, not {len(wanted)}")
            wrong += 1
    # A flat concave polygon is cut where it is; a square with a triangle through it.
    said = run(sesame, [(0, 0, 0), (4, 0, 0), (4, 4, 0), (2, 1, 0), (0, 4, 0)], [(0, 1, 2, 3, 4)])
    wrong += said["self_intersections"] != 0
    said = run(sesame, [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (1, 1, -1), (3, 1, -1), (2, 2, 3)], [(0, 1, 2, 3), (4, 5, 6)])
    if said["self_intersections"] != 1 or said["first_self_intersections"][0]["faces"] != [0, 1]:
        print("a triangle through a square", said["first_self_intersections"])
        wrong += 1
    if abs(said["first_self_intersections"][0]["place"][2]) > 1e-9:
        print("the place of a meeting is not in the plane of the square")
        wrong += 1
    return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("sesame")
    parser.add_argument("--random", type=int, default=80)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    wrong = check_known(arguments.sesame)
    met = 0
    for seed in range(arguments.seed, arguments.seed + arguments.random):
        points, faces = soup(random.Random(seed))
        wanted = meetings(points, faces)
        said = run(arguments.sesame, points, faces)
        met += len(wanted)
        listed = {tuple(m["faces"]) for m in said["first_self_intersections"]}
        if said["self_intersections"] != len(wanted) or not listed <= wanted:
            print(f"seed {seed}: {said['self_intersections']} {sorted(listed)}, not {sorted(wanted)}")
            wrong += 1
    print(f"{arguments.random} soups, {met} meetings, {wrong} wrong")
    return wrong > 0 or met == 0


if __name__ == "__main__":
    sys.exit(main())
