#!/usr/bin/env python3
"""The events of a page lead to the cells that there are after each step: page_events_test.py SESAME [SCRIPTS].

Random scripts over all operations, with cones over bodies written out and not, are replayed into pages. Their events are
carried out as the page does, and what is left is counted.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
import random_script

SESAME = Path(sys.argv[1]).resolve()
SCRIPTS = int(sys.argv[2]) if len(sys.argv) > 2 else 6


def data_of(script, *options):
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.html"
        subprocess.run([SESAME, "replay", "-", "--quiet", *options, "--html", page], input=script, text=True, check=True,
                       timeout=60)
        return json.loads(re.search(r'id="data">([^<]*)</script>', page.read_text(encoding="utf-8"))[1])


def fold(there, step, forwards):
    """What is made comes, what is removed or consumed goes; backwards the other way round."""
    first, count = step.get("made", (0, 0))
    come = set(range(first, first + count))
    gone = set(step.get("removed", [])[::2]) | set(step.get("consumed", []))
    if forwards:
        assert not come & there and gone <= there | come
        return (there | come) - gone
    assert not gone & there
    return (there | gone) - come


def dimension_of(kind):
    """A simploid has those of its factors; other kinds begin with what they are, and then say it."""
    return kind[1] if kind and kind[0] < 1 else sum(kind)


def is_cell(kind):
    """Not a part of a cell that is no ball."""
    return not kind or kind[0] != -3


def check(data, what):
    kinds = [data["cells"]["types"][number] for number in data["cells"]["type"]]
    dimensions = list(map(dimension_of, kinds))
    assert len(data["places"]["cells"]) == dimensions.count(0), what
    there, cells, first = set(), [], 0
    for number, step in enumerate(data["steps"]):  # one that made some cells and did nothing else is their number
        if isinstance(step, int):
            data["steps"][number] = {"made": (first, step)}
        first += data["steps"][number].get("made", (0, 0))[1]
    for number, step in enumerate(data["steps"], 1):
        if "undone" in step:
            for undone in step["undone"]:
                there = fold(there, data["steps"][undone], False)
        else:
            there = fold(there, step, True)
        cells = step.get("cells", cells)
        found = [dimensions[cell] for cell in there if is_cell(kinds[cell])]
        assert [found.count(p) for p in range(max(found, default=-1) + 1)] == cells, f"{what}, step {number}"


def main():
    for operations in ("basic", "all", "nest", "tear", "abstract"):
        for seed in range(1, SCRIPTS + 1):
            script = random_script.write_script(seed, 40, operations=operations)
            for options in ([], ["--explicit-cones", "0"]):
                check(data_of(script, *options), f"{operations}, seed {seed}, {options}")
    print(f"{SCRIPTS} scripts of each kind have the cells that they should have")


if __name__ == "__main__":
    main()
