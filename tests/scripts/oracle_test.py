#!/usr/bin/env python3
"""Tests of the oracle and of what stands on it: random scripts, the comparison's checks, the shipped examples."""

import collections
import glob
import itertools
import json
import math
import os
import random
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
import compare_with_oracle
import gmaps
import oracle
import random_script
import split_plans

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "..", "replay", "examples")


def determinant(matrix):
    if not matrix:
        return 1
    return sum((-1) ** k * row[0] * determinant([r[1:] for i, r in enumerate(matrix) if i != k])
               for k, row in enumerate(matrix) if row[0])


def factors_by_minors(matrix):
    """Invariant factors as quotients of the greatest common divisors of all minors."""
    divisors = [1]
    for size in range(1, min(len(matrix), len(matrix[0])) + 1):
        g = 0
        for rows in itertools.combinations(matrix, size):
            for columns in itertools.combinations(range(len(matrix[0])), size):
                g = math.gcd(g, determinant([[row[c] for c in columns] for row in rows]))
        if g == 0:
            break
        divisors.append(g)
    return [b // a for a, b in zip(divisors, divisors[1:])]


def replayed(*steps, header='{"sesame":1}'):
    return oracle.replay("\n".join([header, *steps]).encode("utf-8"), "script")


KLEIN = ('{"op":"simploid","name":"q","type":[1,1]}',
         '{"op":"identify","pairs":[["q.0-1x0","q.1x0-1"],["q.0x0-1","q.0-1x1"]]}')


TORUS = (KLEIN[0], '{"op":"identify","pairs":[["q.0x0-1","q.1x0-1"],["q.0-1x0","q.0-1x1"]]}')


def run(*steps):
    """An oracle after these steps, given as dictionaries without "op": op and fields."""
    twin = oracle.Oracle()
    for op, details in steps:
        twin.apply({"op": op, **details})
    return twin


def found(twin):
    """(cells, betti, torsion), without zeros at the end."""
    numbers = oracle.summary(twin.state, 0)
    return tuple(oracle.trimmed(numbers[key], [] if key == "torsion" else 0) for key in ("cells", "betti", "torsion"))


def simplex(name, dim):
    return "simplex", {"name": name, "dim": dim}


def glue(*pairs):
    return "identify", {"pairs": [list(pair) for pair in pairs]}


def squash(cell, along):
    return "degenerate", {"cell": cell, "along": along}


def projective_plane(name):
    """One triangle: the edge from 0 to 2 is squashed, the other two are one."""
    return [simplex(name, 2), squash(f"{name}.0-2", 0), glue((f"{name}.0-1", f"{name}.1-2"))]


def product(left, right, kind, name="P"):
    return "product", {"name": name, "left": left, "right": right, "kind": kind}


def cyclic(group):
    """(rank, [orders]) of one dimension as the list of the orders of its cyclic summands, 0 for Z."""
    return [0] * group[0] + group[1]


def kunneth(left, right):
    """Betti numbers and torsion of a product, from (betti, torsion) of its factors."""
    top = len(left[0]) + len(right[0])
    orders = [[] for _ in range(top)]
    for p, first in enumerate(zip(*left)):
        for q, second in enumerate(zip(*right)):
            for a in cyclic(first):
                for b in cyclic(second):
                    orders[p + q].append(math.gcd(a, b))
                    if a and b:
                        orders[p + q + 1].append(math.gcd(a, b))
    torsion = [[d for d in oracle.divisibility_chain([n for n in group if n]) if d > 1] for group in orders]
    return without_zeros([group.count(0) for group in orders], torsion)


def without_zeros(betti, torsion):
    """The same groups, without those at the end that are 0."""
    return oracle.trimmed(betti, 0), oracle.trimmed(torsion, [])


def homology_of(state, cells):
    """(betti, torsion) of a subcomplex."""
    alone = state.copy()
    alone.cells = {c: alone.cells[c] for c in cells}
    numbers = oracle.summary(alone, 0)
    return numbers["betti"], numbers["torsion"]


def oracle_report(report):
    return {key: report[key] for key in ("cells", "euler", "betti", "torsion")}


def all_values(state, largest):
    """Every cell with at most `largest` directions, degenerate ones included."""
    layer = {state.plain(c) for c in state.alive() if state.dim(c) <= largest}
    found_values = set()
    while layer:
        found_values |= layer
        layer = {higher for value in layer if sum(oracle.type_of(value[1])) < largest for higher in degeneracies(value)}
    return found_values


def degeneracies(value):
    shape = value[1]
    for i in range(len(shape) + 1):
        yield oracle.collapse(value, i, 0, True)
    for i, part in enumerate(shape):
        for j in range(len(part)):
            yield oracle.collapse(value, i, j, False)


def naive_quotient(state, equations, largest):
    """Classes of all values: a union-find that knows nothing of normal forms. Returns {value: class}."""
    parent = {value: value for value in all_values(state, largest)}

    def root(value):
        while parent[value] != value:
            value = parent[value]
        return value

    pending = list(equations)
    while pending:
        left, right = pending.pop()
        if root(left) == root(right):
            continue
        parent[root(left)] = root(right)
        pending += [(state.face(left, i, j), state.face(right, i, j))
                    for i, j in oracle.face_slots(oracle.type_of(left[1]))]
        if sum(oracle.type_of(left[1])) < largest:
            pending += zip(degeneracies(left), degeneracies(right))
    return {value: root(value) for value in parent}


class OracleTest(unittest.TestCase):
    def test_invariant_factors_are_quotients_of_the_divisors_of_minors(self):
        source = random.Random(7)
        for _ in range(150):
            height, width = source.randint(1, 4), source.randint(1, 4)
            matrix = [[source.choice([0, 0, 1, -1, 2, -2, 3, 6]) for _ in range(width)] for _ in range(height)]
            found = oracle.invariant_factors([dict(enumerate(row)) for row in matrix])
            self.assertEqual(found, factors_by_minors(matrix), matrix)
            modulo = oracle.invariant_factors([dict(enumerate(row)) for row in matrix], 3)
            self.assertEqual(len(modulo), sum(1 for f in found if f % 3), matrix)

    def test_every_boundary_of_a_boundary_is_zero(self):
        for kind in ((3,), (1, 1, 1), (2, 1), (1, 2, 1), (2, 2)):
            state = oracle.State()
            oracle.add_simploid(state, "q", kind)
            self.assertIsNone(state.broken_law())
            for c in state.alive():
                self.assertEqual(oracle.boundary_of_chain(state, state.boundary(c), 0), {})

    def test_random_scripts_are_legal_and_random_wrong_ones_fail_in_the_last_line(self):
        for operations, seed in [*(("basic", n) for n in range(25)), *(("all", n) for n in range(12)),
                                 *(("maps", n) for n in range(6))]:
            text = random_script.write_script(seed, 30, operations=operations)
            self.assertEqual(oracle.replay(text.encode(), "script")[0], 0)
            wrong = random_script.write_script(seed, 30, illegal=True, operations=operations)
            status, message, _ = oracle.replay(wrong.encode(), "script")
            self.assertEqual(status, 2)
            self.assertTrue(message.startswith(f"script:{wrong.count(chr(10))}: "), message)

    def test_a_failed_expect_has_its_own_exit_status(self):
        status, message, _ = replayed(*KLEIN, '{"op":"expect","betti":[1,2,1]}')
        self.assertEqual((status, message[:9]), (3, "script:4:"))

    def test_a_refused_step_changes_nothing(self):
        status, _, run = replayed(*KLEIN, '{"op":"identify","pairs":[["q.0-1x0","q.0x0-1"],["q","q.0x0"]]}')
        self.assertEqual(status, 2)
        self.assertEqual(oracle.summary(run.state, 0)["cells"], [1, 2, 1])

    def test_generators_are_checked_by_what_they_claim(self):
        run = replayed(*KLEIN)[2]
        found = oracle.summary(run.state, 0)
        point = {"dim": 0, "order": 0, "chain": [[1, "q.0x0"]]}
        free = {"dim": 1, "order": 0, "chain": [[1, "q.0x0-1"]]}
        torsion = {"dim": 1, "order": 2, "chain": [[1, "q.0x0-1"], [-1, "q.0-1x0"]]}
        compare_with_oracle.check_generators(run.state, found, [point, free, torsion], 0)
        doubled = {"dim": 1, "order": 0, "chain": [[2, "q.0x0-1"]]}
        mislabelled = {"dim": 1, "order": 2, "chain": [[1, "q.0-1x0"]]}
        alias = {"dim": 1, "order": 0, "chain": [[1, "q.0-1x1"]]}
        for bad in ([point, doubled, torsion], [point, free, mislabelled], [point, free], [point, alias, torsion]):
            with self.assertRaises(compare_with_oracle.Difference):
                compare_with_oracle.check_generators(run.state, found, bad, 0)

    def test_every_shipped_example_meets_its_expects(self):
        paths = sorted(glob.glob(os.path.join(EXAMPLES, "*.jsonl")))
        self.assertGreater(len(paths), 20)
        for path in paths:
            with open(path, "rb") as script:
                data = script.read()
            self.assertIn(b'"op":"expect"', data, path)
            self.assertEqual(oracle.replay(data, path)[:2], (0, ""))

    def test_the_menger_example_is_what_its_generator_prints(self):
        command = [sys.executable, os.path.join(HERE, "make_menger.py")]
        printed = subprocess.run(command, capture_output=True, check=True)
        with open(os.path.join(EXAMPLES, "menger_sponge.jsonl"), "rb") as script:
            self.assertEqual(printed.stdout, script.read())


class OperationsTest(unittest.TestCase):
    def test_the_two_products_of_two_edges_are_a_square_and_two_triangles(self):
        edges = [simplex("e", 1), simplex("f", 1)]
        self.assertEqual(found(run(*edges, product("e", "f", "simploidal"))), ([4, 4, 1], [1], []))
        twin = run(*edges, product("e", "f", "simplicial"))
        self.assertEqual(found(twin), ([4, 5, 2], [1], []))
        state = twin.state
        for triangle, names in (("P.(e^0|f^1)", ["P.(e|f.1^0)", "P.(e|f)", "P.(e.0^0|f)"]),
                                ("P.(e^1|f^0)", ["P.(e.1^0|f)", "P.(e|f)", "P.(e|f.0^0)"])):
            self.assertEqual([state.cells[c].name for c, _ in state.faces(state.find(triangle))], names)

    def test_a_product_of_projective_planes_has_the_torsion_of_kunneth(self):
        expected = ([1], [[], [2, 2], [2], [2]])
        for kind in ("simploidal", "simplicial"):
            planes = projective_plane("a") + projective_plane("b")
            self.assertEqual(found(run(*planes, product("a", "b", kind)))[1:], expected)
            self.assertEqual(found(run(*projective_plane("a"), product("a", "a", kind)))[1:], expected)

    def test_both_products_of_random_bodies_are_what_kunneth_says(self):
        compared = 0
        for seed in range(60):
            writer = random_script.WriterOfAll(seed, "Z")
            writer.weights = {**writer.weights, "simploid": 0, "product": 0, "cone": 1}
            writer.write(15)
            state = writer.oracle.state
            pair = writer.random.choices(writer.usable_bodies(), k=2)
            sides = [state.cells_of_body(state.find_body(name)) for name in pair]
            if len(sides[0]) * len(sides[1]) > 100:
                continue
            simplices = all(len(state.cells[c].kind) <= 1 for side in sides for c in side)
            simplices = simplices and state.disordered.isdisjoint(map(state.find_body, pair))
            expected = kunneth(*(homology_of(state, side) for side in sides))
            for kind in ("simploidal", "simplicial")[: 2 if simplices else 1]:
                after = state.copy()
                oracle.op_product(after, {"op": "product", "name": "new", "left": pair[0], "right": pair[1],
                                          "kind": kind}, 0)
                self.assertIsNone(after.broken_law())
                found_groups = homology_of(after, after.cells_of_body(after.find_body("new")))
                self.assertEqual(without_zeros(*found_groups), expected, seed)
                compared += 1
        self.assertGreater(compared, 30)

    def test_a_product_takes_any_name_of_a_cell_and_uses_its_factors_up(self):
        twin = run(simplex("e", 1), simplex("f", 1), glue(("e.0", "e.1")), product("e", "f", "simploidal"))
        state = twin.state
        self.assertEqual(state.find("P.(e.1|f)"), state.find("P.(e.0|f)"))
        self.assertEqual(state.cells[state.find("P.(e.1|f)")].name, "P.(e.0|f)")
        for step in (("class", {"chain": [[1, "e"]]}), simplex("e", 0), ("cone", {"apex": "v", "over": "e"}),
                     product("f", "P", "simploidal", "Q")):
            with self.assertRaises(oracle.ScriptError):
                twin.apply({"op": step[0], **step[1]})
        twin.apply({"op": "undo"})
        twin.apply({"op": "cone", "apex": "v", "over": "e"})

    def test_a_cone_over_a_square_is_a_pyramid(self):
        twin = run(("simploid", {"name": "q", "type": [1, 1]}), ("cone", {"apex": "v"}))
        self.assertEqual(found(twin), ([5, 8, 5, 1], [1], []))
        state = twin.state
        self.assertEqual(state.cells[state.find("v*q")].kind, (1, 1, 1))
        ends = ((state.find("v"), ((0, 0), (0, 0))), state.plain(state.find("q")))
        self.assertEqual(state.faces(state.find("v*q"))[4:], ends)
        self.assertIsNone(state.broken_law())

    def test_the_chain_of_a_cone_is_the_cone_of_the_chain(self):
        for base in ([simplex("q", 2), squash("q.0-1", 0)], [("simploid", {"name": "q", "type": [2, 1]}),
                                                               squash("q.0-1x0", 0)]):
            state = run(*base, ("cone", {"apex": "v"})).state
            self.assertIsNone(state.broken_law())
            top = state.find("q")
            expected = {top: (-1) ** (state.dim(top) + 1)}
            for c, v in state.boundary(top).items():
                expected[state.find(f"v*{state.cells[c].name}")] = v
            self.assertEqual(state.boundary(state.find("v*q")), expected)

    def test_a_suspension_shifts_homology(self):
        for kind in ("simploidal", "simplicial"):
            base = [*projective_plane("a"), simplex("e", 1), glue(("e.0", "e.1")), product("a", "e", kind)]
            names = [cell.name for cell in run(*base).state.cells.values()]
            twin = run(*base, ("cone", {"apex": "v"}), ("cone", {"apex": "w", "over": names}))
            self.assertEqual(found(run(*base))[1:], ([1, 1], [[], [2], [2]]))
            self.assertEqual(found(twin)[1:], ([1, 0, 1], [[], [], [2], [2]]))
            self.assertEqual(found(run(*base, ("suspend", {"apexes": ["v", "w"]}))), found(twin))

    def test_a_suspension_may_not_give_a_name_twice(self):
        for apexes in (["v", "v"], ["v", "q"], ["v"], ["v", "v*q"], "v"):
            with self.assertRaises(oracle.ScriptError):
                run(simplex("q", 1), ("suspend", {"apexes": apexes}))

    def test_a_triangle_with_one_edge_squashed_has_two_edges(self):
        twin = run(simplex("t", 2), squash("t.0-1", 0))
        self.assertEqual(found(twin), ([2, 2, 1], [1], []))
        self.assertEqual(twin.state.value("t.0-1"), (twin.state.find("t.1"), ((0, 0),)))
        self.assertEqual(twin.apply({"op": "class", "chain": [[1, "t.0-1"]]})["class"], {"cycle": True, "zero": True})

    def test_a_triangle_with_its_boundary_squashed_is_a_sphere(self):
        edges = [squash("t.0-1", 0), squash("t.1-2", 0), squash("t.0-2", 0)]
        self.assertEqual(found(run(simplex("t", 2), *edges)), ([1, 0, 1], [1, 0, 1], []))

    def test_a_cell_glued_to_a_degenerate_one_is_squashed_as_that_is(self):
        twin = run(simplex("t", 2), simplex("u", 2), squash("t", 1), glue(("u", "t")))
        self.assertEqual(found(twin), ([2, 1], [1], []))
        self.assertEqual(twin.state.value("u"), (twin.state.find("t.0-1"), ((0, 1, 1),)))
        square = run(("simploid", {"name": "q", "type": [1, 1]}), squash("q", [2, 0]), squash("q.0x0-1", 0))
        self.assertEqual(found(square), ([2, 1], [1], []))

    def test_squashing_a_degenerate_cell_once_more_squashes_what_it_lies_on(self):
        twin = run(simplex("t", 2), squash("t", 0), squash("t", 1))
        self.assertEqual(found(twin), ([1], [1], []))

    def test_quotients_are_those_of_a_union_find_over_all_degenerate_cells(self):
        degenerate = 0
        for seed in range(60):
            source = random.Random(seed)
            state = oracle.State()
            for name in ("a", "b"):
                oracle.add_simploid(state, name, source.choice([(1,), (2,), (2,), (3,), (1, 1), (1, 1), (1, 2)]))
            largest = max(state.dim(c) for c in state.alive())
            values = sorted(all_values(state, largest))
            equations = []
            for _ in range(source.randint(1, 3)):
                left = source.choice(values)
                alike = [value for value in values if oracle.type_of(value[1]) == oracle.type_of(left[1])]
                equations.append((left, source.choice(alike)))
            classes = naive_quotient(state, equations, largest)
            squashed = {root for value, root in classes.items() if oracle.is_degenerate(value)}
            after = state.copy()
            after.equate(equations)
            expected = sorted({min(other[0] for other, its in classes.items() if its == root)
                               for root in set(classes.values()) - squashed})
            self.assertEqual(after.alive(), expected, seed)
            self.assertIsNone(after.broken_law())
            for c in state.alive():
                self.assertEqual(classes[state.plain(c)], classes[after.names[state.cells[c].name]], seed)
            degenerate += len(after.cells) < len(state.cells) and bool(squashed)
        self.assertGreater(degenerate, 20)

    def test_a_torus_cut_along_its_circles_is_a_square(self):
        twin = replayed(*TORUS)[2]
        self.assertEqual(found(twin), ([1, 2, 1], [1, 2, 1], []))
        upright = {"cell": "q.0x0-1", "as": "v", "moves": [["q", 0]]}
        level = {"cell": "q.0-1x0", "as": "h", "moves": [["q", 2]]}
        twin.apply({"op": "deidentify", "split": [upright]})
        self.assertEqual(found(twin), ([1, 3, 1], [1, 2], []))
        twin.apply({"op": "deidentify", "split": [level]})
        self.assertEqual(found(twin), ([1, 4, 1], [1, 3], []))
        corners = [{"cell": "q.0x0", "as": "p10", "moves": [["v", 1], ["q.0-1x0", 0]]},
                   {"cell": "q.1x1", "as": "p11", "moves": [["v", 0], ["h", 0]]},
                   {"cell": "q.1x0", "as": "p01", "moves": [["h", 1], ["q.0x0-1", 0]]}]
        twin.apply({"op": "deidentify", "split": corners})
        self.assertEqual(found(twin), ([4, 4, 1], [1], []))
        twin.apply({"op": "undo", "steps": 3})
        self.assertEqual(found(twin), ([1, 2, 1], [1, 2, 1], []))
        twin.apply({"op": "deidentify", "split": [*corners, upright, level]})
        self.assertEqual(found(twin), ([4, 4, 1], [1], []))

    def test_a_split_that_breaks_a_face_law_is_refused(self):
        for split in ([{"cell": "t.0", "as": "x", "moves": [["t.0-1", 1]]}],
                      [{"cell": "t.0", "as": "x", "moves": [["t.0-1", 0]]}],
                      [{"cell": "t.0", "as": "x", "moves": [["t.0-1", 1], ["t.0-2", 1], ["t.0-1", 1]]}],
                      [{"cell": "t.0", "as": "t.1", "moves": []}]):
            twin = run(simplex("t", 2))
            with self.assertRaises(oracle.ScriptError):
                twin.apply({"op": "deidentify", "split": split})
            self.assertEqual(found(twin), ([3, 3, 1], [1], []))
        twin = run(simplex("t", 2))
        twin.apply({"op": "deidentify", "split": [
            {"cell": "t.0", "as": "x", "moves": [["t.0-1", 1], ["t.0-2", 1]]}]})
        self.assertEqual(found(twin), ([4, 3, 1], [2], []))

    def test_links_are_split_legally_and_their_parts_are_not(self):
        split_whole = split_part = 0
        for seed in range(20):
            writer = random_script.WriterOfAll(seed, "Z")
            writer.write(12)
            state = writer.oracle.state
            for c in writer.some_cells(6):
                for part in split_plans.link_classes(state, c):
                    step = {"op": "deidentify", "split": split_plans.split_cell(state, c, part, lambda: "new")}
                    oracle.op_deidentify(state.copy(), step, 0)
                    split_whole += 1
                    if len(part) > 1:
                        step["split"][0]["moves"].pop()
                        with self.assertRaises(oracle.ScriptError):
                            oracle.op_deidentify(state.copy(), step, 0)
                        split_part += 1
        self.assertGreater(min(split_whole, split_part), 40)

    def test_a_gluing_taken_back_leaves_what_was_there(self):
        compared = 0
        for seed in range(30):
            writer = random_script.WriterOfTearing(seed, "Z")
            random_script.Writer.write(writer, 12)
            before = writer.oracle.state
            if not writer.identify():
                continue
            undone = writer.gluings[-1].undone(writer.oracle.state, writer.fresh_copy())
            if writer.deidentify(undone):
                after = writer.oracle.state
                self.assertEqual(*(oracle.summary(state, 0) for state in (before, after)), seed)
                compared += 1
        self.assertGreater(compared, 10)

    def test_a_complex_torn_apart_is_a_heap_of_standard_simploids(self):
        for seed in range(15):
            twin = oracle.replay(random_script.write_script(seed, 30, operations="tear").encode(), "script")[2]
            state = twin.state
            used_by = split_plans.users(state)
            for top in (c for c in state.alive() if not used_by[c]):
                corners = [value[0] for _, value in split_plans.corners(state, top)]
                self.assertEqual(len(set(corners)), len(corners))
                self.assertTrue(all(used_by[c] <= set(corners) for c in corners))

    def test_an_isolated_closure_shares_no_cell_with_anything(self):
        cut = 0
        for seed in range(25):
            writer = random_script.WriterOfTearing(seed, "Z")
            random_script.Writer.write(writer, 15)
            for outside in (False, True):
                for top in writer.some_cells(4):
                    after = writer.oracle.state.copy()
                    split = split_plans.isolate(after, top, writer.fresh_copy(), outside)
                    oracle.op_deidentify(after, {"op": "deidentify", "split": split}, 0)
                    name = next((entry["as"] for entry in split if entry["cell"] == after.cells[top].name), None)
                    closure = set(after.closure([after.find(name) if name and not outside else top]))
                    users = split_plans.users(after)
                    self.assertTrue(all(users[c] <= closure for c in closure))
                    cut += bool(split)
        self.assertGreater(cut, 20)

    def test_a_circle_is_contracted_edge_by_edge(self):
        twin = run(*(("insert", {"simplex": [k, (k + 1) % 4]}) for k in range(4)))
        self.assertEqual(found(twin), ([4, 4], [1, 1], []))
        twin.apply({"op": "collapse", "from": 0, "to": 1})
        self.assertEqual(found(twin), ([3, 3], [1, 1], []))
        twin.apply({"op": "collapse", "from": 2, "to": "1"})
        self.assertEqual(found(twin), ([2, 1], [1], []))
        self.assertEqual(twin.state.find("{0,3}"), twin.state.find("{1,3}"))
        self.assertTrue(oracle.is_degenerate(twin.state.value("{0,1}")))

    def test_edges_that_meet_head_to_tail_are_opposite(self):
        twin = run(("insert", {"simplex": ["a", "b"]}), ("insert", {"simplex": ["b", "c"]}),
                   ("collapse", {"from": "c", "to": "a"}))
        chain = oracle.read_chain(twin.state, [[1, "{a,b}"], [1, "{b,c}"]], 0)
        self.assertEqual({c: v for c, v in chain.items() if v}, {})
        self.assertEqual((len(twin.state.abstract), twin.state.disordered), (1, twin.state.abstract))

    def test_boundaries_of_boundaries_are_zero_in_random_abstract_complexes(self):
        unordered = 0
        for seed in range(15):
            writer = random_script.WriterOfAbstract(seed, "Z")
            writer.write(30)
            state = writer.oracle.state
            for c in state.alive():
                self.assertEqual(oracle.boundary_of_chain(state, state.boundary(c), 0), {})
            unordered += bool(state.disordered)
        self.assertGreater(unordered, 4)

    def test_a_gluing_that_folds_a_cell_is_refused(self):
        base = (simplex("t", 2), simplex("e", 1), squash("e", 0))
        for pairs in ([["t.0-1", "t.0-1", [1, 0]]], [["t", "t", [1, 2, 0]]],
                      [["t.0-1", "t.1-2"], ["t.0-1", "t.1-2", [1, 0]]], [["t.0-1", "t.1-2", [0, 0]]]):
            with self.assertRaises(oracle.ScriptError):
                run(*base, ("identify", {"pairs": pairs}))
        twin = run(*base, ("identify", {"pairs": [["t.0-1", "t.0-1", [1, 0]], ["t.0-1", "e"]]}))
        self.assertEqual(found(twin)[0], [2, 2, 1])

    def test_a_collapse_is_what_it_does_to_sets_of_labels(self):
        for seed in range(15):
            writer = random_script.WriterOfAbstract(seed, "Z")
            writer.weights = {"insert": 3, "query": 1, "simplex": 0, "cone": 0, "product": 0}
            writer.write(12)
            known = writer.live_labels()
            before, (u, v) = {*writer.oracle.state.orders}, writer.random.sample(known, 2)
            writer.oracle.apply({"op": "collapse", "from": u, "to": v})
            after = {frozenset(v if label == u else label for label in simplex) for simplex in before}
            self.assertEqual({*writer.oracle.state.orders}, after)

    def test_undo_takes_back_every_operation(self):
        for seed in range(10):
            text = random_script.write_script(seed, 30, operations="all", weights={"undo": 0})
            twin = oracle.Oracle()
            reports = [oracle.summary(twin.state, 0)]
            for line in text.splitlines()[1:]:
                reports.append(oracle_report(twin.apply(json.loads(line))))
            for report in reversed(reports[:-1]):
                self.assertEqual(oracle_report(twin.apply({"op": "undo"})), report)
            self.assertEqual((twin.state.names, twin.state.bodies), ({}, {}))


def polygon(name, sides):
    return "polygon", {"name": name, "sides": sides}


def sew(dim, *pairs):
    return "sew", {"dim": dim, "pairs": [list(pair) for pair in pairs]}


def unsew(dim, *darts):
    return "unsew", {"dim": dim, "darts": list(darts)}


def solid(name, kind):
    alpha = random_script.map_of_faces(random_script.SOLIDS[kind])
    return "gmap", {"name": name, "alpha": [*alpha, list(range(len(alpha[0])))]}


def groups_of_analogue(state):
    """(betti, torsion) of the simplicial analogue of all maps as they are sewn now, but for factors of products."""
    total = oracle.Oracle()
    consumed = {name for name, made in state.maps.items()
                if all(state.names.get(f"{name}.0:{text}", name) is None for k, text in enumerate(made.texts) if (name, k) in state.alpha)}
    for n in {made.dimension for name, made in state.maps.items() if name not in consumed}:
        darts = [d for d in state.alpha if state.maps[d[0]].dimension == n and d[0] not in consumed]
        number = {d: k for k, d in enumerate(darts)}
        alpha = [[number[state.alpha[d][i]] for d in darts] for i in range(n + 1)]
        total.apply({"op": "gmap", "name": f"m{n}", "alpha": alpha, "as": "simplices"})
    numbers = oracle.summary(total.state, 0)
    return without_zeros(numbers["betti"], numbers["torsion"])


class MapsTest(unittest.TestCase):
    def refuses(self, *steps):
        with self.assertRaises(oracle.ScriptError):
            run(*steps)

    def test_a_polygon_has_its_corners_and_sides_by_any_of_their_darts(self):
        state = run(polygon("p", 5)).state
        self.assertEqual([state.find(f"p.1:{k}") for k in (2, 4)], [state.find(f"p.1:{k}") for k in (3, 5)])
        self.assertEqual(state.find("p.0:1"), state.find("p.0:2"))
        self.assertEqual(state.find("p"), state.find("p.2:7"))
        self.assertEqual([state.cells[c].name for c in state.alive()],
                         [*(f"p.0:{k}" for k in (0, 1, 3, 5, 7)), *(f"p.1:{k}" for k in (0, 2, 4, 6, 8)), "p"])

    def test_each_dart_counts_once_in_the_boundaries_of_its_cells(self):
        twin = run(polygon("p", 3), polygon("q", 3), solid("s", "prism"), sew(2, ("p:0", "q:4")), sew(2, ("p:3", "q:0")))
        for name, made in twin.state.maps.items():
            for i in range(1, made.dimension + 1):
                for text in made.texts:
                    value = twin.state.value(f"{name}.{i}:{text}")
                    self.assertEqual(twin.state.face(value, 0, 0), twin.state.value(f"{name}.{i - 1}:{text}"))
                    if name == "s":  # no face is there twice
                        boundary = twin.state.boundary(value[0])
                        face = twin.state.find(f"{name}.{i - 1}:{text}")
                        sign = twin.state.sign(f"{name}.{i}:{text}") * twin.state.sign(f"{name}.{i - 1}:{text}")
                        self.assertEqual(boundary[face], sign)

    def test_maps_by_cells_have_the_groups_of_their_simplicial_analogues_after_every_step(self):
        compared = collections.Counter()
        for seed in range(32):
            writer = random_script.WriterOfMaps(seed, "Z")
            writer.weights = {"polygon": 4, "solid": 1, "surface": 1, "closed_surface": 2, "closed_solid": 1, "small_map": 1, "nmap": 2,
                              "sew": 10, "unsew": 3, "extend": 2, "undo": 1, "map_product": 3, "take_cell_out": 6, "put_cell_in": 6}
            writer.of_maps = writer.weights  # no chains of maps, but in products
            writer.write(20)
            twin = oracle.Oracle()
            for step in writer.lines[1:]:
                report = twin.apply(step)
                self.assertIsNone(twin.state.broken_law())
                has_darts = not twin.state.levels and all(name in twin.state.maps for name in twin.state.products)
                if len(twin.state.alpha) < 150 and has_darts:
                    self.assertEqual(without_zeros(report["betti"], report["torsion"]), groups_of_analogue(twin.state), seed)
                    compared[step["op"]] += 1
                    compared["hollow"] += any(map(twin.state.is_hollow, twin.state.alive()))
        self.assertTrue(all(compared[op] > 3 for op in ("polygon", "sew", "unsew", "extend", "hollow", "product", "remove_cell",
                                                        "contract_cell", "insert_cell", "split_cell")), compared)

    def test_products_of_maps_are_what_kunneth_says_and_maps_again(self):
        compared = collections.Counter()
        for seed in range(30):
            writer = random_script.WriterOfMaps(seed, "Z")
            writer.weights = {"polygon": 3, "closed_surface": 2, "small_map": 2, "nmap": 2, "chain": 1, "sew": 8, "map_product": 4}
            writer.of_maps = writer.weights
            writer.write(14)
            twin = oracle.Oracle()
            for step in writer.lines[1:]:
                before = twin.state
                twin.apply(step)
                if step["op"] != "product":
                    continue
                state = twin.state
                self.assertIsNone(state.broken_law())
                sides = [before.cells_of_body(before.find_body(step[side])) for side in ("left", "right")]
                groups = homology_of(state, state.cells_of_body(state.find_body(step["name"])))
                self.assertEqual(without_zeros(*groups), kunneth(*(homology_of(before, side) for side in sides)), seed)
                if step["name"] in state.maps:
                    name, made = step["name"], state.maps[step["name"]]
                    for k in range(0, len(made.texts), 5):
                        for i in range(1, made.dimension + 1):
                            value = state.value(f"{name}.{i}:{k}")
                            self.assertEqual(state.face(value, 0, 0), state.value(f"{name}.{i - 1}:{k}"))
                compared["with darts" if step["name"] in state.maps else "without"] += 1
        self.assertTrue(all(compared[kind] > 3 for kind in ("with darts", "without")), compared)

    def test_products_are_refused_of_what_is_no_ball_and_of_mixed_cells(self):
        torus = "gmap", {"name": "T", "alpha": [[1, 0, 3, 2, 5, 4, 7, 6], [7, 2, 1, 4, 3, 6, 5, 0],
                                                [5, 4, 7, 6, 1, 0, 3, 2], [0, 1, 2, 3, 4, 5, 6, 7]]}
        self.refuses(torus, polygon("p", 3), ("product", {"name": "P", "left": "T", "right": "p"}))
        self.refuses(polygon("p", 3), simplex("t", 2), product("p", "t", "simploidal"))
        self.refuses(polygon("p", 3), polygon("q", 3), product("p", "q", "simplicial"))
        self.refuses(polygon("p", 3), polygon("q", 3), squash("q.1:0", 0), product("p", "q", "simploidal"))
        self.assertEqual(found(run(polygon("p", 3), simplex("e", 1), product("p", "e", "simploidal"))), ([6, 9, 5, 1], [1], []))

    def test_what_is_put_into_a_map_can_be_taken_out_again(self):
        ways = collections.Counter()
        for seed in range(160):
            writer = random_script.WriterOfMaps(seed, "Z")
            writer.weights = writer.of_maps = {"sew": 1}
            writer.random.choice([writer.polygon, writer.solid, writer.closed_surface, writer.closed_solid])()
            writer.write(1)
            before = writer.oracle.state
            if not writer.put_cell_in():
                continue
            step = writer.lines[-1]
            inverse = "remove_cell" if step["op"] == "insert_cell" else "contract_cell"
            dimension = before.maps[step["darts"][0].split(":")[0]].dimension
            ways[step["op"], step["dim"] if inverse == "remove_cell" else dimension - step["dim"]] += 1
            writer.oracle.apply({"op": inverse, "cell": f'{step["name"]}.{step["dim"]}:0'})
            self.assertEqual(writer.oracle.state.alpha, before.alpha, step)
        self.assertTrue(all(ways[op, i] > 2 for op in ("insert_cell", "split_cell") for i in range(3)), ways)

    def test_an_edge_that_is_removed_makes_two_faces_one_or_opens_what_it_lies_in(self):
        two = [polygon("p", 4), polygon("q", 3), sew(2, ("p:0", "q:0"))]
        one = run(*two, ("remove_cell", {"cell": "p.1:1"}))
        self.assertEqual(found(one), ([5, 5, 1], [1], []))
        self.assertEqual([one.state.cells[c].name for c in one.state.alive()][-1], "p.2:2")
        self.assertEqual(one.state.alpha["p", 7][1], ("q", 5))
        self.assertEqual(one.state.find("q.2:2"), one.state.find("p.2:7"))
        self.assertEqual(found(run(*two, ("contract_cell", {"cell": "p.1:1"}))), ([5, 5, 2], [2], []))  # no face has another side
        self.assertEqual(found(run(solid("s", "cube"), ("contract_cell", {"cell": "s.1:1"}))), ([7, 11, 6, 1], [1], []))
        self.assertEqual(found(run(*two, ("remove_cell", {"cell": "p.1:2"}))), ([5, 5, 2], [1], []))  # a face is open
        self.refuses(*two, ("remove_cell", {"cell": "p.0:1"}))  # three edges meet there
        self.refuses(*two, ("remove_cell", {"cell": "p.1:1"}), sew(2, ("p:0", "p:3")))
        self.refuses(*two, glue(("p.1:2", "q.1:2")), ("contract_cell", {"cell": "p.1:2"}))
        torus = polygon("t", 4), sew(2, ("t:0", "t:5")), sew(2, ("t:2", "t:7"))
        self.assertEqual(found(run(*torus, ("contract_cell", {"cell": "t.1:0"})))[1:], ([1, 0, 1], []))


    def test_cells_that_are_no_balls_are_refused(self):
        square = [[1, 0, 3, 2, 5, 4, 7, 6], [7, 2, 1, 4, 3, 6, 5, 0]]
        torus, plane = [5, 4, 7, 6, 1, 0, 3, 2], [4, 5, 6, 7, 0, 1, 2, 3]
        for top in (torus, plane):
            self.assertEqual(found(run(("gmap", {"name": "m", "alpha": [*square, top]})))[0][2], 1)
            over = {"name": "m", "alpha": [*square, top, list(range(8)), list(range(8))]}
            self.refuses(("gmap", over))  # of dimension 4
            self.assertEqual(found(run(("gmap", {**over, "as": "simplices"})))[1:], ([1], []))  # a cone
        self.refuses(("gmap", {"name": "m", "alpha": [*square, [1, 0, 2, 3, 4, 5, 6, 7]]}))  # a side on itself
        self.refuses(("gmap", {"name": "m", "alpha": [[0, 2, 1, 3], [1, 0, 3, 2], [0, 1, 2, 3]]}))  # an open face

    def test_largest_cells_that_are_no_balls_are_cones_over_surfaces(self):
        square = [[1, 0, 3, 2, 5, 4, 7, 6], [7, 2, 1, 4, 3, 6, 5, 0]]
        torus, plane = [5, 4, 7, 6, 1, 0, 3, 2], [4, 5, 6, 7, 0, 1, 2, 3]
        for top, groups, suspended in ((torus, ([1, 2, 1], []), ([1, 0, 2, 1], [])),
                                       (plane, ([1], [[], [2]]), ([1], [[], [], [2]]))):
            surface = ("gmap", {"name": "m", "alpha": [*square, top]})
            self.assertEqual(found(run(surface))[1:], groups)
            solid = ("gmap", {"name": "m", "alpha": [*square, top, list(range(8))]})
            for twin in (run(surface, ("extend", {"maps": ["m"]})), run(solid)):
                self.assertEqual(found(twin)[0][3], 1)
                self.assertEqual(found(twin)[1:], ([1], []))
                self.assertEqual(oracle.summary(twin.state, 0)["euler"], 1)
                self.assertIsNone(twin.state.broken_law())
            self.assertEqual(found(run(solid, ("remove", {"cells": ["m.3:5"]})))[1:], groups)
            other = ("gmap", {**solid[1], "name": "k"})
            sewn = run(solid, other, sew(3, *((f"m:{d}", f"k:{d}") for d in range(8))))
            self.assertEqual(found(sewn)[1:], suspended)
            glued = run(solid, other, ("identify", {"pairs": [["m.3:0", "k.3:1"]]}))
            self.assertEqual(found(glued), found(run(solid)))
            coned = run(solid, ("cone", {"apex": "v"}), ("remove", {"cells": ["v*m.3:2"]}))
            self.assertEqual(found(coned)[1:], suspended)
            self.refuses(solid, ("deidentify", {"split": [{"cell": "m.3:0", "as": "x", "moves": []}]}))
            self.refuses(solid, ("extend", {"maps": ["m"]}))

    def test_chains_of_maps_have_the_groups_of_their_analogues_after_every_gluing(self):
        compared = 0
        for seed in range(40):
            writer = random_script.WriterOfMaps(seed, "Z")
            while not any(line.get("op") == "chain_of_maps" for line in writer.lines):
                writer.chain()
            step = {field: value for field, value in writer.lines[-1].items() if field != "as"}
            name, levels = step["name"], step["levels"]
            cells, simplices = run((step["op"], step)), run((step["op"], {**step, "as": "simplices"}))
            self.assertEqual(found(cells)[1:], found(simplices)[1:])
            top = levels[-1]
            for _ in range(6 if len(levels) > 1 else 0):
                d, e = (writer.random.randrange(len(top["sigma"])) for _ in range(2))
                pairs = [[d, e]]  # what becomes one with these
                for one, other in pairs:
                    for images in top["alpha"]:
                        if [images[one], images[other]] not in pairs:
                            pairs.append([images[one], images[other]])
                i = len(levels) - 1
                numbers = "-".join(map(str, range(i + 1)))
                try:
                    cells.apply({"op": "identify", "pairs": [[f"{name}.{i}:{d}", f"{name}.{i}:{e}"]]})
                except oracle.ScriptError:
                    continue
                simplices.apply({"op": "identify", "pairs": [[f"{name}.<{numbers}>:{k}" for k in pair] for pair in pairs]})
                self.assertIsNone(cells.state.broken_law())
                self.assertEqual(found(cells)[1:], found(simplices)[1:], seed)
                compared += 1
        self.assertGreater(compared, 40)

    def test_incidence_graphs_have_the_groups_of_their_chains(self):
        for seed in range(20):
            writer = random_script.WriterOfMaps(seed, "Z")
            while not any(line.get("op") == "incidence" for line in writer.lines):
                writer.incidence()
            step = {field: value for field, value in writer.lines[-1].items() if field != "as"}
            chains = run((step["op"], {**step, "as": "simplices"}))
            try:
                cells = run((step["op"], step))
            except oracle.ScriptError:
                continue
            self.assertIsNone(cells.state.broken_law())
            self.assertEqual(found(cells)[1:], found(chains)[1:])
            for cell in step["cells"]:
                if cell.get("faces"):  # the first face counts once
                    called, first = f'{step["name"]}.{cell["id"]}', f'{step["name"]}.{cell["faces"][0]}'
                    boundary = cells.state.boundary(cells.state.find(called))
                    self.assertEqual(boundary[cells.state.find(first)], cells.state.sign(called) * cells.state.sign(first))

    def test_incidence_graphs_with_jumps_or_cells_that_are_no_balls_are_refused(self):
        def graph(*cells, **more):
            return "incidence", {"name": "K", "cells": [{"id": k, "faces": list(own)} for k, own in cells], **more}

        vertices = [(v, "") for v in "abcd"]
        circles = [("e", "ab"), ("f", "ab"), ("g", "cd"), ("h", "cd")]
        self.refuses(graph(*vertices, ("e", "ab"), ("f", "ec")))
        for over in ([("s", "abc")], [*circles, ("w", "efgh")]):
            self.refuses(graph(*vertices, *over))
            self.assertEqual(len(found(run(graph(*vertices, *over, **{"as": "simplices"})))[0]), 2 if over[0][0] == "s" else 3)
        self.refuses(graph(("a", ""), ("b", ""), ("1:0", "ab"), ("e", "ab")))

    def test_what_cannot_be_sewn_is_refused(self):
        made = [polygon("p", 3), polygon("q", 4), solid("a", "prism"), solid("b", "cube")]
        for dim, *pair in ((2, "p:0", "q:8"), (2, "p:0", "x:0"), (2, "p:0", "b:0"), (3, "p:0", "q:0"), (1, "p:0", "q:0"),
                           (2, "p:0", "p:0"), (2, "p:0", "p:1"), (3, "a:0", "b:0")):
            self.refuses(*made, sew(dim, pair))
        self.refuses(*made, sew(2, ("p:0", "q:0")), sew(2, ("p:1", "q:3")))
        self.refuses(*made, sew(2, ("p:0", "q:0"), ("p:1", "q:3")))
        run(*made, sew(2, ("p:0", "q:0"), ("p:1", "q:1")))

    def test_cells_of_maps_are_glued_as_darts_see_them(self):
        state = run(polygon("p", 5), polygon("q", 5), glue(("p.2:2", "q.2:5"))).state
        for name, other in (("p.1:2", "q.1:5"), ("p.0:2", "q.0:5"), ("p.0:3", "q.0:4"), ("p.2:2", "q.2:5")):
            self.assertEqual(state.value(name), state.value(other))
        self.refuses(polygon("p", 5), polygon("q", 4), glue(("p", "q")))
        self.refuses(polygon("p", 5), glue(("p", "p.2:1")))  # a fold
        self.refuses(polygon("p", 5), squash("p", 0))

    def test_what_is_unsewn_is_called_by_its_own_darts(self):
        twin = run(polygon("p", 3), sew(2, ("p:0", "p:3")))
        self.assertEqual(twin.state.value("p.1:0"), twin.state.value("p.1:3"))
        twin = run(polygon("p", 3), sew(2, ("p:0", "p:3")), unsew(2, "p:1"))
        self.assertEqual(found(twin), ([3, 3, 1], [1], []))
        state = twin.state
        self.assertEqual(state.cells[state.find("p.1:2")].name, "p.1:3")  # as its orientation was that of dart 3
        self.assertEqual([state.sign(f"p.1:{k}") for k in (2, 3)], [-1, 1])
        self.refuses(polygon("p", 3), unsew(2, "p:0"))
        self.refuses(polygon("p", 3), polygon("q", 3), sew(2, ("p:0", "q:1")), glue(("p.1:2", "q.1:2")), unsew(2, "p:0"))
        self.refuses(polygon("p", 3), sew(2, ("p:2", "p:5")), squash("p.1:0", 0), unsew(2, "p:2"))

    def test_maps_by_simplices_are_unsewn_and_extended(self):
        def piece(name):
            return "polygon", {"name": name, "sides": 3, "as": "simplices"}

        apart = run(piece("p"), piece("q"))
        for dim, *pair in ((2, "p:0", "q:1"), (2, "p:0", "p:3")):
            twin = run(piece("p"), piece("q"), sew(dim, pair), unsew(dim, pair[1]))
            self.assertEqual(found(twin), found(apart))
            self.assertEqual({c.name for c in twin.state.cells.values()}, {c.name for c in apart.state.cells.values()})
        steps = [piece("p"), piece("q"), sew(2, ("p:0", "q:1")), ("extend", {"maps": ["q"]})]
        steps += [sew(3, ("p:0", "q:1")), unsew(3, "q:2"), unsew(1, "p:1"), unsew(2, "q:0"), unsew(0, "q:3")]
        for count in range(3, len(steps) + 1):
            twin = run(*steps[:count])
            self.assertIsNone(twin.state.broken_law())
            self.assertEqual(without_zeros(*found(twin)[1:]), groups_of_analogue(twin.state))
        self.assertEqual(found(run(*steps[:4]))[0], [12, 33, 34, 12])
        self.refuses(piece("p"), unsew(2, "p:0"))
        self.refuses(piece("p"), unsew(3, "p:0"))
        self.refuses(*steps[:3], glue(("p.<0>:0", "q.<0>:3")), unsew(2, "p:0"))
        self.refuses(piece("p"), polygon("r", 3), ("extend", {"maps": ["p", "r"]}))

    def test_a_polygon_keeps_its_name_when_it_is_a_face_of_a_solid(self):
        pillows = [step for name in "pq" for step in (polygon(name, 2), sew(2, (f"{name}:0", f"{name}:3")),
                                                      ("extend", {"maps": [name]}))]
        twin = run(*pillows, sew(3, ("p:0", "q:0")), unsew(3, "q:1"))
        for name in "pq":
            self.assertEqual(twin.state.value(name), twin.state.value(f"{name}.2:0"))

    def test_an_n_map_is_its_g_map_with_two_darts_for_each(self):
        beta = [[1, 2, 3, 0, 5, 6, 7, 4], [4, None, None, None, 0, None, None, None]]
        twin = run(("map", {"name": "m", "beta": beta}))
        self.assertEqual(found(twin), ([6, 7, 2], [1], []))
        for one, other in (("m.1:0", "m.1:4'"), ("m.0:0", "m.0:3'"), ("m.0:0", "m.0:5")):
            self.assertEqual(twin.state.find(one), twin.state.find(other))
        self.assertIsNone(gmaps.broken_law(gmaps.gmap_of(beta)))
        self.refuses(("map", {"name": "m", "beta": [[0], [0]]}))

    # -- cells known by their boundaries

    def test_cells_that_are_known_by_their_boundaries_have_the_groups_that_these_say(self):
        def cells(*faces):
            return [{"id": "v", "dim": 0}, {"id": "a", "dim": 1, "boundary": [[-1, "v"], [1, "v"]]},
                    *({"id": ident, "dim": dim, "boundary": boundary} for ident, dim, boundary in faces)]

        lens = ("complex", {"name": "l", "cells": cells(("s", 3, []), ("f", 2, [[7, "a"]]))})
        self.assertEqual(found(run(lens)), ([1, 1, 1, 1], [1, 0, 0, 1], [[], [7]]))
        twice = ("complex", {"name": "k", "cells": cells(("f", 2, [[7, "a"]]), ("s", 3, []))})
        glued = run(lens, twice, ("identify", {"pairs": [["l.f", "k.f"]]}))
        self.assertEqual(found(glued), ([1, 1, 1, 2], [1, 0, 0, 2], [[], [7]]))
        self.assertEqual(glued.state.find("k.v"), glued.state.find("l.v"))
        self.assertEqual(found(run(lens, ("degenerate", {"cell": "l.a", "along": 0})))[1:], ([1, 0, 1, 1], []))
        coned = run(lens, ("cone", {"apex": "x", "over": "l"}))
        self.assertEqual(found(coned), ([2, 2, 2, 2, 1], [1], []))
        self.assertIsNone(coned.state.broken_law())
        self.assertEqual(found(run(lens, ("suspend", {"apexes": ["n", "s"]})))[1:], ([1, 0, 0, 0, 1], [[], [], [7]]))
        for wrong in (("f", 2, [[1, "v"]]), ("f", 1, [[1, "v"]]), ("f", 3, [[1, "f"]]), ("f", 2, [[0, "a"]])):
            self.refuses(("complex", {"name": "l", "cells": cells(wrong)}))
        edge = [{"id": "v"}, {"id": "w"}, {"id": "a", "faces": ["w", "v"]}, {"id": "f", "dim": 2, "boundary": [[2, "a"]]}]
        self.refuses(("complex", {"name": "l", "cells": edge}))  # no cycle
        self.refuses(lens, ("complex", {"name": "k", "cells": cells(("f", 2, [[5, "a"]]))}),
                     ("identify", {"pairs": [["l.f", "k.f"]]}))
        self.refuses(lens, ("deidentify", {"split": [{"cell": "l.v", "as": "w", "moves": [["l.a", 0]]}]}))
        self.refuses(lens, ("product", {"name": "P", "left": "l", "right": "l"}))


if __name__ == "__main__":
    unittest.main()
