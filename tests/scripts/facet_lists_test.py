#!/usr/bin/env python3
"""Lists of facets, as topologists write them down, given to `sesame tower`, `replay` and `import`; and what is no
filtration yet: matrices of distances and lists of points.

Usage: facet_lists_test.py SESAME
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
# The projective plane on six vertices, and a circle.
PLANE = [[1, 2, 3], [1, 2, 6], [1, 3, 4], [1, 4, 5], [1, 5, 6], [2, 3, 5], [2, 4, 5], [2, 4, 6], [3, 4, 6], [3, 5, 6]]
CIRCLE = [[4, 7], [7, 9], [9, 4]]


def written(facets):
    """The list in the forms of several programs."""
    blanks = "".join(" ".join(map(str, facet)) + "\n" for facet in facets)
    yield "blanks", blanks
    yield "commas, with CR LF and a comment", "# facets\r\n" + blanks.replace(" ", ", ").replace("\n", "\r\n")
    yield "polymake", "".join("{" + " ".join(map(str, facet)) + "}\n" for facet in facets)
    yield "JSON", json.dumps(facets)
    yield "Sage", "{" + ", ".join(map(str, map(tuple, facets))) + "}\n"
    yield "Sage's command", f"SimplicialComplex({facets})\n"
    yield "simpcomp", "M := SCFromFacets( [ " + ",\n  ".join(str(facet) for facet in facets) + " ] );\n"
    yield "Lutz, on a line", f"manifold_lex_d2_n{len(facets)}_o1_g0_#1={str(facets).replace(' ', '')}\n"
    yield "Lutz, on many lines", f"manifold_2_6_1={str(facets).replace(' ', '').replace(',[', ',' + chr(10) + '[')}\n"
    yield "broken inside of facets", str(facets).replace(", ", ",\n")


class FacetLists(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text, newline="")
        return path

    def run_on(self, command, *arguments, stdin=None):
        return subprocess.run([SESAME, command, *map(str, arguments)], input=stdin, capture_output=True, text=True,
                              timeout=60, check=False)

    def last_object(self, command, *arguments):
        done = self.run_on(command, *arguments, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])

    # ---- replay and import

    def test_replay_has_the_groups_of_the_complex_however_it_is_written(self):
        for form, text in written(PLANE):
            found = self.last_object("replay", self.file("plane.txt", text))
            self.assertEqual((found["steps"], found["cells"], found["betti"], found["torsion"]),
                             (1, [6, 15, 10], [1, 0, 0], [[], [2], []]), form)

    def test_replay_says_what_it_has_read(self):
        path = self.file("plane.txt", str(PLANE))
        self.assertIn("plane.txt: read as a list of facets: 10 facets", self.run_on("replay", path).stderr)
        self.assertEqual(self.run_on("replay", path, "--quiet").stderr, "")

    def test_import_makes_a_script_of_one_insertion(self):
        for form, text in written(PLANE):
            script = self.folder / "plane.jsonl"
            done = self.run_on("import", self.file("plane.txt", text), "-o", script)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("read as a list of facets: 10 facets", done.stderr)
            steps = [json.loads(line) for line in script.read_text().splitlines() if not line.startswith("#")][1:]
            self.assertEqual(steps, [{"op": "insert", "simplices": PLANE}], form)
            self.assertEqual(self.last_object("replay", script)["torsion"], [[], [2], []])

    def test_import_can_assemble_a_list_facet_by_facet(self):
        script = self.folder / "plane.jsonl"
        done = self.run_on("import", self.file("plane.txt", str(PLANE)), "--assemble", "--ring", "Z/3", "-o", script)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = self.last_object("replay", script)
        self.assertEqual((found["ring"], found["steps"], found["betti"]), ("Z/3", 10, [1, 0, 0]))

    def test_names_of_vertices_are_for_scripts(self):
        path = self.file("named.txt", "[['a','b'],['b','c'],['c','a']]\n")
        self.assertEqual(self.last_object("replay", path)["betti"], [1, 1])
        done = self.run_on("tower", path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("named.txt:1: ", done.stderr)
        self.assertIn("sesame import", done.stderr)
        plain = self.file("plain.txt", "a b\nb c\nc a\n")
        done = self.run_on("import", "--format", "facets", plain)
        self.assertEqual(done.stdout.splitlines()[-1], '{"op":"insert","simplices":[["a","b"],["b","c"],["c","a"]]}')

    def test_simplices_that_are_there_already_are_counted(self):
        path = self.file("twice.txt", "[[1,2,3],[3,2,1],[1,2],[3,4]]\n")
        self.assertEqual(self.last_object("replay", path)["already"], 1)
        found = self.last_object("tower", path)
        self.assertEqual((found["already"], found["added_faces"]), (2, 7))
        self.assertIn("2 simplices that were there already", self.run_on("tower", path).stdout)

    # ---- towers

    def test_tower_adds_the_faces_of_each_facet_at_its_time(self):
        for form, text in written(CIRCLE):
            found = self.last_object("tower", self.file("circle.txt", text))
            self.assertEqual((found["format"], found["bars"], found["ops"]),
                             ("facets", [[0, 0, None], [1, 2, None]], 3), form)
        for ring, betti in (("Z/2", [1, 1, 1]), ("Z/3", [1])):
            state = self.last_object("tower", self.file("plane.txt", str(PLANE)), "--ring", ring)
            open_bars = [d for d, _, death in state["bars"] if death is None]
            self.assertEqual([open_bars.count(d) for d in range(len(betti))], betti)

    def test_tower_has_the_groups_over_the_integers(self):
        found = self.last_object("tower", self.file("plane.txt", str(PLANE)), "--ring", "Z")
        self.assertEqual(found["groups"][-1], [9, [{"rank": 1, "torsion": []}, {"rank": 0, "torsion": [2]}]])
        self.assertEqual(found["format"], "facets")

    def test_cycles_of_facets_are_cycles(self):
        found = self.last_object("tower", self.file("circle.txt", str(CIRCLE)), "--generators", "--ring", "Z/3")
        (cycle,) = [g["now"] for g in found["generators"] if g["dim"] == 1]
        self.assertEqual(sorted(map(tuple, (labels for _, labels in cycle))), [(4, 7), (4, 9), (7, 9)])

    def test_a_list_that_grows_is_read_from_a_pipe(self):
        done = self.run_on("tower", "-", "--json", stdin="".join(f"{k} {k + 1}\n" for k in range(1, 2000)))
        self.assertEqual(json.loads(done.stdout)["bars"], [[0, 0, None]])

    # ---- missing faces

    def test_a_missing_face_is_refused_with_a_hint_that_works(self):
        for text in ("i 0\ni 1\ni 2\ni 0 1 2\n", "0 0 0\n0 1 0\n0 2 0\n2 0 1 2 1\n"):
            path = self.file("t.tower", text)
            done = self.run_on("tower", path)
            self.assertEqual(done.returncode, 2)
            self.assertIn("t.tower:4: the face {", done.stderr)
            self.assertIn("--add-faces", done.stderr)
            found = self.last_object("tower", path, "--add-faces")
            self.assertEqual(found["added_faces"], 3)
            self.assertEqual([bar for bar in found["bars"] if bar[0] == 1], [])
            self.assertEqual(found["ops"], 4)

    def test_added_faces_come_at_the_time_of_their_simplex(self):
        path = self.file("t.tower", "2 i 5 6 7\n3 i 5 6\n4 c 5 6\n9 i 8\n")
        found = self.last_object("tower", path, "--add-faces", "--every", "1")
        self.assertEqual((found["bars"], found["already"]), ([[0, 2, None], [0, 9, None]], 1))
        done = self.run_on("tower", path, "--add-faces", "--every", "1", "--json")
        states = [json.loads(line) for line in done.stdout.splitlines()[:-1]]
        self.assertEqual([(s["ops"], s["time"], s["cells"]) for s in states],
                         [(1, 2, [3, 3, 1]), (2, 3, [3, 3, 1]), (3, 4, [2, 1]), (4, 9, [3, 1])])

    def test_faces_are_added_over_the_integers_too(self):
        path = self.file("t.tower", "i 5 6 7\nc 5 6\ni 5 6 7\n")
        found = self.last_object("tower", path, "--add-faces", "--ring", "Z")
        self.assertEqual(found["groups"], [[0, [{"rank": 1, "torsion": []}]]])

    def test_what_has_no_labels_has_no_faces_to_add(self):
        done = self.run_on("tower", self.file("m.phat", "0\n0\n1 0 1\n"), "--add-faces")
        self.assertEqual(done.returncode, 1)
        self.assertIn("--add-faces", done.stderr)

    # ---- formats

    def test_the_format_is_named_in_json_or_on_standard_error_where_it_was_found_out(self):
        for name, text, said in (("tower", "i 0\n", None), ("script", '{"sesame":1}\n', None),
                                 ("gudhi", "0 0 0\n", "a list of simplices and values"),
                                 ("phat", "0\n0\n1 0 1\n", "a boundary matrix"),
                                 ("facets", "1 2\n2 3\n3 1\n", "a list of facets")):
            path = self.file("input", text)
            done = self.run_on("tower", path, "--json")
            self.assertEqual((json.loads(done.stdout)["format"], done.stderr), (name, ""))
            done = self.run_on("tower", path)
            self.assertEqual(done.stderr.startswith(f"{path}: read as {said}"), said is not None, done.stderr)
            self.assertEqual(self.run_on("tower", path, "--format", name).stderr, "")

    def test_what_can_be_two_formats_is_refused_until_one_is_named(self):
        path = self.file("fan.txt", "0 1 2\n0 2 3\n0 3 4\n")
        done = self.run_on("tower", path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("fan.txt:1: ", done.stderr)
        self.assertIn("--format gudhi or --format facets", done.stderr)
        self.assertEqual(self.last_object("tower", path, "--format", "facets")["bars"], [[0, 0, None]])
        self.assertEqual(len(self.last_object("tower", path, "--format", "gudhi")["bars"]), 3)

    def test_distances_and_points_are_refused_with_what_makes_a_filtration_of_them(self):
        for text, what, line in (("0.5,\n0.3,0.4,\n", "the lower half of a distance matrix", 1),
                                 ("\n1\n2 3\n4 5 6\n", "the lower half of a distance matrix", 2),
                                 ("0,0.5,1\n0.5,0,2\n1,2,0\n", "a distance matrix", 1),
                                 ("0 1 1\n1 0 1\n1 1 0\n", "a distance matrix", 1),
                                 ("# points\n0.1 0.2\n0.3 0.1\n", "a list of points", 2)):
            done = self.run_on("tower", self.file("points.txt", text))
            self.assertEqual(done.returncode, 2, text)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(f"points.txt:{line}: this looks like {what}", done.stderr)
            self.assertIn("RipsComplex", done.stderr)

    def test_what_is_wrong_in_a_list_is_told_with_its_line(self):
        for text, line, what in (("[[1,2,3],\n[1,2,2]]\n", 2, "the vertex 2 stands twice"),
                                 ("[[1,2,3],\n[1,2]\n", 2, "has not been closed"),
                                 ("[[1,2]]\n[[3,4]]\n", 2, "a second list begins"),
                                 ("M1=[[1,2]]\nM2=[[3,4]]\n", 2, "stands outside of the brackets"),
                                 ("1 2 3\n3 4 5\n6 7 7\n", 3, "stands twice")):
            path = self.file("list.txt", text)
            for command in ("tower", "replay", "import"):
                done = self.run_on(command, path)
                self.assertEqual(done.returncode, 2, (command, text, done.stderr))
                self.assertIn(f"list.txt:{line}: ", done.stderr)
                self.assertIn(what, done.stderr)

    def test_a_list_without_facets_is_refused_by_every_command(self):
        for text, line in (("[]\n", 1), ("# none\n\nM = [ ];\n", 3)):
            path = self.file("none.txt", text)
            for command in (["tower"], ["tower", "--format", "facets"], ["tower", "--json", "--ring", "Z"], ["replay"],
                            ["import"], ["import", "--assemble"], ["import", "--format", "facets"]):
                done = self.run_on(*command, path)
                self.assertEqual((done.returncode, done.stdout), (2, ""), (command, text))
                self.assertIn(f"none.txt:{line}: this list has no facets", done.stderr)
        for command in ("tower", "import"):
            done = self.run_on(command, "--format", "facets", self.file("empty.txt", ""))
            self.assertEqual((done.returncode, done.stdout), (2, ""), command)
            self.assertIn("empty.txt:1: this list has no facets", done.stderr)
        done = self.run_on("tower", "--partial", "--json", self.file("none.txt", "[]\n"))
        self.assertEqual((done.returncode, json.loads(done.stdout)["bars"]), (2, []))

    def test_a_tower_given_to_replay_is_sent_to_the_right_command(self):
        done = self.run_on("replay", self.file("t.tower", "i 0\ni 1\n"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("sesame tower", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
