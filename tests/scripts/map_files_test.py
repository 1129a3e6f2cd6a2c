#!/usr/bin/env python3
"""CGAL's map files: what `sesame import` makes of them, and what `sesame export` writes, as a plain reader sees it.

Usage: map_files_test.py SESAME GOLDEN [--heavy]     GOLDEN: the folder of files that CGAL 5.5 has written
"""

import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import gmaps
from map_files import MapFile

SESAME = os.path.abspath(sys.argv[1])
GOLDEN = pathlib.Path(sys.argv[2]).resolve()
IS_HEAVY = "--heavy" in sys.argv
HEADER = '{"sesame":1,"ring":"Z","title":"test"}'

# What CGAL says of its files: dimension, cells, components; and their homology.
KNOWN = {
    "tetrahedron": (3, [4, 6, 4, 1], [1]),
    "cubes": (3, [16, 28, 16, 3], [1]),
    "torus": (2, [1, 2, 1], [1, 2, 1]),
    "moebius": (2, [2, 3, 1], [1, 1]),
}


def run(*arguments, text=None):
    return subprocess.run([SESAME, *map(str, arguments)], input=text, capture_output=True, timeout=300, check=False,
                          text=True)


def script(*steps):
    return "\n".join([HEADER, *map(json.dumps, steps)]) + "\n"


def trimmed(numbers):
    numbers = list(numbers)
    while numbers and not numbers[-1]:
        numbers.pop()
    return numbers


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def imported(self, path, *options):
        done = run("import", path, "--quiet", *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), path)
        return done.stdout

    def exported(self, text, *options):
        done = run("export", "-", "--quiet", *options, text=text)
        self.assertEqual((done.returncode, done.stderr), (0, ""), text)
        return done.stdout

    def state(self, text):
        """Cells, Betti numbers and torsion after a script."""
        done = run("replay", "--json", "-", text=text)
        self.assertEqual(done.returncode, 0, done.stderr + text)
        last = json.loads(done.stdout.splitlines()[-1])
        return trimmed(last["cells"]), trimmed(last["betti"]), trimmed(last["torsion"])

    def refusal(self, text, *options):
        done = run("export", "-", *options, text=text)
        self.assertEqual((done.returncode, done.stdout), (2, ""), text)
        return done.stderr

    def complaint(self, name, content, *options):
        """What is said of a file that is wrong."""
        path = self.folder / name
        path.write_text(content, encoding="utf-8")
        done = run("import", path, *options)
        self.assertEqual((done.returncode, done.stdout), (2, ""), content)
        return done.stderr.replace(str(path), name)


class Golden(Folder):
    def test_files_of_cgal_have_the_cells_that_it_counts(self):
        for name, (dimension, cells, betti) in KNOWN.items():
            text = self.imported(GOLDEN / f"{name}.3map", "--dim", dimension)
            self.assertEqual(json.loads(text.splitlines()[-1]), {"op": "expect", "cells": cells})
            self.assertEqual(self.state(text)[:2], (cells, betti), name)
            self.assertEqual(MapFile((GOLDEN / f"{name}.3map").read_text()).cells(dimension), cells)

    def test_what_was_imported_is_exported_link_for_link(self):
        for name, (dimension, _, _) in KNOWN.items():
            ours = GOLDEN / f"{name}.3map"
            form = "3map-generalized" if name == "moebius" else "3map"
            theirs = MapFile(ours.read_text())
            written = MapFile(self.exported(self.imported(ours, "--dim", dimension), "--format", form))
            self.assertEqual(written.links, theirs.links, name)
            self.assertEqual(written.is_general, theirs.is_general)
            if theirs.points:
                self.assertEqual(written.points_of_vertices(dimension), theirs.points_of_vertices(dimension))

    def test_the_dimension_is_that_of_the_name_or_what_is_said(self):
        text = (GOLDEN / "torus.3map").read_text()
        for name, options, dimension in [("t.2map", [], 2), ("t.4map", ["--dim", "2"], 2), ("t.xml", [], 2)]:
            (self.folder / name).write_text(text)
            made = json.loads(self.imported(self.folder / name, *options).splitlines()[1])
            self.assertEqual(len(made["beta"]), dimension, name)
        # As a 3-map it has a volume that no sphere bounds.
        self.assertIn("--simplices takes it", self.complaint("t.3map", text))
        made = self.imported(self.folder / "t.3map", "--simplices")
        self.assertEqual(self.state(made)[1], [1, 0, 0, 0][:1])
        self.assertIn("the dimension should be 1: --dim says which it is", self.complaint("t.3map", text, "--dim", "1"))

    def test_a_file_may_come_packed_or_through_standard_input(self):
        text = (GOLDEN / "tetrahedron.3map").read_text()
        done = run("import", "-", "--format", "map", "--dim", "3", "--quiet", text=text)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[1:][-1], self.imported(GOLDEN / "tetrahedron.3map").splitlines()[-1])
        self.assertIn("--format map", run("import", "-", text=text).stderr)
        self.assertIn("a map file is no mesh", run("mesh", GOLDEN / "tetrahedron.3map").stderr)

    def test_what_is_left_out_is_said(self):
        text = (GOLDEN / "tetrahedron.3map").read_text()
        for old, new, said in [
                ("<attributes>", '<attributes><dimension index="3"><type>i</type></dimension>', "attributes of dimension"),
                ("<attributes>", "<colours/><attributes>", 'the element `colours`'),
                ("<d><b", "<d><v>7</v><b", "the values of darts"),
                ("<p><x>1</x><y>0</y><z>0</z></p>", "", "not every vertex has a point")]:
            (self.folder / "m.3map").write_text(text.replace(old, new, 1))
            done = run("import", self.folder / "m.3map")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(said, done.stderr)
            self.assertIn("darts: 4 vertices, 6 edges, 4 faces, 1 volume", done.stderr)


class Wrong(Folder):
    def test_a_file_that_is_cut_is_refused_with_its_line(self):
        for name in KNOWN:
            text = (GOLDEN / f"{name}.3map").read_text().replace("<d>", "\n<d>")
            for end in range(0, len(text) - 7, 1 if IS_HEAVY else 41):
                said = self.complaint("cut.3map", text[:end], "--dim", "3")
                self.assertRegex(said, r"^cut\.3map:\d+: ", text[:end])

    def test_each_law_that_is_broken_is_named_with_its_line(self):
        text = (GOLDEN / "tetrahedron.3map").read_text().replace("<d>", "\n<d>").replace("<a>", "\n<a>")
        for old, new, said in [
                ('<b i="2">4</b>', '<b i="2">13</b>', 'm.3map:3: a link of dart 1 leads to `13`: it should be the number '
                                                      "of a dart, from 1 to 12"),
                ('<b i="2">4</b>', '<b i="2">0</b>', 'leads to `0`'),
                ('<b i="2">4</b>', '<b i="2">-4</b>', 'leads to `-4`'),
                ('<b i="2">4</b>', '<b i="2">four</b>', 'leads to `four`'),
                ('<b i="2">4</b>', '<b i="2"/>', "leads to nothing"),
                ('<b i="2">4</b>', '<b i="2">5</b>', "m.3map:3: beta_2 sends dart 1 to dart 5, and that one to dart 10: it "
                                                     "should be sent back"),
                ('<b i="2">4</b>', "", "m.3map:6: beta_2 sends dart 4 to dart 1, and that one nowhere"),
                ('<b i="2">4</b>', '<b i="2">4</b><b i="2">4</b>', "m.3map:3: dart 1 has two links with index 2"),
                ('<b i="2">4</b>', '<b i="0">4</b>', '`i` should be a number from 1 to 30'),
                ('<b i="2">4</b>', "<b>4</b>", "has the index nothing"),
                ('<b i="2">4</b>', '<a i="2">4</a>', "m.3map:3: dart 1 has a link `a`, and there are links `b` before"),
                ('<b i="1">2</b>', '<b i="1">1</b>', "beta_1 sends darts"),
                ("<d>6</d>", "<d>66</d>", "an attribute has the dart"),
                ("<x>1</x>", "<x>one</x>", "the point of dart 2, `x`: "),
                ("<x>1</x>", "", "the point of dart 2, `x`: "),
                ("<d>2</d>", "<d>1</d>", "dart 1 has another point than dart 1, and both are at one vertex"),
                ("<darts>", "<dart>", "this is no XML"),
                ("<d>6</d>", "<d>6", "this is no XML")]:
            self.assertIn(old, text)
            self.assertIn(said, self.complaint("m.3map", text.replace(old, new, 1)), new)
        for content, said in [("", "this is no XML"), ("<data/>", "m.3map:1: there is no element `darts`"),
                              ("<data><darts/></data>", "m.3map:1: there are no darts"),
                              ("<html>\n<darts/></html>", "m.3map:1: there is no element `darts`"),
                              ("<data><darts><d/></darts></data>" + "<x>" * 100_000, "this is no XML")]:
            self.assertIn(said, self.complaint("m.3map", content))
        general = (GOLDEN / "moebius.3map").read_text()
        self.assertIn("alpha_0 alpha_2 is no involution", self.complaint("m.3map", general.replace(
            '<a i="2">5</a>', '<a i="2">6</a>').replace('<a i="2">6</a></d><d><a i="0">4', '<a i="2">3</a></d><d><a i="0">4')
            .replace('<a i="0">4</a><a i="1">2</a>', '<a i="0">4</a><a i="1">2</a><a i="2">2</a>')
            .replace('<a i="2">1</a>', "").replace('<a i="2">2</a></d><d><a i="0">8', '<a i="2">1</a></d><d><a i="0">8')))

    def test_options_are_those_of_map_files(self):
        for options, said in [(["--cells"], "--cells is for meshes"), (["--assemble"], "--assemble is for meshes"),
                              (["--weld", "1"], "--weld is for meshes of polygons"), (["--dim", "-1"], "--dim")]:
            done = run("import", GOLDEN / "torus.3map", *options)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertIn(said, done.stderr)


SQUARES = [{"op": "polygon", "name": "a", "sides": 4}, {"op": "polygon", "name": "b", "sides": 4}]
SEWN = {"op": "sew", "dim": 2, "pairs": [["a:2", "b:7"]]}


class Refusals(Folder):
    def test_what_is_no_map_is_refused_with_what_it_is(self):
        for steps, said in [
                ([], "there is none"),
                ([{"op": "simplex", "name": "t", "dim": 2}], "there is none"),
                ([*SQUARES, {"op": "simplex", "name": "t", "dim": 0}], '"t" is none of the cells of its maps'),
                ([*SQUARES, {"op": "identify", "pairs": [["a.0:0", "b.0:0"]]}], "was glued, but not by sewing"),
                ([*SQUARES, {"op": "identify", "pairs": [["a.1:2", "b.1:7"]]}], "was glued, but not by sewing"),
                ([{"op": "polygon", "name": "a", "sides": 1}, {"op": "degenerate", "cell": "a.1:0", "along": 0}], "was squashed"),
                ([*SQUARES, {"op": "remove", "cells": ["a"]}], "was removed"),
                ([*SQUARES, SEWN, {"op": "deidentify", "split": [{"cell": "a.1:2", "as": "e", "moves": [["b", 3]]}]}],
                 "has not the face that"),
                ([*SQUARES, {"op": "deidentify", "split": [{"cell": "a", "as": "x", "moves": []}]}],
                 '"x" is none of the cells of its maps'),
                ([*SQUARES, {"op": "cone", "apex": "v", "over": ["a.0:0"]}], "is none of the cells of its maps"),
                ([*SQUARES, {"op": "gmap", "name": "m", "alpha": [[1, 0], [0, 1]]}],
                 '"m" is a map of dimension 1, and there is one of dimension 2')]:
            for form in ("3map", "3map-generalized"):
                self.assertIn(said, self.refusal(script(*steps), "--format", form), steps)

    def test_a_split_that_is_hidden_by_a_gluing_is_noticed(self):
        # Two edges in a row: the middle becomes two, and one of these is glued to an end. There are as many vertices as before.
        steps = [{"op": "gmap", "name": "m", "alpha": [[1, 0, 3, 2], [0, 2, 1, 3]]},
                 {"op": "deidentify", "split": [{"cell": "m.0:1", "as": "x", "moves": [["m.1:2", 0]]}]},
                 {"op": "identify", "pairs": [["x", "m.0:0"]]}]
        self.assertIn("was split", self.refusal(script(*steps), "--format", "3map"))

    def test_what_was_taken_back_leaves_no_trace(self):
        plain = self.exported(script(*SQUARES, SEWN), "--format", "3map")
        for steps in ([*SQUARES, SEWN, {"op": "remove", "cells": ["a"]}, {"op": "undo", "steps": 1}],
                      [*SQUARES, {"op": "polygon", "name": "c", "sides": 3}, {"op": "remove", "cells": ["c"],
                                                                             "cofaces": True},
                       {"op": "remove", "cells": ["c.1:0", "c.1:2", "c.1:4"]},
                       {"op": "remove", "cells": ["c.0:0", "c.0:2", "c.0:4"]}, SEWN],
                      [*SQUARES, SEWN, {"op": "unsew", "dim": 2, "darts": ["a:2"]}, SEWN],
                      [*SQUARES, SEWN, {"op": "extend", "maps": []}, {"op": "undo", "steps": 1}][:3]):
            self.assertEqual(self.exported(script(*steps), "--format", "3map"), plain, steps)

    def test_what_has_no_orientation_is_written_as_a_generalized_map_only(self):
        strip = script(SQUARES[0], {"op": "sew", "dim": 2, "pairs": [["a:2", "a:6"]]})
        self.assertIn('what "a:0" belongs to is not orientable, and a combinatorial map is; --format 3map-generalized can '
                      "hold it", self.refusal(strip, "--format", "3map"))
        self.assertEqual(MapFile(self.exported(strip, "--format", "3map-generalized")).cells(2), [2, 3, 1])
        free = script({"op": "gmap", "name": "m", "alpha": [[0, 1], [1, 0]], "as": "simplices"})
        self.assertIn('"m:0" is 0-free', self.refusal(free, "--format", "3map"))

    def test_positions_are_written_when_all_are_known(self):
        at = [[k, k * k, 0.1] for k in range(4)]
        text = script({**SQUARES[0], "at": at})
        self.assertEqual(MapFile(self.exported(text, "--format", "3map")).points_of_vertices(2),
                         sorted(map(tuple, at)))
        done = run("export", "-", "--format", "3map", text=script({**SQUARES[0], "at": at}, SQUARES[1]))
        self.assertEqual(done.returncode, 0)
        self.assertEqual(MapFile(done.stdout).points, {})
        self.assertIn("4 of the vertices have no position, so none is written", done.stderr)


class Random(Folder):
    def random_steps(self, seed):
        """Polygons and solids, sewn at random as far as that is possible."""
        draw = random.Random(seed)
        form = {"as": "simplices"} if seed % 3 == 0 else {}
        steps, darts = [], []
        dimension = 2 + seed % 2
        for k in range(draw.randint(1, 5)):
            name = f"m{k}"
            if dimension == 2:
                sides = draw.randint(2, 6)
                steps.append({"op": "polygon", "name": name, "sides": sides, **form})
                darts += [f"{name}:{d}" for d in range(2 * sides)]
            else:
                alpha = gmaps.gmap_of(draw.choice(SOLIDS))
                alpha.append(list(range(len(alpha[0]))))
                steps.append({"op": "gmap", "name": name, "alpha": alpha, **form})
                darts += [f"{name}:{d}" for d in range(len(alpha[0]))]
        for _ in range(10):
            steps.append({"op": "sew", "dim": dimension, "pairs": [draw.sample(darts, 2)]})
        return dimension, steps, "--simplices" if form else None

    def test_objects_of_random_maps_go_out_and_come_back(self):
        orientable = 0
        for seed in range(300 if IS_HEAVY else 24):
            dimension, steps, as_simplices = self.random_steps(seed)
            log = self.folder / "log.jsonl"
            run("replay", "-", "--quiet", "--keep-going", "--log", log, "--overwrite", text=script(*steps))
            text = run("export", log, "--format", "script").stdout
            state = self.state(text)
            for form in ("3map", "3map-generalized"):
                done = run("export", "-", "--quiet", "--format", form, text=text)
                if form == "3map" and done.returncode == 2:
                    self.assertRegex(done.stderr, "is not orientable|has one image under alpha_0 and alpha_")
                    continue
                self.assertEqual((done.returncode, done.stderr), (0, ""), text)
                file = MapFile(done.stdout)
                self.assertEqual(file.is_general, form != "3map")
                orientable += form == "3map"
                path = self.folder / "out.3map"
                path.write_text(done.stdout)
                back = self.imported(path, "--dim", dimension, *([as_simplices] if as_simplices else []))
                self.assertEqual(self.state(back), state, seed)
                if not as_simplices:
                    self.assertEqual(file.cells(dimension), state[0], seed)
        self.assertGreater(orientable, 5)


def solid(faces):
    """The 2-map of a polyhedron whose faces are turned the same way."""
    darts = {(face[k], face[(k + 1) % len(face)]): None for face in faces for k in range(len(face))}
    number = {side: k for k, side in enumerate(darts)}
    following = [0] * len(number)
    for face in faces:
        sides = [number[face[k], face[(k + 1) % len(face)]] for k in range(len(face))]
        for k, side in enumerate(sides):
            following[side] = sides[(k + 1) % len(sides)]
    return [following, [number[b, a] for a, b in darts]]


SOLIDS = [solid([(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]), solid([(0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3),
                                                                      (3, 4, 0)]),
          solid([(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)])]

if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
