#!/usr/bin/env python3
"""`sesame import --cells` of meshes of solids: their homology beside that of simplices, in every form of the files.

Usage: solid_meshes_test.py SESAME [--heavy]
"""

import itertools
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

SESAME = os.path.abspath(sys.argv[1])
IS_HEAVY = "--heavy" in sys.argv
SECTIONS = {4: "Tetrahedra", 5: "Pyramids", 6: "Prisms", 8: "Hexahedra"}
TYPES = {4: 10, 5: 14, 6: 13, 8: 12}
# The faces of a solid by its number of corners, written down apart from those of the program.
FACES = {
    4: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    5: [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
    6: [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    8: [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
}


def run(*arguments, text=None):
    return subprocess.run([SESAME, *map(str, arguments)], input=text, capture_output=True, timeout=300, check=False,
                          text=True)


class Grid:
    """Solids on the points of a grid, and points in the middle of its cubes."""

    def __init__(self):
        self.points, self.number, self.solids = [], {}, []

    def point(self, *place):
        if place not in self.number:
            self.number[place] = len(self.points)
            self.points.append(place)
        return self.number[place]

    def corners(self, x, y, z):
        return [self.point(x + a, y + b, z + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]

    def add_cube(self, place, form):
        c = self.corners(*place)
        if form == "cube":
            self.solids.append(c)
        elif form == "prisms":
            self.solids += [[c[k] for k in (0, 1, 2, 4, 5, 6)], [c[k] for k in (0, 2, 3, 4, 6, 7)]]
        elif form == "pyramids":
            middle = self.point(*(x + 0.5 for x in place))
            self.solids += [[*(c[k] for k in face), middle] for face in FACES[8]]
        else:  # a tetrahedron for each way along the sides from the first corner to the last
            for order in itertools.permutations(range(3)):
                path = [list(place)]
                for axis in order:
                    path.append([x + (k == axis) for k, x in enumerate(path[-1])])
                self.solids.append([self.point(*p) for p in path])

    def medit(self):
        lines = ["MeshVersionFormatted 2", "# a comment", "Dimension", "3", "Vertices", str(len(self.points))]
        lines += [" ".join(map(str, p)) + " 0" for p in self.points]
        lines += ["Triangles", "1", "1 2 3 7"]
        for size, section in SECTIONS.items():
            some = [s for s in self.solids if len(s) == size]
            lines += [section, str(len(some))] + [" ".join(str(v + 1) for v in s) + " 5" for s in some]
        return "\n".join([*lines, "End", ""])

    def vtk(self, version):
        cells = self.solids
        if version == "polyhedra":
            cells = [[len(FACES[len(s)]), *(n for face in FACES[len(s)] for n in (len(face), *(s[k] for k in face)))]
                     for s in self.solids]
        types = [42 if version == "polyhedra" else TYPES[len(s)] for s in self.solids]
        cells, types = [[0], *cells], [1, *types]  # and a vertex, which is no solid
        lines = ["# vtk DataFile Version 5.1" if version == "offsets" else "# vtk DataFile Version 2.0", "a title", "ASCII",
                 "DATASET UNSTRUCTURED_GRID", f"POINTS {len(self.points)} double"]
        lines += [" ".join(map(str, p)) for p in self.points]
        if version == "offsets":
            ends = [0, *itertools.accumulate(map(len, cells))]
            lines += ["METADATA", "INFORMATION 1", "NAME L2_NORM_RANGE LOCATION vtkDataArray", "DATA 2 0 1.7", ""]
            lines += [f"CELLS {len(ends)} {ends[-1]}", "OFFSETS vtktypeint64", " ".join(map(str, ends)),
                      "CONNECTIVITY vtktypeint64", *(" ".join(map(str, cell)) for cell in cells)]
        else:
            lines += [f"CELLS {len(cells)} {sum(map(len, cells)) + len(cells)}"]
            lines += [" ".join(map(str, [len(cell), *cell])) for cell in cells]
        lines += [f"CELL_TYPES {len(cells)}", *map(str, types), "POINT_DATA 1", "SCALARS x double 1", "nonsense"]
        return "\n".join([*lines, ""])

    def cells_of_the_mesh(self):
        """How many points, edges and faces it has, if equal ones are one."""
        faces = {frozenset(s[k] for k in face) for s in self.solids for face in FACES[len(s)]}
        edges = {frozenset((s[face[k - 1]], s[face[k]])) for s in self.solids for face in FACES[len(s)]
                 for k in range(len(face))}
        return [len({v for s in self.solids for v in s}), len(edges), len(faces), len(self.solids)]


def facets(cubes):
    """The tetrahedra of cubes, as a list of facets."""
    grid = Grid()
    for cube in cubes:
        grid.add_cube(cube, "tetrahedra")
    return json.dumps(grid.solids)


class Solids(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def imported(self, name, content):
        path = self.folder / name
        path.write_text(content)
        done = run("import", "--cells", path)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, done.stderr

    def complaint(self, name, content, *options):
        path = self.folder / name
        path.write_text(content)
        done = run("import", "--cells", path, *options)
        self.assertEqual((done.returncode, done.stdout), (2, ""), content)
        return done.stderr.replace(str(path), name)

    def betti(self, text):
        done = run("replay", "--json", "-", text=text)
        self.assertEqual(done.returncode, 0, done.stderr)
        betti = json.loads(done.stdout.splitlines()[-1])["betti"]
        return (betti + [0] * 4)[:4]

    def test_random_solids_have_the_homology_of_simplices(self):
        plain = 0
        for seed in range(200 if IS_HEAVY else 24):
            draw = random.Random(seed)
            size = [draw.randint(1, 3) for _ in range(3)]
            cubes = [c for c in itertools.product(*map(range, size)) if draw.random() < (0.95 if seed % 2 else 0.7)]
            if seed == 0:
                cubes = [c for c in itertools.product(range(3), repeat=3) if c != (1, 1, 1)]
            elif seed == 1:
                cubes = [c for c in itertools.product(range(3), range(3), range(1)) if c != (1, 1, 0)]
            forms = draw.choice([["cube"], ["cube", "pyramids"], ["prisms"], ["tetrahedra"]])
            grid = Grid()
            for cube in cubes:
                grid.add_cube(cube, draw.choice(forms))
            if not cubes:
                continue
            script, said = self.imported("grid.mesh", grid.medit())
            cells = json.loads(script.splitlines()[-1])["cells"]
            counted = grid.cells_of_the_mesh()
            self.assertEqual(cells[2:], counted[2:], seed)
            # Where solids meet along edges or points only, there are several of these.
            if "are several" not in said:
                self.assertEqual(cells, counted, seed)
                self.assertEqual(self.betti(script), self.betti_of_facets(cubes), seed)
                plain += 1
            else:
                self.assertGreater(cells[0] + cells[1], counted[0] + counted[1])
                self.betti(script)  # its counts are expected there
        self.assertGreater(plain, 10)

    def betti_of_facets(self, cubes):
        done = run("replay", "--json", "-", text=facets(cubes))
        self.assertEqual(done.returncode, 0, done.stderr)
        return (json.loads(done.stdout.splitlines()[-1])["betti"] + [0] * 4)[:4]

    def test_every_form_of_a_file_gives_the_same_script(self):
        grid = Grid()
        for k, form in enumerate(["cube", "pyramids", "cube", "pyramids"]):
            grid.add_cube((k, 0, 0), form)
        grid.solids.sort(key=len)  # as MEDIT lists them
        medit, said = self.imported("grid.mesh", grid.medit())
        self.assertIn('left out the section `Triangles`', said)
        self.assertIn("14 volumes", said)
        step = json.loads(medit.splitlines()[2])
        self.assertEqual(step["op"], "gmap")
        for version in ("rows", "offsets"):
            script, said = self.imported("grid.vtk", grid.vtk(version))
            self.assertIn("left out 1 cell of lower dimensions", said)
            self.assertEqual(json.loads(script.splitlines()[2]), step, version)
        script, _ = self.imported("grid.vtk", grid.vtk("polyhedra"))
        self.assertEqual(script.splitlines()[-1], medit.splitlines()[-1])
        self.assertEqual(self.betti(script), [1, 0, 0, 0])
        done = run("import", "--cells", "-", "--format", "medit", text=grid.medit())
        self.assertEqual(done.stdout.splitlines()[-1], medit.splitlines()[-1])

    def test_two_tetrahedra_on_the_same_points_are_a_sphere(self):
        grid = Grid()
        grid.points, grid.solids = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3], [3, 2, 1, 0]]
        script, _ = self.imported("grid.mesh", grid.medit())
        self.assertEqual(json.loads(script.splitlines()[-1])["cells"], [4, 6, 4, 2])
        self.assertEqual(self.betti(script), [1, 0, 0, 1])

    def test_a_voxel_is_a_cube_whose_points_are_counted_along_the_axes(self):
        grid = Grid()
        grid.add_cube((0, 0, 0), "cube")
        cube = grid.vtk("rows")
        voxel = cube.replace("8 0 1 2 3 4 5 6 7", "8 0 1 3 2 4 5 7 6").replace("\n12\n", "\n11\n")
        self.assertNotEqual(cube, voxel)
        self.assertEqual(self.imported("grid.vtk", voxel)[0], self.imported("grid.vtk", cube)[0])

    def test_what_is_exported_for_vtk_is_read_again(self):
        steps = [{"op": "simplex", "name": "t", "dim": 3, "at": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]},
                 {"op": "simploid", "name": "q", "type": [1, 1, 1], "at": [list(p) for p in itertools.product(
                     (2, 3), repeat=3)]}]
        text = '{"sesame":1}\n' + "\n".join(map(json.dumps, steps))
        grid = run("export", "-", "--format", "vtk", text=text).stdout
        script, _ = self.imported("grid.vtk", grid)
        self.assertEqual(json.loads(script.splitlines()[-1])["cells"], [12, 18, 10, 2])
        self.assertEqual(self.betti(script), [2, 0, 0, 0])

    def test_solids_that_are_no_map_are_refused_by_name(self):
        points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [0, 0, -1], [1, 1, 0], [1, 0, 1], [0, 1, 1]]

        def mesh(*solids):
            grid = Grid()
            grid.points, grid.solids = points, list(solids)
            return grid.medit()

        for solids, said in [
                (([0, 1, 2, 3], [0, 1, 2, 4], [0, 1, 2, 5]), "grid.mesh:23: the face (0, 1, 2) of this solid is one of those "
                                                             "in lines 21 and 22, too: a map has at most two solids at a "
                                                             "face"),
                (([0, 1, 2, 2],), "grid.mesh:21: a face of this solid has the corners (0, 2, 2), which should be"),
                (([0, 1, 6, 2, 3, 7, 4, 8], [0, 6, 1, 2, 5]), "has the corners of (0, 6, 1, 2), one of that in line"),
                (([0, 1, 6, 2, 3, 7, 4, 8], [0, 1, 2, 5]), "lies against a part of (0, 1, 6, 2), a face of that in line"),
                ((), "there are no solids")]:
            with self.subTest(said):
                self.assertIn(said, self.complaint("grid.mesh", mesh(*solids)), solids)
        open_one = "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 int\n0 0 0 1 0 0 0 1 0 0 0 1\n" \
                   "CELLS 1 14\n13 3 3 0 1 2 3 0 1 3 3 0 2 3\nCELL_TYPES 1\n42\n"
        self.assertIn("grid.vtk:8: the edge from 1 to 2 of this solid is on 1 of its faces, and should be on 2",
                      self.complaint("grid.vtk", open_one))
        pillow = open_one.replace("13 3 3 0 1 2 3 0 1 3 3 0 2 3", "9 2 3 0 1 2 3 0 2 1")
        self.assertIn("grid.vtk:8: this solid has the face (0, 1, 2) twice", self.complaint("grid.vtk", pillow))
        quads = [[4, *(x % 3 + 3 * (y % 3) for x, y in ((a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)))]
                 for a, b in itertools.product(range(3), repeat=2)]
        ring = open_one.replace("POINTS 4", "POINTS 9").replace("0 0 1\nC", "0 0 1" + " 2 2 2" * 5 + "\nC").replace(
            "13 3 3 0 1 2 3 0 1 3 3 0 2 3", " ".join(map(str, [46, 9, *itertools.chain(*quads)])))
        self.assertIn("with darts counted from 0, ", self.complaint("grid.vtk", ring))
        for old, new, said in [("13 3 3 0", "13 2 3 0", "a polyhedron should have the number of its faces"),
                               ("13 3 3 0", "13 3 9 0", "should each have the number of their points"),
                               ("3 0 2 3\nCELL", "3 0 2 4\nCELL", "a solid has the point 4, and there are 4 points, counted"),
                               ("\n42", "\n10", "a cell of type 10 has 13 points, and should have 4"),
                               ("\n42", "\n25", "a cell of type 25: linear ones"),
                               ("\n42", "", "a type of cells: nothing should be a number"),
                               ("CELL_TYPES 1\n42\n", "", "there are 1 cells, and CELL_TYPES has 0"),
                               ("ASCII", "BINARY", "grid.vtk:3: the file is not ASCII"),
                               ("UNSTRUCTURED_GRID", "POLYDATA", "an UNSTRUCTURED_GRID is expected"),
                               ("# vtk", "# VTK", "grid.vtk:1: `# vtk DataFile"),
                               ("POINTS 4", "POINTS 9999999999", "grid.vtk:5: the number of points"),
                               ("POINTS 4", "POINTS 5", "a point: "),
                               ("CELLS 1 14", "CELLS one 14", "the number of cells: `one` should be a number")]:
            with self.subTest(said):
                self.assertIn(old, open_one)
                self.assertIn(said, self.complaint("grid.vtk", open_one.replace(old, new)), new)
        good = mesh([0, 1, 2, 3])
        for old, new, said in [("1 2 3 4 5", "1 2 3 10 5", "grid.mesh:21: a solid has the point 10, and there are 9 points"),
                               ("1 2 3 4 5", "1 2 3 0 5", "grid.mesh:21: a vertex of a solid: `0` should be a number"),
                               ("1 2 3 4 5", "1 2 3 4", "should be a reference"),
                               ("Dimension\n3", "Dimension\n2", "Dimension of a mesh of solids"),
                               ("Vertices\n9", "Vertices\n8", "is no name of a section"),
                               ("Vertices", "Points", "there is no section `Vertices`"),
                               ("0 0 -1 0", "0 0 x 0", "a point: "),
                               ("Pyramids", "Vertices", "there is a second section `Vertices`")]:
            with self.subTest(said):
                self.assertIn(old, good)
                self.assertIn(said, self.complaint("grid.mesh", good.replace(old, new, 1)), new)

    def test_a_file_that_is_cut_is_refused_or_smaller(self):
        grid = Grid()
        grid.add_cube((0, 0, 0), "cube")
        for name, text in [("grid.mesh", grid.medit()), ("grid.vtk", grid.vtk("rows")), ("grid.vtk", grid.vtk("offsets"))]:
            last = text.index("POINT_DATA") if "POINT_DATA" in text else text.index("Hexahedra") + 25
            for end in range(0, last - 1, 1 if IS_HEAVY else 17):
                self.assertRegex(self.complaint(name, text[:end]), rf"^{name}:", text[:end])

    def test_solids_are_for_cells(self):
        path = self.folder / "grid.mesh"
        path.write_text("MeshVersionFormatted 1\n")
        for arguments, status, said in [
                (["import", path], 1, "a mesh of solids, which are taken as cells: say --cells"),
                (["import", path, "--cells", "--weld", "1"], 1, "--weld is for meshes of polygons"),
                (["import", path, "--cells", "--dim", "3"], 1, "are for map files"),
                (["mesh", path], 2, "a mesh of solids is none of polygons")]:
            done = run(*arguments)
            self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
