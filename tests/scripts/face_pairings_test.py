#!/usr/bin/env python3
"""Triangulations given by face pairings, glued by `sesame replay` with vertex maps.

    face_pairings_test.py SESAME

The homology of each is worked out here from the quotient itself: its cells are the classes of ordered vertex tuples of
the tetrahedra, up to order, under the pairings. Where a cell is itself in another order the program has to refuse.
"""

import itertools
import json
import random
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
import oracle

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
IS_HEAVY = "--heavy" in sys.argv  # else a quarter of the pairings of one tetrahedron, and fewer random ones
STRIDE = 1 if IS_HEAVY else 4
FACES = [(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)]
ORDERS = list(itertools.permutations(range(3)))

# A pairing is (tetrahedron, its face, tetrahedron, its face, map); of each closed manifold its H_1, Betti numbers, pairings.
CENSUS = {
    "S^3 with one vertex": (
        [], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (0, 1, 2)), (0, (0, 1, 3), 0, (0, 1, 2), (1, 2, 0))]),
    "S^3 with two vertices": (
        [], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (0, 1, 2)), (0, (0, 1, 3), 0, (0, 1, 2), (0, 1, 2))]),
    "L(4,1)": (
        [4], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (1, 2, 0)), (0, (0, 1, 3), 0, (0, 1, 2), (1, 2, 0))]),
    "L(5,2)": (
        [5], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (1, 2, 0)), (0, (0, 1, 3), 0, (0, 1, 2), (2, 0, 1))]),
    "RP^3": (
        [2], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (0, 1, 2)), (0, (0, 1, 3), 1, (1, 2, 3), (2, 0, 1)),
                            (0, (0, 1, 2), 1, (0, 2, 3), (0, 1, 2)), (1, (0, 1, 3), 1, (0, 1, 2), (1, 2, 0))]),
    "L(3,1)": (
        [3], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (2, 0, 1)), (0, (0, 1, 3), 1, (1, 2, 3), (2, 1, 0)),
                            (0, (0, 1, 2), 1, (0, 2, 3), (2, 1, 0)), (1, (0, 1, 3), 1, (0, 1, 2), (0, 1, 2))]),
    "L(7,2)": (
        [7], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (1, 2, 0)), (0, (0, 1, 3), 1, (1, 2, 3), (0, 2, 1)),
                            (0, (0, 1, 2), 1, (0, 2, 3), (1, 0, 2)), (1, (0, 1, 3), 1, (0, 1, 2), (2, 0, 1))]),
    "L(8,3)": (
        [8], [1, 0, 0, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (2, 0, 1)), (0, (0, 1, 3), 1, (1, 2, 3), (1, 0, 2)),
                            (0, (0, 1, 2), 1, (0, 1, 3), (2, 0, 1)), (1, (0, 2, 3), 1, (0, 1, 2), (2, 1, 0))]),
    "S^3 by the quaternions": (
        [2, 2], [1, 0, 0, 1], [(0, (1, 2, 3), 1, (1, 2, 3), (2, 1, 0)), (0, (0, 2, 3), 1, (0, 2, 3), (1, 0, 2)),
                               (0, (0, 1, 3), 1, (0, 1, 2), (1, 2, 0)), (0, (0, 1, 2), 1, (0, 1, 3), (2, 0, 1))]),
    "S^2 x S^1": (
        [], [1, 1, 1, 1], [(0, (1, 2, 3), 0, (0, 2, 3), (2, 0, 1)), (0, (0, 1, 3), 1, (1, 2, 3), (2, 1, 0)),
                           (0, (0, 1, 2), 1, (0, 2, 3), (2, 1, 0)), (1, (0, 1, 3), 1, (0, 1, 2), (1, 2, 0))]),
    "the twisted S^2 bundle over S^1": (
        [], [1, 1, 0, 0], [(0, (1, 2, 3), 1, (1, 2, 3), (1, 2, 0)), (0, (0, 2, 3), 1, (0, 2, 3), (1, 0, 2)),
                           (0, (0, 1, 3), 1, (0, 1, 3), (1, 2, 0)), (0, (0, 1, 2), 1, (0, 1, 2), (2, 1, 0))]),
    "RP^2 x S^1": (
        [2], [1, 1, 0, 0], [(1, (0, 2, 3), 0, (0, 2, 3), (2, 1, 0)), (2, (0, 1, 3), 1, (1, 2, 3), (1, 0, 2)),
                            (2, (0, 2, 3), 1, (0, 1, 2), (0, 2, 1)), (0, (1, 2, 3), 2, (1, 2, 3), (1, 2, 0)),
                            (0, (0, 1, 2), 1, (0, 1, 3), (1, 2, 0)), (2, (0, 1, 2), 0, (0, 1, 3), (0, 2, 1))]),
}


def homology(tetrahedra, pairings):
    """(cells, betti, torsion) of the quotient; None when a cell is itself in another order of its vertices."""
    parent = {(t, ordered): (t, ordered) for t in range(tetrahedra)
              for size in range(1, 5) for ordered in itertools.permutations(range(4), size)}

    def find(x):
        while parent[x] != x:
            x = parent[x]
        return x

    for a, face, b, other, to in pairings:
        for size in range(1, 4):
            for places in itertools.permutations(range(3), size):
                one = find((a, tuple(face[k] for k in places)))
                parent[one] = find((b, tuple(other[to[k]] for k in places)))
    cells = [[], [], [], []]
    of_class = {}  # class -> (number of the cell, sign)
    for t, ordered in sorted(parent, key=lambda x: (len(x[1]), x)):
        dim = len(ordered) - 1
        if ordered != tuple(sorted(ordered)) or find((t, ordered)) in of_class:
            continue
        for order in itertools.permutations(range(dim + 1)):
            orbit = find((t, tuple(ordered[k] for k in order)))
            if orbit in of_class:
                return None
            of_class[orbit] = len(cells[dim]), oracle.sign_between(order, range(dim + 1))
        cells[dim].append((t, ordered))
    factors = [[]]
    for dim in (1, 2, 3):
        rows = []
        for t, ordered in cells[dim]:
            rows.append({})
            for k in range(dim + 1):
                number, sign = of_class[find((t, ordered[:k] + ordered[k + 1:]))]
                rows[-1][number] = rows[-1].get(number, 0) + sign * (-1) ** k
        factors.append(oracle.invariant_factors(rows))
    factors.append([])
    return ([len(c) for c in cells], [len(cells[p]) - len(factors[p]) - len(factors[p + 1]) for p in range(4)],
            [[f for f in factors[p + 1] if f > 1] for p in range(4)])


def replayed(tetrahedra, pairings, in_one_step, options=()):
    """The same by the program; None when it refuses to fold a cell."""
    steps = [{"op": "simplex", "name": f"t{t}", "dim": 3} for t in range(tetrahedra)]
    pairs = [[f"t{a}." + "-".join(map(str, face)), f"t{b}." + "-".join(map(str, other)), list(to)]
             for a, face, b, other, to in pairings]
    steps += [{"op": "identify", "pairs": part} for part in ([pairs] if in_one_step else [[pair] for pair in pairs])]
    text = "".join(json.dumps(line) + "\n" for line in [{"sesame": 1}, *steps])
    done = subprocess.run([SESAME, "replay", "--json", *options, "-"], input=text, capture_output=True, text=True,
                          timeout=60, check=False)
    if done.returncode == 2 and "to itself with its vertices in the order" in done.stderr:
        return None
    if done.returncode != 0:
        raise AssertionError(f"exit status {done.returncode}: {done.stderr}\n{text}")
    last = json.loads(done.stdout.splitlines()[-1])
    return last["cells"], last["betti"], last["torsion"]


def all_pairings(faces):
    """Every way to pair all faces up, each pair with every map."""
    if not faces:
        yield []
        return
    for k in range(1, len(faces)):
        for rest in all_pairings(faces[1:k] + faces[k + 1:]):
            for order in ORDERS:
                yield [(*faces[0], *faces[k], order), *rest]


class FacePairings(unittest.TestCase):
    def check(self, tetrahedra, pairings, options=()):
        expected = homology(tetrahedra, pairings)
        for in_one_step in (True, False):
            self.assertEqual(replayed(tetrahedra, pairings, in_one_step, options), expected, pairings)
        return expected

    def test_closed_manifolds_have_the_homology_that_is_known(self):
        for name, (torsion, betti, pairings) in CENSUS.items():
            with self.subTest(name):
                _, found, groups = self.check(1 + max(max(p[0], p[2]) for p in pairings), pairings, ["--verify"])
                self.assertEqual((found, groups[1]), (betti, torsion))

    def test_every_pairing_of_all_faces_of_one_tetrahedron(self):
        results = [self.check(1, p) for p in itertools.islice(all_pairings([(0, face) for face in FACES]), None, None, STRIDE)]
        self.assertEqual(len(results), 3 * 36 // STRIDE)
        self.assertIn(None, results)
        groups = [str(found[2][1]) for found in results if found]
        self.assertEqual({"[]", "[4]", "[5]"} - set(groups), set())

    def test_random_pairings_of_some_faces(self):
        rng = random.Random(1)
        folded = 0
        rounds = 120 if IS_HEAVY else 24
        for round_ in range(rounds):
            tetrahedra = rng.choice([1, 2, 2, 3])
            faces = [(t, face) for t in range(tetrahedra) for face in FACES]
            rng.shuffle(faces)
            pairings = [(*faces[2 * k], *faces[2 * k + 1], rng.choice(ORDERS))
                        for k in range(rng.randint(1, len(faces) // 2))]
            folded += self.check(tetrahedra, pairings, ["--verify"] if round_ % 4 == 0 else []) is None
        self.assertTrue(0 < folded < rounds)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
