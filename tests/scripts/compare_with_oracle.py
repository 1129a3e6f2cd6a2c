#!/usr/bin/env python3
"""Compares `sesame replay` with the oracle, step by step, over Z, Z/2 and Z/3.

    compare_with_oracle.py SESAME SCRIPT...
    compare_with_oracle.py SESAME --random COUNT [--seed N] [--steps M] [--ops basic|all|tear|nest|abstract|maps|boundaries]

Every reported step (cells, Euler characteristic, Betti numbers, torsion, class), the exit status, the line that an
error names and the summary must agree. A chain that a class is said to bound and, with --generators, the
generators of the summary are checked by what they claim: boundaries are taken by the oracle. Over another ring than the
script's own, its expects are replaced by notes (undo counts both).
Of the random scripts every fifth ends with an illegal step. With --verify the program checks its own laws as well.
Prints `N passed, N failed`; the exit status is 0 only if something was compared and nothing differed.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import oracle
import random_script

RINGS = ["Z", "Z/2", "Z/3"]
COMPARED = ["step", "op", "cells", "euler", "betti", "torsion"]


class Difference(Exception):
    """Where the program and the oracle part."""


def without_expects(data):
    """The same script with notes in place of its expects."""
    lines = []
    for raw in data.split(b"\n"):
        if raw.strip() and not raw.startswith(b"#"):
            try:
                value = json.loads(raw)
                if isinstance(value, dict) and value.get("op") == "expect":
                    raw = b'{"op":"note","text":"an expect for another ring"}'
            except ValueError:
                pass
        lines.append(raw)
    return b"\n".join(lines)


def own_ring(data):
    for _, value in oracle.read_objects(data):
        return value.get("ring", "Z") if isinstance(value, dict) else "Z"
    return "Z"


def run_program(program, path, ring, extra):
    command = [program, "replay", "--json", "--every", "1", "--ring", ring, *extra, path]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=120, check=False)
    if done.returncode not in (0, 2, 3):
        raise Difference(f"exit status {done.returncode}: {done.stderr.decode(errors='replace').strip()[-500:]}")
    objects = []
    for line in done.stdout.decode("utf-8").splitlines():
        try:
            value = json.loads(line)
        except ValueError:
            value = None
        if not isinstance(value, dict):
            raise Difference(f"standard output has a line that is no JSON object: {line[:200]}")
        objects.append(value)
    return done.returncode, objects, done.stderr.decode("utf-8", errors="replace")


def has_unknown(state, chain):
    """Whether a chain has generators of cells that are no balls: of these the program has others than the oracle."""
    return any(isinstance(name, str) and ("~" in name or state.is_hollow(state.find(name))) for _, name in chain)


def read_answer(state, chain, prime, what):
    """A chain of the program's output: canonical names of living cells, each once, no zero coefficient."""
    try:
        read = oracle.read_chain(state, chain, prime)
        cells = [state.find(name) for _, name in chain]
    except oracle.ScriptError as problem:
        raise Difference(f"{what}: {problem}") from None
    for (_, name), cell in zip(chain, cells):
        canonical = state.cells[cell].name
        if canonical != name:
            raise Difference(f'{what}: the cell "{name}" should be called "{canonical}"')
    if len(read) != len(chain):
        raise Difference(f"{what}: repeated cells or zero coefficients in {json.dumps(chain)[:300]}")
    return read


def plain(value):
    """The same JSON value with integers written as strings of digits (beyond 64 bits) as integers."""
    if isinstance(value, list):
        return [plain(item) for item in value]
    return oracle.integer(value, "a number") if isinstance(value, str) and value.removeprefix("-").isdigit() else value


def reduced(chain, prime):
    chain = {c: (v % prime if prime else v) for c, v in chain.items()}
    return {c: v for c, v in chain.items() if v}


def check_class(state, step, expected, answer, prime):
    if not isinstance(answer, dict) or answer.get("cycle") != expected["cycle"]:
        raise Difference(f"class is {json.dumps(answer)}, the oracle says {json.dumps(expected)}")
    if not expected["cycle"]:
        return
    if answer.get("zero") != expected["zero"]:
        raise Difference(f"class is {json.dumps(answer)}, the oracle says {json.dumps(expected)}")
    bounds = answer.get("bounds")
    if (bounds is not None) != expected["zero"]:
        raise Difference(f"class is {json.dumps(answer)}: a chain that it bounds belongs to class zero, and to it only")
    if bounds is not None and not has_unknown(state, bounds):
        witness = read_answer(state, bounds, prime, "bounds")
        chain = oracle.read_chain(state, step["chain"], prime)
        if oracle.boundary_of_chain(state, witness, prime) != chain:
            raise Difference(f"the boundary of bounds is not the chain: {json.dumps(answer)[:300]}")


def check_generators(state, found, generators, prime):
    """Cycles, of the stated orders, as many as the groups have, and all of homology is made of them.

    Such a family maps onto a group that it is abstractly isomorphic to, so it is a basis. It spans iff chains modulo
    boundaries and generators are free of the rank of the differential.
    """
    lists, factors = oracle.chain_rank_data(state, prime)
    for dim in range(len(lists)):
        mine = [g for g in generators if g["dim"] == dim]
        orders = sorted(plain(g["order"]) for g in mine)
        if orders != sorted([0] * found["betti"][dim] + found["torsion"][dim]):
            raise Difference(f"generators of dimension {dim} have the orders {orders}")
        if any(has_unknown(state, g["chain"]) for g in mine):
            continue
        above = [state.boundary(c) for c in lists[dim + 1]] if dim + 1 < len(lists) else []
        chains = []
        for g in mine:
            chain = read_answer(state, g["chain"], prime, f"generator of dimension {dim}")
            if any(state.dim(c) != dim for c in chain):
                raise Difference(f"a generator of dimension {dim} has cells of another")
            if oracle.boundary_of_chain(state, chain, prime):
                raise Difference(f"a generator of dimension {dim} is not a cycle")
            multiple = reduced({c: plain(g["order"]) * v for c, v in chain.items()}, prime)
            if not oracle.is_boundary(state, multiple, prime):
                raise Difference(f"a generator of dimension {dim} is not of order {g['order']}")
            chains.append(chain)
        spanned = oracle.invariant_factors(above + chains, prime)
        if spanned != [1] * (len(lists[dim]) - len(factors[dim])):
            raise Difference(f"the generators of dimension {dim} do not generate")


def compare(program, data, ring, extra=()):
    """Raises Difference at the first thing on which the two disagree; returns the number of steps compared.

    extra: options for the program, of --generators and --verify.
    """
    if ring != own_ring(data):
        data = without_expects(data)
    prime = oracle.parse_ring(ring)
    handle, path = tempfile.mkstemp(suffix=".jsonl")
    try:
        with os.fdopen(handle, "wb") as script:
            script.write(data)
        status, objects, messages = run_program(program, path, ring, extra)
    finally:
        os.unlink(path)
    reports = [o for o in objects if not o.get("summary")]
    position = 0
    oracle_run = None
    expected_status, expected_line = 0, 0
    try:
        for expected_line, value in oracle.read_objects(data):
            if oracle_run is None:
                oracle.read_header(value)
                oracle_run = oracle.Oracle(prime)
                continue
            if isinstance(value, oracle.ScriptError):
                raise value
            expected = oracle_run.apply(value)
            if position == len(reports):
                raise Difference(f"no report of step {expected['step']}; exit status {status}: {messages[-300:]}")
            compare_step(oracle_run.state, value, expected, reports[position], prime)
            position += 1
        if oracle_run is None:
            expected_status = 2
    except oracle.ScriptError:
        expected_status = 2
    except oracle.ExpectFailed:
        expected_status = 3
    if status != expected_status:
        raise Difference(f"exit status {status}, the oracle's is {expected_status} (line {expected_line})")
    # A failed expect changes nothing, so it may be reported or not.
    if len(reports) - position > (1 if status == 3 else 0):
        raise Difference(f"{len(reports)} steps were reported, {position} were done")
    if status and f"{path}:{expected_line}:" not in messages:
        raise Difference(f'standard error does not name line {expected_line}: "{messages.strip()[-300:]}"')
    if status == 0:
        check_summary(oracle_run, objects, prime, "--generators" in extra)
    return position


def compare_step(state, step, expected, report, prime):
    for key in COMPARED:
        found = report.get(key)
        if (plain(found) if key == "torsion" else found) != expected[key]:
            raise Difference(f"step {expected['step']} ({expected['op']}): {key} is {json.dumps(found)}, "
                             f"the oracle says {json.dumps(expected[key])}")
    if ("class" in expected) != ("class" in report):
        raise Difference(f"step {expected['step']} ({expected['op']}): only class steps report a class")
    if "class" in expected:
        try:
            check_class(state, step, expected["class"], report["class"], prime)
        except Difference as problem:
            raise Difference(f"step {expected['step']}: {problem}") from None


def check_summary(oracle_run, objects, prime, generators):
    if not objects or objects[-1].get("summary") is not True:
        raise Difference("the last object is not the summary")
    found = oracle.summary(oracle_run.state, prime)
    for key, value in [("steps", oracle_run.steps), *found.items()]:
        if plain(objects[-1].get(key)) != value:
            seen = json.dumps(objects[-1].get(key))
            raise Difference(f"summary: {key} is {seen}, the oracle says {json.dumps(value)}")
    if generators:
        check_generators(oracle_run.state, found, objects[-1].get("generators", []), prime)


def cases(options):
    """(label, bytes) of every script to compare."""
    for path in options.scripts:
        with open(path, "rb") as script:
            yield path, script.read()
    for number in range(options.random or 0):
        seed = options.seed + number
        illegal = number % 5 == 4
        text = random_script.write_script(seed, options.steps, illegal=illegal, operations=options.ops)
        flag = (f" --ops {options.ops}" if options.ops != "basic" else "") + (" --illegal" if illegal else "")
        yield f"random_script.py --seed {seed} --steps {options.steps}{flag}", text.encode("utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="SESAME")
    parser.add_argument("scripts", nargs="*", metavar="SCRIPT")
    parser.add_argument("--random", type=int, metavar="COUNT")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--ops", choices=random_script.WRITERS, default="basic")
    parser.add_argument("--lazy-cones", action="store_true", help="no cone over whole bodies is written out")
    parser.add_argument("--verify", action="store_true", help="the program checks every law after every step; slow")
    parser.add_argument("--generators", action="store_true", help="ask for generators and check them")
    options = parser.parse_args()
    extra = [f"--{name}" for name in ("generators", "verify") if getattr(options, name)]
    if options.lazy_cones:
        extra.append("--explicit-cones=0")
    passed = failed = 0
    for label, data in cases(options):
        for ring in RINGS:
            try:
                compare(options.program, data, ring, extra)
                passed += 1
            except (Difference, OSError, UnicodeDecodeError, subprocess.TimeoutExpired) as problem:
                failed += 1
                print(f"FAILED {label} over {ring}: {problem}")
    print(f"{passed} passed, {failed} failed")
    return 0 if passed and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
