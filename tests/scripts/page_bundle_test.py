#!/usr/bin/env python3
"""The page that is built into the program is the one that its sources make: page_bundle_test.py ROOT [CMAKE_SOURCE].

The bundle names the hash of the sources that it was made from, which is compared with theirs. Where Node and the packages
of replay/page are there it is made anew, too, and compared byte by byte. With the second argument, the source of C++ that
CMake made of it, the pieces in that are put together again.
"""
import hashlib
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
PAGE = ROOT / "replay" / "page"
EMBEDDED = Path(sys.argv[2]) if len(sys.argv) > 2 else None
AGAIN = "run `npm ci && node build.mjs` in replay/page, and commit the bundle with the sources"
LIMIT = 2_000_000


def hash_of_sources():
    """As build.mjs reckons it."""
    names = ["build.mjs", "package.json", "package-lock.json", "tsconfig.json",
             *sorted(str(path.relative_to(PAGE)) for path in (PAGE / "src").rglob("*") if path.is_file())]
    found = hashlib.sha256()
    for name in names:
        found.update(f"{name}\n".encode() + (PAGE / name).read_bytes())
    return found.hexdigest()


class Bundle(unittest.TestCase):
    def setUp(self):
        self.bundle = (PAGE / "bundle" / "page.html").read_text(encoding="ascii")

    def test_it_was_made_from_the_sources_as_they_are(self):
        self.assertEqual(re.search(r"<!-- sources ([0-9a-f]{64}) -->", self.bundle)[1], hash_of_sources(), AGAIN)

    def test_making_it_again_gives_the_same(self):
        if not shutil.which("node") or not (PAGE / "node_modules" / "esbuild").is_dir():
            self.skipTest("no Node, or no node_modules in replay/page")
        again = subprocess.run(["node", "build.mjs", "--stdout"], cwd=PAGE, capture_output=True, text=True, check=True)
        self.assertTrue(again.stdout == self.bundle, AGAIN)

    def test_it_needs_nothing_else_and_says_whose_it_is(self):
        self.assertLess(len(self.bundle), LIMIT)
        self.assertIn("default-src 'none'", self.bundle)
        self.assertNotRegex(self.bundle, r"<(?:script|img|iframe)[^>]* src=|<link")
        self.assertIn("The MIT License", self.bundle)
        self.assertIn("three.js authors", self.bundle)
        self.assertEqual(self.bundle.count("@SESAME_PAGE_DATA@"), 1)

    def test_the_program_has_it_whole(self):
        if EMBEDDED is None:
            self.skipTest("no source of C++ was named")
        pieces = re.findall(r'R"sesame_page\((.*?)\)sesame_page"', EMBEDDED.read_text(encoding="ascii"), re.S)
        self.assertTrue("".join(pieces) == self.bundle)
        self.assertTrue(all(len(piece) <= 65536 for piece in pieces))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
