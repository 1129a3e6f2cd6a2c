#!/usr/bin/env python3
"""Tests of the tower oracle: towers whose barcode is known, and filtrations beside a plain reduction."""

import itertools
import os
import random
import sys
import unittest

sys.dont_write_bytecode = True
import random_tower
import tower_oracle
from tower_oracle import TowerError, barcode, parse

PROJECTIVE_PLANE = [(1, 2, 3), (1, 2, 4), (1, 3, 5), (1, 4, 6), (1, 5, 6), (2, 3, 6), (2, 4, 5), (2, 5, 6), (3, 4, 5),
                    (3, 4, 6)]


def bars(lines, p=2):
    return barcode(parse(lines), p)


def inserted(facets):
    """Lines that insert a complex, by dimension."""
    faces = {face for facet in facets for n in range(1, len(facet) + 1) for face in itertools.combinations(facet, n)}
    return ["i " + " ".join(map(str, face)) for face in sorted(faces, key=lambda face: (len(face), face))]


def subdivided(facets, edge, new):
    """The complex with a new vertex on an edge."""
    result = []
    for facet in facets:
        if set(edge) <= set(facet):
            result += [tuple(sorted(set(facet) - {end} | {new})) for end in edge]
        else:
            result.append(facet)
    return result


def bars_by_reduction(operations, p):
    """The standard algorithm, for towers without contractions."""
    place = {tuple(sorted(o.labels)): k for k, o in enumerate(operations)}
    reduced, paired, found = {}, set(), []
    for simplex, k in place.items():
        column = {place[face]: c % p for face, c in tower_oracle.boundary({simplex: 1}, p).items()}
        while column and max(column) in reduced:
            other = reduced[max(column)]
            tower_oracle.add(column, other, -column[max(column)] * pow(other[max(column)], -1, p), p)
        if column:
            low = max(column)
            reduced[low] = column
            paired |= {low, k}
            found.append([len(operations[low].labels) - 1, operations[low].time, operations[k].time])
    found += [[len(o.labels) - 1, o.time, None] for k, o in enumerate(operations) if k not in paired]
    return sorted((bar for bar in found if bar[1] != bar[2]), key=tower_oracle.bar_order)


class KnownTowers(unittest.TestCase):
    def test_a_circle_contracted_to_a_point_dies_with_its_second_last_vertex(self):
        circle = ["i 0", "i 1", "i 2", "i 0 1", "i 1 2", "i 0 2", "c 2 1", "c 1 0"]
        for p in (2, 3):
            self.assertEqual(bars(circle, p), [[0, 0, None], [0, 1, 3], [0, 2, 4], [1, 5, 6]])

    def test_two_points_become_one(self):
        self.assertEqual(bars(["i 5", "i 9", "c 5 9"]), [[0, 0, None], [0, 1, 2]])

    def test_a_contraction_of_two_vertices_that_are_not_joined_makes_a_circle(self):
        self.assertEqual(bars(["i 0", "i 1", "i 2", "i 0 1", "i 1 2", "i 3", "i 2 3", "c 3 0"]),
                         [[0, 0, None], [0, 1, 3], [0, 2, 4], [0, 5, 6], [1, 7, None]])

    def test_a_projective_plane_stays_one_when_a_subdivided_edge_is_contracted(self):
        for edge in itertools.combinations(range(1, 7), 2):
            lines = inserted(subdivided(PROJECTIVE_PLANE, edge, 7))
            for end in edge:
                tower = [*lines, f"c 7 {end}"]
                essential = {p: [bar[0] for bar in bars(tower, p) if bar[2] is None] for p in (2, 3)}
                self.assertEqual(essential, {2: [0, 1, 2], 3: [0]})
                self.assertNotIn(len(lines), [death for _, _, death in bars(tower, 2)])

    def test_a_wrapped_edge_path_tells_two_from_three(self):
        # A hexagon is laid twice around a triangle: over Z/2 its class dies, over Z/3 the younger one.
        lines = [*(f"i {v}" for v in range(6)), *(f"i {v} {(v + 1) % 6}" for v in range(6)), "c 3 0", "c 4 1", "c 5 2"]
        circles = {p: [bar for bar in bars(lines, p) if bar[0] == 1] for p in (2, 3)}
        self.assertEqual(circles, {2: [[1, 11, 14], [1, 12, None]], 3: [[1, 11, None], [1, 12, 14]]})

    def test_contractions_that_are_isomorphisms_end_no_bar(self):
        lines = [*inserted(PROJECTIVE_PLANE), "i 7", "i 1 7"]
        for p in (2, 3):
            self.assertEqual(bars([*lines, "c 7 1", "i 8", "i 8 2", "c 2 8"], p), sorted(
                [*bars(lines, p), [0, len(lines) + 1, len(lines) + 2]], key=tower_oracle.bar_order))

    def test_operations_of_equal_time_are_one_map(self):
        self.assertEqual(bars(["1 i 0", "1 i 1", "1 i 0 1", "2.5 i 2", "3 c 2 0", "3 i 7"]),
                         [[0, 1, None], [0, 2.5, 3], [0, 3, None]])

    def test_wrong_towers_are_refused(self):
        for lines in (["i 0 1"], ["i 0", "i 0"], ["i 0", "c 0 1"], ["i 0", "c 0 0"], ["2 i 0", "1 i 1"], ["i 0", "i 0 0"]):
            with self.assertRaises(TowerError):
                bars(lines)


class RandomTowers(unittest.TestCase):
    def test_filtrations_have_the_bars_of_the_standard_algorithm(self):
        for seed in range(60):
            times = ["none", "equal", "distinct"][seed % 3]
            operations = random_tower.make(seed, operations=30, contract=0, times=times)
            for p in (2, 3):
                self.assertEqual(barcode(operations, p), bars_by_reduction(operations, p), f"seed {seed}")

    def test_bars_count_the_betti_numbers_at_every_time(self):
        for seed in range(40):
            operations = random_tower.make(seed, operations=30, any_two=seed % 2 == 1, times="equal")
            found = barcode(operations, 3)
            for time, _, simplices in tower_oracle.moments(operations):
                boundaries = tower_oracle.boundaries_by_dimension(simplices, 3, 4)
                for d in range(4):
                    alive = sum(bar[0] == d and bar[1] <= time and (bar[2] is None or time < bar[2]) for bar in found)
                    self.assertEqual(alive, len(tower_oracle.homology_basis(simplices, d, boundaries[d], 3)))

    def test_a_renaming_of_the_vertices_changes_no_bar(self):
        for seed in range(30):
            operations = random_tower.make(seed, operations=25, any_two=True, reuse=0)
            labels = sorted({label for o in operations for label in o.labels})
            renamed = dict(zip(labels, random.Random(seed).sample(labels, len(labels))))
            other = [tower_oracle.Operation(o.time, o.kind, [renamed[label] for label in o.labels]) for o in operations]
            self.assertEqual(barcode(operations, 3), barcode(other, 3), f"seed {seed}")

    def test_the_printed_tower_is_read_back(self):
        for seed in range(20):
            times = ["none", "equal", "distinct"][seed % 3]
            operations = random_tower.make(seed, times=times)
            read = parse(random_tower.text(operations, times != "none").splitlines())
            self.assertEqual([vars(o) for o in read], [vars(o) for o in operations])


if __name__ == "__main__":
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    unittest.main()
