#!/usr/bin/env python3
"""Random small towers.

    random_tower.py [--seed N] [--operations N] [--vertices N] [--dimension N] [--contract P] [--any-two] [--reuse P]
                    [--times none|equal|distinct]

An operation is, with probability P, a contraction: along a random edge, or with --any-two of any two vertices; else an
insertion of a random simplex whose faces are there, a vertex only while fewer than so many are alive. A new vertex
gets, with the probability of --reuse, a label that was contracted away. Prints the tower format.
"""

import argparse
import itertools
import random
import sys

sys.dont_write_bytecode = True
import tower_oracle
from tower_oracle import Operation


class RandomTower:
    def __init__(self, rng, vertices, dimension, contract, any_two, reuse):
        self.rng, self.vertices, self.dimension = rng, vertices, dimension
        self.contract, self.any_two, self.reuse = contract, any_two, reuse
        self.simplices, self.dead, self.used = set(), [], set()

    def contraction(self):
        size = 1 if self.any_two else 2
        pool = sorted(s for s in self.simplices if len(s) == size)
        if len(pool) < (2 if self.any_two else 1):
            return None
        pair = [v for s in self.rng.sample(pool, 2) for v in s] if self.any_two else list(self.rng.choice(pool))
        self.rng.shuffle(pair)
        return "c", pair

    def new_label(self):
        if self.dead and self.rng.random() < self.reuse:
            return self.dead.pop(self.rng.randrange(len(self.dead)))
        while True:
            label = self.rng.choice([self.rng.randrange(30), self.rng.randrange(10 ** 6), self.rng.randrange(2 ** 64)])
            if label not in self.used:
                self.used.add(label)
                return label

    def insertion(self):
        alive = sorted(s[0] for s in self.simplices if len(s) == 1)
        for d in range(self.rng.randrange(self.dimension + 1), 0, -1):
            missing = [s for s in itertools.combinations(alive, d + 1) if s not in self.simplices and
                       all(s[:k] + s[k + 1:] in self.simplices for k in range(d + 1))]
            if missing:
                labels = list(self.rng.choice(missing))
                self.rng.shuffle(labels)
                return "i", labels
        return ("i", [self.new_label()]) if len(alive) < self.vertices else None

    def operation(self, time):
        """The next operation, applied; nothing when there is none."""
        if self.rng.random() < self.contract:
            made = self.contraction() or self.insertion()
        else:
            made = self.insertion() or (self.contraction() if self.contract > 0 else None)
        if made is None:
            return None
        operation = Operation(time, *made)
        self.simplices = tower_oracle.after(self.simplices, operation)
        if operation.kind == "c":
            self.dead.append(operation.labels[0])
        return operation


def next_time(rng, time, times):
    if times == "equal" and rng.random() < 0.5:
        return time
    return time + rng.choice([0.125, 0.5, 1, 3])


def make(seed, operations=25, vertices=6, dimension=3, contract=0.15, any_two=False, times="none", reuse=0.3):
    """The operations of a random tower."""
    rng = random.Random(seed)
    tower = RandomTower(rng, vertices, dimension, contract, any_two, reuse)
    made, time = [], 0 if times == "none" else rng.choice([-2.5, 0, 7])
    for k in range(operations):
        time = k if times == "none" else next_time(rng, time, times)
        operation = tower.operation(time)
        if operation is None:
            break
        made.append(operation)
    return made


def text(operations, with_times):
    return "".join((f"{o.time!r} " if with_times else "") + " ".join([o.kind, *map(str, o.labels)]) + "\n"
                   for o in operations)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--operations", type=int, default=25)
    parser.add_argument("--vertices", type=int, default=6)
    parser.add_argument("--dimension", type=int, default=3)
    parser.add_argument("--contract", type=float, default=0.15)
    parser.add_argument("--any-two", action="store_true")
    parser.add_argument("--reuse", type=float, default=0.3)
    parser.add_argument("--times", choices=["none", "equal", "distinct"], default="none")
    options = vars(parser.parse_args())
    sys.stdout.write(text(make(**options), options["times"] != "none"))


if __name__ == "__main__":
    main()
