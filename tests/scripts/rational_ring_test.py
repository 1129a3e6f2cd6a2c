#!/usr/bin/env python3
"""Over the rational numbers every command finds the ranks that it finds over the integers, and no torsion.

Usage: rational_ring_test.py SESAME EXAMPLES_DIRECTORY
"""

import fractions
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import random_script
import random_tower

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
IS_HEAVY = "--heavy" in sys.argv  # else a third of the examples, and of random scripts and towers
EXAMPLES = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "replay/examples")


def without_zeros(numbers):
    numbers = list(numbers)
    while numbers and numbers[-1] == 0:
        numbers.pop()
    return numbers


def betti_of(bars, time):
    betti = []
    for dimension, birth, death in bars:
        if birth <= time and (death is None or time < death):
            betti += [0] * (dimension + 1 - len(betti))
            betti[dimension] += 1
    return betti


def boundary(chain):
    """Of a chain as `sesame tower` prints it; labels ascend."""
    total = {}
    for coefficient, labels in chain:
        for k in range(len(labels) if len(labels) > 1 else 0):
            face = tuple(labels[:k] + labels[k + 1:])
            total[face] = total.get(face, 0) + (-1) ** k * fractions.Fraction(coefficient)
    return {face: coefficient for face, coefficient in total.items() if coefficient}


class RationalRing(unittest.TestCase):
    def objects(self, *arguments, text=None):
        done = subprocess.run([SESAME, *map(str, arguments), "--json"], input=text, capture_output=True, text=True,
                              timeout=120, check=False)
        self.assertEqual((arguments, done.returncode), (arguments, 0), done.stderr)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def check_script(self, script, *arguments, text=None):
        """Compares all steps, and the summary as the last of them."""
        rational, integral = [self.objects("replay", script, "--every", "1", "--ring", ring, *arguments, text=text)
                              for ring in ("Q", "Z")]
        self.assertEqual(len(rational), len(integral))
        for over_q, over_z in zip(rational, integral):
            for key in ("summary", "step", "op", "cells", "euler", "betti"):
                self.assertEqual(over_q.get(key), over_z.get(key), (script, over_z.get("step"), key))
            self.assertEqual(sum(over_q["torsion"], []), [])
        self.assertEqual((rational[-1]["ring"], integral[-1]["ring"]), ("Q", "Z"))
        self.assertEqual({g["order"] for g in rational[-1].get("generators", [])} - {0}, set())
        return rational[-1]

    def test_replay_finds_the_same_ranks_after_every_step_of_every_example(self):
        examples = sorted(EXAMPLES.glob("*.jsonl"))
        self.assertGreater(len(examples), 40)
        for script in examples[::1 if IS_HEAVY else 3]:
            self.check_script(script)
            summary = self.check_script(script, "--generators", "--verify")
            self.assertEqual([g["dim"] for g in summary["generators"]],
                             [d for d, rank in enumerate(summary["betti"]) for _ in range(rank)])

    def test_replay_finds_the_same_ranks_in_the_large_examples(self):
        for script in sorted(EXAMPLES.glob("large/*.jsonl")):
            self.check_script(script)

    def test_replay_finds_the_same_ranks_after_every_step_of_random_scripts(self):
        for operations in random_script.WRITERS:
            for seed in range(5 if IS_HEAVY else 2):
                text = random_script.write_script(seed, 30, operations=operations)
                self.check_script("-", "--generators", "--verify", text=text)

    def check_tower(self, path, is_filtration=False):
        (beside,) = self.objects("tower", path, "--rings", "Q,Z/2,Z/3")
        (with_cycles,) = self.objects("tower", path, "--ring", "Q", "--generators")
        (integral,) = self.objects("tower", path, "--ring", "Z")
        bars = beside["rings"][0]["bars"]
        self.assertEqual([ring["ring"] for ring in beside["rings"]], ["Q", "Z/2", "Z/3"])
        self.assertEqual(with_cycles["bars"], bars, path)
        self.assertEqual([[g[key] for key in ("dim", "birth", "death")] for g in with_cycles["generators"]], bars)
        for g in with_cycles["generators"]:
            self.assertEqual((boundary(g["cycle"]), boundary(g.get("now", []))), ({}, {}), path)
            if is_filtration and g["death"] is not None:
                self.assertEqual(boundary(g["bounds"]),
                                 {tuple(labels): fractions.Fraction(c) for c, labels in g["cycle"]}, path)
        for time, groups in integral["groups"]:
            self.assertEqual(without_zeros(betti_of(bars, time)), without_zeros(g["rank"] for g in groups), (path, time))
        has_torsion = any(group["torsion"] for _, groups in integral["groups"] for group in groups)
        if not has_torsion:  # then every field finds the same Betti numbers
            for time, _ in integral["groups"]:
                for ring in beside["rings"][1:]:
                    self.assertEqual(betti_of(ring["bars"], time), betti_of(bars, time), (path, time, ring["ring"]))

    def test_tower_has_bars_with_the_ranks_of_the_groups(self):
        for path in sorted(EXAMPLES.glob("*.tower")):
            self.check_tower(path, is_filtration=path.name == "projective_plane.tower")
        with tempfile.TemporaryDirectory() as folder:
            for seed in range(20 if IS_HEAVY else 6):
                path = pathlib.Path(folder) / f"{seed}.tower"
                operations = random_tower.make(seed, operations=60, vertices=8, any_two=seed % 2 == 1,
                                               contract=0 if seed % 3 == 0 else 0.15)
                path.write_text(random_tower.text(operations, False), encoding="utf-8")
                self.check_tower(path, is_filtration=seed % 3 == 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
