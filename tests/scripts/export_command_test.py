#!/usr/bin/env python3
"""What `sesame export` writes, read again: matrices by a Smith form of another make and by `sesame tower`, scripts and
facets by `sesame replay`, drawings by plain readers that know nothing of sesame.

Usage: export_command_test.py SESAME EXAMPLES
"""

import gzip
import json
import math
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.dont_write_bytecode = True
import oracle
import random_script

SESAME = os.path.abspath(sys.argv[1])
EXAMPLES = pathlib.Path(sys.argv[2]).resolve()
IS_HEAVY = "--heavy" in sys.argv  # else a fifth of the examples, and of random scripts one of each kind
SCRIPTS = sorted(EXAMPLES.glob("*.jsonl"))
SOME_SCRIPTS = SCRIPTS[::1 if IS_HEAVY else 5]
HEADER = '{"sesame":1,"ring":"Z","title":"test"}\n'
CORNERS = {0: 0, 1: 1, 3: 2, 5: 3, 9: 4, 10: 4, 12: 8, 13: 6}  # of VTK's types of cells; polygons have any number
DIMENSION = {1: 0, 3: 1, 5: 2, 9: 2, 10: 3, 12: 3, 13: 3, 7: 2, 0: 3}


def run(*arguments, text=None, **options):
    encoding = {} if isinstance(text, bytes) else {"text": True}
    return subprocess.run([SESAME, *map(str, arguments)], input=text, capture_output=True, timeout=120, check=False,
                          **encoding, **options)


def trimmed(numbers):
    numbers = list(numbers)
    while numbers and not numbers[-1]:
        numbers.pop()
    return numbers


def random_scripts():
    for operations in ("basic", "all", "tear", "nest", "abstract", "maps"):
        for seed in range(1, 9 if IS_HEAVY else 2):
            yield f"{operations} {seed}", random_script.write_script(seed, 25, operations=operations)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def export(self, script, form, *arguments):
        """The text of an export of a file, or of a script that is a text."""
        text = script if isinstance(script, str) else None
        done = run("export", "-" if text else script, "--format", form, "--quiet", *arguments, text=text)
        self.assertEqual((done.returncode, done.stderr), (0, ""), script)
        return done.stdout

    def summary(self, script, *arguments):
        text = script if isinstance(script, str) else None
        done = run("replay", "--json", "-" if text else script, *arguments, text=text)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout.splitlines()[-1])
        del found["seconds"]
        return found

    def boundaries(self, script):
        """The names of the cells of each dimension, and of each boundary matrix from dimension 1 on the columns, as
        {row: entry}."""
        prefix = self.folder / "m"
        text = script if isinstance(script, str) else None
        done = run("export", "-" if text else script, "--format", "matrix-market", "-o", prefix, text=text)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        bases, matrices = [], []
        while (path := self.folder / f"m.{len(matrices) + 1}.mtx").exists():
            head, *lines = path.read_text(encoding="utf-8").splitlines()
            self.assertEqual(head, "%%MatrixMarket matrix coordinate integer general")
            comments = [line for line in lines if line.startswith("%")]
            rows, columns, entries = map(int, lines[len(comments)].split())
            names = {"row": [], "column": []}
            for line in comments[2:]:
                what, number, name = re.fullmatch(r"% (row|column) (\d+): (\S+)", line).groups()
                names[what].append(name)
                self.assertEqual(int(number), len(names[what]))
            self.assertEqual((len(names["row"]), len(names["column"])), (rows, columns))
            matrix = [{} for _ in range(columns)]
            for line in lines[len(comments) + 1:]:
                row, column, value = map(int, line.split())
                self.assertTrue(1 <= row <= rows and 1 <= column <= columns and value != 0)
                self.assertNotIn(row - 1, matrix[column - 1])
                matrix[column - 1][row - 1] = value
                entries -= 1
            self.assertEqual(entries, 0)
            self.assertIn(names["row"], bases[-1:] or [names["row"]])
            bases = (bases or [names["row"]]) + [names["column"]]
            matrices.append(matrix)
            path.unlink()
        return bases, matrices

    def assert_cycle(self, matrix, chain):
        """That the boundary of a chain, coefficients by column, is zero."""
        total = {}
        for coefficient, column in zip(chain, matrix):
            for row, value in column.items():
                total[row] = total.get(row, 0) + value * coefficient
        self.assertFalse(any(total.values()))


def parts_in(basis):
    """How many generators of a basis are parts of cells that are no balls, and no cells."""
    return sum("~" in name for name in basis)


class Matrices(Folder):
    def check_matrices(self, script):
        """Matrix Market against the groups and generators of a replay over Z, and boundaries of boundaries against
        zero."""
        bases, matrices = self.boundaries(script)
        sizes = list(map(len, bases))
        for lower, upper in zip(matrices, matrices[1:]):
            for column in upper:
                self.assert_cycle([lower[row] for row in column], column.values())
        factors = [[], *map(oracle.invariant_factors, matrices), []]
        betti = [size - len(factors[p]) - len(factors[p + 1]) for p, size in enumerate(sizes)]
        torsion = [[t for t in factors[p + 1] if t > 1] for p in range(len(sizes))]
        expected = self.summary(script, "--ring", "Z", "--generators")
        for generator in expected["generators"]:
            if (degree := generator["dim"]) > 0:
                chain = {name: int(coefficient) for coefficient, name in generator["chain"]}
                self.assert_cycle(matrices[degree - 1], [chain.get(name, 0) for name in bases[degree]])
        self.assertEqual(trimmed([len(basis) - parts_in(basis) for basis in bases]), expected["cells"])
        self.assertEqual((trimmed(betti), trimmed(torsion)), (trimmed(expected["betti"]), trimmed(expected["torsion"])))

    def test_matrix_market_has_the_groups_of_every_example(self):
        for script in SOME_SCRIPTS:
            with self.subTest(script=script.name):
                self.check_matrices(script)

    def test_matrix_market_has_the_groups_of_random_scripts(self):
        for name, script in random_scripts():
            with self.subTest(script=name):
                self.check_matrices(script)

    def test_one_dimension_goes_to_standard_output(self):
        self.export(EXAMPLES / "torus.jsonl", "matrix-market", "--dim", "2", "-o", self.folder / "two")
        self.assertEqual(self.export(EXAMPLES / "torus.jsonl", "matrix-market", "--dim", "2"),
                         (self.folder / "two").read_text(encoding="utf-8"))
        done = run("export", EXAMPLES / "torus.jsonl", "--format", "matrix-market", "--dim", "3")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("--dim should be at most 2", done.stderr)

    def check_phat(self, script):
        text = script if isinstance(script, str) else None
        open_bars = {}
        for form in ("phat", "phat-binary"):
            path = self.folder / form
            done = run("export", "-" if text else script, "--format", form, "-o", path, text=text)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            found = run("tower", "--format", form, "--json", path)
            self.assertEqual((found.returncode, found.stderr), (0, ""))
            open_bars[form] = json.loads(found.stdout)["bars"]
        self.assertEqual(open_bars["phat"], open_bars["phat-binary"])
        expected = self.summary(script, "--ring", "Z/2")
        infinite = [dim for dim, _, death in open_bars["phat"] if death is None]
        self.assertEqual([infinite.count(p) for p in range(len(expected["cells"]))], expected["betti"])
        lines = (self.folder / "phat").read_text(encoding="utf-8").splitlines()
        dimensions = [int(line.split()[0]) for line in lines]
        self.assertEqual(dimensions, sorted(dimensions))
        parts = [parts_in(basis) for basis in self.boundaries(script)[0]]
        self.assertEqual([dimensions.count(p) - parts[p] for p in range(len(expected["cells"]))], expected["cells"])
        words = [len(lines)]
        for line in lines:
            dimension, *rows = map(int, line.split())
            words += [dimension, len(rows), *rows]
        self.assertEqual((self.folder / "phat-binary").read_bytes(), struct.pack(f"={len(words)}q", *words))

    def test_open_bars_of_boundary_matrices_are_the_betti_numbers_mod_2_of_every_example(self):
        for script in SOME_SCRIPTS:
            if self.summary(script)["cells"]:
                with self.subTest(script=script.name):
                    self.check_phat(script)

    def test_open_bars_of_boundary_matrices_are_the_betti_numbers_mod_2_of_random_scripts(self):
        for name, script in random_scripts():
            if self.summary(script)["cells"]:
                with self.subTest(script=name):
                    self.check_phat(script)

    def test_an_even_incidence_is_none_mod_2(self):
        loop = HEADER + '{"op":"complex","name":"K","cells":[{"id":"v"},{"id":"e","faces":["v","v"]},' \
            '{"id":"f","faces":["e","e"],"type":[2]}]}\n'
        text = loop.replace('["e","e"],"type":[2]', '["e","f0","e"]').replace(
            '{"id":"f",', '{"id":"f0","faces":["v","v"]},{"id":"f",')
        self.assertEqual(self.export(text, "phat"), "0\n1\n1\n2 2\n")
        self.assertTrue(self.export(text, "matrix-market", "--dim", "2").endswith("\n2 1 2\n1 1 2\n2 1 -1\n"))


class Facets(Folder):
    def check_facets(self, script):
        """Whether the object has facets; then replay, tower and import have the same groups from them."""
        text = script if isinstance(script, str) else None
        done = run("export", "-" if text else script, "--format", "facets", text=text)
        expected = self.summary(script, "--ring", "Z")
        if done.returncode != 0:
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))
            self.assertRegex(done.stderr, "is no simplicial complex, .*\"|the object has no cells")
            return False
        path = self.folder / "facets"
        path.write_text(done.stdout, encoding="utf-8")
        found = self.summary(path)
        for field in ("cells", "euler", "betti", "torsion"):
            self.assertEqual(found[field], expected[field])
        tower = run("tower", "--json", "--ring", "Z", path)
        self.assertEqual((tower.returncode, tower.stderr), (0, ""))
        groups = json.loads(tower.stdout)["groups"][-1][1]
        self.assertEqual(trimmed(group["rank"] for group in groups), trimmed(expected["betti"]))
        imported = run("import", "--quiet", path)
        self.assertEqual((imported.returncode, imported.stderr), (0, ""))
        self.assertEqual(self.summary(imported.stdout)["betti"], expected["betti"])
        return True

    def test_facets_have_the_groups_of_every_example_that_is_a_simplicial_complex(self):
        self.assertGreater(sum(self.check_facets(script) for script in SOME_SCRIPTS), 10 if IS_HEAVY else 0)

    def test_facets_have_the_groups_of_random_scripts_that_make_simplicial_complexes(self):
        self.assertGreater(sum(self.check_facets(script) for _, script in random_scripts()), 8 if IS_HEAVY else 0)

    def test_labels_that_are_integers_are_kept_and_other_names_are_comments(self):
        inserted = HEADER + '{"op":"insert","simplices":[[10,3],[3,7,18446744073709551615],[5]]}\n'
        self.assertEqual(self.export(inserted, "facets"),
                         "# a simplicial complex of dimension 2: 5 vertices, 3 facets\n"
                         "[[5],\n [3,10],\n [3,7,18446744073709551615]]\n")
        for label in ('"a"', '"007"', '"18446744073709551616"'):
            text = self.export(HEADER + '{"op":"insert","simplex":[10,%s]}\n' % label, "facets")
            self.assertTrue(text.endswith('\n[[0,1]]\n# 0: {10}\n# 1: {%s}\n' % label.strip('"')), text)

    def test_many_vertices_with_names_are_found_to_be_a_list_of_facets(self):
        text = HEADER + json.dumps({"op": "complex", "name": "K", "cells": [{"id": f"v{k}"} for k in range(5000)]})
        path = self.folder / "facets"
        self.export(text, "facets", "-o", path)
        self.assertEqual(self.summary(path)["cells"], [5000])
        self.assertEqual(run("tower", "--quiet", path).returncode, 0)

    def test_a_collapsed_vertex_is_called_by_the_label_that_it_has(self):
        text = HEADER + '{"op":"insert","simplices":[[1,2],[2,3],[3,4],[1,4]]}\n{"op":"collapse","from":4,"to":1}\n'
        self.assertTrue(self.export(text, "facets").endswith("\n[[1,2],\n [2,3],\n [1,3]]\n"))

    def test_what_is_in_the_way_is_named(self):
        cases = {'{"op":"simploid","name":"q","type":[1,1]}': '"q" is a cube of dimension 2, and should be a simplex',
                 '{"op":"simplex","name":"e","dim":1}\n{"op":"identify","pairs":[["e.0","e.1"]]}':
                     '"e" has the vertex "e.0" more than once',
                 '{"op":"complex","name":"K","cells":[{"id":"a"},{"id":"b"},{"id":"e","faces":["b","a"]},'
                 '{"id":"f","faces":["a","b"]}]}': '"K.e" and "K.f" have the same vertices'}
        for steps, what in cases.items():
            done = run("export", "-", "--format", "facets", text=HEADER + steps + "\n")
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(what, done.stderr)


class Scripts(Folder):
    def check_script(self, script):
        plain = self.export(script, "script")
        self.assertNotIn("\n#", "\n" + plain)
        self.assertEqual(self.summary(plain), self.summary(script))
        self.assertEqual(self.export(plain, "script"), plain)
        expected = self.summary(script)
        without = self.export(script, "script", "--without-undone")
        self.assertNotIn('"op":"undo"', without)
        found = self.summary(without)
        self.assertEqual(found.pop("steps"), len(without.splitlines()) - 1)
        expected.pop("steps")
        for of in (found, expected):
            of.pop("already", None)  # counts undone steps too
        self.assertEqual(found, expected)

    def test_every_example_is_the_same_as_a_plain_script(self):
        for script in SOME_SCRIPTS:
            with self.subTest(script=script.name):
                self.check_script(script)

    def test_random_scripts_are_the_same_as_plain_scripts(self):
        for name, script in random_scripts():
            with self.subTest(script=name):
                self.check_script(script)

    def test_what_an_undo_takes_back_is_left_out_whatever_the_step(self):
        def vertex(name):
            return '{"op":"simplex","name":"%s","dim":0}\n' % name
        undo = '{"op":"undo","steps":%d}\n'
        text = HEADER + "# a comment\n" + vertex("a") + vertex("b") + '{"op":"note","text":"x"}\n' + undo % 2 + \
            vertex("c") + '{"op":"expect","cells":[2]}\n' + vertex("d") + undo % 1 + undo % 1 + vertex("e")
        self.assertEqual(self.export(text, "script", "--without-undone"),
                         HEADER + vertex("a") + vertex("c") + vertex("e"))
        self.assertEqual(self.export(text, "script"), text.replace("# a comment\n", ""))
        self.assertEqual(self.export(text, "script", "--until", "4", "--without-undone"), HEADER + vertex("a"))
        done = run("export", "-", "--format", "script", "--without-undone", text=HEADER + vertex("a") + undo % 2)
        self.assertEqual(done.returncode, 2)
        self.assertIn("standard input:3: there are 1 steps that can be undone", done.stderr)

    def test_a_log_that_is_packed_is_read(self):
        path = self.folder / "log.gz"
        path.write_bytes(gzip.compress((EXAMPLES / "torus.jsonl").read_bytes()))
        for form in ("script", "phat", "obj"):
            self.assertEqual(self.export(path, form), self.export(EXAMPLES / "torus.jsonl", form))


def numbers(text):
    return [float(word) for word in text.split()]


class Drawings(Folder):
    """Of the examples that have positions."""

    def drawn(self):
        for script in SOME_SCRIPTS:
            done = run("export", script, "--format", "vtk")
            if done.returncode == 0:
                yield script, done.stdout
            else:
                self.assertEqual((script.name, done.returncode, done.stdout), (script.name, 2, ""))
                self.assertRegex(done.stderr, r'the vertex "\S+" has no position, and a drawing needs one of each')

    def read_vtu(self, text):
        root = xml.etree.ElementTree.fromstring(text)
        self.assertEqual((root.tag, root.get("type")), ("VTKFile", "UnstructuredGrid"))
        piece = root.find("UnstructuredGrid/Piece")
        arrays = {array.get("Name"): numbers(array.text or "") for array in piece.iter("DataArray")}
        points, cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
        self.assertEqual(len(arrays["positions"]), 3 * points)
        offsets = [0, *map(int, arrays["offsets"])]
        connectivity = list(map(int, arrays["connectivity"]))
        types = list(map(int, arrays["types"]))
        self.assertEqual([b - a for a, b in zip(offsets, offsets[1:])],
                         [CORNERS.get(each, b - a) for each, a, b in zip(types, offsets, offsets[1:])])
        self.assertEqual([int(d) for d in arrays["dimension"]], [DIMENSION[each] for each in types])
        self.assertTrue(all(0 <= k < points for k in connectivity))
        data = {array.get("Name"): numbers(array.text or "") for array in piece.iterfind("CellData/DataArray")}
        self.assertEqual({len(each) for each in data.values()}, {cells})
        return points, types, data

    def read_vtk(self, text):
        words = text.splitlines()
        self.assertTrue(words[0].startswith("# vtk DataFile Version 3.0"))
        self.assertEqual(words[2:4], ["ASCII", "DATASET UNSTRUCTURED_GRID"])
        rest = iter(words[4:])
        points = int(next(rest).split()[1])
        for _ in range(points):
            self.assertEqual(len(numbers(next(rest))), 3)
        _, cells, size = next(rest).split()
        lists = [list(map(int, next(rest).split())) for _ in range(int(cells))]
        self.assertEqual(sum(map(len, lists)), int(size))
        self.assertEqual(next(rest), f"CELL_TYPES {cells}")
        types = [int(next(rest)) for _ in lists]
        self.assertEqual([each[0] for each in lists],
                         [CORNERS.get(each, among[0]) for each, among in zip(types, lists)])
        self.assertTrue(all(len(each) == each[0] + 1 and max(each[1:], default=-1) < points for each in lists))
        self.assertEqual(next(rest), f"CELL_DATA {cells}")
        data = {}
        for line in rest:
            name = re.fullmatch(r"SCALARS (\S+) (int|double) 1", line)[1]
            self.assertEqual(next(rest), "LOOKUP_TABLE default")
            data[name] = [float(next(rest)) for _ in types]
        return points, types, data

    def test_grids_have_the_cells_of_the_object_and_generators_that_are_cycles(self):
        count = 0
        for script, text in self.drawn():
            with self.subTest(script=script.name):
                expected = self.summary(script, "--generators")
                points, types, data = self.read_vtu(self.export(script, "vtu"))
                self.assertEqual(self.read_vtk(text), (points, types, data))
                cells = expected["cells"][:4] or [0]
                self.assertEqual(points, cells[0])
                dimensions = list(map(DIMENSION.get, types))
                self.assertEqual([dimensions.count(p) for p in range(len(cells))], cells)
                generators = [g for g in expected["generators"] if g["dim"] <= 3]
                names = [name for name in data if name != "dimension"]
                self.assertEqual([int(name[1:name.index("_")]) for name in names], [g["dim"] for g in generators])
                _, matrices = self.boundaries(script)
                for name, generator in zip(names, generators):
                    degree = generator["dim"]
                    chain = [c for c, d in zip(data[name], dimensions) if d == degree]
                    self.assertFalse(any(c for c, d in zip(data[name], dimensions) if d != degree))
                    self.assertEqual(sorted(map(float, filter(None, chain))),
                                     sorted(float(coefficient) for coefficient, _ in generator["chain"]))
                    if degree > 0 and expected["ring"] == "Z":
                        self.assert_cycle(matrices[degree - 1], chain)
                count += 1
        self.assertGreater(count, 20 if IS_HEAVY else 2)

    def test_a_generator_mod_p_has_coefficients_from_0_on_and_degrees_can_be_chosen(self):
        data = self.read_vtu(self.export(EXAMPLES / "projective_plane.jsonl", "vtu", "--ring", "Z/2"))[2]
        self.assertEqual(list(data), ["dimension", "H0_0", "H1_0", "H2_0"])
        self.assertEqual({x for name in ("H1_0", "H2_0") for x in data[name]}, {0, 1})
        data = self.read_vtu(self.export(EXAMPLES / "torus.jsonl", "vtu", "--generators=1"))[2]
        self.assertEqual(list(data), ["dimension", "H1_0", "H1_1"])

    def volume(self, points, hexahedron):
        """Of a hexahedron, as the sum of the tetrahedra over its outward faces, seen from corner 0."""
        faces = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
        total = 0
        for a, b, c, d in faces:
            for triangle in ((a, b, c), (a, c, d)):
                u, v, w = ([points[hexahedron[k]][i] - points[hexahedron[0]][i] for i in range(3)] for k in triangle)
                total += u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + \
                    u[2] * (v[0] * w[1] - v[1] * w[0])
        return total / 6

    def test_a_cube_has_the_corners_in_the_order_of_the_format(self):
        at = [[x, y, z] for x in range(2) for y in range(2) for z in range(2)]
        script = HEADER + json.dumps({"op": "simploid", "name": "q", "type": [1, 1, 1], "at": at}) + "\n"
        root = xml.etree.ElementTree.fromstring(self.export(script, "vtu"))
        arrays = {array.get("Name"): numbers(array.text) for array in root.iter("DataArray")}
        points = [arrays["positions"][k:k + 3] for k in range(0, 24, 3)]
        hexahedron = list(map(int, arrays["connectivity"][-8:]))
        self.assertEqual(self.volume(points, hexahedron), 1)
        for k in range(4):  # sides of the bottom, and upwards, have length 1
            self.assertEqual(math.dist(points[hexahedron[k]], points[hexahedron[(k + 1) % 4]]), 1)
            self.assertEqual(math.dist(points[hexahedron[k]], points[hexahedron[k + 4]]), 1)
        squares = [list(map(int, line.split()[1:])) for line in self.export(script, "obj").splitlines()
                   if line.startswith("f ")]
        self.assertEqual(len(squares), 6)
        for square in squares:
            for a, b in zip(square, square[1:] + square[:1]):
                self.assertEqual(math.dist(points[a - 1], points[b - 1]), 1)

    def test_meshes_have_the_edges_of_the_object_and_loops_that_close(self):
        count = 0
        for script, _ in self.drawn():
            with self.subTest(script=script.name):
                expected = self.summary(script, "--generators=1")
                cells = (expected["cells"] + [0, 0, 0])[:3]
                lines = self.export(script, "obj", "--generators").splitlines()
                groups = {}
                for line in lines:
                    if line.startswith("g "):
                        groups[line[2:]] = []
                    elif line.startswith(("l ", "f ")):
                        list(groups.values())[-1].append(list(map(int, line.split()[1:])))
                self.assertEqual(sum(line.startswith("v ") for line in lines), cells[0])
                self.assertEqual(len(groups["edges"]), cells[1])
                self.assertLessEqual(len(groups["faces"]), cells[2])
                loops = [groups[name] for name in groups if name.startswith("H1_")]
                chains = [g["chain"] for g in expected["generators"]]
                self.assertEqual([len(loop) for loop in loops], [len(chain) for chain in chains])
                for loop, chain in zip(loops, chains):
                    if all(abs(coefficient) == 1 for coefficient, _ in chain) and expected["ring"] == "Z":
                        self.assertEqual(sorted(a for a, _ in loop), sorted(b for _, b in loop))
                ply = self.export(script, "ply", "--generators").splitlines()
                head = ply[:ply.index("end_header")]
                self.assertIn(f"element vertex {cells[0]}", head)
                self.assertIn(f"element face {len(groups['faces'])}", head)
                self.assertIn(f"element edge {cells[1]}", head)
                self.assertEqual(len(ply), len(head) + 1 + cells[0] + len(groups["faces"]) + cells[1])
                edges = [list(map(float, line.split())) for line in ply[len(ply) - cells[1]:]] if cells[1] else []
                self.assertEqual([[a - 1, b - 1] for a, b in groups["edges"]], [edge[:2] for edge in edges])
                for k, chain in enumerate(chains):
                    self.assertEqual(sorted(edge[2 + k] for edge in edges if edge[2 + k]),
                                     sorted(float(coefficient) for coefficient, _ in chain))
                count += 1
        self.assertGreater(count, 20 if IS_HEAVY else 2)

    def test_a_mesh_that_is_exported_can_be_imported_again(self):
        for form in ("obj", "ply"):
            for arguments in ([], ["--generators"]):
                path = self.folder / f"mesh.{form}"
                script = EXAMPLES / "projective_plane_six_vertices.jsonl"
                self.export(script, form, "-o", path, *arguments)
                imported = run("import", "--quiet", path)
                self.assertEqual((imported.returncode, imported.stderr), (0, ""))
                found, expected = self.summary(imported.stdout), self.summary(script)
                self.assertEqual([found[field] for field in ("cells", "betti", "torsion")],
                                 [expected[field] for field in ("cells", "betti", "torsion")])

    def test_undone_positions_are_forgotten_and_splits_stay_where_they_were(self):
        script = HEADER + '{"op":"simplex","name":"a","dim":0,"at":[[1,2,3]]}\n{"op":"undo"}\n' \
            '{"op":"simplex","name":"e","dim":1}\n'
        done = run("export", "-", "--format", "obj", text=script)
        self.assertEqual(done.returncode, 2)
        self.assertIn('the vertex "e.0" has no position', done.stderr)
        script = HEADER + '{"op":"complex","name":"K","cells":[{"id":"f","faces":["b","c"]},{"id":"b","at":[1,0]},' \
            '{"id":"e","faces":["b","a"]},{"id":"a","at":[0,0]},{"id":"c","at":[2,0]}]}\n' \
            '{"op":"deidentify","split":[{"cell":"K.b","as":"d","moves":[["K.f",0]]}]}\n' \
            '{"op":"cone","apex":"v","over":["K.e"],"at":[0,5,5]}\n'
        lines = self.export(script, "obj").splitlines()
        self.assertEqual([line for line in lines if line.startswith("v ")],
                         ["v 1 0 0", "v 2 0 0", "v 0 0 0", "v 1 0 0", "v 0 5 5"])


class Usage(Folder):
    def refused(self, status, what, *arguments, text=None):
        done = run("export", *arguments, text=text)
        self.assertEqual((arguments, done.returncode, done.stdout), (arguments, status, ""))
        self.assertIn(what, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_what_is_wrong_on_the_command_line_is_said(self):
        script = EXAMPLES / "torus.jsonl"
        formats = "script, phat, phat-binary, matrix-market, vtk, vtu, obj, ply, facets, 3map or 3map-generalized"
        self.refused(1, "--format is required", script)
        self.refused(1, f'"pdf" should be {formats}', script, "--format", "pdf")
        self.refused(1, "FILE is required", "--format", "phat")
        self.refused(1, "cannot read nowhere", "nowhere", "--format", "phat")
        self.refused(1, "--without-undone is for --format script", script, "--format", "phat", "--without-undone")
        self.refused(1, "--dim is for --format matrix-market", script, "--format", "phat", "--dim", "1")
        self.refused(1, "give -o PREFIX", script, "--format", "matrix-market")
        self.refused(1, "from 1 on", script, "--format", "matrix-market", "--dim", "0")
        self.refused(1, "--generators is for", script, "--format", "facets", "--generators")
        self.refused(1, "dimension 1 only", script, "--format", "obj", "--generators=0-2")
        self.refused(1, "--ring", script, "--format", "vtk", "--ring", "Z/4")
        self.refused(1, "--ring is for", script, "--format", "script", "--ring", "Z/2")
        self.refused(1, "-o should be", script, "--format", "phat", "-o", "")
        self.refused(1, "is the input", script, "--format", "phat", "-o", script)

    def test_errors_of_the_script_have_the_statuses_of_replay(self):
        over_nothing = HEADER + '{"op":"cone","apex":"v","over":"x"}\n'
        for form in ("phat", "vtk", "facets"):
            self.refused(2, "standard input:1: ", "-", "--format", form, text="nonsense\n")
            self.refused(2, "standard input:2: ", "-", "--format", form, text=over_nothing)
            self.refused(3, "standard input:2: ", "-", "--format", form, text=HEADER + '{"op":"expect","betti":[3]}\n')
        self.refused(2, "standard input:2: ", "-", "--format", "phat-binary", text=HEADER + '{"op":"nothing"}\n')

    def test_an_error_leaves_the_old_file(self):
        path = self.folder / "old"
        path.write_text("old", encoding="utf-8")
        for form, script in (("facets", "torus"), ("obj", "contracted_circle"),
                             ("phat", "large/circle_to_the_sixteenth")):
            self.refused(2, "sesame export: the ", EXAMPLES / f"{script}.jsonl", "--format", form, "-o", path)
        self.assertEqual((path.read_text(encoding="utf-8"), [each.name for each in self.folder.iterdir()]),
                         ("old", ["old"]))

    def test_too_many_cells_are_not_written_out(self):
        large = EXAMPLES / "large" / "circle_to_the_sixteenth.jsonl"
        self.refused(2, "the object has 4294967300 cells", large, "--format", "phat")
        three = EXAMPLES / "product_of_circles.jsonl"
        cells = sum(self.summary(three)["cells"])
        self.refused(2, f"the object has {cells} cells", three, "--format", "phat", "--max-cells", cells - 1)
        self.assertEqual(len(self.export(EXAMPLES / "torus.jsonl", "phat", "--max-cells", "1").splitlines()), 4)

    def test_an_interrupt_leaves_no_file(self):
        with subprocess.Popen([SESAME, "export", "-", "--format", "phat", "-o", "x"], cwd=self.folder,
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stdin.write(HEADER.encode())
            process.stdin.flush()
            while not (self.folder / "x.part").exists():
                pass
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=60), 130)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_the_same_script_gives_the_same_bytes(self):
        for form in ("script", "phat", "vtk", "vtu", "obj", "ply"):
            self.assertEqual(self.export(EXAMPLES / "menger_sponge.jsonl", form),
                             self.export(EXAMPLES / "menger_sponge.jsonl", form))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
