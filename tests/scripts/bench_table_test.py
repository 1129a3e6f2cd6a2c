#!/usr/bin/env python3
"""tools/bench_table makes the tables of README.md from a report of `sesame bench`: bench_table_test.py SESAME BENCH_TABLE."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SESAME, BENCH_TABLE = sys.argv[1], sys.argv[2]


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


class BenchTable(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)
        self.report = str(Path(self.directory.name) / "report.json")

    def test_methods_stand_side_by_side_with_means_and_tails(self):
        bench = run(SESAME, "bench", "glue-and-split", "--quick", "--repeat", "1", "--out", self.report)
        self.assertEqual(bench.returncode, 0, bench.stderr)
        table = run(BENCH_TABLE, self.report)
        self.assertEqual(table.returncode, 0, table.stderr)
        head, _, row = table.stdout.splitlines()[:3]
        self.assertIn("| mean of a step | p50 | p99 | max |", head)
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        self.assertEqual(cells[:3], ["`glue-and-split` 500", "1,003", "live / eager / recompute"])  # the other one refuses
        for cell in cells[3:]:
            self.assertRegex(cell, r"^[\d.]+ [mµn]?s( / [\d.]+ [mµn]?s){2}$")

    def test_a_report_of_another_kind_is_refused(self):
        Path(self.report).write_text('{"sesame_bench":1}', encoding="utf-8")
        refused = run(BENCH_TABLE, self.report)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn('"sesame_bench" should be 2', refused.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
