#!/usr/bin/env python3
"""Compares the homology of simplicial complexes with what independent programs say.

    other_programs_test.py SESAME [--seed N] [--count M] [--gap GAP] [--python PYTHON]

GAP's package HAP (Debian: gap-hap) gives the integral homology, GUDHI (Debian: python3-gudhi, for the system's Python)
the Betti numbers over Z/2, Z/3 and Z/11. The complexes: small known surfaces, Moore spaces, suspensions and wedges of
these, complexes of random group presentations and their suspensions, random complexes, and random acyclic complexes
after Kalai (all faces up to one dimension, and of the next as many as can be had without a rational cycle). Each other
program runs once for all.

Exit status: 0 nothing differs, 1 something does, 77 neither program is there. What differs is printed as facets.
"""

import argparse
import itertools
import json
import os
import random
import re
import subprocess
import sys
import tempfile

SKIPPED = 77
PRIMES = [2, 3, 11]

PROJECTIVE_PLANE = [(1, 2, 3), (1, 2, 4), (1, 3, 5), (1, 4, 6), (1, 5, 6), (2, 3, 6), (2, 4, 5), (2, 5, 6), (3, 4, 5),
                    (3, 4, 6)]
TORUS = [tuple(sorted(((i + a) % 7 + 1, (i + b) % 7 + 1, i + 1))) for i in range(7) for a, b in [(1, 3), (2, 3)]]
KLEIN_BOTTLE = [(1, 2, 4), (1, 2, 5), (1, 3, 4), (1, 3, 8), (1, 5, 6), (1, 6, 8), (2, 3, 7), (2, 3, 8), (2, 4, 6),
                (2, 5, 8), (2, 6, 7), (3, 4, 6), (3, 5, 6), (3, 5, 7), (5, 7, 8), (6, 7, 8)]


# ------------------------------------------------------------------------------------------------------ the complexes


def shifted(facets, by):
    return [tuple(v + by for v in facet) for facet in facets]


def largest(facets):
    return max(v for facet in facets for v in facet)


def suspension(facets):
    north = largest(facets) + 1
    return [facet + (pole,) for facet in facets for pole in (north, north + 1)]


def wedge(left, right):
    """The last vertex of one becomes the first of the other."""
    return left + shifted(right, largest(left) - 1)


def side_by_side(left, right):
    return left + shifted(right, largest(left))


def presentation_complex(words):
    """Circles 1, 2, ... of three edges in a wedge, and a disc for each word of non-zero integers: letter g runs through
    circle g, -g backwards. H_1 has the circles as generators and the words as relations."""
    circles = max(abs(letter) for word in words for letter in word)
    facets = []
    for g in range(1, circles + 1):
        facets += [(1, 2 * g), (2 * g, 2 * g + 1), (1, 2 * g + 1)]
    for word in words:
        rim = [1]
        for letter in word:
            path = [2 * abs(letter), 2 * abs(letter) + 1]
            rim += (path if letter > 0 else path[::-1]) + [1]
        first = largest(facets) + 1
        ring = [*range(first, first + len(rim) - 1), first]
        for i in range(len(rim) - 1):
            facets += [(rim[i], rim[i + 1], ring[i]), (rim[i + 1], ring[i], ring[i + 1]),
                       (ring[i], ring[i + 1], first + len(rim))]
    return [tuple(sorted(facet)) for facet in facets]


def moore_space(n):
    """H_1 = Z/n."""
    return presentation_complex([[1] * n])


def random_presentation(rng):
    letters = range(1, rng.randint(1, 4) + 1)
    words = []
    divisor = rng.randint(1, 4)  # of every exponent, or most groups would have no torsion
    for _ in range(rng.randint(1, 4)):
        words.append([])
        for letter in letters:
            words[-1] += [letter * rng.choice([1, -1])] * (divisor * rng.randint(0, 3))
        words[-1] = words[-1] or [letters[0]]
        rng.shuffle(words[-1])
    return words


def random_facets(rng, dimension):
    vertices = range(1, rng.randint(dimension + 2, 11) + 1)
    facets = [tuple(sorted(rng.sample(vertices, rng.randint(2, dimension + 1)))) for _ in range(rng.randint(3, 40))]
    return facets + [tuple(sorted(rng.sample(vertices, dimension + 1)))]


def random_dense_facets(rng, dimension):
    """All faces up to a dimension and some of the next."""
    vertices = range(1, rng.randint(dimension + 3, 9) + 1)
    tops = list(itertools.combinations(vertices, dimension + 1))
    return (list(itertools.combinations(vertices, dimension))
            + rng.sample(tops, rng.randint(len(tops) // 4, len(tops) * 3 // 4)))


def random_acyclic_facets(rng, dimension, points):
    """Facets in random order, each taken when its boundary is rationally independent of the boundaries before."""
    prime = 2**31 - 1  # rank modulo a prime: never more than the rational one, so no rational cycle comes in
    vertices = range(1, points + 1)
    tops = list(itertools.combinations(vertices, dimension + 1))
    rng.shuffle(tops)
    by_pivot = {}
    taken = []
    for top in tops:
        column = {top[:i] + top[i + 1:]: 1 if i % 2 == 0 else prime - 1 for i in range(dimension + 1)}
        while column:
            pivot = max(column)
            if pivot not in by_pivot:
                scale = pow(column[pivot], -1, prime)
                by_pivot[pivot] = {face: value * scale % prime for face, value in column.items()}
                taken.append(top)
                break
            factor = column[pivot]
            for face, value in by_pivot[pivot].items():
                rest = (column.get(face, 0) - factor * value) % prime
                if rest:
                    column[face] = rest
                else:
                    column.pop(face, None)
    return list(itertools.combinations(vertices, dimension)) + taken


def complexes(seed, count):
    """(what it is, facets) of everything that is compared."""
    yield "projective plane, 6 vertices", PROJECTIVE_PLANE
    yield "torus, 7 vertices", TORUS
    yield "Klein bottle, 8 vertices", KLEIN_BOTTLE
    yield "a point", [(1,)]
    yield "a full simplex", [(1, 2, 3, 4, 5)]
    yield "a sphere of dimension 3", list(itertools.combinations(range(1, 6), 4))
    for n in (2, 3, 4, 6, 11, 12):
        yield f"Moore space of Z/{n}", moore_space(n)
    for n in (3, 4):
        yield f"suspended Moore space of Z/{n}", suspension(moore_space(n))
    yield "Moore spaces of Z/4 and Z/6 in a wedge", wedge(moore_space(4), moore_space(6))
    yield "Klein bottle beside a torus", side_by_side(KLEIN_BOTTLE, TORUS)
    yield "projective plane and its suspension", wedge(suspension(PROJECTIVE_PLANE), PROJECTIVE_PLANE)
    yield "three suspensions of the projective plane", suspension(suspension(suspension(PROJECTIVE_PLANE)))
    rng = random.Random(seed)
    for k in range(count):
        yield f"random {k}", random_facets(rng, rng.randint(1, 4))
        yield f"random and dense {k}", random_dense_facets(rng, rng.randint(2, 3))
        words = random_presentation(rng)
        yield f"presentation {words}", presentation_complex(words)
        yield f"suspended presentation {words}", suspension(presentation_complex(words))
        yield f"random and acyclic, dimension 2, {k}", random_acyclic_facets(rng, 2, rng.randint(8, 18))
        yield f"random and acyclic, dimension 3, {k}", random_acyclic_facets(rng, 3, rng.randint(7, 10))


def dimension_of(facets):
    return max(len(facet) for facet in facets) - 1


# -------------------------------------------------------------------------------------------------------- the programs


def script_of(facets, rng):
    """A script of one `complex`, with the cells listed in random order."""
    cells = {face for facet in facets for n in range(1, len(facet) + 1) for face in itertools.combinations(facet, n)}
    name = "-".join
    listed = []
    for cell in sorted(cells):
        words = [str(v) for v in cell]
        faces = [name(words[:i] + words[i + 1:]) for i in range(len(words))] if len(words) > 1 else []
        listed.append({"id": name(words), "faces": faces} if faces else {"id": name(words)})
    rng.shuffle(listed)
    return '{"sesame":1}\n' + json.dumps({"op": "complex", "name": "K", "cells": listed}) + "\n"


def ask_sesame(sesame, facets, ring, rng):
    done = subprocess.run([sesame, "replay", "--json", "--ring", ring, "-"], input=script_of(facets, rng), text=True,
                          capture_output=True, timeout=300, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"sesame: status {done.returncode}, {done.stderr.strip()}")
    return json.loads(done.stdout.splitlines()[-1])


def ask_hap(gap, batch):
    """For each complex its homology, degree by degree, as a list of orders (0: free). None when HAP is not there.

    HAP 1.47 breaks down on a complex without edges, so it is not asked about those: an empty answer.
    """
    lines = ['SetPrintFormattingStatus("*stdout*", false);;', 'SetInfoLevel(InfoWarning, 0);;',
             'if LoadPackage("HAP") = fail then Print("no HAP\\n"); QUIT_GAP(0); fi;;']
    asked = {number: dimension_of(facets) for number, facets in enumerate(batch) if dimension_of(facets) > 0}
    for number, dimension in asked.items():
        lines.append(f"K := SimplicialComplex({json.dumps(batch[number])});;")
        for n in range(dimension + 1):
            lines.append(f'Print("answer {number} {n} ", Homology(K, {n}), "\\n");')
    with tempfile.TemporaryDirectory() as directory:
        program = os.path.join(directory, "batch.g")
        with open(program, "w", encoding="ascii") as out:
            out.write("\n".join(lines + ["QUIT;", ""]))
        try:
            done = subprocess.run([gap, "-q", "-x", "4096", program], stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, timeout=1200, check=False)
        except FileNotFoundError:
            return None
    if "no HAP" in done.stdout:
        return None
    answers = [[] for _ in batch]
    for number, n, orders in re.findall(r"^answer (\d+) (\d+) \[([\d, ]*)\]$", done.stdout, re.MULTILINE):
        if len(answers[int(number)]) != int(n):
            raise RuntimeError("GAP: answers out of order")
        answers[int(number)].append([int(order) for order in orders.split(",") if order.strip()])
    if any(len(answers[number]) != dimension + 1 for number, dimension in asked.items()):
        raise RuntimeError(f"GAP did not answer everything:\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
    return answers


GUDHI = """
import json, sys
try:
    import gudhi
except ImportError:
    print("null")
    sys.exit()
primes, batch = json.load(sys.stdin)
answers = []
for facets in batch:
    tree = gudhi.SimplexTree()
    for facet in facets:
        tree.insert(facet)
    answer = {}
    for p in primes:
        tree.compute_persistence(homology_coeff_field=p, persistence_dim_max=True)
        answer[p] = tree.persistent_betti_numbers(0, 1)
    answers.append(answer)
print(json.dumps(answers))
"""


def ask_gudhi(python, batch):
    """For each complex its Betti numbers over each prime, {"2": [...], ...}. None when GUDHI is not there."""
    try:
        done = subprocess.run([python, "-c", GUDHI], input=json.dumps([PRIMES, batch]), capture_output=True, text=True,
                              timeout=600, check=False)
    except FileNotFoundError:
        return None
    if done.returncode != 0:
        raise RuntimeError(f"GUDHI: status {done.returncode}, {done.stderr.strip()[-1000:]}")
    return json.loads(done.stdout)


# ------------------------------------------------------------------------------------------------------ the comparison


def primary(orders):
    """The orders of the cyclic groups of prime power order whose sum a group is; 0 for each Z."""
    parts = []
    for order in orders:
        if order == 0:
            parts.append(0)
        p = 2
        while order > 1:
            power = 1
            while order % p == 0:
                order //= p
                power *= p
            if power > 1:
                parts.append(power)
            p += 1
    return sorted(parts)


def without_trailing_zeros(numbers):
    end = len(numbers)
    while end and numbers[end - 1] == 0:
        end -= 1
    return list(numbers[:end])


def groups_of(summary):
    """As HAP writes them, and a complaint when the invariant factors are no divisor chain."""
    groups = []
    for rank, factors in zip(summary["betti"], summary["torsion"]):
        factors = [int(t) for t in factors]
        if any(t < 2 for t in factors) or any(b % a for a, b in zip(factors, factors[1:])):
            raise RuntimeError(f"sesame: {factors} is no chain of divisors")
        groups.append([0] * rank + factors)
    return groups


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sesame", metavar="SESAME")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=25, help="random complexes of each kind")
    parser.add_argument("--gap", default="gap")
    parser.add_argument("--python", default="/usr/bin/python3", help="a Python that has gudhi")
    options = parser.parse_args()
    named = list(complexes(options.seed, options.count))
    batch = [facets for _, facets in named]
    hap, gudhi = ask_hap(options.gap, batch), ask_gudhi(options.python, batch)
    for program, answers in [("GAP with HAP", hap), ("GUDHI", gudhi)]:
        print(f"{program}: {'not installed' if answers is None else f'{len(answers)} complexes'}")
    if hap is None and gudhi is None:
        return SKIPPED
    rng = random.Random(options.seed)
    compared = different = with_torsion = 0
    largest_order = 1

    def compare(program, name, facets, ring, ours, theirs):
        nonlocal compared, different
        compared += 1
        if ours != theirs:
            different += 1
            print(f"DIFFERENT {name} over {ring}: sesame says {ours}, {program} says {theirs}; facets {facets}")

    for number, (name, facets) in enumerate(named):
        integral = groups_of(ask_sesame(options.sesame, facets, "Z", rng))
        orders = [order for group in integral for order in group if order > 1]
        with_torsion += 1 if orders else 0
        largest_order = max([largest_order, *orders])
        if hap is not None and hap[number]:
            compare("HAP", name, facets, "Z", [primary(g) for g in integral], [primary(g) for g in hap[number]])
        for p in PRIMES if gudhi is not None else []:
            ours = ask_sesame(options.sesame, facets, f"Z/{p}", rng)["betti"]
            compare("GUDHI", name, facets, f"Z/{p}", without_trailing_zeros(ours),
                    without_trailing_zeros(gudhi[number][str(p)]))
    print(f"{len(named)} complexes, {with_torsion} with torsion (largest order {largest_order}): {compared} compared,"
          f" {different} different")
    return 1 if different or not compared else 0


if __name__ == "__main__":
    sys.exit(main())
