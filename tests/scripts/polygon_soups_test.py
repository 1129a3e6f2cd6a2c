#!/usr/bin/env python3
"""Random soups of polygons that meet their corners again and again, against their cellular chain complex.

    polygon_soups_test.py SESAME [--random COUNT] [--seed N]

A soup has a cell for every point, for every pair of points next to each other on a polygon, and a 2-cell for every
polygon, whose boundary is the sum of its sides in order. Groups over Z, Z/2 and Z/3 are computed here from that, by Smith
forms, and so are the counts of faces left out, of boundary and non-manifold edges, and whether the soup is orientable.
`sesame mesh --json` and what `sesame replay` says of every form that `sesame import` makes have to agree.

Prints `N passed, N failed`; exit status 1 if anything differed.
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import oracle

RINGS = {"Z": 0, "Z/2": 2, "Z/3": 3}
FORMS = [[], ["--polygons", "cone"], ["--assemble"], ["--assemble", "--polygons", "cone", "--order", "file"]]


class Difference(Exception):
    """Where the program and the chain complex part."""


# ----------------------------------------------------------------------------------------------------- random soups


def random_word(rng, points):
    """Corners of one polygon: any walk, a walk several times around, one that comes back, one with stops."""
    word = [rng.randrange(points) for _ in range(rng.randint(1, 7))]
    kind = rng.randrange(6)
    if kind == 0:
        word *= rng.randint(2, 3)
    elif kind == 1:
        word += word[::-1]
    elif kind == 2:
        other = [rng.randrange(points) for _ in range(rng.randint(2, 3))]
        start = [rng.randrange(points)]
        word = start + word + start + other + start + word[::-1] + start + other[::-1]
    elif kind == 3:
        word = [corner for corner in word for _ in range(rng.randint(1, 2))]
    elif kind == 4:
        at = rng.randrange(len(word))
        word[at:at] = [word[at], rng.randrange(points)]
    return word


def random_soup(rng):
    points = rng.randint(2, 8)
    words = [random_word(rng, points) for _ in range(rng.randint(1, 4))]
    for word in list(words):
        if rng.random() < 0.15:
            turn = rng.randrange(len(word))
            words.append((word[turn:] + word[:turn])[::rng.choice([1, -1])])
    rng.shuffle(words)
    return points, words


def off_file(points, words):
    coordinates = [f"{i % 3} {i // 3 % 3} {i * i % 7}" for i in range(points)]
    return "\n".join([f"OFF\n{points} {len(words)} 0", *coordinates,
                      *(" ".join(map(str, [len(word), *word])) for word in words)]) + "\n"


# ----------------------------------------------------------------------------------------------- the complex, from words


def without_stops(word):
    """Sides without length vanish."""
    return [corner for i, corner in enumerate(word) if len(word) == 1 or corner != word[i - 1]] or word[:1]


def rotations(word):
    return [tuple(way[i:] + way[:i]) for way in (word, word[::-1]) for i in range(len(way))]


class Complex:
    def __init__(self, points, words):
        self.faces, self.lines = [], set()
        self.face_of_file = {}  # of those that stay
        self.counts = {"faces_in_file": len(words), "degenerate_faces": 0, "duplicate_faces": 0, "segments": 0}
        seen = set()
        for number, word in enumerate(words):
            walk = without_stops(word)
            if len(word) == 2 and len(walk) == 2:
                self.counts["segments"] += 1
                self.lines.add(tuple(sorted(walk)))
            elif len(walk) < 3:
                self.counts["degenerate_faces"] += 1
            elif tuple(walk) in seen:
                self.counts["duplicate_faces"] += 1
            else:
                seen.update(rotations(walk))
                self.face_of_file[number] = len(self.faces)
                self.faces.append(walk)
        self.uses = {}  # edge: [(face, +1 up or -1 down)]
        for f, walk in enumerate(self.faces):
            for i, corner in enumerate(walk):
                step = (walk[i - 1], corner)
                self.uses.setdefault(tuple(sorted(step)), []).append((f, 1 if step[0] < step[1] else -1))
        self.lines -= set(self.uses)
        self.edges = sorted(set(self.uses) | self.lines)
        is_cloud = not self.edges
        self.points = list(range(points)) if is_cloud else sorted({v for edge in self.edges for v in edge})

    def boundaries(self):
        place = {edge: i for i, edge in enumerate(self.edges)}
        of_edges = [{a: -1, b: 1} for a, b in self.edges]
        of_faces = [{} for _ in self.faces]
        for edge, uses in self.uses.items():
            for f, sign in uses:
                of_faces[f][place[edge]] = of_faces[f].get(place[edge], 0) + sign
        return of_edges, of_faces

    def homology(self, prime):
        """Betti numbers and torsion, zeros and empty lists at the end left out."""
        first, second = (oracle.invariant_factors(rows, prime) for rows in self.boundaries())
        cells = [len(self.points), len(self.edges), len(self.faces)]
        betti = [cells[0] - len(first), cells[1] - len(first) - len(second), cells[2] - len(second)]
        return trimmed(betti), trimmed([[], [n for n in second if n > 1], []])

    def is_orientable(self):
        """Whether every face can be turned so that the two uses of each edge with two cancel."""
        turned = {}
        for first in range(len(self.faces)):
            if first in turned:
                continue
            turned[first] = 1
            waiting = [first]
            while waiting:
                here = waiting.pop()
                for uses in self.uses.values():
                    if len(uses) != 2 or here not in (uses[0][0], uses[1][0]):
                        continue
                    (a, sign_a), (b, sign_b) = uses
                    other = b if a == here else a
                    wanted = -turned[here] * sign_a * sign_b
                    if other not in turned:
                        turned[other] = wanted
                        waiting.append(other)
                    if turned[a] * sign_a != -turned[b] * sign_b:
                        return False
        return True

    def report(self):
        sides = [len(uses) for uses in self.uses.values()]
        return {**self.counts, "vertices": len(self.points), "edges": len(self.edges), "faces": len(self.faces),
                "lines": len(self.lines), "boundary_edges": sides.count(1),
                "non_manifold_edges": sum(n > 2 for n in sides), "orientable": self.is_orientable()}


def trimmed(values):
    values = list(values)
    while values and not values[-1]:
        values.pop()
    return values


# ------------------------------------------------------------------------------------------------------- the program


def run(*command):
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=120, check=False)
    if done.returncode != 0:
        raise Difference(f"{' '.join(map(str, command[1:]))}: status {done.returncode}, {done.stderr.strip()[-300:]}")
    return done


def check_groups(answer, expected, what):
    found = trimmed(answer["betti"]), trimmed(answer["torsion"])
    if found != expected:
        raise Difference(f"{what}: Betti numbers and torsion are {found}, the chain complex has {expected}")


def check_cells(answer, soup, prime, what):
    """With --cells: the counts of the chain complex, and surfaces whose polygons are cycles in it."""
    cells = trimmed([len(soup.points), len(soup.edges), len(soup.faces)])
    if answer["cells"] != cells:
        raise Difference(f"{what}: {answer['cells']} cells, the chain complex has {cells}")
    _, of_faces = soup.boundaries()
    for generator in answer["generators"]:
        if generator["dim"] != 2:
            continue
        total = {}
        for face, times in generator["faces"]:
            for edge, sign in of_faces[soup.face_of_file[face]].items():
                total[edge] = total.get(edge, 0) + int(times) * sign
        if not generator["faces"] or any(n % prime if prime else n for n in total.values()):
            raise Difference(f"{what}: the faces {generator['faces']} are no cycle")


def check_soup(sesame, points, words, folder):
    soup = Complex(points, words)
    file, script = folder / "soup.off", folder / "soup.jsonl"
    file.write_text(off_file(points, words), encoding="ascii")
    expected = {ring: soup.homology(prime) for ring, prime in RINGS.items()}
    left_out = soup.counts["degenerate_faces"] + soup.counts["duplicate_faces"]
    for ring in RINGS:
        done = run(sesame, "mesh", "--json", "--ring", ring, file)
        answer = json.loads(done.stdout)
        check_groups(answer, expected[ring], f"mesh over {ring}")
        of_cells = json.loads(run(sesame, "mesh", "--json", "--cells", "--ring", ring, file).stdout)
        check_groups(of_cells, expected[ring], f"mesh --cells over {ring}")
        check_cells(of_cells, soup, RINGS[ring], f"mesh --cells over {ring}")
        for key, value in soup.report().items():
            if answer["validity"][key] != value:
                raise Difference(f"mesh says {key} {answer['validity'][key]}, the soup has {value}")
        if bool(left_out) != (f"left out {left_out} of {len(words)} face" in done.stderr):
            raise Difference(f"{left_out} faces are left out, standard error has {done.stderr!r}")
    for form in FORMS:
        said = run(sesame, "import", file, "-o", script, *form).stderr
        for kind in ("degenerate", "duplicate"):
            count = soup.counts[f"{kind}_faces"]
            if bool(count) != (f"left out {count} {kind} face" in said):
                raise Difference(f"{count} {kind} faces, import {form} says {said!r}")
        for ring in RINGS:
            summary = json.loads(run(sesame, "replay", "--json", "--ring", ring, script).stdout.splitlines()[-1])
            check_groups(summary, expected[ring], f"import {' '.join(form)}, replay over {ring}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sesame", metavar="SESAME")
    parser.add_argument("--random", type=int, default=10, metavar="COUNT")
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    options = parser.parse_args()
    passed = failed = 0
    with tempfile.TemporaryDirectory() as temporary:
        for seed in range(options.seed, options.seed + options.random):
            points, words = random_soup(random.Random(seed))
            try:
                check_soup(options.sesame, points, words, pathlib.Path(temporary))
                passed += 1
            except Difference as problem:
                failed += 1
                print(f"seed {seed}: {problem}\n{off_file(points, words)}")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
