#!/usr/bin/env python3
"""Checks the includes of the project: check_layers.py [ROOT].

A folder includes itself and folders to its left, tests include all, nothing includes tests. Includes of the project are
quoted and written from the root; none crosses by "../". Exit status 1 and one line per violation, 2 when there is
nothing to check.
"""
import re
import sys
from pathlib import Path, PurePosixPath

ORDER = ["sparse", "reductions", "ops", "engine", "replay", "tools", "tests"]
GENERATED = {"sesame/version.hpp": "sparse"}
SUFFIXES = {".hpp", ".cpp", ".h", ".in"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def violation(folder, quoted, target):
    """What is wrong with an include of `target` in a file of `folder`, or None."""
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
    return None


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
                if wrong := violation(name.parts[0], include[1] == '"', include[2]):
                    print(f"{name}:{number}: {line.strip()} {wrong}")
                    found += 1
    print(f"{len(files)} files, {found} violations of the order {' < '.join(ORDER)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()))
