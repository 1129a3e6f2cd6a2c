#!/usr/bin/env python3
"""Runs the tests of the page that Node runs: page_test.py ROOT units | browser SESAME.

units: each module of replay/page/src for itself. browser: pages that the program writes, in a real one. Exit status 77
when what they need is not here: Node, the packages (`npm ci` in replay/page), Chromium.
"""
import shutil
import subprocess
import sys
from pathlib import Path


def main(root, kind, *arguments):
    page = Path(root).resolve() / "replay" / "page"
    package = {"units": "esbuild", "browser": "playwright-core"}[kind]
    if not shutil.which("node"):
        print("skipped: no Node here")
        return 77
    if not (page / "node_modules" / package).is_dir():
        print("skipped: replay/page has no node_modules; npm ci makes them")
        return 77
    command = {"units": ["test/run.mjs"],
               "browser": ["test/browser.mjs", *(str(Path(each).resolve()) for each in arguments),
                           str(page.parent / "examples")]}[kind]
    return subprocess.run(["node", *command], cwd=page, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
