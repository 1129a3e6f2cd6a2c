#!/usr/bin/env python3
"""What every command reads, and how it ends: whole, badly, in no memory, never; from files, pipes and terminals.

Usage: streams_test.py SESAME EXAMPLES_DIRECTORY MESHES_DIRECTORY FAILING_CALLS
FAILING_CALLS is the library of failing_calls.cpp. Exit status 77: it cannot be preloaded here (under a sanitizer).
"""

import gzip
import json
import os
import pathlib
import pty
import resource
import select
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

SESAME, EXAMPLES, MESHES, FAILING_CALLS = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]), sys.argv[4]
IS_HEAVY = "--heavy" in sys.argv  # else memory runs out at fewer places
HEADER = '{"sesame":1,"ring":"Z","title":"test"}\n'
TRIANGLE = '{"op":"simplex","name":"t","dim":2}\n'
POINT = '{"op":"simplex","name":"u","dim":0}\n'


def run(*arguments, **options):
    options = {"capture_output": True, "timeout": 120, "check": False} | options
    done = subprocess.run([SESAME, *map(str, arguments)], **options)
    done.stdout = done.stdout.decode() if done.stdout is not None else None
    done.stderr = done.stderr.decode()
    return done


def can_preload():
    environment = os.environ | {"LD_PRELOAD": FAILING_CALLS}
    return subprocess.run([SESAME, "--version"], env=environment, capture_output=True, check=False).returncode == 0


def binary_matrix():
    columns = [[0, 0], [0, 0], [1, 2, 0, 1]]
    return struct.pack("<q", len(columns)) + b"".join(struct.pack(f"<{len(c)}q", *c) for c in columns)


BARS = b"0 0 inf\n0 1 3\n1 2 2.5\n"
TOWER = (EXAMPLES / "contracted_circle.tower").read_bytes()
SCRIPT = (EXAMPLES / "wedge.jsonl").read_bytes()
# What is said of data that are no text: of a zero byte, or of a whole line that stands before the first one.
REFUSED_DATA = "byte [0-9]+ of this (line )?is zero|a line should be one JSON object"
# What each command reads, as (arguments, content); FILE stands for the file.
READERS = {
    "replay": (["replay", "--json", "FILE"], SCRIPT),
    "replay, packed": (["replay", "--json", "FILE"], gzip.compress(SCRIPT)),
    "replay, going on": (["replay", "--json", "--keep-going", "FILE"], SCRIPT),
    "export": (["export", "--format", "phat", "FILE"], SCRIPT),
    "export, steps": (["export", "--format", "script", "FILE"], SCRIPT),
    "export, packed": (["export", "--format", "phat", "FILE"], gzip.compress(SCRIPT)),
    "tower": (["tower", "--json", "FILE"], TOWER),
    "tower, packed": (["tower", "--json", "FILE"], gzip.compress(TOWER)),
    "tower, integers": (["tower", "--ring", "Z", "--json", "FILE"], TOWER),
    "tower, boundary matrix": (["tower", "--json", "FILE"], b"0\n0\n1 0 1\n"),
    "tower, binary matrix": (["tower", "--json", "FILE"], binary_matrix()),
    "tower, filtration": (["tower", "--json", "FILE"], b"0 0 0\n0 1 0\n1 0 1 2.5\n"),
    "tower, script": (["tower", "--json", "FILE"], HEADER.encode() + b'{"op":"insert","simplex":[0,1]}\n' * 1),
    "distance, left": (["distance", "--json", "FILE", "OTHER"], BARS),
    "distance, right": (["distance", "--json", "OTHER", "FILE"], BARS),
    "distance, packed": (["distance", "--json", "OTHER", "FILE"], gzip.compress(BARS)),
    "bench --against": (["bench", "--against", "FILE", "klein-bottle-random"], b'{"sesame_bench":1}'),
    "bench --compare": (["bench", "--compare", "FILE", "--quick", "klein-bottle-random"], b'{"sesame_bench":1}'),
} | {f"{command}, {mesh}": ([command, "FILE"], (MESHES / mesh).read_bytes())
     for command in ("mesh", "import") for mesh in ("torus.off", "cube.obj", "tetrahedron.ply", "tetrahedron.stl")}


class Directory(unittest.TestCase):
    """Has a directory for files."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.directory = pathlib.Path(holder.name)
        self.other = self.write("other.pers", BARS)

    def write(self, name, content):
        path = self.directory / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def arguments(self, arguments, path):
        return [{"FILE": path, "OTHER": self.other}.get(a, a) for a in arguments]

    def named_for(self, reader):
        """Meshes are known by their extensions, too."""
        return "input" + (pathlib.Path(reader).suffix if ", " in reader else "")


def places(size, count):
    """Some numbers below a size, both ends among them."""
    return sorted({0, 1, size - 1, *range(0, size, max(1, size // count))})


class Failures(Directory):
    def failing(self, path, **variables):
        return os.environ | {"LD_PRELOAD": FAILING_CALLS, "FAIL_FILE": str(path)} | \
            {name: str(value) for name, value in variables.items()}

    def test_a_read_error_is_status_1_with_its_reason_wherever_it_is(self):
        for reader, (arguments, content) in READERS.items():
            path = self.write(self.named_for(reader), content)
            for at in places(len(content), 12 if IS_HEAVY else 2):
                done = run(*self.arguments(arguments, path), env=self.failing(path, FAIL_READ_AT=at))
                self.assertEqual((reader, at, done.returncode), (reader, at, 1), done.stderr)
                self.assertIn(f"cannot read {path}: Input/output error", done.stderr)
                self.assertNotIn('"summary"', done.stdout)

    def test_a_read_error_on_standard_input_is_one_too(self):
        for reader, (arguments, content) in READERS.items():
            if reader.startswith("bench"):
                continue
            path = self.write(self.named_for(reader), content)
            at = len(content) // 2
            with open(path, "rb") as stream:
                done = run(*self.arguments(arguments, "-"), stdin=stream, env=self.failing(path, FAIL_READ_AT=at))
            self.assertEqual((reader, done.returncode), (reader, 1), done.stderr)
            self.assertIn("cannot read standard input: Input/output error", done.stderr)

    def test_a_folder_that_cannot_be_synced_is_a_warning(self):
        output = self.directory / "torus.phat"
        done = run("generate", "torus-300", "--size", 3, "-o", output, env=self.failing(self.directory, FAIL_SYNC=1))
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertRegex(done.stderr, r"^\[sesame.tools\] \[warning\] .*torus.phat is written, but .*: Input/output error$")
        self.assertGreater(output.stat().st_size, 0)

    def test_an_allocation_that_fails_is_status_5_with_its_reason_or_does_not_matter(self):
        script = self.write("script.jsonl", SCRIPT)
        for reader in ("replay", "tower", "tower, integers", "distance, left", "mesh, torus.off", "import, torus.off"):
            arguments, content = READERS[reader]
            path = self.write(self.named_for(reader), content)
            arguments = self.arguments(arguments, path)
            right = run(*arguments)
            failed = 0
            for number in [*range(1, 40, 1 if IS_HEAVY else 9), *range(40, 4000, 97 if IS_HEAVY else 797)]:
                done = run(*arguments, env=self.failing(path, FAIL_ALLOCATION=number))
                what = (reader, number, done.returncode, done.stderr)
                if done.returncode == 0:
                    self.assertEqual(self.timeless(done.stdout), self.timeless(right.stdout), what)
                else:
                    failed += 1
                    self.assertEqual(done.returncode, 5, what)
                    self.assertIn("out of memory", done.stderr, what)
            self.assertGreater(failed, 20 if IS_HEAVY else 3, reader)
        self.assertTrue(script.exists())

    def test_a_log_has_the_steps_that_were_reported_when_memory_runs_out(self):
        path = self.write("script.jsonl", SCRIPT)
        steps = [json.loads(line)["op"] for line in SCRIPT.decode().splitlines() if line.startswith('{"op"')]
        log = self.directory / "log.jsonl"
        for variable in ("FAIL_ALLOCATION", "FAIL_ALLOCATIONS_FROM"):
            cut = 0
            for number in range(1, 5000, 25 if IS_HEAVY else 333):
                log.unlink(missing_ok=True)
                done = run("replay", "--json", path, "--log", log, "--sync", "never",
                           env=self.failing(path, **{variable: number}))
                what = (variable, number, done.returncode, done.stderr)
                self.assertIn(done.returncode, (0, 5), what)
                reported = [json.loads(line)["op"] for line in done.stdout.splitlines() if '"step"' in line]
                text = log.read_text(encoding="utf-8") if log.exists() else ""
                self.assertTrue(text == "" or text.endswith("\n"), what)
                records = [json.loads(line) for line in text.splitlines() if not line.startswith("#")]
                logged = [record["op"] for record in records[1:]]
                self.assertEqual(logged, steps[:len(logged)], what)
                # One may have happened, and the memory for saying so was missing.
                self.assertIn(len(logged) - len(reported), (0, 1), what)
                cut += done.returncode != 0
            self.assertGreater(cut, 20 if IS_HEAVY else 1, variable)

    @staticmethod
    def timeless(text):
        kept = []
        for line in text.splitlines():
            try:
                value = json.loads(line)
                value.pop("us", None)
                value.pop("seconds", None)
                kept.append(json.dumps(value))
            except json.JSONDecodeError:
                kept.append(line if " s" not in line and "us" not in line else "")
        return kept


class Memory(Directory):
    def test_a_line_of_60_megabytes_is_read_or_refused_for_want_of_memory_whatever_there_is_of_it(self):
        script = self.write("long.jsonl", HEADER + TRIANGLE + '{"op":"note","text":"' + "x" * 60_000_000 + '"}\n' + POINT +
                            '{"op":"expect","betti":[2]}\n')
        outcomes = []
        for megabytes in (100, 120, 150, 180, 220, 260, 300, 350, 400, 500)[::1 if IS_HEAVY else 3]:
            done = run("replay", "--json", "--every", 1, script,
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20)))
            outcomes.append(done.returncode)
            if done.returncode == 0:
                self.assertEqual(json.loads(done.stdout.splitlines()[-1])["steps"], 4)
            else:
                self.assertEqual((megabytes, done.returncode), (megabytes, 5), done.stderr)
                self.assertIn("out of memory", done.stderr)
                self.assertNotIn('"summary"', done.stdout)
        self.assertEqual(outcomes, sorted(outcomes, reverse=True))
        self.assertEqual((outcomes[0], outcomes[-1]), (5, 0))

    def test_other_readers_run_out_of_memory_with_the_same_sentence(self):
        comment = b"# " + b"x" * 60_000_000 + b"\n"
        for name, arguments, content in (("a.tower", ["tower"], comment + b"i 0\n"),
                                         ("a.pers", ["distance", self.other], comment + BARS),
                                         ("a.off", ["mesh"], comment + (MESHES / "torus.off").read_bytes()),
                                         ("a.off", ["import"], comment + (MESHES / "torus.off").read_bytes())):
            path = self.write(name, content)
            done = run(*arguments, path,
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (100 << 20, 100 << 20)))
            self.assertEqual((arguments, done.returncode), (arguments, 5), done.stderr)
            self.assertIn("out of memory", done.stderr)


class Lines(Directory):
    def test_a_line_that_is_longer_than_the_limit_is_refused_with_its_place(self):
        note = '{"op":"note","text":"' + "x" * 5000 + '"}\n'
        script = self.write("script.jsonl", HEADER + note + TRIANGLE)
        done = run("replay", "--json", "--max-line", 5000, script)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"{script}:2: this line is longer than 5000 bytes", done.stderr)
        self.assertEqual(run("replay", "--quiet", "--max-line", 5100, script).returncode, 0)
        self.assertEqual(run("tower", "--ring", "Z", "--max-line", 5000, script).returncode, 2)
        tower = self.write("long.tower", b"i 0\n#" + b"x" * 5000 + b"\ni 1\n")
        done = run("tower", "--max-line", 5000, tower)
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"{tower}:2: this line is longer than 5000 bytes", done.stderr)
        self.assertEqual(run("tower", "--max-line", 5001, tower).returncode, 0)

    def test_what_never_ends_is_refused_by_its_first_bytes(self):
        for device in ("/dev/zero", "/dev/urandom"):
            done = run("replay", device)
            self.assertEqual((device, done.returncode), (device, 2))
            self.assertRegex(done.stderr, "a script is a text" if device == "/dev/zero" else REFUSED_DATA)
        # Data that begin like a list of facets, or like a script, a mesh or a barcode, are no text either.
        for beginning in (b"(Y\xff,\n)", b"[", b'{"sesame":1,"ring":"Z"}\n', b"1 2 3\n", b"OFF\n", b"v 0 0 0\n", b"i 0\n"):
            data = self.write("data", beginning + b"\0\1\2" * 1000)
            for command in ("replay", "tower", "mesh", "import"):
                done = run(command, data)
                self.assertEqual((beginning, command, done.returncode), (beginning, command, 2), done.stderr)
            self.assertRegex(run("replay", data).stderr, REFUSED_DATA)
        for command in ("mesh", "import"):
            done = run(command, "/dev/zero")
            self.assertEqual((command, done.returncode), (command, 2), done.stderr)
        endless = subprocess.Popen(["sh", "-c", f"yes 'no script' | {SESAME} replay -"], stderr=subprocess.PIPE)
        self.assertIn(b"standard input:1: a line should be one JSON object", endless.communicate(timeout=60)[1])

    def test_an_input_for_another_command_is_refused_with_the_name_of_that_command(self):
        done = run("replay", EXAMPLES / "contracted_circle.tower")
        self.assertEqual(done.returncode, 2)
        self.assertIn("`sesame tower`", done.stderr)
        for command in ("replay", "tower"):
            for mesh in ("torus.off", "cube.obj", "tetrahedron.ply", "tetrahedron.stl"):
                done = run(command, MESHES / mesh)
                self.assertEqual((command, mesh, done.returncode), (command, mesh, 2))
                self.assertIn("`sesame mesh`", done.stderr)


class Inputs(Directory):
    def test_every_command_reads_standard_input_gzip_and_pipes(self):
        for reader, (arguments, content) in READERS.items():
            if reader.startswith("bench") or "packed" in reader:
                continue
            suffix = pathlib.Path(reader).suffix if ", " in reader else ""
            plain = run(*self.arguments(arguments, self.write("plain" + suffix, content)))
            self.assertEqual((reader, plain.returncode), (reader, 0), plain.stderr)
            packed = run(*self.arguments(arguments, self.write(f"packed{suffix}.gz", gzip.compress(content))))
            given_packed = run(*self.arguments(arguments, "-"), input=gzip.compress(content))
            piped = run(*self.arguments(arguments, "/dev/stdin"), input=content)
            for done in (packed, given_packed, piped):
                self.assertEqual((reader, done.returncode), (reader, 0), done.stderr)
                self.assertEqual(len(done.stdout.splitlines()), len(plain.stdout.splitlines()), reader)

    def test_a_mesh_has_a_name_wherever_it_comes_from(self):
        mesh = (MESHES / "torus.off").read_bytes()
        packed = self.write("ring.off.gz", gzip.compress(mesh))
        for done, name in ((run("import", "-", input=mesh), "standard_input"), (run("import", packed), "ring")):
            self.assertIn(f'{{"op":"complex","name":"{name}",', done.stdout)
        done = run("mesh", "--json", "-", input=mesh)
        self.assertEqual(json.loads(done.stdout)["mesh"], "standard input")

    def test_standard_input_is_one_of_two_barcodes(self):
        done = run("distance", "-", "-", input=BARS)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard input", done.stderr)

    def test_a_script_that_is_cut_off_as_gzip_data_is_no_shorter_script(self):
        packed = gzip.compress(SCRIPT)
        for size in places(len(packed), 20 if IS_HEAVY else 6)[2:]:
            done = run("replay", "--json", self.write("cut.gz", packed[:size]))
            self.assertNotEqual((size, done.returncode), (size, 0))
            self.assertNotIn('"summary"', done.stdout)


class Follow(Directory):
    def followed(self, name="script.jsonl", content=HEADER + TRIANGLE, **options):
        """A replay that has read the file and waits for more of it."""
        path = self.write(name, content)
        process = subprocess.Popen([SESAME, "replay", "--json", "--follow", str(path)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.kill)
        self.assertEqual(json.loads(process.stdout.readline())["step"], 1)
        return path, process

    def check_end(self, path, process, what):
        out, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, errors)
        self.assertEqual(errors, f"cannot read {path}: it was {what} while it was followed\n")
        self.assertEqual(out, "")

    def test_a_file_that_is_truncated(self):
        path, process = self.followed()
        os.truncate(path, len(HEADER))
        self.check_end(path, process, "truncated")

    def test_a_file_that_is_removed(self):
        path, process = self.followed()
        path.unlink()
        self.check_end(path, process, "removed")

    def test_a_file_that_is_replaced(self):
        path, process = self.followed()
        holder = open(path, "rb")  # so that its inode lives on, as behind a second link
        os.link(path, self.directory / "second")
        os.replace(self.write("new", HEADER + TRIANGLE + POINT), path)
        self.check_end(path, process, "replaced")
        holder.close()

    def test_a_file_that_is_moved_away(self):
        path, process = self.followed()
        path.rename(self.directory / "elsewhere")
        self.check_end(path, process, "moved away")

    def test_a_file_that_is_written_over_and_longer_than_before(self):
        path, process = self.followed()
        with open(path, "r+b") as file:  # at once: no moment at which it is shorter
            file.write((HEADER + '{"op":"simplex","name":"w","dim":1}\n' + POINT).encode())
        self.check_end(path, process, "written over")

    def test_a_followed_file_may_be_packed(self):
        packed = gzip.compress((HEADER + TRIANGLE).encode())
        path, process = self.followed("script.gz", packed)
        with open(path, "ab") as file:
            file.write(gzip.compress(POINT.encode()))
        self.assertEqual(json.loads(process.stdout.readline())["betti"][0], 2)
        process.send_signal(signal.SIGINT)
        self.assertTrue(json.loads(process.communicate(timeout=60)[0])["interrupted"])
        self.assertEqual(process.returncode, 130)

    def test_a_pipe_ends_when_its_writer_does(self):
        done = run("replay", "--json", "--follow", "-", input=(HEADER + TRIANGLE).encode())
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class KeepGoing(Directory):
    def test_refused_steps_are_reported_and_passed_over(self):
        script = self.write("script.jsonl", HEADER + TRIANGLE + "no JSON\n" + TRIANGLE + '{"op":"dance"}\n' + POINT)
        done = run("replay", "--json", "--keep-going", script)
        self.assertEqual(done.returncode, 2)
        objects = [json.loads(line) for line in done.stdout.splitlines()]
        refused = [o for o in objects if "error" in o]
        self.assertEqual([(o["step"], o["error"]["line"]) for o in refused], [(2, 3), (2, 4), (2, 5)])
        self.assertIn('no op "dance"', refused[2]["error"]["what"])
        self.assertEqual([o["step"] for o in objects if "op" in o], [1, 2])
        self.assertEqual((objects[-1]["summary"], objects[-1]["betti"]), (True, [2, 0, 0]))
        self.assertEqual([line.split(": ")[0] for line in done.stderr.splitlines()], [f"{script}:{n}" for n in (3, 4, 5)])
        without = run("replay", "--json", script)
        self.assertEqual((without.returncode, len(without.stdout.splitlines())), (2, 1))

    def test_without_a_header_there_is_nothing_to_go_on_with(self):
        done = run("replay", "--keep-going", "-", input=TRIANGLE.encode() + POINT.encode())
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(len(done.stderr.splitlines()), 1)


class Terminal(unittest.TestCase):
    def talk(self, lines, *arguments):
        """What is on the terminal, and the exit status, when somebody types these lines and then Ctrl-D."""
        process, terminal = pty.fork()
        if process == 0:
            os.execv(SESAME, [SESAME, "replay", *arguments, "-"])
        seen = b""
        typed = [line.encode() + b"\n" for line in lines] + [b"\x04"]
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            ready = select.select([terminal], [], [], 1)[0]
            try:
                piece = os.read(terminal, 65536) if ready else None
            except OSError:  # the other end is closed
                break
            if piece == b"":
                break
            seen += piece or b""
            if typed and seen.count(b"sesame> ") > len(lines) + 1 - len(typed):
                os.write(terminal, typed.pop(0))
        status = os.waitpid(process, 0)[1]
        os.close(terminal)
        return seen.decode(), os.waitstatus_to_exitcode(status)

    def test_a_terminal_is_asked_line_by_line(self):
        seen, status = self.talk([HEADER.strip(), TRIANGLE.strip(), POINT.strip()])
        self.assertEqual(status, 0, seen)
        self.assertEqual(seen.count("sesame> "), 4)
        self.assertIn("H0 = Z^2", seen)

    def test_a_slip_does_not_end_the_session(self):
        seen, status = self.talk([HEADER.strip(), '{"op":"simplexx"}', TRIANGLE.strip()])
        self.assertEqual(status, 2, seen)
        self.assertIn('standard input:2: there is no op "simplexx"', seen)
        self.assertIn("H0 = Z", seen)

    def test_a_pipe_is_not_asked(self):
        done = run("replay", "-", input=HEADER.encode())
        self.assertNotIn("sesame>", done.stdout + done.stderr)


if __name__ == "__main__":
    if not can_preload():
        sys.exit(77)
    unittest.main(argv=[sys.argv[0]])
