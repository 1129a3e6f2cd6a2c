#!/usr/bin/env python3
"""Map files beside CGAL itself: what it writes we read, what we write it reads, and both count the same.

Usage: cgal_maps_test.py SESAME COMPILER [--heavy]

Exit status: 0 nothing differs, 1 something does, 77 there is no CGAL to compile cgal_maps.cpp with (Debian:
libcgal-dev, libmpfr-dev), which takes half a minute.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from map_files import MapFile

SKIPPED = 77
SESAME = os.path.abspath(sys.argv[1])
SOURCE = pathlib.Path(__file__).with_name("cgal_maps.cpp")
HEADER = '{"sesame":1,"ring":"Z","title":"test"}\n'

# Scripts of ours: a name, whether CGAL is given a combinatorial map of them, and their lines.
SCRIPTS = {
    "three squares": (True, [{"op": "polygon", "name": name, "sides": 4, "at": [[x, 0], [x + 1, 0], [x + 1, 1], [x, 1]]}
                             for x, name in enumerate("abc")]
                      + [{"op": "sew", "dim": 2, "pairs": [["a:2", "b:7"], ["b:2", "c:7"]]}]),
    "strip": (False, [{"op": "polygon", "name": "a", "sides": 4},
                      {"op": "sew", "dim": 2, "pairs": [["a:2", "a:6"]]}]),
    "by simplices": (False, [{"op": "polygon", "name": "a", "sides": 3, "as": "simplices"},
                             {"op": "sew", "dim": 2, "pairs": [["a:0", "a:1"]]}]),
}


def run(*words, text=None):
    done = subprocess.run([str(word) for word in words], input=text, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def compiled(folder):
    program = folder / "cgal_maps"
    done = subprocess.run([sys.argv[2], "-std=c++17", "-w", str(SOURCE), "-o", str(program), "-lmpfr", "-lgmp"],
                          capture_output=True, text=True, check=False)
    if done.returncode:
        print(f"skipped: cgal_maps.cpp cannot be compiled:\n{done.stderr[:500]}")
        sys.exit(SKIPPED)
    return program


def demand(is_true, *what):
    if not is_true:
        sys.exit(" ".join(map(str, what)))


def check_theirs(program, folder):
    for name in ("tetrahedron", "cubes", "torus", "moebius"):
        path = folder / f"{name}.3map"
        run(program, "write", name, path)
        kind = "general" if name == "moebius" else "map"
        counted = run(program, "count", kind, path).split()
        darts, cells = int(counted[1]), [int(n) for n in counted[2:6]]
        # As a 3-map a torus has a volume that is no ball.
        made = run(SESAME, "import", path, "--quiet", *([] if name in ("tetrahedron", "cubes") else ["--dim", 2]))
        lines = [json.loads(line) for line in made.splitlines()]
        ours = lines[-1]["cells"]
        demand(ours == cells[:len(ours)], name, ours, "cells, and CGAL counts", cells)
        step = lines[1]
        demand(len((step.get("beta") or step["alpha"])[0]) == darts, name, "has other darts than", darts)
        run(SESAME, "replay", "--quiet", "-", text=made)
        # And back: to the same numbers, and the same points.
        again = folder / "again.3map"
        form = "3map" if kind == "map" else "3map-generalized"
        again.write_text(run(SESAME, "export", "-", "--quiet", "--format", form, text=made))
        demand(run(program, "count", kind, again).split() == counted, name, "comes back as another map")
        demand(MapFile(again.read_text()).links == MapFile(path.read_text()).links, name, "has other links")


def check_ours(program, folder):
    for name, (is_oriented, steps) in SCRIPTS.items():
        text = HEADER + "\n".join(map(json.dumps, steps))
        for kind, form in [("map", "3map"), ("general", "3map-generalized")][0 if is_oriented else 1:]:
            path = folder / "ours.3map"
            path.write_text(run(SESAME, "export", "-", "--quiet", "--format", form, text=text))
            counted = run(program, "count", kind, path).split()
            file = MapFile(path.read_text())
            demand(counted[0] == "valid", name, form, "is no map for CGAL")
            demand(int(counted[1]) == len(file.links), name, form, "has other darts")
            demand([int(n) for n in counted[2:6]] == file.cells(3), name, form, counted, file.cells(3))
            if kind == "map":
                points = file.points_of_vertices(3)
                demand(int(counted[7]) == len(points), name, "has other points")
                demand([float(x) for x in counted[8:]] == [sum(p[k] for p in points) for k in range(3)], name, counted)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        program = compiled(folder)
        check_theirs(program, folder)
        check_ours(program, folder)
    print("nothing differs")


if __name__ == "__main__":
    main()
