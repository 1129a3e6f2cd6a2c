#!/usr/bin/env python3
"""What `sesame distance` promises on its command line: output, errors with their place, exit statuses.

Usage: distance_command_test.py SESAME
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
ONE = "# a comment\n0 0 inf\n0 1 5\n1 2 10\n1 3 3.5\n"
OTHER = "0 0.5 inf\n1 2 9\n2 4 5\n"


class Distance(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.one = self.file("one.pers", ONE)
        self.other = self.file("other.pers", OTHER)

    def file(self, name, text):
        path = self.folder / name
        path.write_bytes(text.encode())
        return path

    def run_on(self, *arguments):
        return subprocess.run([SESAME, "distance", *map(str, arguments)], capture_output=True, text=True, timeout=60,
                              check=False)

    def json_of(self, *arguments):
        done = self.run_on("--json", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def test_the_bottleneck_distance_of_each_dimension_and_of_all(self):
        found = self.json_of(self.one, self.other)
        self.assertEqual(found["distance"], "bottleneck")
        self.assertEqual(found["internal_p"], "inf")
        self.assertEqual([row["dim"] for row in found["dims"]], [0, 1, 2])
        self.assertEqual([row["value"] for row in found["dims"]], [2, 1, 0.5])
        self.assertEqual(found["dims"][0]["bars"], [2, 1])
        self.assertEqual(found["dims"][0]["essential"], [1, 1])
        self.assertEqual(found["value"], 2)
        self.assertNotIn("matching", found["dims"][0])

    def test_the_wasserstein_distance_is_of_exponent_one_unless_told(self):
        for options in (["--wasserstein"], ["--wasserstein", "1"]):
            found = self.json_of(self.one, self.other, *options)
            self.assertEqual((found["distance"], found["q"]), ("wasserstein", 1))
            self.assertEqual([row["value"] for row in found["dims"]], [2.5, 1.25, 0.5])
            self.assertEqual(found["value"], 4.25)
        found = self.json_of(self.one, self.other, "--wasserstein", "2", "--internal-p", "2")
        self.assertEqual((found["q"], found["internal_p"]), (2, 2))
        squares = [0.25 + 8, 1 + 0.125, 0.5]
        for row, square in zip(found["dims"], squares):
            self.assertAlmostEqual(row["value"], square**0.5, places=12)
        self.assertAlmostEqual(found["value"], sum(squares)**0.5, places=12)

    def test_one_dimension_can_be_asked_for(self):
        self.assertEqual(self.json_of(self.one, self.other, "--dim", "1")["value"], 1)
        nothing = self.json_of(self.one, self.other, "--dim", "7")
        self.assertEqual((nothing["value"], nothing["dims"][0]["bars"]), (0, [0, 0]))

    def test_the_matching_has_every_bar_once(self):
        matching = self.json_of(self.one, self.other, "--matching")["dims"][1]["matching"]
        self.assertEqual(matching, [{"left": [2, 10], "right": [2, 9], "cost": 1},
                                    {"left": [3, 3.5], "right": None, "cost": 0.25}])
        text = self.run_on(self.one, self.other, "--matching").stdout
        self.assertIn("[2, 10) - [2, 9): 1\n", text)
        self.assertIn("[3, 3.5) - diagonal: 0.25\n", text)
        self.assertIn("[0, \u221e) - [0.5, \u221e): 0.5\n", text)

    def test_our_own_json_and_ripser_s_text_are_read_too(self):
        json_text = json.dumps({"ring": "Z/2", "ops": 9, "bars": [[0, 0, None], [0, 1, 5], [1, 2, 10], [1, 3, 3.5]],
                                "hidden": 1}) + "\n"
        ripser = ("distance matrix with 4 points\nvalue range: [0.1,9]\npersistence intervals in dim 0:\n [0, )\n"
                  " [1,5)\npersistence intervals in dim 1:\n [2,10):  {[0,1] (2), [1,2] (3)}\n [3,3.5)\n"
                  "persistence intervals in dim 2:\n")
        states = '{"ops":1,"time":0,"ring":"Z/2","cells":[1],"betti":[1]}\n'
        for text in (json_text, states + json_text, json.dumps(json.loads(json_text), indent=2), "\n" + ripser,
                     ripser[ripser.index("persistence"):], ripser.replace("\n", "\r\n")):
            found = self.json_of(self.one, self.file("other", text))
            self.assertEqual([row["bars"] for row in found["dims"]], [[2, 2], [2, 2]], text)
            self.assertEqual(found["value"], 0, text)

    def test_what_sesame_tower_prints_as_json_is_its_barcode(self):
        tower = self.file("t.tower", "1 i 0\n2 i 1\n1732800000000000001 i 0 1\n")
        done = subprocess.run([SESAME, "tower", tower, "--json", "--every", "1", "--pers", self.folder / "t.pers"],
                              capture_output=True, text=True, timeout=60, check=True)
        found = self.json_of(self.file("t.json", done.stdout), self.folder / "t.pers")
        self.assertEqual((found["dims"][0]["bars"], found["value"]), ([2, 2], 0))

    def test_what_is_wrong_in_json_and_ripser_s_text_is_told_with_its_line(self):
        for text, line, what in (('{"ops":1,\n"bars":[[0,0,null]\n', 3, "this is no JSON"),
                                 ('{"bars":[[0,0,null],[0,5,1]]}\n', 1, "the death \"1\" should not be before the birth \"5\""),
                                 ('\n{"bars":[[0,0]]}\n', 2, "[0,0]"),
                                 ('{"bars":[[0,null,1]]}\n', 1, "\"null\" should be a birth"),
                                 ('{"rings":[{"bars":[]},{"bars":[]}]}\n', 1, "one --ring"),
                                 ('{"groups":[]}\n', 1, "--ring Z/2"),
                                 ('{"sesame":1,"ring":"Z"}\n', 1, "has no object with \"bars\""),
                                 ("persistence intervals in dim 0:\n [0,1\n", 2, "should be an interval"),
                                 ("value range: [0,1]\npersistence intervals in dim 0:\n [0,x)\n", 3, "\"x\"")):
            path = self.file("wrong", text)
            done = self.run_on(self.one, path)
            self.assertEqual(done.returncode, 2, text)
            self.assertIn(f"{path}:{line}: ", done.stderr)
            self.assertIn(what, done.stderr)

    def test_people_get_a_table(self):
        lines = self.run_on(self.one, self.other).stdout.splitlines()
        self.assertIn("bottleneck distance, maximum metric", lines[0])
        self.assertEqual(lines[3].split(), ["H0", "2", "and", "1", "1", "and", "1", "2"])
        self.assertEqual(lines[-1].split(), ["all", "2"])

    def test_different_numbers_of_essential_bars_are_infinitely_far_apart(self):
        more = self.file("more.pers", "0 0 inf\n0 1 inf\n")
        self.assertIsNone(self.json_of(more, self.other, "--dim", "0")["value"])
        self.assertIsNone(self.json_of(more, self.other, "--wasserstein", "2")["value"])
        done = self.run_on(more, self.other, "--matching")
        self.assertEqual(done.returncode, 0)
        self.assertIn("[1, \u221e) - nothing: inf", done.stdout)
        self.assertIn("all" + " " * 42 + "inf", done.stdout)

    def test_files_without_dimensions_are_compared_with_each_other_only(self):
        plain = self.file("plain.pers", "1 5\n0 inf\n")
        self.assertIsNone(self.json_of(plain, plain)["dims"][0]["dim"])
        empty = self.file("empty.pers", "")
        self.assertIsNone(self.json_of(empty, plain)["value"])
        done = self.run_on(plain, self.one)
        self.assertEqual(done.returncode, 2)
        self.assertIn("plain.pers: the bars have no dimensions", done.stderr)
        self.assertEqual(self.run_on(plain, plain, "--dim", "0").returncode, 1)

    def test_empty_files_have_distance_0(self):
        empty = self.file("empty.pers", "# nothing\n")
        self.assertEqual(self.json_of(empty, empty)["value"], 0)

    def test_a_malformed_file_is_named_with_its_line(self):
        wrong = self.file("wrong.pers", "0 1 2\n0 1 x\n")
        for arguments in ([self.one, wrong], [wrong, self.one]):
            done = self.run_on(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertEqual(done.stderr, f'{wrong}:2: "x" should be a death, a number or inf\n')

    def test_wrong_usage_and_unreadable_files_have_status_1(self):
        for arguments in (["--wasserstein", "0.5"], ["--wasserstein", "inf"], ["--wasserstein", "x"],
                          ["--internal-p", "3", "--wasserstein", "1"], ["--internal-p", "2"], ["--dim", "-1"],
                          ["--unknown"]):
            done = self.run_on(self.one, self.other, *arguments)
            self.assertEqual((arguments, done.returncode, done.stdout), (arguments, 1, ""))
            self.assertNotEqual(done.stderr, "")
        for missing in (self.folder / "missing.pers", self.folder):
            done = self.run_on(self.one, missing)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"cannot read {missing}", done.stderr)
        self.assertEqual(self.run_on(self.one).returncode, 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
