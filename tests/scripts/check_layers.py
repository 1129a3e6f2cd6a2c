#!/usr/bin/env python3
"""Checks the includes of the project: check_layers.py [ROOT].

A folder includes itself and folders to its left, tests include all, nothing includes tests. Within a folder the same
holds for its rooms. Includes of the project are quoted and written from the root; none crosses by "../". Exit status 1 and one line per violation, 2 when there is
nothing to check.
"""
import re
import sys
from pathlib import Path, PurePosixPath

ORDER = ["sparse", "reductions", "ops", "engine", "replay", "tools", "tests"]
# The rooms of a folder; "" are the files that lie in none.
ROOMS = {
    "ops": ["", "maps", "simplicial", "cells", "vocabulary", "plan"],
    "engine": ["right", "left", "towers", "zigzag", "durable", ""],
    "replay": ["text", "script", "barcode", "tower", "zigzag", "distance", "picture", "export", "page", ""],
    "tools": ["mesh", "bench", "live", "commands", ""],
}
GENERATED = {"sesame/version.hpp": "sparse"}
SUFFIXES = {".hpp", ".cpp", ".h", ".in"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def room_of(parts):
    """The room of a file, or of an include: the folder below the first one."""
    return parts[1] if len(parts) > 2 else ""


def violation_of_rooms(folder, room, target):
    """What is wrong with an include within a folder, or None."""
    rooms = ROOMS.get(folder)
    if rooms is None:
        return None
    there = room_of(target)
    for each in (room, there):
        if each not in rooms:
            return f"is of {folder}/{each}, which is no room: {', '.join(filter(None, rooms))}"
    if rooms.index(there) > rooms.index(room):
        return f"goes from {folder}/{room} to {folder}/{there}, which is to its right"
    return None


def violation(name, quoted, target):
    """What is wrong with an include of `target` in a file of this name, or None."""
    folder = name.parts[0]
    parts = PurePosixPath(target).parts
    if ".." in parts:
        return "crosses by a relative path; write it from the root"
    installed = parts[0] == "sesame" and len(parts) > 2 and parts[1] in ORDER
    owner = GENERATED.get(target) or (parts[1] if installed else parts[0])
    if owner not in ORDER:
        return "is not written from the root" if quoted else None
    if folder != "tests" and (installed or not quoted):
        return 'names the project in another way than "folder/file.hpp"'
    if ORDER.index(owner) > ORDER.index(folder):
        return f"goes from {folder} to {owner}, which is to its right"
    return violation_of_rooms(folder, room_of(name.parts), parts) if owner == folder else None


def main(root):
    files = sorted(f for folder in ORDER for f in (root / folder).rglob("*") if f.suffix in SUFFIXES and f.is_file())
    if not files:
        print(f"{root}: no source files below {', '.join(ORDER)}", file=sys.stderr)
        return 2
    found = 0
    for file in files:
        name = file.relative_to(root)
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            if include := INCLUDE.match(line):
                if wrong := violation(name, include[1] == '"', include[2]):
                    print(f"{name}:{number}: {line.strip()} {wrong}")
                    found += 1
    print(f"{len(files)} files, {found} violations of the order {' < '.join(ORDER)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()))
