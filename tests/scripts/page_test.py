#!/usr/bin/env python3
"""Runs the tests of the page that Node runs: page_test.py ROOT units | short SESAME | all SESAME.

units: each module of replay/page/src for itself. short, all: pages that the program writes, in a real browser. Exit status 77
when what they need is not here: Node, the packages (`npm ci` in replay/page), Chromium.
"""
import shutil
import subprocess
import sys
from pathlib import Path


def main(root, kind, *arguments):
    page = Path(root).resolve() / "replay" / "page"
    package = "esbuild" if kind == "units" else "playwright-core"
    if not shutil.which("node"):
        print("skipped: no Node here")
        return 77
    if not (page / "node_modules" / package).is_dir():
        print("skipped: replay/page has no node_modules; npm ci makes them")
        return 77
    command = ["test/run.mjs"]
    if kind != "units":
        command = ["test/browser.mjs", str(Path(arguments[0]).resolve()), str(page.parent / "examples"), kind]
    return subprocess.run(["node", *command], cwd=page, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
