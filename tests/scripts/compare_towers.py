#!/usr/bin/env python3
"""Compares `sesame tower` with the oracle on random towers, and on random filtrations with GUDHI and PHAT too.

    compare_towers.py SESAME [--others] [--random N] [--seed N] [--operations N] [--rings Z/2,Z/3] [--python PYTHON]

Of N random towers every third has no contractions and is written in all formats, plain, by gzip and through a pipe,
which must all have the same bars. With --others it is these that are compared, with GUDHI (Debian: python3-gudhi, for
the system's Python; over Z/2 and Z/3) and PHAT (Debian: phat-utils; over Z/2) instead of the oracle, as far as they are
there. Where a tower differs it is kept, and its path printed. Ends with `N passed, N failed`; the exit status is 0 only
if nothing differed, and 77 when neither of the others is there.
"""

import argparse
import gzip
import json
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import random_tower
import tower_oracle

# Bars of simplices (vertices ascending from 0) and values, for many filtrations in one run.
GUDHI_PROGRAM = """
import gudhi, json, sys
answers = []
for simplices, p in json.load(sys.stdin):
    tree = gudhi.SimplexTree()
    for vertices, value in simplices:
        tree.insert(vertices, value)
    bars = tree.persistence(homology_coeff_field=p, min_persistence=0, persistence_dim_max=True)
    answers.append([[d, birth, None if death == float("inf") else death] for d, (birth, death) in bars])
json.dump(answers, sys.stdout)
"""


class Difference(Exception):
    """Where the program and what it is compared with part."""


class Case:
    """A random tower and what it was made from."""

    def __init__(self, seed, operations):
        rng = random.Random(seed)
        self.seed = seed
        self.is_filtration = seed % 3 == 0
        self.times = rng.choice(["none", "equal", "distinct"])
        self.operations = random_tower.make(
            seed, operations=rng.randrange(operations + 1), vertices=rng.randrange(1, 8), dimension=rng.randrange(1, 5),
            contract=0 if self.is_filtration else rng.choice([0.1, 0.2, 0.4]), any_two=rng.random() < 0.5,
            times=self.times, reuse=rng.choice([0, 0.5]))

    def text(self):
        return random_tower.text(self.operations, self.times != "none")


# ----------------------------------------------------------------------------------------------------- the program


def answer(program, path, ring, *extra, data=None):
    """What the program says of a file, or of data on its standard input: the object that it prints."""
    command = [program, "tower", path, "--json", "--ring", ring, *extra]
    done = subprocess.run(command, input=data, stdin=subprocess.DEVNULL if data is None else None, capture_output=True,
                          timeout=120, check=False)
    if done.returncode != 0:
        raise Difference(f"{' '.join(command)}: exit status {done.returncode}: {done.stderr.decode()[-500:]}")
    found = json.loads(done.stdout)
    if not {"ring", "ops", "bars", "hidden", "seconds"} <= set(found) or found["ring"] != ring:
        raise Difference(f"{' '.join(command)}: not the object that was expected: {done.stdout.decode()[:200]}")
    return found


def check(what, found, expected):
    if found != expected:
        extra = [bar for bar in found if bar not in expected]
        missing = [bar for bar in expected if bar not in found]
        raise Difference(f"{what}: {len(found)} bars, not {len(expected)}; only there {extra}, missing {missing}")


def check_count(case, found):
    """In a filtration every cell begins a bar or ends one."""
    essential = sum(bar[2] is None for bar in found["bars"])
    pairs = (len(case.operations) - essential) // 2
    if case.is_filtration and found["hidden"] != pairs - (len(found["bars"]) - essential):
        raise Difference(f"hidden: {found['hidden']} of {pairs} pairs")


def check_tower(program, directory, case, rings):
    path = os.path.join(directory, "case.tower")
    with open(path, "w", encoding="ascii") as file:
        file.write(case.text())
    for ring in rings:
        found = answer(program, path, ring)
        if found["ops"] != len(case.operations):
            raise Difference(f"{ring}: {found['ops']} operations, not {len(case.operations)}")
        check(ring, found["bars"], tower_oracle.barcode(case.operations, int(ring[2:])))
        check_count(case, found)


# ----------------------------------------------------------------------------------------------- filtrations as files


def columns(operations):
    """The boundary matrix: (dimension, rows) by column."""
    place, found = {}, []
    for k, operation in enumerate(operations):
        simplex = tuple(sorted(operation.labels))
        place[simplex] = k
        faces = [simplex[:i] + simplex[i + 1:] for i in range(len(simplex))] if len(simplex) > 1 else []
        found.append((len(simplex) - 1, sorted(place[face] for face in faces)))
    return found


def written(operations):
    """The filtration in every format, as (option, bytes), its times the indices. A matrix has no signs: it is for Z/2."""
    matrix = columns(operations)
    numbers = [len(matrix)] + [n for d, rows in matrix for n in (d, len(rows), *rows)]
    phat = "".join(" ".join(map(str, [d, *rows])) + "\n" for d, rows in matrix)
    gudhi = "".join(" ".join(map(str, [len(o.labels) - 1, *o.labels, k])) + "\n" for k, o in enumerate(operations))
    return {"tower": random_tower.text(operations, False).encode(), "phat": phat.encode(), "gudhi": gudhi.encode(),
            "phat-binary": struct.pack(f"={len(numbers)}q", *numbers)}


def check_formats(program, directory, case):
    indexed = [tower_oracle.Operation(k, o.kind, o.labels) for k, o in enumerate(case.operations)]
    expected = tower_oracle.barcode(indexed, 2)
    path = os.path.join(directory, "case")
    for option, data in written(indexed).items():
        for packed in (data, gzip.compress(data, mtime=0)):
            with open(path, "wb") as file:
                file.write(packed)
            check(f"{option}, named", answer(program, path, "Z/2", "--format", option)["bars"], expected)
            check(f"{option}, by content", answer(program, path, "Z/2")["bars"], expected)
            check(f"{option}, through a pipe", answer(program, "-", "Z/2", data=packed)["bars"], expected)


# ------------------------------------------------------------------------------------------------------ other programs


def check_phat(program, directory, case):
    matrix, output = (os.path.join(directory, name) for name in ("case.phat", "case.pairs"))
    indexed = [tower_oracle.Operation(k, o.kind, o.labels) for k, o in enumerate(case.operations)]
    with open(matrix, "wb") as file:
        file.write(written(indexed)["phat"])
    subprocess.run(["phat", "--ascii", matrix, output], check=True, stdout=subprocess.DEVNULL, timeout=120)
    with open(output, encoding="ascii") as file:
        pairs = [list(map(int, line.split())) for line in file.read().splitlines()[1:]]
    dimensions = [d for d, _ in columns(indexed)]
    essential = set(range(len(dimensions))) - {k for pair in pairs for k in pair}
    bars = [[dimensions[i], i, j] for i, j in pairs] + [[dimensions[i], i, None] for i in essential]
    check("PHAT", answer(program, matrix, "Z/2")["bars"], sorted(bars, key=tower_oracle.bar_order))


def gudhi_says(python, questions):
    """The bars of each question; nothing when GUDHI is not there."""
    try:
        done = subprocess.run([python, "-c", GUDHI_PROGRAM], input=json.dumps(questions).encode(), capture_output=True,
                              timeout=600, check=False)
    except OSError:
        return None
    return json.loads(done.stdout) if done.returncode == 0 else None


def check_gudhi(program, directory, cases, python):
    """The number of cases that passed, and the differences; nothing when GUDHI is not there."""
    questions, asked = [], []
    for case in cases:
        labels = {label: n for n, label in enumerate(sorted({label for o in case.operations for label in o.labels}))}
        for p in (2, 3):
            questions.append([[[[labels[label] for label in o.labels], o.time] for o in case.operations], p])
            asked.append((case, p))
    answers = gudhi_says(python, questions)
    if answers is None:
        return None
    path, passed, failed = os.path.join(directory, "case.tower"), 0, []
    for (case, p), bars in zip(asked, answers):
        with open(path, "w", encoding="ascii") as file:
            file.write(case.text())
        try:
            check(f"GUDHI, Z/{p}", answer(program, path, f"Z/{p}")["bars"], sorted(bars, key=tower_oracle.bar_order))
            passed += 1
        except Difference as difference:
            failed.append((case, difference))
    return passed, failed


# ----------------------------------------------------------------------------------------------------------- the runs


def keep(case, difference):
    path = os.path.join(tempfile.gettempdir(), f"sesame-tower-{case.seed}.tower")
    with open(path, "w", encoding="ascii") as file:
        file.write(case.text())
    print(f"{path} (seed {case.seed}): {difference}")


def run(checks):
    """The numbers of cases that passed and failed."""
    passed, failed = 0, 0
    for case, one in checks:
        try:
            one(case)
            passed += 1
        except Difference as difference:
            keep(case, difference)
            failed += 1
    return passed, failed


def compare_with_oracle(arguments, directory, cases):
    checks = [(case, lambda case: check_tower(arguments.program, directory, case, arguments.rings)) for case in cases]
    checks += [(case, lambda case: check_formats(arguments.program, directory, case))
               for case in cases if case.is_filtration]
    return run(checks)


def compare_with_others(arguments, directory, cases):
    """As above; nothing when none of the others is there."""
    filtrations = [case for case in cases if case.is_filtration]
    beside_gudhi = check_gudhi(arguments.program, directory, filtrations, arguments.python)
    has_phat = shutil.which("phat") is not None
    if beside_gudhi is None:
        print("GUDHI is not here: left out")
    if not has_phat:
        print("PHAT is not here: left out")
    if beside_gudhi is None and not has_phat:
        return None
    passed, failed = beside_gudhi if beside_gudhi is not None else (0, [])
    for case, difference in failed:
        keep(case, difference)
    checks = [(case, lambda case: check_phat(arguments.program, directory, case)) for case in filtrations if has_phat]
    passed_phat, failed_phat = run(checks)
    return passed + passed_phat, len(failed) + failed_phat


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--others", action="store_true", help="compare with GUDHI and PHAT instead of the oracle")
    parser.add_argument("--random", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--operations", type=int, default=40, help="at most so many in a tower")
    parser.add_argument("--rings", type=lambda text: text.split(","), default=["Z/2", "Z/3"])
    parser.add_argument("--python", default="/usr/bin/python3", help="the Python that has GUDHI")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        cases = [Case(arguments.seed + k, arguments.operations) for k in range(arguments.random)]
        compare = compare_with_others if arguments.others else compare_with_oracle
        found = compare(arguments, directory, cases)
    if found is None:
        return 77
    passed, failed = found
    print(f"{passed} passed, {failed} failed")
    return 0 if passed > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
