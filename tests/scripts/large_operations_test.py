#!/usr/bin/env python3
"""Products, cones and splits of large objects: the right answer, and what each step took.

    large_operations_test.py SESAME [--side N]

Answers are checked; times are printed beside them and never asserted. With the default side, 408, a torus has 998,784
cells: N*N vertices, 3 N*N edges, 2 N*N triangles. The time of a step is that of the step alone (`us` in the reports).
"""
import argparse
import json
import math
import random
import statistics
import subprocess
import sys
import tempfile


def torus(name, n):
    cells = [{"id": f"v{i}_{j}"} for i in range(n) for j in range(n)]
    places = [(i, j, (i + 1) % n, (j + 1) % n) for i in range(n) for j in range(n)]
    for i, j, k, m in places:
        cells += [{"id": f"h{i}_{j}", "faces": [f"v{k}_{j}", f"v{i}_{j}"]},
                  {"id": f"k{i}_{j}", "faces": [f"v{i}_{m}", f"v{i}_{j}"]},
                  {"id": f"d{i}_{j}", "faces": [f"v{k}_{m}", f"v{i}_{j}"]}]
    for i, j, k, m in places:
        cells += [{"id": f"a{i}_{j}", "faces": [f"k{k}_{j}", f"d{i}_{j}", f"h{i}_{j}"]},
                  {"id": f"b{i}_{j}", "faces": [f"h{i}_{m}", f"d{i}_{j}", f"k{i}_{j}"]}]
    return {"op": "complex", "name": name, "cells": cells}


def replay(program, steps):
    """The reports of all steps, in order. Ends the run when the program does not end well."""
    with tempfile.NamedTemporaryFile("w", suffix=".jsonl") as script:
        script.write(json.dumps({"sesame": 1, "ring": "Z"}) + "\n")
        script.writelines(json.dumps(step) + "\n" for step in steps)
        script.flush()
        run = subprocess.run([program, "replay", "--json", "--every", "1", script.name], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"exit status {run.returncode}: {run.stderr}")
    return [json.loads(line) for line in run.stdout.splitlines()][:-1]


FAILURES = []


def check(what, found, expected):
    if found != expected:
        FAILURES.append(what)
        print(f"WRONG {what}: {found}, should be {expected}")


def milliseconds(reports, op):
    return [report["us"] / 1000 for report in reports if report["op"] == op]


def summary(times):
    return f"median {statistics.median(times):.4f} ms, largest {max(times):.3f} ms"


def random_edges(n, rng):
    return [f"{rng.choice('hk')}{rng.randrange(n)}_{rng.randrange(n)}" for _ in range(2)]


def products(program, n):
    rng = random.Random(1)
    gluings = []
    for _ in range(1000):
        one, other = random_edges(n, rng)
        vertices = [f"v{rng.randrange(n)}_{rng.randrange(n)}" for _ in range(2)]
        gluings.append({"op": "identify", "pairs": [[f"P.(T.{one}|U.{vertices[0]})", f"P.(T.{other}|U.{vertices[1]})"]]})
    reports = replay(program, [torus("T", n), torus("U", n), {"op": "product", "name": "P", "left": "T", "right": "U"},
                               *gluings, {"op": "cone", "apex": "v"}])
    cells = 6 * n * n
    check("cells of the product", sum(reports[2]["cells"]), cells * cells)
    check("torus x torus", reports[2]["betti"], [1, 4, 6, 4, 1])
    # Each pair of edges has other vertices than those before, nearly always: 1,000 gluings make about 1,000 loops.
    inside = reports[-2]
    check("Euler characteristic after the gluings", inside["euler"],
          sum((-1) ** p * b for p, b in enumerate(inside["betti"])))
    check("a cone on all of it", reports[-1]["betti"], [1, 0, 0, 0, 0, 0])
    print(f"two bodies of {cells:,} cells: built in {summary(milliseconds(reports, 'complex'))}")
    print(f"  their product, {cells * cells:,} cells: {summary(milliseconds(reports, 'product'))}")
    print(f"  1,000 gluings of edge x vertex inside: {summary(milliseconds(reports, 'identify'))}, "
          f"b_1 = {inside['betti'][1]}")
    print(f"  a cone over all of that: {summary(milliseconds(reports, 'cone'))}")
    rng = random.Random(1)
    reports = replay(program, [torus("T", n)] + [{"op": "identify", "pairs": [[f"T.{a}", f"T.{b}"]]}
                                                for a, b in (random_edges(n, rng) for _ in range(1000))])
    print(f"  1,000 gluings of edges in one torus: {summary(milliseconds(reports, 'identify'))}, "
          f"b_1 = {reports[-1]['betti'][1]}")


def circles(program):
    steps = [{"op": "simplex", "name": "c1", "dim": 1}, {"op": "identify", "pairs": [["c1.0", "c1.1"]]}]
    for k in (1, 2, 4, 8):
        steps.append({"op": "product", "name": f"c{2 * k}", "left": f"c{k}", "right": f"c{k}"})
    reports = replay(program, steps)
    check("the 16-fold product of a circle", reports[-1]["betti"], [math.comb(16, k) for k in range(17)])
    check("its cells", sum(reports[-1]["cells"]), 2 ** 16)
    print(f"16-fold product of a circle: {sum(report['us'] for report in reports) / 1000:.2f} ms in all")


def splits(program, n, repetitions):
    """Glues two vertices of a torus, far from each other, and splits them again: the same place, many times."""
    i, j = 2 * n // 3, n // 2
    one, other = f"T.v{n // 3}_{n // 3}", f"T.v{i}_{j}"
    star = [[f"T.h{i}_{j}", 1], [f"T.h{i - 1}_{j}", 0], [f"T.k{i}_{j}", 1], [f"T.k{i}_{j - 1}", 0],
            [f"T.d{i}_{j}", 1], [f"T.d{i - 1}_{j - 1}", 0]]
    steps = [torus("T", n)]
    for k in range(repetitions):
        steps += [{"op": "identify", "pairs": [[one, other]]},
                  {"op": "deidentify", "split": [{"cell": one, "as": f"w{k}", "moves": star}]}]
        other = f"w{k}"
    reports = replay(program, steps)
    for k, report in enumerate(reports):
        check(f"b_1 after step {k + 1}", report["betti"], [1, 3 if report["op"] == "identify" else 2, 1])
    built = reports[0]["us"] / 1000
    times = milliseconds(reports, "deidentify")
    print(f"a torus of {6 * n * n:,} cells: built in {built:.1f} ms")
    print(f"  splitting a vertex, {repetitions} times: {summary(times)}; median / building = "
          f"{statistics.median(times) / built:.6f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--side", type=int, default=408)
    options = parser.parse_args()
    products(options.program, options.side)
    circles(options.program)
    splits(options.program, options.side, 20)
    splits(options.program, options.side // 4, 400)
    if FAILURES:
        sys.exit(f"{len(FAILURES)} wrong")


if __name__ == "__main__":
    main()
