#!/usr/bin/env python3
"""Compares `sesame distance` with GUDHI (bottleneck) and with SciPy's linear assignment (Wasserstein).

    compare_distances.py SESAME [--points N] [--seed N] [--python PYTHON]

Diagrams: random points above the diagonal; points near the diagonal; small numbers on a grid, where most distances are
equal; a diagram and the same one moved a little. Each pair has some essential bars, and two dimensions. Of the
Wasserstein distances q = 1, 2 and 5 are compared, in both metrics of the plane. The matchings printed must attain the
distances printed.

Python packages are those of PYTHON, by default the system's (Debian: python3-gudhi, python3-scipy). Exit status: 0
nothing differs, 1 something does, 77 a package is not there.
"""

import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

SKIPPED = 77
EXPONENTS = [1, 2, 5]


# ------------------------------------------------------------------------------------------------------- the diagrams


def uniform(rng, n):
    return [tuple(sorted((rng.random(), rng.random()))) for _ in range(n)]


def near_the_diagonal(rng, n):
    births = [rng.random() for _ in range(n)]
    return [(b, b + rng.expovariate(20)) for b in births]


def on_a_grid(rng, n):
    pairs = [sorted((rng.randrange(60), rng.randrange(60))) for _ in range(n)]
    return [(b, d + 1) for b, d in pairs]


def moved(rng, points):
    def jittered():
        return [tuple(sorted((b + rng.gauss(0, 1e-3), d + rng.gauss(0, 1e-3)))) for b, d in points]
    return jittered()


def cases(rng, n):
    for kind in (uniform, near_the_diagonal, on_a_grid):
        yield kind.__name__, kind(rng, n), kind(rng, n * 9 // 10)
    base = uniform(rng, n)
    yield "moved", base, moved(rng, base)
    yield "one is empty", base, []


def with_essential(rng, points):
    return points + [(rng.random(), math.inf) for _ in range(3)]


def write_diagrams(path, by_dimension):
    with open(path, "w", encoding="utf-8") as out:
        for dimension, points in enumerate(by_dimension):
            for birth, death in points:
                out.write(f"{dimension} {birth!r} {death!r}\n")


# ------------------------------------------------------------------------------------------------- what others say


def split(points):
    ends = [p for p in points if p[1] != math.inf]
    essential = sorted(p[0] for p in points if p[1] == math.inf)
    return ends, essential


def wasserstein(left, right, q, ground):
    """All of each side, and for each point of the other side the diagonal: a square assignment problem."""
    import numpy
    from scipy.optimize import linear_sum_assignment

    (left, left_essential), (right, right_essential) = split(left), split(right)
    n, m = len(left), len(right)
    costs = numpy.zeros((n + m, n + m))
    half = 2 if ground == "inf" else math.sqrt(2)
    if n:
        x = numpy.array(left)
        costs[:n, m:] = ((x[:, 1] - x[:, 0]) / half)[:, None]
    if m:
        y = numpy.array(right)
        costs[n:, :m] = ((y[:, 1] - y[:, 0]) / half)[None, :]
    if n and m:
        apart = numpy.abs(x[:, None, :] - y[None, :, :])
        costs[:n, :m] = apart.max(axis=2) if ground == "inf" else numpy.hypot(apart[:, :, 0], apart[:, :, 1])
    rows, columns = linear_sum_assignment(costs**q)
    powers = [float(costs[i, j]) ** q for i, j in zip(rows, columns)]
    powers += [abs(a - b) ** q for a, b in zip(left_essential, right_essential)]
    return math.fsum(powers) ** (1 / q)


def bottleneck(left, right):
    import gudhi

    return gudhi.bottleneck_distance([list(p) for p in left], [list(p) for p in right])


# ------------------------------------------------------------------------------------------------------ the comparison


def distance(sesame, left, right, options):
    done = subprocess.run([sesame, "distance", left, right, "--json", "--matching", *options], check=True,
                          capture_output=True, text=True)
    return json.loads(done.stdout)


def value_of_matching(row, q):
    costs = [match["cost"] for match in row["matching"]]
    return max(costs, default=0) if q is None else math.fsum(c**q for c in costs) ** (1 / q)


def is_close(x, y):
    return math.isclose(x, y, rel_tol=1e-9, abs_tol=1e-12)


def compare(sesame, name, files, diagrams):
    """The number of differences, each printed."""
    differences = 0
    kinds = [(None, "inf")] + [(q, ground) for q in EXPONENTS for ground in ("inf", "2")]
    for q, ground in kinds:
        options = [] if q is None else ["--wasserstein", str(q), "--internal-p", ground]
        found = distance(sesame, *files, options)
        for row, left, right in zip(found["dims"], *diagrams):
            expected = bottleneck(left, right) if q is None else wasserstein(left, right, q, ground)
            attained = value_of_matching(row, q)
            if not is_close(row["value"], expected) or not is_close(row["value"], attained):
                print(f"{name}, H{row['dim']}, q = {q}, metric {ground}: sesame {row['value']!r}, its matching "
                      f"{attained!r}, expected {expected!r}")
                differences += 1
    return differences


def run(options):
    rng = random.Random(options.seed)
    differences = 0
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, name) for name in ("left.pers", "right.pers")]
        for name, left, right in cases(rng, options.points):
            diagrams = [[with_essential(rng, left), with_essential(rng, left[: len(left) // 2])],
                        [with_essential(rng, right), with_essential(rng, right[: len(right) // 2])]]
            for path, diagram in zip(files, diagrams):
                write_diagrams(path, diagram)
            differences += compare(options.sesame, name, files, diagrams)
    print(f"{differences} differences" if differences else "nothing differs")
    return 1 if differences else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sesame")
    parser.add_argument("--points", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--python", default="/usr/bin/python3")
    options = parser.parse_args()
    try:
        import gudhi  # noqa: F401
        import scipy.optimize  # noqa: F401
    except ImportError as problem:
        if os.path.exists(options.python) and not os.path.samefile(options.python, sys.executable):
            os.execv(options.python, [options.python, __file__, *sys.argv[1:]])
        print(f"skipped: {problem}")
        sys.exit(SKIPPED)
    sys.exit(run(options))


if __name__ == "__main__":
    main()
