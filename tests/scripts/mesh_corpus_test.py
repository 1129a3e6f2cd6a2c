#!/usr/bin/env python3
"""Every variant of a mesh file in tests/golden/meshes is read as its manifest says, by every command that reads meshes.

    mesh_corpus_test.py SESAME DIRECTORY

manifest.json has an entry for each file: `betti` and `torsion` over Z (nothing: no torsion), `betti_modulo_2` where
they differ, how many `faces` are kept, how many are `degenerate_faces`, `duplicate_faces`, `segments` or `folded_faces`
(nothing: 0), and parts of `remarks`, each to be found exactly once; or, of a file that is `refused`, a part of what is
said. `sesame mesh` and all forms of `sesame import`, replayed over Z and Z/2, have to agree.
"""

import json
import pathlib
import subprocess
import sys
import unittest

SESAME, DIRECTORY = sys.argv[1], pathlib.Path(sys.argv[2])
IS_HEAVY = "--heavy" in sys.argv  # else each file in one ring and one form, in turns
MANIFEST = json.loads((DIRECTORY / "manifest.json").read_text(encoding="utf-8"))
KEPT = {name: entry for name, entry in MANIFEST.items() if "refused" not in entry}
COUNTS = ("degenerate_faces", "duplicate_faces", "segments", "folded_faces")
FORMS = ([], ["--polygons", "cone", "--order", "file"], ["--assemble", "--order", "file"],
         ["--assemble", "--polygons", "cone"])


def run(*words, stdin=b""):
    return subprocess.run([SESAME, *map(str, words)], input=stdin, capture_output=True, timeout=120, check=False)


def groups(answer):
    betti, torsion = list(answer["betti"]), [list(factors) for factors in answer["torsion"]]
    return betti, torsion


def expected_groups(entry, ring):
    betti = entry["betti"]
    if ring == "Z":
        return betti, entry.get("torsion", [[] for _ in betti])
    return entry.get("betti_modulo_2", betti) if ring == "Z/2" else betti, [[] for _ in betti]


class Corpus(unittest.TestCase):
    def test_every_file_is_in_the_manifest(self):
        files = {path.name for path in DIRECTORY.iterdir() if path.suffix in (".off", ".obj", ".ply", ".stl")}
        self.assertEqual(files, set(MANIFEST))

    def test_sesame_mesh_says_what_the_manifest_says(self):
        for number, (name, entry) in enumerate(KEPT.items()):
            rings = ("Z", "Q", "Z/2")
            for ring in rings if IS_HEAVY else rings[number % 3:][:1]:
                with self.subTest(file=name, ring=ring):
                    done = run("mesh", "--json", "--ring", ring, DIRECTORY / name)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    answer = json.loads(done.stdout)
                    self.assertEqual(groups(answer), expected_groups(entry, ring))
                    self.check_report(answer["validity"], entry, done.stderr.decode())

    def check_report(self, validity, entry, said):
        self.assertEqual(validity["faces"], entry["faces"])
        for count in COUNTS:
            self.assertEqual(validity[count], entry.get(count, 0), count)
        self.assertEqual(validity["faces_in_file"], validity["faces"] + sum(validity[count] for count in COUNTS[:3]))
        left_out = validity["degenerate_faces"] + validity["duplicate_faces"]
        self.assertEqual(f"left out {left_out} of {validity['faces_in_file']} face" in said, left_out > 0, said)
        for part in entry.get("remarks", []):
            self.assertEqual(sum(part in remark for remark in validity["remarks"]), 1, (part, validity["remarks"]))

    def test_every_form_of_import_is_replayed_to_the_same_groups(self):
        for number, (name, entry) in enumerate(KEPT.items()):
            for form in FORMS if IS_HEAVY else FORMS[number % len(FORMS):][:1]:
                with self.subTest(file=name, form=form):
                    made = run("import", DIRECTORY / name, *form)
                    self.assertEqual(made.returncode, 0, made.stderr)
                    self.check_said(made.stderr.decode(), entry)
                    for ring in ("Z", "Z/2"):
                        done = run("replay", "--json", "--ring", ring, "-", stdin=made.stdout)
                        self.assertEqual(done.returncode, 0, done.stderr)
                        summary = json.loads(done.stdout.splitlines()[-1])
                        self.assertEqual(groups(summary), expected_groups(entry, ring))

    def check_said(self, said, entry):
        for part in entry.get("remarks", []):
            self.assertEqual(said.count(part), 1, (part, said))
        for kind in ("degenerate", "duplicate"):
            self.assertEqual(f" {kind} face" in said, entry.get(f"{kind}_faces", 0) > 0, said)

    def test_what_is_refused_is_refused_by_both_with_the_same_sentence(self):
        for name, entry in MANIFEST.items():
            if name in KEPT:
                continue
            with self.subTest(file=name):
                for command in ("mesh", "import"):
                    done = run(command, DIRECTORY / name)
                    self.assertEqual((done.returncode, done.stdout), (2, b""))
                    self.assertIn(name + entry["refused"], done.stderr.decode())

    def test_sentences_for_people_have_no_wrong_plurals(self):
        for name in KEPT:
            with self.subTest(file=name):
                said = run("import", DIRECTORY / name).stderr.decode() + run("mesh", DIRECTORY / name).stdout.decode()
                self.assertNotRegex(said, r"(?<![\d.])1 (degenerate |duplicate |folded )?"
                                          r"(faces|points|lines|vertices|edges|triangles|steps|bytes|strips|coordinates)\b")
                self.assertNotRegex(said, r"\b(inf|nan)\b")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
