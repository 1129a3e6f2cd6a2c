#!/usr/bin/env python3
"""Objects with the numbers of a published table, by cells and by simplices: alike after every step.

    table_of_maps_test.py SESAME [--heavy]

The numbers of cells and simplices are counted here too, as orbits of the darts that a script has sewn.
"""

import itertools
import json
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import gmaps
import table_of_maps

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
IS_HEAVY = "--heavy" in sys.argv  # else the laws of one of them are checked, over the integers only


def sewn_map(lines):
    """The G-map that the steps of a script make, as lists of involutions; sewn the plain way."""
    first, alpha = {}, []
    for step in lines:
        if step.get("op") in ("polygon", "gmap"):
            own = step.get("alpha") or gmaps.polygon(step["sides"])
            alpha = alpha or [[] for _ in own]
            start = first[step["name"]] = len(alpha[0])
            for images, more in zip(alpha, own):
                images += [start + image for image in more]
        for one, other in step.get("pairs", []):
            pairs = [tuple(first[name] + int(dart) for name, dart in (d.split(":") for d in (one, other)))]
            for a, b in pairs:
                if alpha[-1][a] == a:
                    alpha[-1][a], alpha[-1][b] = b, a
                    pairs += [(images[a], images[b]) for images in alpha[:-2]]
    return alpha


def counts(alpha):
    """How many cells of each dimension a map has, and how many simplices of its analogue."""
    cells = [len(gmaps.orbits(alpha, gmaps.all_but(alpha, i))) for i in range(len(alpha))]
    simplices = [sum(len(gmaps.orbits(alpha, gmaps.all_but(alpha, *numbers)))
                     for numbers in itertools.combinations(range(len(alpha)), size + 1)) for size in range(len(alpha))]
    return cells, simplices


def groups(step):
    return step["betti"], step["torsion"], step["euler"]


class TableOfMaps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.written = table_of_maps.write_scripts(pathlib.Path(folder.name))

    def test_the_darts_have_the_numbers_of_the_table(self):
        for thing, *paths in self.written:
            for path in paths:
                alpha = sewn_map([json.loads(line) for line in path.read_text().splitlines()])
                self.assertIsNone(gmaps.broken_law(alpha))
                self.assertEqual(counts(alpha), (thing.cells, thing.simplices), path.name)

    def test_cells_and_simplices_have_the_same_groups_after_every_step(self):
        for thing, *paths in self.written:
            by_cells, by_simplices = (table_of_maps.replayed(SESAME, path) for path in paths)
            self.assertEqual(by_cells[-1]["op"], "expect")
            self.assertEqual(by_cells[-1]["cells"], thing.cells)
            self.assertEqual(by_simplices[-1]["cells"], thing.simplices)
            self.assertEqual([groups(step) for step in by_cells], [groups(step) for step in by_simplices],
                             thing.name)
            for one, other in zip(by_cells, by_simplices):
                self.assertLess(sum(one["big"]), sum(other["big"]))

    def test_a_number_beside_the_table_is_not_what_is_there(self):
        thing, path, _ = self.written[0]
        self.assertEqual(thing.cells, [151, 295, 142])
        misprinted = path.read_text().replace('"cells":[151,295,142]', '"cells":[151,294,142]')
        other = path.with_name("misprinted.jsonl")
        other.write_text(misprinted)
        with self.assertRaises(SystemExit) as failure:
            table_of_maps.replayed(SESAME, other)
        self.assertIn("cells should be [151,294,142] but is [151,295,142]", str(failure.exception))

    def test_every_law_holds(self):
        for thing, path, _ in self.written:
            if IS_HEAVY or thing.name == "menger_sponge":
                table_of_maps.replayed(SESAME, path, "--verify")

    def test_other_rings_tell_cells_and_simplices_the_same(self):
        for thing, *paths in self.written:
            for ring in ("Z/2", "Z/3") if IS_HEAVY else ("Z/2",):
                found = []
                for path in paths:
                    bare = path.with_suffix(".bare")
                    bare.write_text("".join(line for line in path.read_text().splitlines(True)
                                            if '"op":"expect"' not in line))
                    found.append([groups(step) for step in table_of_maps.replayed(SESAME, bare, "--ring", ring)])
                self.assertEqual(*found, thing.name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
