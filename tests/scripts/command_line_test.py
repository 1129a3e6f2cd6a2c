#!/usr/bin/env python3
"""What the program promises on its command line: output, errors with their place, exit statuses, signals.

Usage: command_line_test.py SESAME EXAMPLES_DIRECTORY
"""

import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
EXAMPLES = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else ".")
HEADER = '{"sesame":1,"ring":"Z","title":"test"}\n'
TRIANGLE = '{"op":"simplex","name":"t","dim":2}\n'


def run(*arguments, text=None, **options):
    return subprocess.run([SESAME, *map(str, arguments)], input=text, capture_output=True, text=True, timeout=60,
                          check=False, **options)


def replay(text, *arguments):
    return run("replay", "-", *arguments, text=text)


class Replay(unittest.TestCase):
    def test_json_has_one_object_per_step_and_a_summary(self):
        done = run("replay", "--json", "--generators", EXAMPLES / "torus.jsonl")
        self.assertEqual(done.returncode, 0, done.stderr)
        objects = [json.loads(line) for line in done.stdout.splitlines()]
        steps, summary = objects[:-1], objects[-1]
        self.assertEqual([o["step"] for o in steps], list(range(1, len(steps) + 1)))
        for o in steps:
            self.assertGreaterEqual(set(o), {"step", "op", "cells", "euler", "betti", "torsion", "small", "big", "us"})
        self.assertTrue(summary["summary"])
        self.assertEqual(summary["ring"], "Z")
        self.assertEqual(summary["betti"], [1, 2, 1])
        self.assertEqual(sorted(g["dim"] for g in summary["generators"]), [0, 1, 1, 2])
        self.assertEqual(done.stderr, "")

    def test_the_same_script_gives_the_same_bytes(self):
        def untimed():
            done = run("replay", "--json", "--generators", EXAMPLES / "lens_space.jsonl")
            objects = [json.loads(line) for line in done.stdout.splitlines()]
            for o in objects:
                o.pop("us", None)
                o.pop("seconds", None)
            return json.dumps(objects)

        self.assertEqual(untimed(), untimed())

    def test_a_page_is_one_file_the_same_each_time_and_may_go_to_standard_output(self):
        with tempfile.TemporaryDirectory() as directory:
            pages = [os.path.join(directory, name) for name in ("a.html", "b.html")]
            for page in pages:
                done = run("replay", "--html", page, EXAMPLES / "projective_plane.jsonl")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("identify", done.stdout)
            texts = [pathlib.Path(page).read_text(encoding="utf-8") for page in pages]
            self.assertTrue(texts[0] == texts[1])
            printed = run("replay", "--html", "-", EXAMPLES / "projective_plane.jsonl")
            self.assertTrue(printed.stdout == texts[0])
            data = json.loads(re.search(r'id="data">([^<]*)</script>', texts[0])[1])
            self.assertEqual((data["ring"], len(data["steps"])), ("Z", 12))
            both = run("replay", "--json", "--html", pages[0], EXAMPLES / "projective_plane.jsonl")
            self.assertEqual(json.loads(both.stdout.splitlines()[-1])["torsion"], [[], [2], []])
        for more, what in ((["--json", "--html", "-"], "both go to standard output"),
                           (["--follow", "--html", "x"], "excludes"),
                           (["--log", "x", "--append", "--html", "y"], "excludes")):
            done = run("replay", *more, EXAMPLES / "torus.jsonl")
            self.assertEqual(done.returncode, 1)
            self.assertIn(what, done.stderr)

    def test_a_page_stays_as_it_was_after_an_error_unless_it_goes_on(self):
        with tempfile.TemporaryDirectory() as directory:
            page = pathlib.Path(directory) / "page.html"
            page.write_text("old", encoding="utf-8")
            bad = HEADER + TRIANGLE + '{"op":"identify","pairs":[["t","u"]]}\n' + '{"op":"note","text":"last"}\n'
            for status, arguments in ((2, []), (2, ["--ring", "Z/2"])):
                self.assertEqual(replay(bad, "--html", page, *arguments).returncode, status)
                self.assertEqual(page.read_text(encoding="utf-8"), "old")
            self.assertEqual(replay(HEADER + "[", "--html", page).returncode, 2)
            self.assertEqual(replay("[", "--keep-going", "--html", page).returncode, 2)
            self.assertEqual(page.read_text(encoding="utf-8"), "old")
            self.assertEqual(replay(bad, "--html", page, "--keep-going").returncode, 2)
            self.assertIn("last", page.read_text(encoding="utf-8"))
            self.assertEqual(os.listdir(directory), ["page.html"])

    def test_verify_holds_on_every_example_over_every_ring(self):
        for script in sorted(EXAMPLES.glob("*.jsonl")):
            done = run("replay", "--quiet", "--verify", script)
            self.assertEqual((script.name, done.returncode, done.stderr), (script.name, 0, ""))

    def test_a_loop_of_finite_order_bounds_a_rational_chain(self):
        text = (EXAMPLES / "projective_plane.jsonl").read_text(encoding="utf-8") + \
            '{"op":"class","chain":[[1,"a.0-1"]]}\n'
        integral, rational = [json.loads(replay(text, "--json", "--ring", ring).stdout.splitlines()[-2])["class"]
                              for ring in ("Z", "Q")]
        self.assertEqual((integral["cycle"], integral["zero"], integral["bounds"]), (True, False, None))
        self.assertEqual((rational["cycle"], rational["zero"]), (True, True))
        self.assertEqual({str(c).lstrip("-") for c, _ in rational["bounds"]}, {"1/2"})
        self.assertIn("1/2 ", replay(text, "--ring", "Q").stdout)

    def test_the_table_is_for_people_and_without_colour_in_a_pipe(self):
        done = run("replay", "--generators", EXAMPLES / "projective_plane.jsonl")
        self.assertEqual(done.returncode, 0)
        self.assertIn("H1 = Z/2", done.stdout)
        self.assertIn("order 2", done.stdout)
        self.assertNotIn("\033", done.stdout + done.stderr)

    def test_until_every_ring_and_quiet(self):
        torus = EXAMPLES / "torus.jsonl"
        self.assertEqual(len(run("replay", "--json", "--until", 3, torus).stdout.splitlines()), 4)
        every = [json.loads(line) for line in run("replay", "--json", "--every", 2, torus).stdout.splitlines()]
        self.assertTrue(all(o["step"] % 2 == 0 or "class" in o for o in every if "step" in o))
        field = run("replay", "--json", "--ring", "Z/2", EXAMPLES / "projective_plane.jsonl")
        # The example expects its integral homology, which over Z/2 is not checked, as a note says.
        self.assertEqual((field.returncode, field.stderr.count("not checked")), (0, 1))
        self.assertEqual(run("replay", "--quiet", "--ring", "Z/2", EXAMPLES / "projective_plane.jsonl").stderr, "")
        self.assertEqual(run("replay", "--quiet", torus).stdout, "")

    def test_wrong_usage_is_status_1(self):
        for arguments in (["replay"], ["replay", "/nowhere/at/all.jsonl"], ["replay", "--ring", "Z/4", "-"], ["no"],
                          ["replay", "--until", "0", "-"], ["replay", "--undo-limit", "-1", "-"],
                          ["replay", "--forget", "-"], ["replay", "--forget", "--undo-limit", "9", "--verify", "-"],
                          ["replay", "/"], [], ["help", "nothing"],
                          ["import", "/nowhere.off"], ["replay", "--every", "-1", "-"], ["replay", "--every", "x", "-"],
                          ["import", "--weld", "nan", "/nowhere.off"]):
            done = run(*arguments, text="")
            self.assertEqual((arguments, done.returncode), (arguments, 1))
            self.assertNotEqual(done.stderr, "")

    def test_cells_that_are_gone_can_be_forgotten(self):
        steps = "".join(f'{{"op":"simplex","name":"x{k}","dim":1}}\n{{"op":"degenerate","cell":"x{k}","along":0}}\n'
                        f'{{"op":"identify","pairs":[["t.0","x{k}.0"]]}}\n' for k in range(2000))
        script = HEADER + TRIANGLE + steps
        limited = ["--quiet", "--json", "--undo-limit", "5"]
        kept, forgotten = (json.loads(replay(script, *limited, *more).stdout.splitlines()[-1])
                           for more in ([], ["--forget"]))
        del kept["seconds"], forgotten["seconds"]
        self.assertEqual(kept, forgotten)
        # A name that nobody can come back to is free again.
        again = script + '{"op":"simplex","name":"x7","dim":1}\n'
        self.assertEqual([replay(again, *limited, *more).returncode for more in ([], ["--forget"])], [2, 0])

    def test_a_wrong_script_is_status_2_with_its_place(self):
        cases = {
            "": "this script is empty",
            '{"op":"simplex","name":"t","dim":2}\n': "the header",
            '{"sesame":2}\n': "version 1",
            '{"sesame":1,"ring":"Z/6"}\n': "not a prime",
            HEADER + '{"op":"simplexx","name":"t","dim":2}\n': 'no op "simplexx"',
            HEADER + '{"op":"simplex","name":"t","dim":2,"size":1}\n': 'unknown field "size"',
            HEADER + '{"op":"simplex","name":"t","dim":-1}\n': "dim",
            HEADER + '{"op":"simplex","name":"t","dim":60}\n': "limit",
            HEADER + '{"op":"simplex","name":"a b","dim":1}\n': "white space",
            HEADER + "# a comment\n\n" + TRIANGLE + TRIANGLE: "in use",
            HEADER + TRIANGLE + '{"op":"identify","pairs":[["t","t.0"]]}\n': "same type",
            HEADER + TRIANGLE + '{"op":"identify","pairs":[["t.9","t.0"]]}\n': 'no cell "t.9"',
            HEADER + '{"op":"undo"}\n': "undo",
            HEADER + '{"op":"note","text":"a","text":"b"}\n': '"text" stands twice',
            HEADER + HEADER: "one header",
            HEADER + '{"op":"simplex","name":"t","dim":0,"at":[[1e999,0]]}\n': "out of range",
            HEADER + '{"op":"simplex","name":"t",\n': "JSON",
        }
        for text, expected in cases.items():
            done = replay(text)
            self.assertEqual((text, done.returncode), (text, 2))
            self.assertIn(expected, done.stderr)
            self.assertTrue(done.stderr.startswith("standard input:"), done.stderr)
        done = replay(HEADER + "# a comment\n\n" + TRIANGLE + TRIANGLE, "--json")
        self.assertIn("standard input:5:", done.stderr)
        self.assertEqual(json.loads(done.stdout.splitlines()[0])["cells"], [3, 3, 1])

    def test_a_failed_expectation_is_status_3_and_says_both_values(self):
        done = replay(HEADER + TRIANGLE + '{"op":"expect","betti":[2],"euler":1}\n')
        self.assertEqual(done.returncode, 3)
        self.assertIn("standard input:3: betti should be [2] but is [1", done.stderr)
        self.assertNotIn("euler", done.stderr)

    def test_byte_order_mark_carriage_returns_and_a_missing_last_newline(self):
        done = replay("\ufeff" + HEADER.replace("\n", "\r\n") + "\r\n" + TRIANGLE.strip(), "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_integers_beyond_64_bits_survive(self):
        big = str(3**60)
        done = replay(HEADER + TRIANGLE + '{"op":"class","chain":[["%s","t.0"]]}\n' % big, "--json")
        answer = json.loads(done.stdout.splitlines()[1])["class"]
        self.assertEqual(answer["coefficients"], [big])

    def test_the_log_can_be_replayed(self):
        with tempfile.TemporaryDirectory() as directory:
            log = os.path.join(directory, "log.jsonl")
            first = run("replay", "--json", "--log", log, EXAMPLES / "undo.jsonl")
            again = run("replay", "--json", log)
            self.assertEqual((first.returncode, again.returncode), (0, 0), again.stderr)
            strip = [[{k: v for k, v in json.loads(line).items() if k not in ("us", "seconds")}
                      for line in done.stdout.splitlines()] for done in (first, again)]
            self.assertEqual(strip[0], strip[1])

    def test_generators_of_a_large_product_come_one_by_one_by_dimension_and_by_length(self):
        large = EXAMPLES / "large" / "circle_to_the_sixteenth.jsonl"
        done = run("replay", "--json", "--every", "1000", "--generators=1-2,16", "--max-terms", "3", large,
                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30)))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        generators = json.loads(done.stdout.splitlines()[-1])["generators"]
        self.assertEqual([g["dim"] for g in generators], [1] * 14 + [2] * 120 + [16])
        self.assertEqual({g["dim"]: g.get("terms", 0) for g in generators}, {1: 0, 2: 4, 16: 65536})
        for arguments in (["--generators=1,"], ["--generators=2-1"], ["--generators=x"], ["--max-terms", "3"],
                          ["--generators", "--max-terms", "-1"]):
            self.assertEqual(run("replay", *arguments, large).returncode, 1, arguments)

    def test_an_interrupt_ends_the_list_of_generators(self):
        large = EXAMPLES / "large" / "circle_to_the_sixteenth.jsonl"
        with subprocess.Popen([SESAME, "replay", "--json", "--every", "1000", "--generators=10-16", large],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            text = ""
            while '"generators":[' not in text:
                text += process.stdout.read(1)
            process.send_signal(signal.SIGINT)
            text += process.stdout.read()
            self.assertEqual((process.wait(timeout=60), process.stderr.read()), (130, ""))
        summary = json.loads(text.splitlines()[-1])
        self.assertTrue(summary["interrupted"])
        self.assertEqual({g["dim"] for g in summary["generators"]}, {10})

    def test_the_debug_lines_say_what_each_step_did(self):
        done = run("replay", "--quiet", "-", text=HEADER + "".join(line + "\n" for line in (
            '{"op":"simplex","name":"t","dim":2}', '{"op":"simplex","name":"u","dim":2}',
            '{"op":"identify","pairs":[["t.0-1","u.0-1"]]}', '{"op":"note","text":"hello"}',
            '{"op":"undo","steps":2}', '{"op":"product","name":"P","left":"t","right":"u"}')),
                   env={**os.environ, "SPDLOG_LEVEL": "debug"})
        steps = [line.partition("[debug] ")[2] for line in done.stderr.splitlines() if line.startswith("[sesame.engine]")]
        self.assertEqual([re.sub(r"; took [0-9.]+ us, [0-9]+ terms read, [0-9]+ written$", "", line) for line in steps],
                         ["step 1 (simplex): cells made: 7; bodies made: 1",
                          "step 2 (simplex): cells made: 7; bodies made: 1",
                          "step 3 (identify): cells merged or squashed: 3; bodies joined to others: 1",
                          "step 4 (note): nothing changed",
                          "step 5 (undo): steps taken back: 2; cells separate again: 3; bodies apart again: 1",
                          "step 6 (product): products and large cones: 1; bodies made: 1"])

    def test_deep_nesting_is_an_error_and_no_crash(self):
        for text in ('{"sesame":' + "[" * 300000 + "]" * 300000 + "}\n",
                     HEADER + '{"op":"note","text":' + "[" * 300000 + "]" * 300000 + "}\n"):
            self.assertEqual(replay(text).returncode, 2)

    def test_long_scripts_report_progress_only(self):
        text = HEADER + "".join('{"op":"simplex","name":"t%d","dim":1}\n' % k for k in range(300))
        with tempfile.TemporaryDirectory() as directory:
            script = os.path.join(directory, "long.jsonl")
            pathlib.Path(script).write_text(text, encoding="utf-8")
            done = run("replay", "--json", script)
        self.assertEqual([json.loads(line).get("summary") for line in done.stdout.splitlines()], [True])

    def test_interrupt_finishes_the_step_and_prints_the_summary(self):
        process = subprocess.Popen([SESAME, "replay", "--json", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        process.stdin.write(HEADER + TRIANGLE)
        process.stdin.flush()
        deadline = time.monotonic() + 30
        self.assertTrue(json.loads(self.first_line(process, deadline))["step"] == 1)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=30)
        summary = json.loads(out.splitlines()[-1])
        self.assertEqual(process.returncode, 130)
        self.assertTrue(summary["interrupted"])
        self.assertEqual(summary["cells"], [3, 3, 1])

    def test_follow_goes_on_as_the_file_grows(self):
        with tempfile.TemporaryDirectory() as directory:
            script = os.path.join(directory, "growing.jsonl")
            with open(script, "w", encoding="utf-8") as growing:
                growing.write(HEADER + TRIANGLE)
                growing.flush()
                process = subprocess.Popen([SESAME, "replay", "--json", "--follow", script], stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True)
                deadline = time.monotonic() + 30
                self.assertEqual(json.loads(self.first_line(process, deadline))["step"], 1)
                growing.write('{"op":"simplex",')
                growing.flush()
                time.sleep(0.3)
                growing.write('"name":"u","dim":0}\n')
                growing.flush()
                self.assertEqual(json.loads(self.first_line(process, deadline))["betti"][0], 2)
            process.send_signal(signal.SIGINT)
            out, _ = process.communicate(timeout=30)
            self.assertTrue(json.loads(out.splitlines()[-1])["interrupted"])

    def first_line(self, process, deadline):
        line = process.stdout.readline()  # a report is flushed when it is made
        self.assertLess(time.monotonic(), deadline)
        return line


class Log(unittest.TestCase):
    """What is said of the work: by nobody unless it is asked for, and never on standard output."""

    # A loop that is glued and torn until its equivalence is begun afresh, and a step that is refused.
    SCRIPT = HEADER + '{"op":"simplex","name":"t","dim":1}\n{"op":"identify","pairs":[["t.0","t.1"]]}\n' + "".join(
        '{"op":"deidentify","split":[{"cell":"t.0","as":"c%d","moves":[["t",0]]}]}\n'
        '{"op":"identify","pairs":[["t.0","c%d"]]}\n' % (k, k) for k in range(5)) + \
        '{"op":"identify","pairs":[["t","t.0"]]}\n{"op":"note","text":"the end"}\n'
    ERROR = "standard input:14: \"t\" is a simplex of dimension 1 and"

    def said(self, *arguments, **options):
        """The lines of the log on standard error: (logger, level, text); and the other ones."""
        done = run("replay", "-", "--quiet", "--keep-going", *arguments, text=self.SCRIPT, **options)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        found = [re.fullmatch(r"\[sesame\.(\w+)\] \[(\w+)\] (.*)", line) for line in done.stderr.splitlines()]
        return [line.groups() for line in found if line], \
            [line for line, match in zip(done.stderr.splitlines(), found) if not match]

    def test_nothing_is_said_by_default(self):
        lines, others = self.said()
        self.assertEqual(lines, [])
        self.assertEqual(len(others), 1)
        self.assertTrue(others[0].startswith(self.ERROR), others)

    def test_milestones_are_said_with_verbose_once(self):
        lines, others = self.said("--verbose")
        self.assertEqual([line[:2] for line in lines],
                         [("tools", "info"), ("replay", "info"), ("replay", "info")])
        self.assertEqual(len(others), 1)

    def test_every_step_and_refusal_is_said_with_verbose_twice(self):
        for arguments in (["-vv"], ["--verbose", "-v"]):
            lines, _ = self.said(*arguments)
            self.assertEqual({level for _, level, _ in lines}, {"info", "debug"})
            steps = [text for logger, _, text in lines if logger == "engine"]
            self.assertEqual(len(steps), 13)
            self.assertRegex(steps[1], r"^step 2 \(identify\): cells merged or squashed: 1; took [0-9.]+ us, \d+ terms ")
            self.assertIn("step 13 (identify) did not happen: \"t\" is a simplex of dimension 1 and",
                          " ".join(text for logger, _, text in lines if logger == "refusals"))

    def test_three_times_is_the_most_that_is_said(self):
        thrice, _ = self.said("-vvv")
        self.assertEqual({level for _, level, _ in thrice}, {"info", "debug", "trace"})
        self.assertEqual(len(self.said("-vvvvv")[0]), len(thrice))

    def test_the_environment_asks_by_name(self):
        env = {**os.environ, "SPDLOG_LEVEL": "sesame.rebase=debug,sesame.refusals=debug"}
        lines = self.said(env=env)[0]
        self.assertEqual([line[:2] for line in lines], [("rebase", "debug")] * 5 + [("refusals", "debug")])
        self.assertRegex(lines[0][2], r"^begun afresh from 3 cells, as a split of so few is not worth taking in; took ")

    def test_a_tower_says_what_it_is_read_as_and_what_did_not_happen(self):
        done = run("tower", "-vv", "--quiet", "-", text="i 0\ni 0 1\n")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("[sesame.tower] [info] standard input: read as a tower\n", done.stderr)
        self.assertRegex(done.stderr, r"\[sesame.tower\] \[debug\] an operation did not happen: .*\n.*\bstandard input:2: ")

    def test_a_file_has_all_of_it_with_times_behind_what_it_had(self):
        with tempfile.TemporaryDirectory() as directory:
            log = pathlib.Path(directory, "log")
            for arguments, said in (([], []), (["-v"], ["tools", "replay", "replay"])):
                lines, _ = self.said("--log-file", log, *arguments)
                self.assertEqual([line[0] for line in lines], said)
            written = [re.fullmatch(r"\[\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{6}\] \[sesame\.(\w+)\] \[(\w+)\] (.*)", line)
                       for line in log.read_text(encoding="utf-8").splitlines()]
            self.assertNotIn(None, written)
            expected = [line[:2] for line in self.said("-vv")[0]]
            self.assertEqual([line.groups()[:2] for line in written], expected * 2)

    def test_standard_output_is_the_same_with_and_without(self):
        for arguments in (["tower", EXAMPLES / "coarsened_circle.tower"],
                          ["tower", "--json", "--pers", "-", EXAMPLES / "coarsened_circle.tower"],
                          ["replay", "--quiet", "--log", "-", EXAMPLES / "torus.jsonl"], ["generate", "tower-A", "--size", 9]):
            with tempfile.TemporaryDirectory() as directory:
                plain = run(*arguments)
                told = run(*arguments, "-vvv", "--log-file", os.path.join(directory, "log"))
            untimed = [re.sub(r'"seconds":[^,}]*', "", done.stdout) for done in (plain, told)]
            self.assertEqual((plain.returncode, untimed[0]), (told.returncode, untimed[1]))
            self.assertIn("[sesame.tools] [info] ", told.stderr)

    def test_a_log_that_is_another_file_of_the_command_line_is_refused(self):
        with tempfile.TemporaryDirectory() as directory:
            script, other = pathlib.Path(directory, "script"), pathlib.Path(directory, "other")
            script.write_text(HEADER + TRIANGLE, encoding="utf-8")
            os.symlink(script, other)
            absent = os.path.join(directory, "absent")
            relative = os.path.join(directory, ".", "absent")
            for arguments, expected in (
                    (["replay", script, "--log-file", script], "is what FILE names"),
                    (["replay", script, "--log-file", other], "is what FILE names"),
                    (["replay", script, "--log", absent, "--log-file", relative], "is what --log names"),
                    (["tower", script, "--svg", absent, "--log-file", relative], "is what --svg names"),
                    (["import", "x.off", "-o", absent, "--log-file", relative], "is what --output names"),
                    (["distance", other, script, "--log-file", script], "is what A names"),
                    (["replay", script, "--log-file", "-"], "standard output is for"),
                    (["replay", script, "--log-file", directory], "it is a folder"),
                    (["replay", script, "--log-file", absent + "/log"], "cannot write")):
                done = run(*arguments)
                self.assertEqual((arguments, done.returncode, done.stdout), (arguments, 1, ""))
                self.assertIn("--log-file: ", done.stderr)
                self.assertIn(expected, done.stderr)
            self.assertEqual(script.read_text(encoding="utf-8"), HEADER + TRIANGLE)
            self.assertFalse(os.path.exists(absent))

    def test_a_log_that_cannot_be_written_is_an_error_at_the_end(self):
        done = run("replay", "--quiet", "--log-file", "/dev/full", EXAMPLES / "torus.jsonl")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertEqual(done.stderr, "sesame: --log-file: cannot write /dev/full: No space left on device\n")

    def test_every_command_has_it(self):
        for command in ("replay", "import", "export", "mesh", "generate", "tower", "distance", "bench"):
            explained = run("help", command).stdout
            self.assertIn("--verbose", explained)
            self.assertIn("--log-file FILE", explained)


class Program(unittest.TestCase):
    def test_help_and_version(self):
        self.assertRegex(run("--version").stdout, r"^sesame \d+\.\d+\.\d+$|^sesame \d+\.\d+\.\d+\n$")
        for arguments in (["--help"], ["help"], ["help", "replay"], ["replay", "--help"], ["import", "--help"]):
            done = run(*arguments)
            self.assertEqual((arguments, done.returncode), (arguments, 0))
            self.assertIn("sesame", done.stdout)

    def test_every_command_is_explained(self):
        commands = ("replay", "import", "export", "mesh", "generate", "tower", "distance", "bench", "help")
        general = run("--help").stdout
        self.assertEqual((run("help").stdout, general.count("\nUsage: sesame [OPTIONS] SUBCOMMAND\n")), (general, 1))
        for command in commands:
            self.assertIn(f"\n  {command} ", general)
            explained = run("help", command)
            self.assertEqual((explained.returncode, explained.stderr), (0, ""))
            self.assertIn(f"Usage: sesame {command} ", explained.stdout)
            self.assertEqual(run(command, "--help").stdout, explained.stdout)
            self.assertNotIn("->", explained.stdout)

    def test_without_arguments_it_says_what_there_is_and_fails(self):
        done = run()
        self.assertEqual((done.returncode, done.stdout, done.stderr), (1, "", run("--help").stdout))

    def test_what_is_wrong_on_the_command_line_is_said_in_one_line(self):
        cases = {
            ("repaly", "x"): 'sesame: there is no command "repaly"; did you mean replay?\n',
            ("xyzzy",): 'sesame: there is no command "xyzzy"; see sesame --help\n',
            ("help", "tower-"): 'sesame help: there is no command "tower-"; did you mean tower?\n',
            ("--versoin",): "sesame: not expected: --versoin (did you mean --version?); see sesame --help\n",
            ("--json", "replay", "x"): "sesame replay: not expected: --json (it goes behind the command); ",
            ("replay", "--jsn"):
                "sesame replay: not expected: --jsn (did you mean --json?); see sesame replay --help\n",
            ("replay", "--utnil=3", "x"): "sesame replay: not expected: --utnil=3 (did you mean --until?); ",
            ("replay", "--xyzzy", "x"): "sesame replay: not expected: --xyzzy; ",
            ("tower", "a", "b", "c", "--formt", "d"): "not expected: b, c, --formt (did you mean --format?), d; ",
            ("replay", "--", "a", "--b", "c"): "sesame replay: not expected: --b, c; ",
            ("replay",): "sesame replay: FILE is required; ",
            ("mesh", "m.off", "--format", "3"): 'sesame mesh: --format: "3" should be auto, off, obj, ply or stl; ',
            ("mesh", "m.off", "--format", "OFF"): '"OFF" should be auto, off, obj, ply or stl; ',
            ("mesh", "m.off", "--generators-limit", "-1"): '"-1" should be a whole number from 0 on; ',
            ("import", "m.off", "--polygons", "0"): '"0" should be fan or cone; ',
            ("import", "m.off", "--order", "1"): '"1" should be connected or file; ',
            ("tower", "t", "--format", "1"): '"1" should be auto, tower, phat, phat-binary, gudhi, facets or script; ',
            ("distance", "a", "b", "--internal-p", "0"): '"0" should be inf or 2; ',
            ("generate", "torus", "--format", "off"): '"off" should be phat-binary, phat, gudhi, tower or script; ',
            ("bench", "--time-limit", "0"): '"0" should be a number above 0; ',
        }
        for arguments, said in cases.items():
            done = run(*arguments)
            self.assertEqual((arguments, done.returncode, done.stdout), (arguments, 1, ""))
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertTrue(done.stderr.startswith("sesame"), done.stderr)

    def test_import_then_replay(self):
        square = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"
        with tempfile.TemporaryDirectory() as directory:
            mesh = os.path.join(directory, "square.off")
            pathlib.Path(mesh).write_text(square, encoding="utf-8")
            for flags in ([], ["--assemble"], ["--polygons", "cone"], ["--order", "file", "--assemble"]):
                script = os.path.join(directory, "square.jsonl")
                self.assertEqual(run("import", mesh, "-o", script, *flags).returncode, 0)
                done = run("replay", "--json", "--verify", script)
                self.assertEqual((flags, done.returncode, done.stderr), (flags, 0, ""))
                self.assertEqual(json.loads(done.stdout.splitlines()[-1])["betti"], [1, 0, 0])
            pathlib.Path(mesh).write_text(square.replace("4 0 1 2 3", "4 0 1 2 7"), encoding="utf-8")
            done = run("import", mesh, "-o", script)
            self.assertEqual(done.returncode, 2)
            self.assertIn("square.off:7:", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
