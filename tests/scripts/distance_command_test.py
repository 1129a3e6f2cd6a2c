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
