#!/usr/bin/env python3
"""What `sesame tower` promises on its command line: formats, outputs, errors with their place, exit statuses; that it
says the same as `sesame replay`; and that every shipped tower has the bars that its comment and the oracle say.

Usage: tower_command_test.py SESAME EXAMPLES
"""

import csv
import gzip
import json
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
import random_tower
import tower_oracle

SESAME = sys.argv[1] if len(sys.argv) > 1 else "sesame"
EXAMPLES = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "replay/examples")
IS_HEAVY = "--heavy" in sys.argv  # else fewer random towers
CIRCLE = "i 0\ni 1\ni 2\ni 0 1\ni 1 2\ni 0 2\nc 0 1\nc 2 1\n"
CIRCLE_BARS = [[0, 0, None], [0, 1, 3], [0, 2, 4], [1, 5, 6]]


def as_script(tower, ring="Z"):
    """The same tower as a construction script, an operation a line."""
    lines = [json.dumps({"sesame": 1, "ring": ring})]
    for line in tower.splitlines():
        words = line.split()
        if words[0] == "i":
            lines.append(json.dumps({"op": "insert", "simplex": [int(v) for v in words[1:]]}))
        else:
            lines.append(json.dumps({"op": "collapse", "from": words[1], "to": words[2]}))
    return "\n".join(lines) + "\n"


def random_text(seed, operations=60):
    """A tower without times, and labels used once: what a script can say too."""
    done = subprocess.run([sys.executable, random_tower.__file__, "--seed", str(seed), "--operations", str(operations),
                           "--vertices", "9", "--contract", "0.2", "--reuse", "0", "--times", "none",
                           *(["--any-two"] if seed % 2 else [])], capture_output=True, text=True, check=True)
    return "".join(line + "\n" for line in done.stdout.splitlines() if not line.startswith("#"))


def page_bars(data):
    """The bars of a page, as `--json` has them."""
    bars = []
    for each in data["bars"]:
        birth = 0
        for step, length in zip(each["births"], each["lengths"], strict=True):
            birth += step
            bars.append([each["dim"], birth, birth + length])
        birth = 0
        for step in each["open"]:
            birth += step
            bars.append([each["dim"], birth, None])
    return sorted(bars, key=tower_oracle.bar_order)


def chains_of(known):
    """What a class of a page and one of `--json` both say."""
    chains = [[key, [[c, list(map(int, labels))] for c, labels in known[key]]]  # large labels are texts on a page
              for key in ("cycle", "bounds", "now") if key in known]
    return json.dumps(chains + [[key, known[key]] for key in ("cycle_terms", "bounds_terms", "now_terms") if key in known])


def classes_of(data):
    return sorted(map(chains_of, data["classes"]))


class Tower(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def run_on(self, *arguments, stdin=None, command="tower"):
        return subprocess.run([SESAME, command, *map(str, arguments)], input=stdin, capture_output=True, timeout=60,
                              check=False)

    def objects(self, *arguments, stdin=None, command="tower"):
        done = self.run_on(*arguments, "--json", stdin=stdin, command=command)
        self.assertEqual((done.returncode, done.stderr), (0, b""), arguments)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def bars(self, *arguments, stdin=None):
        (found,) = self.objects(*arguments, stdin=stdin)
        return found["bars"]

    # ---- what it says

    def test_an_output_may_be_standard_output_instead_of_the_table(self):
        path = self.file("c.tower", CIRCLE)
        for kind in ("pers", "csv", "svg", "html"):
            out = self.folder / f"c.{kind}"
            self.assertEqual(self.run_on(path, f"--{kind}", out, "--quiet").returncode, 0)
            for name in ("-", "/dev/stdout"):
                done = self.run_on(path, f"--{kind}", name)
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, out.read_bytes(), b""), kind)
        for arguments in (("--pers", "-", "--csv", "-"), ("--svg", "-", "--html", "/dev/stdout"), ("--svg", "-", "--json")):
            done = self.run_on(path, *arguments)
            self.assertEqual((done.returncode, done.stdout), (1, b""), arguments)
            self.assertNotEqual(done.stderr, b"")
        done = self.run_on(path, "--pers", "-", "--every", "1")
        self.assertTrue(all(line[:1] in b"#012" for line in done.stdout.splitlines()))

    def test_the_csv_begins_with_the_names_of_its_columns(self):
        out = self.folder / "c.csv"
        self.assertEqual(self.run_on(self.file("c.tower", CIRCLE), "--csv", out, "--quiet").returncode, 0)
        rows = [line.split(",") for line in out.read_text().splitlines()]
        self.assertEqual(rows[0], ["time", "b0", "b1"])
        self.assertEqual([row for row in rows[1:] if len(row) != 3 or not all(map(str.isdigit, row))], [])

    def test_every_shipped_tower_has_the_bars_that_its_comment_and_the_oracle_say(self):
        paths = sorted(EXAMPLES.glob("*.tower"))
        self.assertGreaterEqual(len(paths), 5)
        for path in paths:
            marker = "# Bars over Z/2: "
            (line,) = [line for line in path.read_text().splitlines() if line.startswith(marker)]
            self.assertEqual(self.bars(path), json.loads(line[len(marker):]), path)
            operations = tower_oracle.parse(path.read_text().splitlines())
            for p in (2, 3):
                self.assertEqual(self.bars(path, "--ring", f"Z/{p}"), tower_oracle.barcode(operations, p), path)

    def test_replay_and_tower_have_the_same_betti_numbers_at_every_step(self):
        for seed in range(12 if IS_HEAVY else 4):
            text = random_text(seed)
            tower, script = self.file("t.tower", text), self.file("t.jsonl", as_script(text))
            for ring in ("Z/2", "Z/3"):
                states = self.objects(tower, "--every", "1", "--ring", ring)[:-1]
                steps = self.objects(script, "--every", "1", "--ring", ring, command="replay")[:-1]
                self.assertEqual(len(states), len(text.splitlines()))
                for state, step in zip(states, steps, strict=True):
                    self.assertEqual(state["cells"], step["cells"])
                    self.assertEqual(padded(state["betti"], len(step["betti"])), step["betti"])

    def test_a_script_has_the_bars_of_the_same_tower_counted_from_one(self):
        for seed in range(12 if IS_HEAVY else 4):
            text = random_text(seed)
            tower, script = self.file("t.tower", text), self.file("t.jsonl", as_script(text))
            shifted = [[d, b + 1, None if e is None else e + 1] for d, b, e in self.bars(tower, "--ring", "Z/3")]
            self.assertEqual(self.bars(script, "--ring", "Z/3"), shifted)

    def test_groups_over_the_integers_are_those_of_replay(self):
        for seed in range(6 if IS_HEAVY else 3):
            text = random_text(seed)
            (found,) = self.objects(self.file("t.tower", text), "--ring", "Z")
            steps = self.objects(self.file("t.jsonl", as_script(text)), "--every", "1", command="replay")[:-1]
            changes = dict((int(time), groups) for time, groups in found["groups"])
            groups = []
            for number, step in enumerate(steps):
                groups = changes.get(number, groups)
                ranks = padded([g["rank"] for g in groups], len(step["betti"]))
                torsion = [g["torsion"] for g in groups] + [[]] * (len(step["betti"]) - len(groups))
                self.assertEqual((ranks, torsion), (step["betti"], step["torsion"]))

    def test_labels_may_be_used_again_over_the_integers_too(self):
        path = self.file("t.tower", "i 0\ni 1\ni 0 1\nc 0 1\ni 0\ni 0 1\nc 1 0\ni 1\n")
        (found,) = self.objects(path, "--ring", "Z")
        self.assertEqual([groups[0]["rank"] for _, groups in found["groups"]], [1, 2, 1, 2, 1, 2])

    def test_rings_side_by_side_show_torsion(self):
        (found,) = self.objects(EXAMPLES / "projective_plane.tower", "--rings", "Z/2,Z/3,Z/5")
        self.assertEqual([ring["ring"] for ring in found["rings"]], ["Z/2", "Z/3", "Z/5"])
        self.assertEqual([(each["bar"], each["multiplicity"]) for each in found["differences"]],
                         [([1, 12, 30], {"Z/2": 0, "Z/3": 1, "Z/5": 1}),
                          ([1, 12, None], {"Z/2": 1, "Z/3": 0, "Z/5": 0}),
                          ([2, 30, None], {"Z/2": 1, "Z/3": 0, "Z/5": 0})])
        text = self.run_on(EXAMPLES / "projective_plane.tower", "--rings", "Z/2,Z/3").stdout.decode()
        self.assertIn("there is torsion", text)
        text = self.run_on(EXAMPLES / "contracted_circle.tower", "--rings", "Z/2,Z/3").stdout.decode()
        self.assertIn("the same over all rings", text)

    def test_every_bar_has_a_cycle_and_what_it_bounds(self):
        (found,) = self.objects(self.file("c.tower", CIRCLE), "--generators", "--ring", "Z/3")
        loop = found["generators"][-1]
        self.assertEqual((loop["dim"], loop["birth"], loop["death"]), (1, 5, 6))
        self.assertEqual(sorted(simplex for _, simplex in loop["cycle"]), [[0, 1], [0, 2], [1, 2]])
        self.assertEqual(loop["bounds"], [])
        self.assertEqual(found["generators"][0]["now"], [[1, [1]]])
        self.assertEqual(len(found["generators"]), len(found["bars"]))

    def test_cycles_are_written_of_some_dimensions_and_up_to_a_length(self):
        path = self.file("c.tower", CIRCLE)
        (found,) = self.objects(path, "--generators=1", "--max-terms", "2")
        self.assertEqual(found["generators"], [{"dim": 1, "birth": 5, "death": 6, "cycle_terms": 3, "bounds": []}])
        (found,) = self.objects(path, "--generators=0,2-5", "--max-terms", "0")
        self.assertEqual(found["generators"][0], {"dim": 0, "birth": 0, "death": None, "cycle_terms": 1, "now_terms": 1})
        self.assertEqual({each["dim"] for each in found["generators"]}, {0})
        text = self.run_on(path, "--generators=1", "--max-terms", "2").stdout.decode()
        self.assertIn("born as  a chain of 3 terms\n  bounds   0\n", text)
        for arguments in (("--generators=1-0",), ("--max-terms", "2")):
            self.assertEqual(self.run_on(path, *arguments).returncode, 1)

    # ---- outputs

    def test_betti_curves_are_the_sums_over_the_bars(self):
        path = self.file("t.tower", random_text(5, 200))
        out = self.folder / "t.csv"
        bars = [bar for bar in self.bars(path, "--csv", out)]
        rows = list(csv.DictReader(out.read_text().splitlines()))
        self.assertGreater(len(rows), 20)
        for row in rows:
            time = float(row["time"])
            for d in range(len(row) - 1):
                alive = sum(1 for e, b, x in bars if e == d and b <= time and (x is None or time < x))
                self.assertEqual(int(row[f"b{d}"]), alive)

    def test_the_bars_in_a_file_are_those_printed(self):
        path, out = self.file("t.tower", random_text(7, 200)), self.folder / "t.pers"
        bars = self.bars(path, "--pers", out)
        lines = [line.split() for line in out.read_text().splitlines() if not line.startswith("#")]
        written = [[int(d), float(b), None if x == "inf" else float(x)] for d, b, x in lines]
        self.assertEqual(sorted(written, key=tower_oracle.bar_order), bars)
        self.assertEqual(self.objects(out, out, command="distance")[0]["value"], 0)

    def test_pictures_are_written(self):
        path = self.file("t.tower", random_text(7, 200))
        svg, page = self.folder / "t.svg", self.folder / "t.html"
        self.assertEqual(self.run_on(path, "--svg", svg, "--html", page, "--quiet").returncode, 0)
        self.assertTrue(svg.read_text().lstrip().startswith("<"))
        self.assertIn("</svg>", svg.read_text())
        self.assertIn("</html>", page.read_text())
        self.assertIn("default-src 'none'", page.read_text())

    def page_data(self, *arguments):
        page = self.folder / "page.html"
        done = self.run_on(*arguments, "--quiet", "--html", page)
        self.assertEqual((done.returncode, done.stderr), (0, b""), arguments)
        return json.loads(page.read_text().partition('id="data">')[2].partition("</script>")[0])

    def test_a_page_has_the_bars_and_as_far_as_they_are_cheap_their_classes(self):
        path = self.file("t.tower", random_text(7, 200))
        (found,) = self.objects(path, "--generators")
        data = self.page_data(path)
        self.assertEqual(page_bars(data), found["bars"])
        self.assertEqual(len(data["classes"]), len(found["bars"]))
        self.assertEqual(classes_of(data), sorted(map(chains_of, found["generators"])))
        self.assertEqual(data["notes"], [])
        loops = self.page_data(path, "--generators=1", "--max-terms", "3")
        (found,) = self.objects(path, "--generators=1", "--max-terms", "3")
        self.assertEqual(classes_of(loops), sorted(map(chains_of, found["generators"])))
        self.assertEqual(len(loops["notes"]), 1)
        for each in data["classes"]:
            self.assertEqual(each["born"]["text"], path.read_text().splitlines()[each["born"]["line"] - 1])
        many = self.file("many.tower", "".join(f"i {k}\n" for k in range(20001)))
        data = self.page_data(many)
        self.assertEqual((len(page_bars(data)), data["classes"]), (20001, []))
        self.assertIn("more than 20,000 operations", data["notes"][0])
        data = self.page_data(many, "--until", "20000")
        self.assertEqual(len(data["classes"]), 2000)
        self.assertIn("2,000 of the 20,000 bars have their class on this page", data["notes"][0])
        self.assertEqual(len(self.page_data(many, "--generators")["classes"]), 20001)

    def test_points_are_on_the_page(self):
        path, points = self.file("c.tower", CIRCLE), self.file("p.txt", "# x y\n0 0\n1,0\n0 1\n")
        data = self.page_data(path, "--points", points)["complex"]
        self.assertEqual(data["points"], [0, 0, 0, 1, 0, 0, 0, 1, 0])
        self.assertEqual((data["dims"], data["ends"]), ([0, 0, 0, 1, 1, 1, -1, -1], list(range(1, 9))))
        self.assertIsNone(self.page_data(path)["complex"])
        facets = self.page_data(self.file("f", "0 1 2\n"), "--points", points, "--format", "facets")
        self.assertEqual(len(facets["complex"]["dims"]), 7)
        self.assertEqual({each["born"]["line"] for each in facets["classes"]}, {1})

    def test_points_that_are_wrong_or_do_not_fit_are_refused(self):
        path, out = self.file("c.tower", CIRCLE), self.file("page.html", "old")
        wrong = [("0 0\n1 x\n0 1\n", 2, "p.txt:2: \"x\" should be a coordinate"),
                 ("0 0\n1 0\n", 2, "c.tower:3: vertex 2 has no point: "),
                 ("", 2, "c.tower:1: vertex 0 has no point: ")]
        for text, status, what in wrong:
            done = self.run_on(path, "--html", out, "--points", self.file("p.txt", text))
            self.assertEqual((done.returncode, done.stdout), (status, b""))
            self.assertIn(what, done.stderr.decode())
        points = self.file("p.txt", "0 0 0 9\n1 0 0 9\n0 1 0 9\n")
        matrix, script = self.file("m", "0\n0\n1 0 1\n"), self.file("s.jsonl", as_script("i 0\n"))
        for arguments, what in (((path, "--points", points), "--points is for the page"),
                                ((path, "--points", self.folder / "none", "--html", out), "none"),
                                ((path, "--points", points, "--html", points), "p.txt"),
                                (("-", "--points", "-", "--html", out), "standard input"),
                                ((matrix, "--points", points, "--html", out), "boundary matrix"),
                                ((script, "--points", points, "--html", out), "sesame replay --html")):
            done = self.run_on(*arguments, stdin=CIRCLE.encode())
            self.assertEqual((done.returncode, done.stdout), (1, b""), arguments)
            self.assertIn(what, done.stderr.decode(), arguments)
        self.assertEqual(out.read_text(), "old")
        done = self.run_on(path, "--points", points, "--html", out)
        self.assertEqual(done.returncode, 0)
        self.assertIn("points of 4 coordinates; the page draws the first three", done.stderr.decode())

    def test_the_picture_of_the_documentation_is_the_one_that_is_drawn(self):
        svg = self.folder / "t.svg"
        subprocess.run([SESAME, "tower", "coarsened_circle.tower", "--svg", svg, "--quiet"], cwd=EXAMPLES, check=True)
        self.assertEqual(svg.read_text(), (EXAMPLES / "pictures" / "coarsened_circle.svg").read_text())

    def test_bars_can_be_left_out_by_length_but_not_from_betti_numbers_and_differences(self):
        path, out = self.file("c.tower", CIRCLE), self.folder / "c.csv"
        (found,) = self.objects(path, "--min-length", "2", "--csv", out)
        self.assertEqual((found["bars"], found["shorter"]), (CIRCLE_BARS[:3], 1))
        rows = list(csv.DictReader(out.read_text().splitlines()))
        self.assertEqual([int(row["b1"]) for row in rows if row["time"] == "5"], [1])
        plane = EXAMPLES / "projective_plane.tower"
        (found,) = self.objects(plane, "--rings", "Z/2,Z/3", "--min-length", "20")
        self.assertIn([1, 12, 30], [each["bar"] for each in found["differences"]])
        self.assertNotIn([1, 12, 30], found["rings"][1]["bars"])

    def test_open_bars_can_be_left_out_but_not_from_betti_numbers(self):
        path, out, svg = self.file("c.tower", CIRCLE), self.folder / "c.csv", self.folder / "c.svg"
        (found,) = self.objects(path, "--no-open", "--csv", out, "--svg", svg, "--generators")
        self.assertEqual((found["bars"], found["open"]), (CIRCLE_BARS[1:], 1))
        self.assertEqual([[each["dim"], each["birth"], each["death"]] for each in found["generators"]], CIRCLE_BARS[1:])
        self.assertEqual([row["b0"] for row in csv.DictReader(out.read_text().splitlines())][-1], "1")
        self.assertIn("1 bar that never end left out", svg.read_text())
        self.assertIn(b"1 open bar left out", self.run_on(path, "--no-open").stdout)
        (found,) = self.objects(path, "--no-open", "--min-length", "2")
        self.assertEqual((found["bars"], found["open"], found["shorter"]), (CIRCLE_BARS[1:3], 1, 1))

    def test_bars_above_a_dimension_are_not_asked_for_in_any_format(self):
        texts = [random_text(seed, 150) for seed in range(4)]
        columns = "".join(f"{len(rows) - 1 if rows else 0} {' '.join(map(str, rows))}\n"
                          for rows in ([], [], [], [0, 1], [0, 2], [1, 2], [3, 4, 5], [3, 4, 5])).replace(" \n", "\n")
        inputs = [self.file(f"{k}.tower", text) for k, text in enumerate(texts)]
        inputs += [self.file("m.phat", columns), self.file("f", "1 2 3\n1 2 4\n1 3 4\n2 3 4\n"),
                   self.file("g", "0 1 0\n0 2 0\n0 3 0\n1 1 2 1\n1 2 3 2\n1 1 3 3\n2 1 2 3 4\n"),
                   *(self.file(f"{k}.jsonl", as_script(text)) for k, text in enumerate(texts))]
        for path in inputs:
            has_cycles = path.suffix not in (".jsonl",)
            every = self.objects(path, *(["--generators"] if has_cycles else []))[0]
            for last in range(4):
                out = self.folder / "out.csv"
                (found,) = self.objects(path, "--max-dim", str(last), "--csv", out,
                                        *(["--generators"] if has_cycles else []))
                self.assertEqual(found["bars"], [bar for bar in every["bars"] if bar[0] <= last], (path, last))
                self.assertEqual(found["max_dim"], last)
                self.assertLessEqual(len(out.read_text().splitlines()[0].split(",")), last + 2)
                if has_cycles:
                    self.assertEqual([[each[key] for key in ("dim", "birth", "death")] for each in found["generators"]],
                                     [[each[key] for key in ("dim", "birth", "death")] for each in every["generators"]
                                      if each["dim"] <= last])
        for path, last, whole, below in ((inputs[5], 1, 3, 1), (inputs[6], 0, 2, 1), (inputs[-1], 1, 3, 2)):
            for options, longest in (((), whole), (("--max-dim", str(last)), below)):
                (found,) = self.objects(path, "--ring", "Z", *options)
                self.assertEqual(max(len(each) for _, each in found["groups"]), longest, (path, options))
        for wrong in ("-1", "x", "1.5", "99999999999999999999"):
            self.assertEqual(self.run_on(inputs[0], f"--max-dim={wrong}").returncode, 1, wrong)

    def test_pictures_leave_out_where_a_filtration_was_cut_off_and_say_so(self):
        words = "bars of H1, the top dimension, left out: nothing there could end them (--max-dim 1 draws them)"
        square = "".join(f"0 {v} 0\n" for v in range(4)) + "".join(f"1 {a} {b} {a + b}\n" for a, b in
                                                                 ((0, 1), (0, 2), (0, 3), (1, 3), (2, 3)))
        tower = "".join(f"i {v}\n" for v in range(4)) + "".join(f"i {a} {b}\n" for a, b in
                                                              ((0, 1), (0, 2), (0, 3), (1, 3), (2, 3)))
        closed = "".join(f"0 {v} 0\n" for v in range(3)) + "1 0 1 1\n1 0 2 1\n1 1 2 2\n"
        facets = "".join(f"{a} {b}\n" for a, b in ((0, 1), (0, 2), (0, 3), (1, 3), (2, 3)))
        for name, text, options, is_cut in (("g", square, (), True), ("t.tower", tower, (), True),
                                            ("g", square, ("--max-dim", "1"), False), ("f", facets, (), False),
                                            ("t.tower", tower + "c 0 1\n", (), False), ("c", closed, (), False)):
            path, out = self.file(name, text), self.folder / "out"
            for picture in ("--svg", "--html"):
                self.assertEqual(self.run_on(path, picture, out, *options).returncode, 0)
                self.assertEqual(words in " ".join(out.read_text().replace("</text>", " ").split()), is_cut,
                                 (name, options, picture, out.read_text()[-3000:]))
            self.assertIn(1, [bar[0] for bar in self.bars(path, *options)])  # of pictures only

    def test_an_output_takes_the_place_of_an_older_one_only_when_it_is_complete(self):
        good, bad = self.file("c.tower", CIRCLE), self.file("bad.tower", "i 0\ni 1\ni 0 2\n")
        outs = [self.file(f"x.{kind}", "old") for kind in ("pers", "csv", "svg", "html")]
        options = [word for out in outs for word in (f"--{out.suffix[1:]}", out)]
        self.assertEqual(self.run_on(bad, *options, "--quiet").returncode, 2)
        self.assertEqual([out.read_text() for out in outs], ["old"] * 4)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir() if path.suffix == ".part"), [])
        self.assertEqual(self.run_on(bad, *options, "--quiet", "--partial").returncode, 2)
        self.assertNotIn("old", [out.read_text() for out in outs])
        self.assertEqual(self.run_on(good, *options, "--quiet").returncode, 0)
        self.assertIn("1 5 6", outs[0].read_text())
        self.assertEqual(sorted(path.name for path in self.folder.iterdir() if path.suffix == ".part"), [])

    def test_outputs_that_are_no_files_are_written_at_once(self):
        path = self.file("c.tower", CIRCLE)
        self.assertIn(b"1 5 6", self.run_on(path, "--quiet", "--pers", "/dev/stdout").stdout)
        done = self.run_on(path, "--quiet", "--csv", "/dev/full")
        self.assertEqual((done.returncode, done.stderr), (1, b"sesame tower: cannot write /dev/full: No space left on device\n"))

    def test_outputs_that_would_be_lost_are_refused(self):
        path, out = self.file("c.tower", CIRCLE), self.folder / "x"
        link = self.folder / "link"
        link.symlink_to(path)
        for arguments in (("--pers", out, "--csv", out), ("--svg", out, "--html", self.folder / "." / "x"),
                          ("--pers", out, "--csv", f"{out}.part"), ("--pers", link)):
            done = self.run_on(path, *arguments)
            self.assertEqual((done.returncode, done.stdout), (1, b""), arguments)
        with open(path, "rb") as file:
            done = subprocess.run([SESAME, "tower", "-", "--pers", path], stdin=file, capture_output=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"is the input", done.stderr)
        self.assertEqual(path.read_text(), CIRCLE)
        self.assertFalse(out.exists())

    def test_a_length_is_a_number_from_zero_on(self):
        path = self.file("c.tower", CIRCLE)
        for length in ("nan", "-1", "-nan", "x", ""):
            self.assertEqual(self.run_on(path, f"--min-length={length}").returncode, 1, length)

    def test_quiet_says_nothing(self):
        done = self.run_on(self.file("c.tower", CIRCLE), "--quiet", "--every", "1")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, b"", b""))

    def test_it_stops_where_it_is_told(self):
        self.assertEqual(self.bars(self.file("c.tower", CIRCLE), "--until", "6"), [*CIRCLE_BARS[:3], [1, 5, None]])

    # ---- inputs

    def test_all_formats_of_one_filtration_have_the_same_bars(self):
        cells = [(), (), (), (0, 1), (1, 2), (0, 2), (3, 4, 5)]
        columns = [(max(0, len(rows) - 1), rows) for rows in cells]
        phat = "".join(" ".join(map(str, (d, *rows))) + "\n" for d, rows in columns)
        words = [len(columns), *(word for d, rows in columns for word in (d, len(rows), *rows))]
        binary = struct.pack(f"<{len(words)}q", *words)
        simplices = [(0,), (1,), (2,), (0, 1), (1, 2), (0, 2), (0, 1, 2)]
        gudhi = "".join(f"{len(s) - 1} {' '.join(map(str, s))} {t}\n" for t, s in enumerate(simplices))
        tower = "".join(f"i {' '.join(map(str, s))}\n" for s in simplices)
        expected = [[0, 0, None], [0, 1, 3], [0, 2, 4], [1, 5, 6]]
        for name, data in (("phat", phat.encode()), ("phat-binary", binary), ("gudhi", gudhi.encode()),
                           ("tower", tower.encode())):
            self.assertEqual(self.bars(self.file(name, data)), expected, name)
            self.assertEqual(self.bars(self.file(name, data), "--format", name), expected, name)
            self.assertEqual(self.bars("-", stdin=data), expected, name)
            self.assertEqual(self.bars("-", stdin=gzip.compress(data)), expected, name)

    def test_a_script_that_is_no_tower_is_refused(self):
        path = self.file("s.jsonl", '{"sesame":1}\n{"op":"simplex","name":"t","dim":1}\n'
                         '{"op":"product","name":"P","left":"t","right":"t"}\n')
        done = self.run_on(path)
        self.assertEqual((done.returncode, done.stdout), (2, b""))
        self.assertIn(b"s.jsonl:3: there is no barcode: step 2 is a product", done.stderr)
        done = self.run_on(path, "--partial", "--json")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(json.loads(done.stdout)["bars"], [[0, 1, None]])

    def test_every_shipped_script_that_is_a_tower_has_a_barcode(self):
        towers = 0
        for path in sorted(EXAMPLES.glob("*.jsonl")):
            done = self.run_on(path, "--json")
            if done.returncode == 0:
                towers += 1
                self.assertEqual(json.loads(done.stdout)["hidden"], 0)
            else:
                self.assertEqual(done.returncode, 2, path)
                self.assertIn(b"there is no barcode: step ", done.stderr, path)
        self.assertGreater(towers, 30)

    def test_what_a_script_expects_is_checked_over_its_own_ring_only(self):
        lines = ['{"sesame":1,"ring":"Z/3"}', '{"op":"insert","simplex":[0]}', '{"op":"expect","betti":[2]}']
        path = self.file("e.jsonl", "\n".join(lines) + "\n")
        self.assertEqual(self.run_on(path, "--ring", "Z/3").returncode, 3)
        done = self.run_on(path, "--ring", "Z/3", "--partial", "--json")
        self.assertEqual((done.returncode, json.loads(done.stdout)["bars"]), (3, [[0, 1, None]]))
        self.assertEqual(self.bars(path, "--ring", "Z/2"), [[0, 1, None]])

    def test_a_script_that_is_cut_off_or_damaged_as_gzip_data_is_an_error(self):
        data = gzip.compress(as_script(random_text(3)).encode())
        for wrong, what in ((data[:-30], b"the file is cut off"), (data[:40] + b"XXXX" + data[44:], b"damaged"),
                            (data[:12], b"cut off")):
            path = self.file("s.jsonl.gz", wrong)
            done = self.run_on(path, "--format", "script")
            self.assertEqual((done.returncode, done.stdout), (2, b""))
            self.assertEqual(done.stderr.count(b"\n"), 1)
            self.assertIn(what, done.stderr)
        done = self.run_on(self.file("s.jsonl.gz", data[:-30]), "--partial", "--json")
        self.assertEqual(done.returncode, 2)
        self.assertGreater(json.loads(done.stdout)["ops"], 0)

    def test_an_interrupt_before_the_first_line_is_complete_is_one(self):
        texts = (b"", b'{"sesame":1,"ri', b"i 0\ni")
        waiting = [subprocess.Popen([SESAME, "tower", "-"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL) for _ in texts]
        for text, process in zip(texts, waiting):
            process.stdin.write(text)
            process.stdin.flush()
        time.sleep(1)  # until all of them wait for more
        for text, process in zip(texts, waiting):
            with process:
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(timeout=30), 130, text)

    def test_operations_at_one_time_are_one_change_of_the_groups(self):
        (found,) = self.objects(self.file("t.tower", "0 i 0\n0 i 1\n1 i 2\n1 i 0 1\n2 i 0 2\n"), "--ring", "Z")
        self.assertEqual([(at, groups[0]["rank"]) for at, groups in found["groups"]], [(0, 2), (2, 1)])

    # ---- errors

    def test_a_wrong_line_is_named_and_what_was_before_it_can_be_had(self):
        for text, line, what in (("i 0\ni 1\ni 0 2\n", 3, "vertex 2 is not there"),
                                 ("i 0\ni 0\n", 2, "is there already"),
                                 ("i 0\ni 1\ni 0 1\nc 0 7\n", 4, "vertex 7 is not there"),
                                 ("i 0\ni 1\ni 2\ni 0 1 2\n", 4, "is not there"),
                                 ("i 0\nx 1\n", 2, ""),
                                 ("i 0\ni 1.5\n", 2, "")):
            path = self.file("bad.tower", text)
            done = self.run_on(path)
            self.assertEqual((done.returncode, done.stdout), (2, b""), text)
            self.assertIn(f"bad.tower:{line}: ".encode(), done.stderr)
            self.assertIn(what.encode(), done.stderr)
            done = self.run_on(path, "--partial", "--json")
            self.assertEqual(done.returncode, 2)
            self.assertEqual(json.loads(done.stdout)["ops"], line - 1)

    def test_a_wrong_matrix_is_named_by_its_column(self):
        done = self.run_on(self.file("m.phat", "0\n0\n0\n1 0 1\n1 1 2\n2 3 4\n"))
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"m.phat:6: the boundary of its boundary is not 0", done.stderr)

    def test_what_cannot_be_is_refused_before_anything_is_written(self):
        tower, matrix = self.file("c.tower", CIRCLE), self.file("m.phat", "0\n0\n1 0 1\n")
        out = self.folder / "x.pers"
        for arguments in ((matrix, "--ring", "Z/3"), (tower, "--ring", "Z", "--pers", out),
                          (tower, "--rings", "Z/2,Z/3", "--pers", out), (tower, "--rings", "Z/2,Z"),
                          (tower, "--rings", "Z/2,Z/2"), (tower, "--ring", "Z/4"), (tower, "--ring", "Z", "--generators"),
                          (tower, "--pers", tower), (tower, "--svg", self.folder / "no" / "x.svg"),
                          (self.folder / "absent",), (tower, "--format", "off"), (tower, "--until", "0")):
            done = self.run_on(*arguments)
            self.assertEqual((done.returncode, done.stdout), (1, b""), arguments)
            self.assertNotEqual(done.stderr, b"")
        self.assertFalse(out.exists())
        self.assertEqual(tower.read_text(), CIRCLE)


def padded(numbers, size):
    return numbers + [0] * (size - len(numbers))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
