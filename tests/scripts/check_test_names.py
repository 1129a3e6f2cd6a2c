#!/usr/bin/env python3
"""Fails when a test has a name that CMake or Catch2 would take apart: such tests are run wrongly or not at all.

Usage: check_test_names.py ROOT
"""

import pathlib
import re
import sys

CASE = re.compile(r'TEST_CASE(?:_METHOD)?\(\s*"((?:[^"\\]|\\.)*)"|TEMPLATE_(?:LIST_)?TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"')


def main(root):
    names, wrong = 0, []
    for path in sorted((pathlib.Path(root) / "tests").rglob("*.cpp")):
        for match in CASE.finditer(path.read_text(encoding="utf-8")):
            name = match.group(1) or match.group(2)
            names += 1
            if re.search(r'[\[\];\\"*]', name) or name.startswith("-") or name != name.strip():
                wrong.append(f"{path}: \"{name}\" has one of [ ] ; \\ * or begins with -: ctest would take it apart")
    print("\n".join(wrong) if wrong else f"{names} test names are fine")
    return 1 if wrong or names == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
