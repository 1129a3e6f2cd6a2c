#!/usr/bin/env python3
"""What `sesame zigzag` promises on its command line: that without deletions it says the same as `sesame tower`, byte for byte;
its outputs, errors with their place, exit statuses; files, gzip data and pipes alike.

Usage: zigzag_command_test.py SESAME EXAMPLES
"""

import gzip
import json
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
import random_tower

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
IS_HEAVY = "--heavy" in sys.argv  # else fewer random zigzags and towers
EXAMPLES = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "replay/examples")
# A circle that is filled, opened again by another way, and cut.
CIRCLE = "i 0\ni 1\ni 2\ni 0 1\ni 1 2\ni 0 2\ni 0 1 2\nd 2 1 0\nr 0 1\n"
CIRCLE_BARS = [[0, 0, None], [0, 1, 3], [0, 2, 4], [1, 5, 6], [1, 7, 8]]


def not_undone(script, reports):
    """The reports of the steps of a script, as it is read, that no later one takes back."""
    operations = [json.loads(line) for line in script.read_text().splitlines() if line.startswith('{"op"')]
    kept = []
    for operation, report in zip(operations, map(json.loads, reports.splitlines())):
        if operation["op"] == "undo":
            del kept[len(kept) - operation.get("steps", 1):]
        else:
            kept.append(report)
    return kept


def without_seconds(text):
    return re.sub(r'"seconds":[^}]*', "", text)


def random_text(seed, operations=80):
    done = subprocess.run([sys.executable, random_tower.__file__, "--seed", str(seed), "--operations", str(operations),
                           "--vertices", "9", "--contract", "0.2", *(["--any-two"] if seed % 2 else [])],
                          capture_output=True, text=True, check=True)
    return done.stdout


def random_zigzag(seed, operations, labels=12):
    """Insertions and deletions without contractions, to tetrahedra."""
    draw = random.Random(seed)
    there, lines = set(), []
    while len(lines) < operations:
        if there and draw.random() < 0.4:
            simplex = draw.choice(sorted(there))
            while over := [s for s in there if len(s) == len(simplex) + 1 and set(simplex) < set(s)]:
                simplex = draw.choice(sorted(over))
            there.remove(simplex)
            lines.append("d " + " ".join(map(str, draw.sample(simplex, len(simplex)))))
            continue
        simplex = tuple(sorted(draw.sample(range(labels), draw.randint(1, 4))))
        while missing := [f for k in range(len(simplex)) if (f := simplex[:k] + simplex[k + 1:]) and f not in there]:
            simplex = draw.choice(missing)
        if simplex not in there:
            there.add(simplex)
            lines.append("i " + " ".join(map(str, simplex)))
    return "".join(line + "\n" for line in lines)


def boundary(chain):
    """Modulo 2; chains are sets of simplices, which are tuples."""
    faces = set()
    for simplex in chain:
        if len(simplex) > 1:
            for k in range(len(simplex)):
                faces ^= {simplex[:k] + simplex[k + 1:]}
    return faces


def bounds(cycle, complex_):
    """Whether a chain of dimension d is a boundary modulo 2: elimination by the largest simplices."""
    dim = len(next(iter(cycle))) if cycle else 0
    by_largest = {}

    def reduced(chain):
        while chain and (largest := max(chain)) in by_largest:
            chain = chain ^ by_largest[largest]
        return chain

    for simplex in complex_:
        if len(simplex) == dim + 1 and (chain := reduced(boundary({simplex}))):
            by_largest[max(chain)] = chain
    return not reduced(cycle)


def complexes(text):
    """That after each operation, of lines i and d."""
    there, found = set(), []
    for line in text.splitlines():
        kind, *labels = line.split()
        there = there ^ {tuple(sorted(map(int, labels)))}
        found.append((kind, there))
    return found


class Zigzag(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.folder = pathlib.Path(directory.name)

    def run_sesame(self, *arguments, stdin=None):
        return subprocess.run([SESAME, *map(str, arguments)], input=stdin, capture_output=True)

    def file(self, text, name="input.zigzag"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def json_of(self, text, *options):
        done = self.run_sesame("zigzag", self.file(text), "--json", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def assert_error(self, text, line, message, *options):
        done = self.run_sesame("zigzag", self.file(text), "--json", *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, b"")
        self.assertRegex(done.stderr.decode(), f"input.zigzag:{line}: .*{message}")

    # ------------------------------------------------------------------------------------------------ bars

    def test_a_circle_that_is_filled_opened_and_cut(self):
        done = self.json_of(CIRCLE)
        self.assertEqual(done["bars"], CIRCLE_BARS)
        self.assertEqual((done["ring"], done["ops"], done["hidden"]), ("Z/2", 9, 0))

    def test_a_simplex_may_come_again(self):
        self.assertEqual(self.json_of("i 7\nd 7\ni 7\nd 7\n")["bars"], [[0, 0, 1], [0, 2, 3]])

    def test_a_class_that_is_born_by_a_deletion_may_end_by_one(self):
        # A sphere of which one triangle goes, and then the opposite vertex with its star.
        faces = "i 0\ni 1\ni 2\ni 0 1\ni 1 2\ni 0 2\ni 0 1 2\ni 3\ni 0 3\ni 1 3\ni 2 3\ni 0 1 3\ni 0 2 3\ni 1 2 3\n"
        self.assertEqual([b for b in self.json_of(faces + "d 0 1 2\nd 0 1 3\nd 0 1\n")["bars"] if b[1] >= 13],
                         [[1, 15, 16], [2, 13, 14]])

    def test_operations_at_one_time_count_as_one(self):
        done = self.json_of("1 i 0\n1 i 1\n2 i 0 1\n2 d 0 1\n2.5 i 0 1\n")
        # The edge in between has joined the two points, whatever came of it.
        self.assertEqual(done["bars"], [[0, 1, 2], [0, 1, None], [0, 2, 2.5]])
        self.assertEqual(done["hidden"], 0)
        done = self.json_of("1 i 0\n2 i 1\n2 d 1\n")
        self.assertEqual((done["bars"], done["hidden"]), ([[0, 1, None]], 1))

    def test_both_ways_of_computing_agree_whatever_the_input(self):
        for seed in range(12 if IS_HEAVY else 4):
            text = random_zigzag(seed, 400)
            for ring in ("Z/2", "Z/3", "Q"):
                with self.subTest(seed=seed, ring=ring):
                    file = self.json_of(text, "--ring", ring, "--verify")
                    piped = self.run_sesame("zigzag", "-", "--json", "--ring", ring, stdin=text.encode())
                    alone = self.json_of(text, "--ring", ring)
                    self.assertEqual(file["bars"], alone["bars"])
                    self.assertEqual(json.loads(piped.stdout)["bars"], alone["bars"])
                    self.assertGreater(len(alone["bars"]), 50)

    # ------------------------------------------------------------------------------------------------ cycles

    def test_every_bar_has_its_cycles(self):
        done = self.run_sesame("zigzag", EXAMPLES / "filled_and_cut.zigzag", "--json", "--generators", "--ring", "Z/3")
        found = json.loads(done.stdout)
        triangle = [[1, [0, 1]], [-1, [0, 2]], [1, [1, 2]]]
        reversed_triangle = [[-coefficient, edge] for coefficient, edge in triangle]
        expected = [
            {"dim": 0, "birth": 0, "death": None, "pieces": [{"from": 0, "until": None, "cycle": [[1, [0]]]}]},
            {"dim": 0, "birth": 1, "death": 3,
             "pieces": [{"from": 1, "until": 3, "cycle": [[-1, [0]], [1, [1]]]}]},
            {"dim": 0, "birth": 2, "death": 4,
             "pieces": [{"from": 2, "until": 4, "cycle": [[-1, [0]], [1, [2]]]}]},
            {"dim": 1, "birth": 5, "death": 6, "pieces": [{"from": 5, "until": 6, "cycle": triangle}]},
            {"dim": 1, "birth": 7, "death": 8, "pieces": [{"from": 7, "until": 8, "cycle": reversed_triangle}]}]
        self.assertEqual(found["bars"], CIRCLE_BARS)
        self.assertEqual(found["generators"], expected)
        text = self.run_sesame("zigzag", self.file(CIRCLE), "--generators=1").stdout.decode()
        self.assertIn("H1 [5, 6)\n  [5, 6)  {0 1} + {0 2} + {1 2}\nH1 [7, 8)\n", text)

    def test_cycles_are_written_of_some_bars_and_up_to_a_length(self):
        loops = self.json_of(CIRCLE, "--generators=1", "--max-terms", "2")["generators"]
        self.assertEqual([each["pieces"] for each in loops],
                         [[{"from": 5, "until": 6, "cycle_terms": 3}], [{"from": 7, "until": 8, "cycle_terms": 3}]])
        self.assertEqual({each["dim"] for each in self.json_of(CIRCLE, "--generators", "--max-dim", "0")["generators"]}, {0})
        kept = self.json_of(CIRCLE, "--generators", "--no-open", "--min-length", "2")["generators"]
        self.assertEqual([(each["birth"], each["death"]) for each in kept], [(1, 3), (2, 4)])
        self.assertEqual(self.json_of(CIRCLE, "--generators=1", "--until", "6")["generators"][0]["pieces"][0]["until"], None)
        self.assertIn("a chain of 3 terms",
                      self.run_sesame("zigzag", self.file(CIRCLE), "--generators", "--max-terms", "2").stdout.decode())
        for options in (("--generators=1-0",), ("--max-terms", "2")):
            self.assertEqual(self.run_sesame("zigzag", self.file(CIRCLE), *options).returncode, 1)

    def test_pieces_have_the_labels_of_their_times(self):
        # Vertex 7 has the larger star, so it stays and is called 8: the loop is the same, its edges have other names.
        square = "i 0\ni 7\ni 2\ni 0 7\ni 7 2\ni 0 2\ni 8\nc 7 8\n"
        (loop,) = self.json_of(square, "--generators=1")["generators"]
        self.assertEqual(loop["pieces"], [{"from": 5, "until": 7, "cycle": [[1, [0, 2]], [1, [0, 7]], [1, [2, 7]]]},
                                          {"from": 7, "until": None, "cycle": [[1, [0, 2]], [1, [0, 8]], [1, [2, 8]]]}])

    def assert_cycles_are_consistent(self, text, generators):
        moments = complexes(text)
        alive = [[0] * 4 for _ in moments]
        for each in generators:
            end = len(moments) if each["death"] is None else each["death"]
            cycles, at = {}, each["birth"]
            for piece in each["pieces"]:
                self.assertEqual(piece["from"], at)
                at = piece["until"]
                for k in range(piece["from"], end if at is None else at):
                    cycles[k] = {tuple(simplex) for _, simplex in piece["cycle"]}
            self.assertEqual(at, each["death"])
            for k, cycle in cycles.items():
                kind, there = moments[k]
                self.assertTrue(cycle <= there)
                self.assertFalse(boundary(cycle))
                alive[k][each["dim"]] += 1
                if k > each["birth"]:
                    self.assertTrue(bounds(cycle ^ cycles[k - 1], there | moments[k - 1][1]))
                elif kind != "i":
                    self.assertTrue(bounds(cycle, moments[k - 1][1]))
            if end < len(moments) and moments[end][0] == "i":
                self.assertTrue(bounds(cycles[end - 1], moments[end][1]))
        return alive

    def test_cycles_are_homologous_from_one_operation_to_the_next(self):
        for seed in range(8 if IS_HEAVY else 2):
            text = random_zigzag(seed, 250, labels=7).replace("r ", "d ")
            with self.subTest(seed=seed):
                done = self.json_of(text, "--generators")
                alive = self.assert_cycles_are_consistent(text, done["generators"])
                self.assertEqual(len(done["generators"]), len(done["bars"]))
                states = self.run_sesame("zigzag", self.file(text), "--json", "--every", "1").stdout.splitlines()[:-1]
                for k, state in enumerate(map(json.loads, states)):
                    self.assertEqual(alive[k], (state["betti"] + [0] * 4)[:4])

    def test_cycles_change_nothing_else(self):
        text = random_zigzag(3, 300)
        alone = self.json_of(text)
        done = self.json_of(text, "--generators", "--verify")
        self.assertEqual((alone["bars"], alone["hidden"]), (done["bars"], done["hidden"]))
        piped = json.loads(self.run_sesame("zigzag", "-", "--json", "--generators", stdin=text.encode()).stdout)
        self.assertEqual(piped["generators"], done["generators"])

    # ------------------------------------------------------------------------------------------------ as tower

    def assert_same_as_tower(self, path, *options):
        outputs = {}
        for command in ("tower", "zigzag"):
            files = [self.folder / f"{command}.{kind}" for kind in ("pers", "svg", "csv")]
            done = self.run_sesame(command, path, "--json", *options,
                                   *(f"--{f.suffix[1:]}={f}" for f in files))
            self.assertEqual(done.returncode, 0, done.stderr)
            outputs[command] = [without_seconds(done.stdout.decode()), *(f.read_bytes() for f in files)]
        self.assertEqual(outputs["tower"], outputs["zigzag"])

    def test_towers_have_the_output_of_tower_byte_for_byte(self):
        towers = sorted(EXAMPLES.glob("*.tower"))
        self.assertGreaterEqual(len(towers), 5)
        for path in towers:
            for ring in ("Z/2", "Z/3", "Q"):
                with self.subTest(path=path.name, ring=ring):
                    self.assert_same_as_tower(path, "--ring", ring)

    def test_random_towers_too(self):
        for seed in range(40 if IS_HEAVY else 8):
            path = self.file(random_text(seed))
            with self.subTest(seed=seed):
                self.assert_same_as_tower(path)
                self.assert_same_as_tower(path, "--max-dim", "1", "--until", "50", "--min-length", "2")

    def test_tables_and_progress_reports_are_those_of_tower(self):
        path = self.file(random_text(3))
        for options in ((), ("--every", "7"), ("--every", "7", "--json", "--quiet"), ("--pers", "-")):
            outputs = [without_seconds(self.run_sesame(command, path, *options).stdout.decode())
                       for command in ("tower", "zigzag")]
            with self.subTest(options=options):
                self.assertEqual(*outputs)
                self.assertTrue(outputs[0])

    # ------------------------------------------------------------------------------------------------ scripts

    def test_scripts_that_are_towers_have_the_output_of_tower_byte_for_byte(self):
        same = 0
        for path in sorted(EXAMPLES.glob("*.jsonl"))[::1 if IS_HEAVY else 4]:
            if self.run_sesame("tower", path, "--json").returncode == 0:
                with self.subTest(path=path.name):
                    self.assert_same_as_tower(path, "--ring", "Z/3")
                    same += 1
        self.assertGreater(same, 30 if IS_HEAVY else 7)

    def test_scripts_with_splits_and_removals_have_the_betti_numbers_of_replay(self):
        for name in ("taking_apart", "cutting_a_torus", "cutting_a_surface"):
            path = EXAMPLES / f"{name}.jsonl"
            for ring in ("Z/2", "Q"):
                with self.subTest(name=name, ring=ring):
                    bars = json.loads(self.run_sesame("zigzag", path, "--json", "--ring", ring).stdout)["bars"]
                    steps = self.run_sesame("replay", path, "--json", "--every", "1", "--ring", ring).stdout
                    for step in not_undone(path, steps):
                        for dim, betti in enumerate(step["betti"]):
                            alive = [b for b in bars if b[0] == dim and b[1] <= step["step"] and
                                     (b[2] is None or step["step"] < b[2])]
                            self.assertEqual(len(alive), betti, (step["step"], dim))
            done = self.run_sesame("tower", path)
            self.assertEqual(done.returncode, 2)
            self.assertIn("`sesame zigzag` has the barcode of such a script", done.stderr.decode())

    def test_a_circle_that_is_cut_and_glued_again(self):
        script = ['{"sesame":1}', '{"op":"simplex","name":"e","dim":1}', '{"op":"identify","pairs":[["e.0","e.1"]]}',
                  '{"op":"deidentify","split":[{"cell":"e.0","as":"w","moves":[["e",0]]}]}',
                  '{"op":"identify","pairs":[["e.0","w"]]}', '{"op":"remove","cells":["e"]}']
        text = "".join(line + "\n" for line in script)
        done = self.json_of(text)
        self.assertEqual((done["bars"], done["format"]), ([[0, 1, None], [1, 2, 3], [1, 4, 5]], "script"))
        self.assertEqual(self.json_of(text, "--format", "script", "--until", "3")["bars"], [[0, 1, None], [1, 2, 3]])
        piped = self.run_sesame("zigzag", "-", "--json", stdin=gzip.compress(text.encode()))
        self.assertEqual(json.loads(piped.stdout)["bars"], done["bars"])
        self.assert_error(text + '{"op":"product","name":"P","left":"e","right":"e"}\n', 7, "step 6|no body|there is no")
        done = self.run_sesame("zigzag", self.file(text), "--ring", "Z")
        self.assertEqual((done.returncode, "over a field" in done.stderr.decode()), (1, True), done.stderr)
        self.assertEqual(self.run_sesame("zigzag", self.file("i 0\n"), "--format", "script").returncode, 2)
        done = self.run_sesame("tower", self.file(text), "--generators")
        self.assertEqual((done.returncode, b"sesame zigzag --generators" in done.stderr), (1, True), done.stderr)

    def test_bars_of_scripts_have_cycles_by_the_names_of_cells(self):
        script = ['{"sesame":1}', '{"op":"simplex","name":"t","dim":2}', '{"op":"remove","cells":["t"]}',
                  '{"op":"note","text":"a loop"}', '{"op":"simplex","name":"e\\"","dim":1}',
                  '{"op":"identify","pairs":[["e\\".0","t.0"],["e\\".1","t.1"]]}', '{"op":"remove","cells":["t.0-1"]}']
        text = "".join(line + "\n" for line in script)
        loops = self.json_of(text, "--generators=1", "--ring", "Z/3")["generators"]
        self.assertEqual(loops, [
            {"dim": 1, "birth": 2, "death": 6,
             "pieces": [{"from": 2, "until": 6, "cycle": [[-1, "t.0-1"], [1, "t.0-2"], [-1, "t.1-2"]]}]},
            {"dim": 1, "birth": 5, "death": None,
             "pieces": [{"from": 5, "until": None, "cycle": [[1, "t.0-2"], [-1, "t.1-2"], [-1, 'e"']]}]}])
        self.assertEqual([piece["cycle_terms"] for each in
                          self.json_of(text, "--generators=1", "--max-terms", "1")["generators"]
                          for piece in each["pieces"]], [3, 3])
        table = self.run_sesame("zigzag", self.file(text), "--generators=1", "--ring", "Q").stdout.decode()
        self.assertIn("H1 [2, 6)\n  [2, 6)  -t.0-1 + t.0-2 - t.1-2\n", table)
        self.assertEqual({each["dim"] for each in self.json_of(text, "--generators", "--max-dim", "0")["generators"]}, {0})
        kept = self.json_of(text, "--generators", "--no-open")["generators"]
        self.assertEqual([(each["birth"], each["death"]) for each in kept], [(4, 5), (2, 6)])

    def test_scripts_say_on_the_way_what_they_have(self):
        path = EXAMPLES / "cutting_a_torus.jsonl"
        states = [json.loads(line) for line in
                  self.run_sesame("zigzag", path, "--json", "--every", "2").stdout.splitlines()][:-1]
        steps = [json.loads(line) for line in
                 self.run_sesame("replay", path, "--json", "--every", "2", "--ring", "Z/2").stdout.splitlines()]
        steps = [step for step in steps if step.get("step", 1) % 2 == 0][:len(states)]
        self.assertGreater(len(states), 3)
        for state, step in zip(states, steps):
            self.assertEqual((state["ops"], state["time"], state["cells"]), (step["step"], step["step"], step["cells"]))
            self.assertEqual((state["betti"] + [0] * 9)[:len(step["betti"])], step["betti"])
        self.assertEqual(self.run_sesame("tower", EXAMPLES / "torus.jsonl", "--every", "3", "--json").stdout.count(b'{"ops":'),
                         self.run_sesame("zigzag", EXAMPLES / "torus.jsonl", "--every", "3", "--json").stdout.count(b'{"ops":'))

    def test_scripts_are_verified_and_cycles_change_no_bars(self):
        checked = 0
        for path in sorted(EXAMPLES.glob("*.jsonl"))[::1 if IS_HEAVY else 3]:
            for ring in ("Z/2", "Q"):
                alone = self.run_sesame("zigzag", path, "--json", "--ring", ring)
                if alone.returncode != 0:
                    continue
                with self.subTest(path=path.name, ring=ring):
                    done = self.run_sesame("zigzag", path, "--json", "--ring", ring, "--verify", "--generators")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    bars, found = json.loads(alone.stdout)["bars"], json.loads(done.stdout)
                    self.assertEqual(found["bars"], bars)
                    self.assertEqual([[g["dim"], g["birth"], g["death"]] for g in found["generators"]], bars)
                    checked += 1
        self.assertGreater(checked, 60 if IS_HEAVY else 15)

    def test_the_first_interrupt_ends_a_script_at_a_step(self):
        # Loops in a wedge: a removal each, so the second way takes far longer than the first.
        lines = ['{"sesame":1}', '{"op":"simplex","name":"p","dim":0}']
        for k in range(1500):
            lines.append(f'{{"op":"simplex","name":"e{k}","dim":1}}')
            lines.append(f'{{"op":"identify","pairs":[["e{k}.0","p"],["e{k}.1","p"]]}}')
        lines.append('{"op":"remove","cells":["e3"]}')
        path = self.file("".join(line + "\n" for line in lines), "loops.jsonl")
        for seconds in (0.3, 1, 3, 9):  # while it reads, what has been read is done again
            with subprocess.Popen([SESAME, "zigzag", path, "--json", "--generators=0", "--every", "3002"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
                process.stdout.readline()
                time.sleep(seconds)
                process.send_signal(signal.SIGINT)
                out, errors = process.communicate()
            self.assertEqual(process.returncode, 130, errors)
            found = json.loads(out)
            if found["ops"] < 3002:
                break
        self.assertLess(found["ops"], 3002)
        self.assertIn([0, 1, None], found["bars"])

    # ------------------------------------------------------------------------------------------------ inputs

    def test_files_gzip_data_and_pipes_are_read_alike(self):
        text = random_zigzag(5, 300)
        expected = self.json_of(text)["bars"]
        packed = self.run_sesame("zigzag", self.file(gzip.compress(text.encode()), "input.gz"), "--json")
        self.assertEqual(json.loads(packed.stdout)["bars"], expected)
        piped = self.run_sesame("zigzag", "-", "--json", stdin=gzip.compress(text.encode()))
        self.assertEqual(json.loads(piped.stdout)["bars"], expected)
        windows = "# a comment\r\n\r\n" + text.replace("\n", " # here\r\n")
        self.assertEqual(self.json_of(windows)["bars"], expected)

    def test_until_has_the_bars_of_that_moment(self):
        self.assertEqual(self.json_of(CIRCLE, "--until", "6")["bars"],
                         [[0, 0, None], [0, 1, 3], [0, 2, 4], [1, 5, None]])
        self.assertEqual(self.json_of(CIRCLE, "--until", "100")["bars"], CIRCLE_BARS)

    def test_an_empty_file_is_an_empty_zigzag(self):
        for text in ("", "# nothing\n", "\n\n"):
            done = self.json_of(text)
            self.assertEqual((done["bars"], done["ops"], done["hidden"]), ([], 0, 0))

    def test_labels_and_times_go_to_the_ends_of_their_ranges(self):
        big = 2**64 - 1
        self.assertEqual(self.json_of(f"i {big}\ni 0\ni {big} 0\nd 0 {big}\n")["bars"],
                         [[0, 0, None], [0, 1, 2], [0, 3, None]])
        times = self.json_of(f"-9223372036854775808 i 1\n{big} d 1\n")["bars"]
        self.assertEqual(times, [[0, "-9223372036854775808", str(big)]])

    def test_states_on_the_way_are_those_of_the_moment(self):
        done = self.run_sesame("zigzag", self.file(CIRCLE), "--json", "--every", "1")
        states = [json.loads(line) for line in done.stdout.splitlines()][:-1]
        self.assertEqual([s["betti"] for s in states],
                         [[1], [2], [3], [2], [1], [1, 1], [1], [1, 1], [1]])
        self.assertEqual(states[-1]["cells"], [3, 2])

    def test_a_page_is_written(self):
        page = self.folder / "page.html"
        done = self.run_sesame("zigzag", self.file(CIRCLE), "--quiet", "--html", page)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("are not on this page", page.read_text(encoding="utf-8"))

    # ------------------------------------------------------------------------------------------------ errors

    def test_what_cannot_be_done_is_said_with_its_place(self):
        edge = "i 0\ni 1\ni 0 1\n"
        self.assert_error("d 5\n", 1, r"simplex \{5\} is not there")
        self.assert_error(edge + "d 0 1\nd 1 0\n", 5, r"simplex \{1 0\} is not there")
        self.assert_error(edge + "d 1\n", 4, r"simplex \{1\} is a face of \{0 1\}, which should be deleted before it")
        self.assert_error(edge + "i 0 1\n", 4, r"\{0 1\} is there already")
        self.assert_error(edge + "i 2\ni 0 2\ni 0 1 2\n", 6, r"\{1 2\} of \{0 1 2\} is not there.*--add-faces")
        self.assert_error(edge + "d 0 0\n", 4, r"simplex \{0 0\} is not there")
        self.assert_error(edge + "c 0 0\n", 4, "cannot be contracted into itself")
        self.assert_error(edge + "c 0 9\n", 4, "vertex 9 is not there")
        self.assert_error(edge + "c 0\n", 4, "c should be followed by 2 vertices, not 1")
        self.assert_error(edge + "d\n", 4, "d should be followed by vertices")
        self.assert_error(edge + "d -1\n", 4, "should be a vertex, a whole number")
        self.assert_error(edge + f"d {2**64}\n", 4, "should be a vertex, a whole number")
        self.assert_error(edge + "x 0 1\n", 4, r"should be i \(a simplex is included\), d or r")
        self.assert_error(edge + "3 d 0 1\n", 4, "with a time")
        self.assert_error("2 i 0\n1 d 0\n", 2, "times should not decrease")
        self.assert_error("i " + " ".join(map(str, range(65))) + "\n", 1, "from 1 to 64 vertices")
        self.assert_error("d " + " ".join(map(str, range(65))) + "\n", 1, "is not there")
        self.assert_error("i 0\nx\n", 2, "should be", "--verify")

    def test_wrong_usage_is_told_from_wrong_input(self):
        for options, message in ((("--ring", "Z"), "over a field"), (("--ring", "Z/4"), "prime"),
                                 (("--json", "--pers", "-"), "standard output")):
            done = self.run_sesame("zigzag", self.file(CIRCLE), *options)
            self.assertEqual(done.returncode, 1, options)
            self.assertIn(message, done.stderr.decode())
        self.assertEqual(self.run_sesame("zigzag", self.folder / "nothing").returncode, 1)

    def test_an_error_leaves_older_outputs_alone(self):
        out = self.file("old", "out.pers")
        self.assertEqual(self.run_sesame("zigzag", self.file("i 0\nd 1\n"), "--pers", out).returncode, 2)
        self.assertEqual(out.read_text(), "old")
        self.assertEqual(self.run_sesame("zigzag", self.file("i 0\nd 1\n"), "--pers", out, "--partial").returncode, 2)
        self.assertIn("0 0 inf", out.read_text())

    def test_tower_says_that_deletions_are_for_zigzag(self):
        done = self.run_sesame("tower", self.file("i 0\nd 0\n"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("sesame zigzag", done.stderr.decode())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
