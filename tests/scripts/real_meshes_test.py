#!/usr/bin/env python3
"""Real meshes, read from the archive of Debian's package libcgal-demo, through the whole program.

    real_meshes_test.py SESAME [--archive FILE]

Meshes whose homology is known are imported as one complex and as an assembly of triangles and replayed over Z, the
complex over Z/2 as well. Betti numbers, torsion, the number of cells and the Euler characteristic are compared with
what is known and with what is counted here in the mesh file. The generators are checked by what they claim: each is a
cycle, and modulo 2 those of each degree are independent beside all boundaries, with boundaries that are taken here from
the vertices of the faces in the mesh file.

Then every mesh of the archive goes through `sesame import`, `sesame replay` and `sesame mesh`: none may end by a
signal, hang, or fail without a message, and the two ways to the homology must agree.

Prints tables of what was checked and of seconds. Exit status: 0 all is right, 1 something is not, 77 no archive.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import time

ARCHIVE = "/usr/share/doc/libcgal-dev/data.tar.gz"
FOLDER = "data/meshes/"
MESHES = (".off", ".obj", ".ply", ".stl")
SKIPPED = 77
PATIENCE = 300  # seconds; what takes longer hangs

BETTI = {
    "cheese": [1, 266, 1],
    "knot2": [2, 4, 2],
    "bones": [26, 0, 26],
    "turbine": [1, 22, 1],
    "elephant-with-holes": [1, 111, 0],
    "b9_mesh": [47, 42, 5],
    "refined_elephant": [1, 6, 1],
    "armadillo": [1, 0, 1],
    "bunny00": [1, 0, 1],
}


class Wrong(Exception):
    """Something that the program said or did is not right."""


def check(condition, what):
    if not condition:
        raise Wrong(what)


def run(*command):
    """(finished process, seconds). A signal or a hang is Wrong."""
    words = [str(word) for word in command]
    shown = " ".join(words[1:])
    start = time.monotonic()
    try:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE,
                              check=False)
    except subprocess.TimeoutExpired:
        raise Wrong(f"{shown}: not done after {PATIENCE} s") from None
    check(done.returncode >= 0, f"{shown}: ended by signal {-done.returncode}")
    return done, time.monotonic() - start


def run_well(*command):
    done, seconds = run(*command)
    check(done.returncode == 0, f"{' '.join(map(str, command[1:]))}: status {done.returncode}, {done.stderr.strip()}")
    return done, seconds


def last_object(text):
    lines = text.splitlines()
    check(lines, "nothing on standard output")
    summary = json.loads(lines[-1])
    check(summary.get("summary") is True, "the last object is not the summary")
    return summary


def alternating_sum(numbers):
    return sum(n if p % 2 == 0 else -n for p, n in enumerate(numbers))


# ----------------------------------------------------------------------------------------------- the mesh, read here


class Mesh:
    """The triangles of an OFF file as sorted triples of vertices; edges are sorted pairs."""

    def __init__(self, path):
        words = re.sub(r"#.*", "", pathlib.Path(path).read_text(encoding="utf-8")).split()
        check(words[0] == "OFF", f"{path}: not an OFF file")
        points, faces = int(words[1]), int(words[2])
        at = 4 + 3 * points
        self.triangles = []
        for _ in range(faces):
            check(words[at] == "3", f"{path}: a face that is no triangle")
            self.triangles.append(tuple(sorted(int(word) for word in words[at + 1:at + 4])))
            check(len(set(self.triangles[-1])) == 3, f"{path}: a degenerate triangle")
            at += 4
        self.faces = sorted(set(self.triangles))
        self.edges = sorted({pair for t in self.faces for pair in sides(t)})
        self.vertices = sorted({v for t in self.faces for v in t})

    def cells(self):
        return [len(self.vertices), len(self.edges), len(self.faces)]


def sides(triangle):
    """d_0, d_1, d_2."""
    a, b, c = triangle
    return [(b, c), (a, c), (a, b)]


def boundary(chain):
    """The boundary of a chain {sorted tuple of vertices: coefficient}."""
    result = {}
    for cell, coefficient in chain.items():
        for i in range(len(cell) if len(cell) > 1 else 0):
            face = cell[:i] + cell[i + 1:]
            result[face] = result.get(face, 0) + (coefficient if i % 2 == 0 else -coefficient)
    return {face: n for face, n in result.items() if n}


class ModuloTwo:
    """Sets of cells modulo 2 and their span, by the reduction that persistent homology uses."""

    def __init__(self):
        self.by_lowest = {}

    def add(self, cells):
        """Whether the set is independent of those added before."""
        rest = set(cells)
        while rest:
            lowest = max(rest)
            if lowest not in self.by_lowest:
                self.by_lowest[lowest] = rest
                return True
            rest ^= self.by_lowest[lowest]
        return False


def check_generators(mesh, cell_of, summary):
    """Counts, cycles, and independence modulo 2 of the generators; `cell_of` turns a name into a tuple of vertices."""
    count = [0] * len(summary["betti"])
    modulo_2 = [[] for _ in count]
    for generator in summary["generators"]:
        p = generator["dim"]
        count[p] += 1
        check(generator["order"] == 0, "a generator of finite order")
        chain = {}
        for coefficient, name in generator["chain"]:
            cell = cell_of(name)
            check(len(cell) == p + 1, f"{name} in a generator of dimension {p}")
            check(cell not in chain and int(coefficient) != 0, f"{name} twice or with coefficient 0")
            chain[cell] = int(coefficient)
        check(chain and not boundary(chain), f"a generator of H_{p} is not a cycle")
        modulo_2[p].append([cell for cell, n in chain.items() if n % 2])
    check(count == summary["betti"], f"{count} generators for Betti numbers {summary['betti']}")
    boundaries = [[[(a,), (b,)] for a, b in mesh.edges], [sides(triangle) for triangle in mesh.faces], []]
    for p, cycles in enumerate(modulo_2):
        span = ModuloTwo()
        for cells in boundaries[p]:
            span.add(cells)
        check(all(span.add(cells) for cells in cycles), f"the generators of H_{p} are not independent modulo 2")


# ----------------------------------------------------------------------------------------------- the scripts, read here


def operations(script):
    with open(script, encoding="utf-8") as lines:
        return [json.loads(line) for line in lines if line.strip() and not line.startswith("#")][1:]


def names_of_complex(mesh, script):
    """The cell of each name in the script of one complex, checked against the mesh file."""
    cell_of = {}
    for op in operations(script):
        if op["op"] != "complex":
            continue
        listed = {cell["id"]: cell for cell in op["cells"]}
        for name, cell in listed.items():
            numbers = [int(n) for n in name[1:].split("-")]
            if name[0] == "f":
                vertices = mesh.triangles[numbers[0]]
                faces = [f"e{a}-{b}" for a, b in sides(vertices)]
            else:
                vertices = tuple(numbers)
                faces = [f"v{v}" for v in reversed(vertices)] if name[0] == "e" else []
            check(cell.get("faces", []) == faces, f"the faces of {name} are {cell.get('faces')}, not {faces}")
            cell_of[f"{op['name']}.{name}"] = vertices
    check(sorted(cell_of.values()) == sorted([(v,) for v in mesh.vertices] + mesh.edges + mesh.faces),
          "the complex has other cells than the mesh")
    return cell_of


def names_of_assembly(mesh, script):
    """A function from the names in an assembly to cells; what is glued is checked to be the same in the mesh file."""

    def cell_of(name):
        triangle, _, corners = name.partition(".")
        vertices = mesh.triangles[int(triangle[1:])]
        return tuple(vertices[int(i)] for i in corners.split("-")) if corners else vertices

    built = []
    for op in operations(script):
        if op["op"] == "simplex":
            check(op["dim"] == 2, "a simplex that is no triangle")
            built.append(cell_of(op["name"]))
        elif op["op"] == "identify":
            for a, b in op["pairs"]:
                check(cell_of(a) == cell_of(b), f"{a} is glued to {b}, which is another cell of the mesh")
    check(sorted(built) == mesh.faces, "other triangles are built than the mesh has")
    return cell_of


def check_summary(summary, mesh, betti, ring):
    check(summary["ring"] == ring, f"ring {summary['ring']}")
    check(summary["betti"] == betti, f"Betti numbers {summary['betti']} over {ring}, should be {betti}")
    check(not any(summary["torsion"]), f"torsion {summary['torsion']}")
    check(summary["cells"] == mesh.cells(), f"cells {summary['cells']}, the mesh has {mesh.cells()}")
    check(summary["euler"] == alternating_sum(mesh.cells()) == alternating_sum(betti), f"euler {summary['euler']}")


def check_known_mesh(sesame, path, betti, directory):
    """A row of the table: seconds of import, Z with generators, Z/2; assembly, Z with generators."""
    mesh = Mesh(path)
    seconds = []
    script = directory / "script.jsonl"
    for flags, read_names, rings in [([], names_of_complex, ["Z", "Z/2"]),
                                     (["--assemble"], names_of_assembly, ["Z"])]:
        seconds.append(run_well(sesame, "import", path, "-o", script, *flags)[1])
        names = read_names(mesh, script)
        cell_of = names.__getitem__ if isinstance(names, dict) else names
        for ring in rings:
            wanted = ["--generators"] if ring == "Z" else []
            done, time_taken = run_well(sesame, "replay", "--json", "--ring", ring, *wanted, script)
            seconds.append(time_taken)
            summary = last_object(done.stdout)
            check_summary(summary, mesh, betti, ring)
            if wanted:
                check_generators(mesh, cell_of, summary)
    return mesh.cells(), seconds


# ---------------------------------------------------------------------------------------------------------- every mesh


def check_any_mesh(sesame, path, directory):
    """"fine" or "refused", and the seconds of import, replay and mesh."""
    script = directory / "script.jsonl"
    imported, first = run(sesame, "import", path, "-o", script)
    looked_at, third = run(sesame, "mesh", "--json", path)
    for done in (imported, looked_at):
        check(done.returncode in (0, 2), f"status {done.returncode}: {done.stderr.strip()[:300]}")
    check(imported.returncode == looked_at.returncode, "`import` and `mesh` differ about whether the mesh is legal")
    if imported.returncode == 2:
        check(all(path.name in done.stderr for done in (imported, looked_at)), "no message that names the file")
        return "refused", [first, 0, third]
    replayed, second = run_well(sesame, "replay", "--json", script)
    summary = last_object(replayed.stdout)
    check(summary["euler"] == alternating_sum(summary["cells"]) == alternating_sum(summary["betti"]), "Euler")
    answer = json.loads(looked_at.stdout)
    for key in ("betti", "torsion"):
        check(answer[key] == summary[key], f"{key}: `mesh` says {answer[key]}, `replay` says {summary[key]}")
    return "fine", [first, second, third]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sesame", metavar="SESAME")
    parser.add_argument("--archive", metavar="FILE", default=ARCHIVE)
    options = parser.parse_args()
    if not pathlib.Path(options.archive).exists():
        print(f"skipped: there is no {options.archive} (Debian package libcgal-demo)")
        return SKIPPED
    failures = []
    with tempfile.TemporaryDirectory() as temporary:
        directory = pathlib.Path(temporary)
        with tarfile.open(options.archive) as archive:
            members = [m for m in archive if m.isfile() and m.name.startswith(FOLDER) and m.name.endswith(MESHES)]
            archive.extractall(directory, members=members)
        meshes = sorted(directory / m.name for m in members)
        print(f"{'mesh':<20} {'cells':<20} {'Betti':<12} import  over Z over Z/2  import  over Z  "
              " (seconds; as one complex, then assembled)")
        for name, betti in BETTI.items():
            try:
                cells, seconds = check_known_mesh(options.sesame, directory / FOLDER / f"{name}.off", betti, directory)
                print(f"{name:<20} {' '.join(map(str, cells)):<20} {' '.join(map(str, betti)):<12}",
                      " ".join(f"{s:7.2f}" for s in seconds), flush=True)
            except (Wrong, OSError, ValueError, KeyError) as problem:
                failures.append(f"{name}: {problem!r}")
        total, outcomes = [0.0, 0.0, 0.0], {"fine": 0, "refused": 0}
        for path in meshes:
            try:
                outcome, seconds = check_any_mesh(options.sesame, path, directory)
                outcomes[outcome] += 1
                total = [a + b for a, b in zip(total, seconds)]
            except (Wrong, OSError, ValueError, KeyError) as problem:
                failures.append(f"{path.name}: {problem!r}")
        print(f"all {len(meshes)} meshes: {outcomes['fine']} fine, {outcomes['refused']} refused with a message;"
              " seconds of import {:.1f}, replay {:.1f}, mesh {:.1f}".format(*total))
        if not meshes:
            failures.append("the archive holds no meshes")
    for failure in failures:
        print("FAILED", failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
