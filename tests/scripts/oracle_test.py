#!/usr/bin/env python3
"""Tests of the oracle and of what stands on it: random scripts, the comparison's checks, the shipped examples."""

import glob
import itertools
import math
import os
import random
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
import compare_with_oracle
import oracle
import random_script

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "..", "replay", "examples")


def determinant(matrix):
    if not matrix:
        return 1
    return sum((-1) ** k * row[0] * determinant([r[1:] for i, r in enumerate(matrix) if i != k])
               for k, row in enumerate(matrix) if row[0])


def factors_by_minors(matrix):
    """Invariant factors as quotients of the greatest common divisors of all minors."""
    divisors = [1]
    for size in range(1, min(len(matrix), len(matrix[0])) + 1):
        g = 0
        for rows in itertools.combinations(matrix, size):
            for columns in itertools.combinations(range(len(matrix[0])), size):
                g = math.gcd(g, determinant([[row[c] for c in columns] for row in rows]))
        if g == 0:
            break
        divisors.append(g)
    return [b // a for a, b in zip(divisors, divisors[1:])]


def replayed(*steps, header='{"sesame":1}'):
    return oracle.replay("\n".join([header, *steps]).encode("utf-8"), "script")


KLEIN = ('{"op":"simploid","name":"q","type":[1,1]}',
         '{"op":"identify","pairs":[["q.0-1x0","q.1x0-1"],["q.0x0-1","q.0-1x1"]]}')


class OracleTest(unittest.TestCase):
    def test_invariant_factors_are_quotients_of_the_divisors_of_minors(self):
        source = random.Random(7)
        for _ in range(150):
            height, width = source.randint(1, 4), source.randint(1, 4)
            matrix = [[source.choice([0, 0, 1, -1, 2, -2, 3, 6]) for _ in range(width)] for _ in range(height)]
            found = oracle.invariant_factors([dict(enumerate(row)) for row in matrix])
            self.assertEqual(found, factors_by_minors(matrix), matrix)
            modulo = oracle.invariant_factors([dict(enumerate(row)) for row in matrix], 3)
            self.assertEqual(len(modulo), sum(1 for f in found if f % 3), matrix)

    def test_every_boundary_of_a_boundary_is_zero(self):
        for kind in ((3,), (1, 1, 1), (2, 1), (1, 2, 1), (2, 2)):
            state = oracle.State()
            oracle.add_simploid(state, "q", kind)
            for c in state.alive():
                self.assertEqual(oracle.boundary_of_chain(state, state.boundary(c), 0), {})

    def test_random_scripts_are_legal_and_random_wrong_ones_fail_in_the_last_line(self):
        for seed in range(25):
            text = random_script.write_script(seed, 30)
            self.assertEqual(oracle.replay(text.encode(), "script")[0], 0)
            wrong = random_script.write_script(seed, 30, illegal=True)
            status, message, _ = oracle.replay(wrong.encode(), "script")
            self.assertEqual(status, 2)
            self.assertTrue(message.startswith(f"script:{wrong.count(chr(10))}: "), message)

    def test_a_failed_expect_has_its_own_exit_status(self):
        status, message, _ = replayed(*KLEIN, '{"op":"expect","betti":[1,2,1]}')
        self.assertEqual((status, message[:9]), (3, "script:4:"))

    def test_a_refused_step_changes_nothing(self):
        status, _, run = replayed(*KLEIN, '{"op":"identify","pairs":[["q.0-1x0","q.0x0-1"],["q","q.0x0"]]}')
        self.assertEqual(status, 2)
        self.assertEqual(oracle.summary(run.state, 0)["cells"], [1, 2, 1])

    def test_generators_are_checked_by_what_they_claim(self):
        run = replayed(*KLEIN)[2]
        found = oracle.summary(run.state, 0)
        point = {"dim": 0, "order": 0, "chain": [[1, "q.0x0"]]}
        free = {"dim": 1, "order": 0, "chain": [[1, "q.0x0-1"]]}
        torsion = {"dim": 1, "order": 2, "chain": [[1, "q.0x0-1"], [-1, "q.0-1x0"]]}
        compare_with_oracle.check_generators(run.state, found, [point, free, torsion], 0)
        doubled = {"dim": 1, "order": 0, "chain": [[2, "q.0x0-1"]]}
        mislabelled = {"dim": 1, "order": 2, "chain": [[1, "q.0-1x0"]]}
        alias = {"dim": 1, "order": 0, "chain": [[1, "q.0-1x1"]]}
        for bad in ([point, doubled, torsion], [point, free, mislabelled], [point, free], [point, alias, torsion]):
            with self.assertRaises(compare_with_oracle.Difference):
                compare_with_oracle.check_generators(run.state, found, bad, 0)

    def test_every_shipped_example_meets_its_expects(self):
        paths = sorted(glob.glob(os.path.join(EXAMPLES, "*.jsonl")))
        self.assertGreater(len(paths), 20)
        for path in paths:
            with open(path, "rb") as script:
                data = script.read()
            self.assertIn(b'"op":"expect"', data, path)
            self.assertEqual(oracle.replay(data, path)[:2], (0, ""))

    def test_the_menger_example_is_what_its_generator_prints(self):
        command = [sys.executable, os.path.join(HERE, "make_menger.py")]
        printed = subprocess.run(command, capture_output=True, check=True)
        with open(os.path.join(EXAMPLES, "menger_sponge.jsonl"), "rb") as script:
            self.assertEqual(printed.stdout, script.read())


if __name__ == "__main__":
    unittest.main()
