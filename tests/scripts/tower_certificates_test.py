#!/usr/bin/env python3
"""Every cycle and every bounding chain that `sesame tower --generators` prints, checked as algebra.

Usage: tower_certificates_test.py SESAME [TOWERS [OPERATIONS]]

The complexes, the maps between them and the chains are those of the slow twin (tower_oracle.py), which knows nothing of
how the program finds its chains. Many operations of the towers have the same time.
"""

import json
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
import random_tower
import tower_oracle
from tower_oracle import Echelon, boundary, boundaries_by_dimension, moments, pushed

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
TOWERS = int(sys.argv[2]) if len(sys.argv) > 2 else 60
OPERATIONS = int(sys.argv[3]) if len(sys.argv) > 3 else 30


def answer(text, p, *options):
    done = subprocess.run([SESAME, "tower", "-", "--json", "--generators", "--ring", f"Z/{p}", *options],
                          input=text.encode(), capture_output=True, check=True, timeout=60)
    return json.loads(done.stdout)


class Certificates(unittest.TestCase):
    def chain(self, printed, dimension, simplices, p):
        """A chain as the twin has it; its simplices have a dimension and are in a complex."""
        chain = {}
        for coefficient, labels in printed:
            simplex = tuple(labels)
            self.assertEqual(len(simplex), dimension + 1)
            self.assertIn(simplex, simplices)
            self.assertNotIn(simplex, chain)
            self.assertNotEqual(coefficient % p, 0)
            chain[simplex] = coefficient % p
        return chain

    def check(self, operations, p):
        """The number of bars whose birth or death has a time that several operations have."""
        found = answer(random_tower.text(operations, True), p)
        generators = found["generators"]
        bars = [[g["dim"], g["birth"], g["death"]] for g in generators]
        self.assertEqual(bars, found["bars"])
        self.assertEqual(bars, tower_oracle.barcode(operations, p))
        steps = moments(operations)
        place = {time: k for k, (time, _, _) in enumerate(steps)}
        alive = [[] for _ in steps]  # by moment: dimension and image of the cycle of each bar that is alive
        for g in generators:
            first, dimension = place[g["birth"]], g["dim"]
            last = len(steps) if g["death"] is None else place[g["death"]]
            cycle = self.chain(g["cycle"], dimension, steps[first][2], p)
            self.assertEqual(boundary(cycle, p), {})
            for k in range(first, last):
                for operation in steps[k][1] if k > first else []:
                    cycle = pushed(cycle, operation, p)
                alive[k].append((dimension, cycle))
            if g["death"] is None:
                self.assertEqual(cycle, self.chain(g["now"], dimension, steps[-1][2], p))
                continue
            for operation in steps[last][1]:
                cycle = pushed(cycle, operation, p)
            self.assertEqual(boundary(self.chain(g["bounds"], dimension + 1, steps[last][2], p), p), cycle)
        self.check_bases(steps, alive, p)
        return sum(len(steps[place[t]][1]) > 1 for _, birth, death in bars for t in (birth, death) if t is not None)

    def check_bases(self, steps, alive, p):
        """At every moment the cycles that are alive are a basis of the homology."""
        for (_, _, simplices), chains in zip(steps, alive):
            dimensions = max(len(s) for s in simplices)
            boundaries = boundaries_by_dimension(simplices, p, dimensions)
            for d in range(dimensions):
                cells = [s for s in simplices if len(s) == d + 1]
                below = Echelon(p).extended_by(boundary({s: 1}, p) for s in cells)
                betti = len(cells) - below - len(boundaries[d].by_pivot)
                cycles = [cycle for dimension, cycle in chains if dimension == d]
                self.assertEqual((len(cycles), boundaries[d].extended_by(cycles)), (betti, betti))

    def test_a_cycle_bounds_in_the_complex_that_is_there_after_all_operations_at_its_death(self):
        (edge, _) = answer("0 i 1\n0 i 2\n1 i 1 2\n1 c 1 2\n", 3)["generators"]
        self.assertEqual((edge["death"], edge["bounds"]), (1, []))
        # The loop is born at time 1, when its vertex 2 is called 5 already.
        lines = ["0 i 1", "0 i 2", "0 i 3", "0 i 5", "1 i 1 2", "1 i 2 3", "1 i 1 3", "1 c 2 5", "2 i 1 3 5"]
        loop = answer("\n".join(lines), 3)["generators"][-1]
        self.assertEqual((loop["dim"], loop["birth"], loop["death"]), (1, 1, 2))
        self.assertEqual(sorted(labels for _, labels in loop["cycle"]), [[1, 3], [1, 5], [3, 5]])

    def test_what_is_left_of_a_time_that_has_not_ended_is_what_was_read(self):
        text = "0 i 1\n0 i 2\n1 i 1 2\n1 c 1 2\n"
        (edge, _) = answer(text, 3, "--until", "3")["generators"]
        self.assertEqual((edge["death"], edge["bounds"] in ([[1, [1, 2]]], [[-1, [1, 2]]])), (1, True))

    def test_all_certificates_of_random_towers_hold(self):
        together = 0
        for seed in range(TOWERS):
            for p in (2, 3, 5):
                with self.subTest(seed=seed, p=p):
                    operations = random_tower.make(seed, OPERATIONS, vertices=5 + seed % 3, dimension=3,
                                                   contract=(0.3, 0.15, 0)[seed % 3], any_two=seed % 2 == 0,
                                                   times="distinct" if seed % 10 == 9 else "equal")
                    together += self.check(operations, p)
        self.assertGreater(together, 10 * TOWERS)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
