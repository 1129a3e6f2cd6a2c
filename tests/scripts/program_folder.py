"""A folder in which the program runs, for the tests of logs and limits."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SESAME = os.path.abspath(sys.argv[1])
HEADER = '{"sesame":1,"ring":"Z","title":"test"}\n'


def simplex(name, dim=0):
    return '{"op":"simplex","name":"%s","dim":%d}\n' % (name, dim)


class ProgramFolder(unittest.TestCase):
    SECONDS = 300

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.log = self.folder / "log"

    def run_in(self, *arguments, text=None, **options):
        if text is None:
            options.setdefault("stdin", subprocess.DEVNULL)
        return subprocess.run([SESAME, *map(str, arguments)], capture_output=True, text=True, timeout=self.SECONDS,
                              input=text, check=False, cwd=self.folder, **options)
