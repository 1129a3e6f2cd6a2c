#!/usr/bin/env python3
"""What the program promises of everything that it writes: standard output that fails is said, files are whole or as
they were, logs go on or are replaced, and nothing that is read or that somebody has is lost.

Usage: outputs_test.py SESAME
"""

import gzip
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

SESAME = os.path.abspath(sys.argv[1])
IS_HEAVY = "--heavy" in sys.argv  # else each command in one way, in turns, where there are many
OLD = "somebody's old file\n"
SCRIPT = '{"sesame":1,"ring":"Z","title":"test"}\n{"op":"simplex","name":"t","dim":2}\n'
TOWER = "i 0\ni 1\ni 2\ni 0 1\ni 1 2\ni 0 2\nc 0 1\nc 2 1\n"
MESH = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
PERS = "0 0 inf\n1 2 3\n"


def simplices(names):
    return "".join('{"op":"simplex","name":"%s","dim":0}\n' % name for name in names)


class Folder(unittest.TestCase):
    """A folder with an input for every command; commands run in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, text in (("s.jsonl", SCRIPT), ("t.tower", TOWER), ("m.off", MESH), ("p.pers", PERS)):
            self.write(name, text)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def read(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    @staticmethod
    def script_of(log):
        """What a log says, as a script: its records without numbers and checksums."""
        records = [line for line in log.splitlines(keepends=True) if not line.startswith("#{")]
        return re.sub(r',"seq":\d+(,"synced":\d+)?,"xxh3":"[0-9a-f]{16}"}', "}", "".join(records))

    def log(self, name):
        return self.script_of(self.read(name))

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def run_in(self, *arguments, **options):
        options.setdefault("stdin", subprocess.DEVNULL)
        options.setdefault("stdout", subprocess.PIPE)
        return subprocess.run([SESAME, *map(str, arguments)], stderr=subprocess.PIPE, text=True, timeout=120,
                              check=False, cwd=self.folder, **options)

    def refused(self, what, *arguments, **options):
        done = self.run_in(*arguments, **options)
        self.assertEqual((arguments, done.returncode), (arguments, 1))
        self.assertIn(what, done.stderr, arguments)
        self.assertEqual(done.stderr.count("\n"), 1, (arguments, done.stderr))
        return done


# Every command, with everything that it says on standard output.
SAYING = [["help"], ["--help"], ["--version"], *(["help", name] for name in (
    "replay", "import", "export", "mesh", "generate", "tower", "distance", "bench", "help")),
    ["replay", "s.jsonl"], ["replay", "--json", "s.jsonl"], ["replay", "--generators", "s.jsonl"],
    ["replay", "--quiet", "--log", "-", "s.jsonl"], ["tower", "t.tower"], ["tower", "--json", "t.tower"],
    ["tower", "--every", "1", "t.tower"], ["tower", "--ring", "Z", "t.tower"], ["tower", "--generators", "t.tower"],
    ["tower", "--quiet", "--pers", "-", "t.tower"], ["tower", "s.jsonl"], ["distance", "p.pers", "p.pers"],
    ["distance", "--json", "--matching", "p.pers", "p.pers"], ["mesh", "m.off"], ["mesh", "--json", "m.off"],
    ["import", "m.off", "--quiet"], ["import", "--assemble", "--quiet", "m.off"], ["generate", "torus", "--size", "3"],
    *(["export", "s.jsonl", "--format", form] for form in ("script", "phat", "facets")),
    ["bench", "--list"], ["bench", "torus-random", "--size", "3", "--repeat", "1"],
    ["bench", "torus-random", "--size", "3", "--repeat", "1", "--json"]]

# Every option that names a file to write, and what is read meanwhile.
WRITING = [(["replay", "s.jsonl", "--quiet", "--overwrite", "--log"], "s.jsonl"),
           (["replay", "s.jsonl", "--quiet", "--html"], "s.jsonl"),
           *((["tower", "t.tower", "--quiet", f"--{kind}"], "t.tower") for kind in ("pers", "csv", "svg", "html")),
           (["import", "m.off", "--quiet", "-o"], "m.off"),
           *((["export", "s.jsonl", "--format", form, "-o"], "s.jsonl") for form in ("script", "phat")),
           (["generate", "torus", "--size", "3", "-o"], None),
           (["bench", "torus-random", "--size", "3", "--repeat", "1", "--out"], None),
           (["bench", "torus-random", "--size", "3", "--repeat", "1", "--html"], None),
           (["bench", "torus-random", "--size", "3", "--counts"], None),
           (["bench", "--mesh", "m.off", "--repeat", "1", "--out"], "m.off")]


def in_turns(ways, number):
    return ways if IS_HEAVY else ways[number % len(ways):][:1]


class StandardOutput(Folder):
    def test_every_command_says_when_its_output_is_full_or_closed(self):
        for arguments in SAYING:
            self.assertEqual(self.run_in(*arguments).returncode, 0, arguments)
            what = "cannot write standard output" if "--log" in arguments else "sesame: cannot write to standard output"
            with open("/dev/full", "w", encoding="utf-8") as full:
                self.refused(what, *arguments, stdout=full)
            self.refused(what, *arguments, stdout=None,
                         preexec_fn=lambda: os.close(1))

    def test_what_is_meant_for_a_closed_output_does_not_go_into_a_file(self):
        done = self.run_in("tower", "t.tower", "--pers", "x", stdout=None, preexec_fn=lambda: os.close(1))
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.run_in("tower", "t.tower", "--pers", "y", "--quiet").returncode, 0)
        self.assertEqual(self.read("x"), self.read("y"))
        quiet = self.run_in("tower", "t.tower", "--pers", "x", "--quiet", stdout=None, preexec_fn=lambda: os.close(1))
        self.assertEqual((quiet.returncode, quiet.stderr), (0, ""))

    def test_a_closed_input_is_no_file_that_is_opened_later(self):
        done = self.run_in("replay", "-", "--log", "x", stdin=None, preexec_fn=lambda: os.close(0))
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot read standard input", done.stderr)


class Files(Folder):
    def test_an_output_is_written_and_nothing_else_is_left(self):
        before = self.names()
        for arguments, _ in WRITING:
            self.write("x", OLD)
            self.assertEqual(self.run_in(*arguments, "x").returncode, 0, arguments)
            self.assertNotEqual(self.read("x"), OLD)
            os.remove(self.folder / "x")
            self.assertEqual(self.run_in(*arguments, "new/../x").returncode, 1, arguments)
            self.assertEqual(self.run_in(*arguments, "./x").returncode, 0, arguments)
            os.remove(self.folder / "x")
            self.assertEqual(self.names(), before)

    def test_a_full_disk_leaves_the_old_file(self):
        before = self.names()
        for arguments, _ in WRITING:
            for size in (0, 16) if IS_HEAVY else (16,):
                self.write("x", OLD)
                self.refused("cannot write x: File too large", *arguments, "x",
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
                self.assertEqual(self.read("x"), OLD, arguments)
                os.remove(self.folder / "x")
                self.refused("cannot write x: File too large", *arguments, "x",
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
                if "--log" in arguments:  # it is kept line by line, and has whole lines only
                    self.assertEqual(self.log("x") if (self.folder / "x").exists() else "", "")
                    (self.folder / "x").unlink(missing_ok=True)
                self.assertEqual(self.names(), before, arguments)
            self.refused("cannot write /dev/full: No space left on device", *arguments, "/dev/full")

    def test_no_output_is_the_input_by_whichever_name(self):
        for number, (arguments, read) in enumerate(WRITING):
            if read is None:
                continue
            text = self.read(read)
            os.symlink(read, self.folder / "symlink")
            os.link(self.folder / read, self.folder / "hardlink")
            for name in in_turns((read, "./" + read, self.folder / read, "symlink", "hardlink"), number):
                self.refused("is the input; give the output another name", *arguments, name)
                self.assertEqual(self.read(read), text)
            os.remove(self.folder / "symlink")
            os.remove(self.folder / "hardlink")

    def test_no_output_is_the_file_of_a_standard_stream(self):
        for number, (arguments, _) in enumerate(WRITING):
            words = ["-" if word in ("s.jsonl", "t.tower") else word for word in arguments]
            for command, name in in_turns(((words, "i"), (words, "./i"), (arguments, "i")), number):
                text = SCRIPT if "replay" in arguments else TOWER
                self.write("i", text)
                with open(self.folder / "i", encoding="utf-8") as stream:
                    self.refused("is the input", *command, name, stdin=stream)
                self.assertEqual(self.read("i"), text)
            for descriptor, role in in_turns((("stdout", "standard output"), ("stderr", "standard error")), number):
                self.write("o", "")
                with open(self.folder / "o", "a", encoding="utf-8") as stream:
                    done = subprocess.run([SESAME, *arguments, "o"], cwd=self.folder, check=False, timeout=120,
                                          stdin=subprocess.DEVNULL,
                                          **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, descriptor: stream})
                said = self.read("o") if descriptor == "stderr" else done.stderr.decode()
                self.assertEqual(done.returncode, 1, arguments)
                self.assertIn(f"o is where {role} goes", said)

    def test_two_outputs_are_two_files(self):
        os.mkdir(self.folder / "d")
        os.symlink("d", self.folder / "e")
        self.write("old", OLD)
        os.symlink("old", self.folder / "symlink")
        os.link(self.folder / "old", self.folder / "hardlink")
        before = self.names()
        for one, other in (("x", "x"), ("x", "./x"), ("d/x", "e/x"), ("old", "symlink"), ("old", "hardlink"),
                           ("x", "x.part"), ("-", "-"), ("-", "/dev/stdout")):
            self.refused("two outputs are one file", "tower", "t.tower", "--quiet", "--pers", one, "--csv", other)
            self.refused("two outputs are one file", "bench", "torus-random", "--size", "3", "--repeat", "1",
                         "--json", "--out", one, "--html", other)
        self.assertEqual((self.names(), self.read("old"), os.listdir(self.folder / "d")), (before, OLD, []))
        done = self.run_in("tower", "t.tower", "--quiet", "--pers", "x.part", "--csv", "x")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("0 0 inf", self.read("x.part"))
        self.assertIn("time", self.read("x"))
        self.assertEqual(self.run_in("tower", "t.tower", "--pers", "/dev/null", "--csv", "/dev/null").returncode, 0)

    def test_a_file_called_as_the_part_would_be_is_left_alone(self):
        self.write("x.part", OLD)
        os.symlink("m.off", self.folder / "x.2.part")
        self.assertEqual(self.run_in("tower", "t.tower", "--quiet", "--pers", "x").returncode, 0)
        self.assertEqual((self.read("x.part"), self.read("m.off")), (OLD, MESH))
        self.assertIn("0 0 inf", self.read("x"))

    def test_what_is_replaced_keeps_its_permissions_and_its_links(self):
        self.write("x", OLD)
        os.chmod(self.folder / "x", 0o640)
        os.symlink("x", self.folder / "link")
        self.assertEqual(self.run_in("generate", "torus", "--size", "3", "-o", "link").returncode, 0)
        self.assertTrue((self.folder / "link").is_symlink())
        self.assertNotEqual((self.folder / "x").read_bytes(), OLD.encode())
        self.assertEqual((self.folder / "x").stat().st_mode & 0o777, 0o640)

    def test_what_cannot_be_written_is_named_with_the_reason(self):
        os.symlink("nowhere", self.folder / "dangling")
        for number, (arguments, _) in enumerate(WRITING):
            for name, reason in in_turns((("no/x", "No such file or directory"), (".", "it is a folder"),
                                          ("dangling", "it is a link to nothing"), ("m.off/x", "")), number):
                self.refused(f"cannot write {name}: {reason}", *arguments, name)

    @staticmethod
    def wait_for(condition):
        deadline = time.monotonic() + 60
        while not condition():
            if time.monotonic() > deadline:
                raise TimeoutError("what was waited for has not come")
            time.sleep(0.01)

    def test_a_signal_leaves_the_old_file_and_nothing_else(self):
        self.write("x", OLD)
        before = self.names()
        endless = [["generate", "tower-stream", "--size", "1000000000", "-o", "x"],
                   ["bench", "torus-random", "--size", "3", "--repeat", "1000000", "--out", "x"],
                   ["tower", "-", "--quiet", "--pers", "x"]]
        for arguments in endless:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                if "tower" in arguments and number == signal.SIGINT:
                    continue  # ends the reading, and what was read is reported
                with subprocess.Popen([SESAME, *arguments], cwd=self.folder, stdin=subprocess.PIPE, bufsize=0,
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
                    process.stdin.write(TOWER.encode())
                    self.wait_for((self.folder / "x.part").exists)
                    process.send_signal(number)
                    self.assertEqual(process.wait(timeout=60), -number, arguments)
                self.assertEqual((self.read("x"), self.names()), (OLD, before), (arguments, number))

    def test_a_broken_pipe_leaves_the_old_file(self):
        self.write("x", OLD)
        before = self.names()
        reading, writing = os.pipe()
        os.close(reading)
        done = self.run_in("tower", "t.tower", "--every", "1", "--pers", "x", stdout=writing)
        os.close(writing)
        self.assertEqual((done.returncode, self.read("x"), self.names()), (-signal.SIGPIPE, OLD, before))


class Logs(Folder):
    def replay(self, *arguments, text=None):
        options = {"input": text, "stdin": None} if text is not None else {}
        return self.run_in("replay", *arguments, **options)

    def steps(self, name):
        """The homology after each step of a log, which holds: every step is applied."""
        done = self.replay("--json", "--every", "1", name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [json.loads(line)["betti"] for line in done.stdout.splitlines()]

    def test_an_existing_log_is_refused_unless_it_is_said_what_becomes_of_it(self):
        for text in (OLD, SCRIPT, ""):
            self.write("log", text)
            done = self.refused("log is there already; --append goes on from it, --overwrite replaces it",
                                "replay", "s.jsonl", "--log", "log")
            self.assertEqual((done.stdout, self.log("log")), ("", text))
        self.assertEqual(self.replay("s.jsonl", "--append").returncode, 1)
        self.assertEqual(self.replay("s.jsonl", "--overwrite").returncode, 1)
        self.assertEqual(self.replay("s.jsonl", "--log", "new", "--append", "--overwrite").returncode, 1)
        self.assertFalse((self.folder / "new").exists())
        for flags in ([], ["--append"], ["--overwrite"]):
            self.assertEqual(self.replay("s.jsonl", "--log", "new", *flags).returncode, 0)
            self.assertEqual(self.log("new"), SCRIPT)
            os.remove(self.folder / "new")

    def test_an_appended_log_is_one_log(self):
        first, second = SCRIPT + simplices("ab"), SCRIPT + '{"op":"undo","steps":1}\n' + simplices("cd")
        second = second.replace('"t"', '"u"')
        done = self.replay("-", "--log", "log", "--append", text=first)
        self.assertEqual(done.returncode, 0)
        done = self.replay("-", "--log", "log", "--append", "--json", text=second)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        objects = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([each.get("step") for each in objects], [4, 5, 6, 7, None])  # the new ones
        self.assertEqual(objects[-1]["steps"], 7)
        header, *rest = second.splitlines(keepends=True)
        self.assertEqual(self.log("log"), first + "".join(rest))
        self.assertEqual(self.steps("log")[-1], objects[-1]["betti"])

    def test_an_appended_log_takes_back_steps_of_the_old_one_and_counts_until_from_there(self):
        self.write("log", SCRIPT + simplices("ab"))
        text = SCRIPT.splitlines(keepends=True)[0] + '{"op":"undo","steps":2}\n' + simplices("cde")
        self.assertEqual(self.replay("-", "--log", "log", "--append", "--until", "3", text=text).returncode, 0)
        self.assertEqual(self.log("log"), SCRIPT + simplices("ab") + '{"op":"undo","steps":2}\n' + simplices("cd"))
        self.assertEqual(self.steps("log")[-1], [3, 0, 0])

    def test_a_log_without_a_last_newline_is_gone_on_from(self):
        self.write("log", SCRIPT.strip())
        text = SCRIPT.replace('"t"', '"u"')
        self.assertEqual(self.replay("-", "--log", "log", "--append", text=text).returncode, 0)
        self.assertEqual(self.log("log"), SCRIPT + text.splitlines(keepends=True)[1])

    def test_a_log_that_is_packed_is_not_gone_on_from(self):
        packed = gzip.compress(SCRIPT.encode())
        (self.folder / "log").write_bytes(packed)
        self.refused("it is packed by gzip", "replay", "s.jsonl", "--log", "log", "--append")
        self.assertEqual((self.folder / "log").read_bytes(), packed)

    def test_an_empty_log_gets_a_header(self):
        self.write("log", "")
        self.assertEqual(self.replay("s.jsonl", "--log", "log", "--append").returncode, 0)
        self.assertEqual(self.log("log"), SCRIPT)

    def test_a_log_that_does_not_hold_or_is_over_another_ring_is_not_gone_on_from(self):
        wrong = {SCRIPT + '{"op":"simplex"\n': (2, "log:3: "), OLD: (2, "log:1: "),
                 SCRIPT + SCRIPT.splitlines()[1]: (2, "log:3: "),
                 SCRIPT + '{"op":"expect","betti":[7]}\n': (3, "log:3: betti should be [7]"),
                 SCRIPT.replace('"Z"', '"Z/3"'): (2, "log:1: this log is over Z/3")}
        for text, (status, what) in wrong.items():
            self.write("log", text)
            done = self.replay("-", "--log", "log", "--append", text=SCRIPT.replace('"t"', '"u"'))
            self.assertEqual((done.returncode, self.log("log")), (status, text))
            self.assertIn(what, done.stderr)
        done = self.replay("-", "--log", "log", "--append", "--ring", "Z/3", text=SCRIPT.replace('"t"', '"u"'))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(len(self.steps("log")), 3)

    def test_a_refused_step_leaves_a_log_that_holds(self):
        bad = SCRIPT.replace('"t"', '"u"') + simplices("a") + '{"op":"simplex","name":"a","dim":1}\n' + simplices("b")
        good = "".join(bad.splitlines(keepends=True)[:3])
        self.assertEqual(self.replay("-", "--log", "log", text=bad).returncode, 2)
        self.assertEqual(self.log("log"), good)
        self.write("log", SCRIPT)
        self.assertEqual(self.replay("-", "--log", "log", "--append", text=bad).returncode, 2)
        self.assertEqual(self.log("log"), SCRIPT + "".join(good.splitlines(keepends=True)[1:]))
        self.assertEqual(len(self.steps("log")), 4)

    def test_a_replay_that_breaks_off_leaves_the_log_that_it_was_to_replace_and_the_new_one(self):
        self.write("log", OLD)
        before = self.names()
        text = SCRIPT + SCRIPT.splitlines()[1]
        done = self.replay("-", "--log", "log", "--overwrite", text=text)
        self.assertEqual((done.returncode, self.log("log"), self.log("log.part")), (2, OLD, SCRIPT))
        self.assertIn("log is as it was; the log of the steps until here is ", done.stderr)
        os.remove(self.folder / "log.part")
        done = self.replay("-", "--log", "log", "--overwrite", text="no header\n")
        self.assertEqual((done.returncode, self.log("log"), self.names()), (2, OLD, before))
        self.assertEqual(self.replay("-", "--log", "new", text="no header\n").returncode, 2)
        self.assertEqual(self.names(), before)

    def test_a_replay_that_goes_on_behind_refused_steps_replaces_the_log_with_what_happened(self):
        refused = simplices("a") + '{"op":"no such"}\nno JSON\n{"op":"expect","betti":[7]}\n'
        for text, status in ((SCRIPT + simplices("a") + refused + simplices("b"), 2),
                             (SCRIPT + simplices("a") + '{"op":"expect","betti":[7]}\n' + simplices("b"), 3)):
            self.write("log", OLD)
            before = self.names()
            done = self.replay("-", "--log", "log", "--overwrite", "--keep-going", text=text)
            self.assertEqual((done.returncode, self.log("log")), (status, SCRIPT + simplices("ab")), done.stderr)
            self.assertEqual(self.names(), before)
            self.assertEqual(self.steps("log")[:3], [[1, 0, 0], [2, 0, 0], [3, 0, 0]])
        done = self.replay("-", "--log", "log", "--append", "--keep-going", text=SCRIPT.replace('"t"', '"u"') + refused)
        self.assertEqual((done.returncode, self.log("log")),
                         (2, SCRIPT + simplices("ab") + SCRIPT.replace('"t"', '"u"').splitlines(keepends=True)[1]))

    def test_a_replay_that_goes_on_but_has_no_header_leaves_the_old_log(self):
        self.write("log", OLD)
        before = self.names()
        for text in ("", "no header\n", simplices("ab"), '{"sesame":1,"ring":"Z/6"}\n' + simplices("ab")):
            done = self.replay("-", "--log", "log", "--overwrite", "--keep-going", text=text)
            self.assertEqual((done.returncode, self.log("log"), self.names()), (2, OLD, before), text)

    def test_a_replay_that_goes_on_to_an_end_that_is_none_leaves_both_logs(self):
        packed = gzip.compress((SCRIPT + simplices("abcdefgh")).encode())
        (self.folder / "cut.gz").write_bytes(packed[:-12])
        self.write("long.jsonl", SCRIPT + '{"op":"note","text":"%s"}\n' % ("x" * 200) + simplices("a"))
        for arguments, what in ((["cut.gz"], "cut off"), (["long.jsonl", "--max-line", "100"], "long.jsonl:3: ")):
            self.write("log", OLD)
            done = self.replay(*arguments, "--json", "--log", "log", "--overwrite", "--keep-going")
            self.assertEqual((done.returncode, self.log("log")), (2, OLD), arguments)
            self.assertIn(what, done.stderr)
            self.assertIn("log is as it was; the log of the steps until here is ", done.stderr)
            self.assertTrue(self.log("log.part").startswith(SCRIPT))
            objects = [json.loads(line) for line in done.stdout.splitlines()]
            self.assertEqual([o for o in objects if "summary" in o or "error" in o], [])
            os.remove(self.folder / "log.part")

    def begin(self, *arguments):
        process = subprocess.Popen([SESAME, "replay", "-", "--json", *arguments], cwd=self.folder, text=True,
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdin.write(SCRIPT)
        process.stdin.flush()
        process.stdout.readline()  # it has taken the step
        return process

    def test_a_step_is_in_the_log_before_it_is_reported(self):
        with self.begin("--log", "log") as process:
            self.assertEqual(self.log("log"), SCRIPT)
            process.kill()
        self.write("log", OLD)
        with self.begin("--log", "log", "--overwrite") as process:
            self.assertEqual((self.log("log"), self.log("log.part")), (OLD, SCRIPT))
            process.kill()
            process.wait(timeout=60)
            self.assertEqual((self.log("log"), self.log("log.part")), (OLD, SCRIPT))

    def test_an_interrupt_completes_the_log(self):
        self.write("log", OLD)
        with self.begin("--log", "log", "--overwrite") as process:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            self.assertEqual((process.returncode, self.log("log")), (130, SCRIPT))
        self.assertNotIn("log.part", self.names())
        os.remove(self.folder / "log")
        with self.begin("--log", "log") as process:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            self.assertEqual((process.returncode, self.log("log")), (130, SCRIPT))

    def test_one_replay_at_a_time_goes_on_from_a_log(self):
        self.write("log", SCRIPT.replace('"t"', '"u"'))
        with self.begin("--log", "log", "--append") as process:
            self.refused(f"another process, {process.pid}, is writing this log", "replay", "s.jsonl", "--log", "log", "--append")
            process.communicate(timeout=60)
        self.assertEqual(len(self.steps("log")), 3)

    def test_a_full_disk_ends_the_replay_and_leaves_whole_lines(self):
        long = SCRIPT + '{"op":"note","text":"%s"}\n' % ("x" * 200000) + simplices("a")
        self.assertEqual(self.replay("s.jsonl", "--log", "log").returncode, 0)
        whole = [len(line) for line in self.read("log").splitlines(keepends=True)]
        os.remove(self.folder / "log")
        for size, lines in ((sum(whole[:2]), 2), (sum(whole[:2]) + 70000, 2), (sum(whole[:2]) - 1, 1)):
            def limit():
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

            self.write("long.jsonl", long)
            done = self.refused("cannot write log: File too large", "replay", "long.jsonl", "--log", "log", "--json",
                                preexec_fn=limit)
            self.assertEqual(self.log("log"), "".join(SCRIPT.splitlines(keepends=True)[:lines]))
            self.assertLess(len(done.stdout.splitlines()), 3)
            os.remove(self.folder / "log")
            self.write("log", OLD)
            done = self.run_in("replay", "long.jsonl", "--log", "log", "--overwrite", preexec_fn=limit)
            self.assertEqual(done.returncode, 1)
            self.assertIn("cannot write log: File too large", done.stderr)
            self.assertEqual(self.log("log"), OLD)
            self.assertEqual(self.log("log.part"), "".join(SCRIPT.splitlines(keepends=True)[:lines]))
            os.remove(self.folder / "log.part")
            os.remove(self.folder / "log")

    def test_a_log_goes_to_standard_output(self):
        done = self.replay("s.jsonl", "--quiet", "--log", "-")
        self.assertEqual((done.returncode, self.script_of(done.stdout)), (0, SCRIPT))
        self.assertNotIn("-", self.names())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
