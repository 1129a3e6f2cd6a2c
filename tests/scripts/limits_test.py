#!/usr/bin/env python3
"""What a session may take: limits that are set, and machines that are small. A step that does not fit is refused with a
sentence, and what was before it is there.

Usage: limits_test.py SESAME EXAMPLES [--heavy]
"""

import json
import pathlib
import resource
import sys
import unittest

from program_folder import HEADER, ProgramFolder, simplex

EXAMPLES = sorted(pathlib.Path(sys.argv[2]).resolve().rglob("*.jsonl"))
HEAVY = "--heavy" in sys.argv


def address_space(megabytes):
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
    return limit


class Limits(ProgramFolder):
    SECONDS = 600

    def verified(self):
        done = self.run_in("verify", "log", "--json")
        self.assertEqual(done.returncode, 0)
        return json.loads(done.stdout)

    def test_a_step_beyond_the_cells_that_were_allowed_is_refused_and_smaller_ones_go_on(self):
        text = HEADER + simplex("a", 3) + simplex("b", 4) + simplex("c", 1)
        done = self.run_in("replay", "-", "--max-cells", "20", "--log", "log", "--json", text=text)
        self.assertEqual(done.returncode, 5)
        self.assertEqual(done.stderr, "standard input:3: this step (simplex) would bring the object to 46 cells; "
                                      "the limit that was set is 20\n")
        self.assertEqual(json.loads(done.stdout.splitlines()[-1])["steps"], 1)
        self.assertEqual(self.verified()["steps"], 1)
        done = self.run_in("replay", "-", "--max-cells", "20", "--keep-going", "--json", text=text)
        self.assertEqual((done.returncode, json.loads(done.stdout.splitlines()[-1])["cells"]), (5, [6, 7, 4, 1]))

    def test_a_session_beyond_the_memory_that_was_allowed_ends_with_a_sentence(self):
        text = HEADER + "".join(simplex(f"s{k}", 14) for k in range(20))
        done = self.run_in("replay", "-", "--max-memory", "100M", "--log", "log", "--json", text=text)
        self.assertEqual(done.returncode, 5)
        self.assertIn("the limit that was set is 105 MB", done.stderr)
        steps = json.loads(done.stdout.splitlines()[-1])["steps"]
        self.assertEqual(self.verified()["steps"], steps)
        self.assertTrue(1 < steps < 20)
        self.assertEqual(self.run_in("replay", "-", "--max-memory", "4G", "--quiet", text=text).returncode, 0)

    def test_a_replay_beyond_the_time_that_was_allowed_ends_between_two_steps(self):
        text = HEADER + "".join(simplex(f"s{k}", 8) for k in range(100_000))
        done = self.run_in("replay", "-", "--max-time", "0.2", "--json", "--every", "100000", "--log", "log", text=text)
        self.assertEqual(done.returncode, 5)
        self.assertRegex(done.stderr, r"time is up before this step, the \d+\. one")
        self.assertEqual(json.loads(done.stdout.splitlines()[-1])["steps"], self.verified()["steps"])

    def test_a_product_that_is_too_large_is_refused_with_an_estimate(self):
        text = HEADER + "".join('{"op":"insert","simplices":[%s]}\n' % ",".join(
            f'["{name}{k}"]' for k in range(70_000)) for name in "ab")
        text += '{"op":"product","name":"P","left":"{a0}","right":"{b0}"}\n' + simplex("c")
        done = self.run_in("replay", "-", "--quiet", "--keep-going", "--log", "log", text=text)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("would have 4.9e+09 of them, and take about 368 GB", done.stderr)
        self.assertEqual(self.verified()["steps"], 3)

    def test_wrong_limits_are_refused(self):
        for option, value in (("--max-memory", "much"), ("--max-cells", "0"), ("--max-time", "-1"), ("--sync", "often")):
            done = self.run_in("replay", "-", "--log", "log", option, value, text=HEADER)
            self.assertEqual(done.returncode, 1)
            self.assertIn(option, done.stderr)

    def test_every_example_ends_well_in_any_address_space(self):
        for path in EXAMPLES if HEAVY else EXAMPLES[::6]:
            right = self.run_in("replay", path, "--quiet", "--json")
            steps = json.loads(right.stdout.splitlines()[-1])["steps"]
            for megabytes in range(50, 501, 50 if HEAVY else 150):
                self.log.unlink(missing_ok=True)
                done = self.run_in("replay", path, "--quiet", "--log", "log", preexec_fn=address_space(megabytes))
                what = (path.name, megabytes, done.returncode, done.stderr)
                self.assertIn(done.returncode, (right.returncode, 5), what)
                if done.returncode == 5:
                    self.assertRegex(done.stderr, "memory", what)
                if self.log.exists():
                    found = self.verified()
                    self.assertEqual((found["torn"], found["damage"]), (0, None), what)
                    self.assertLessEqual(found["steps"], steps, what)
                if done.returncode == 0:
                    self.assertEqual(found["steps"], steps, what)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
