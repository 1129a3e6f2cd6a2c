#!/usr/bin/env python3
"""The layer check fails on every kind of violation, planted in an otherwise clean tree, and names file and line."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).with_name("check_layers.py")
CLEAN = {
    "sparse/ring.hpp": "#pragma once\n#include <vector>\n",
    "ops/step.hpp": '#pragma once\n#include "sparse/ring.hpp"\n#include "sesame/version.hpp"\n',
    "ops/step.cpp": '#include "ops/step.hpp"\n#include <boost/graph/adjacency_list.hpp>\n',
    "tools/main.cpp": '#include "ops/step.hpp"\n',
    "tests/ops/step_test.cpp": '#include "tests/support/catch.hpp"\n#include "tools/bench/bench.hpp"\n',
    "tests/scripts/consumer/main.cpp": "#include <sesame/ops/step.hpp>\n",
}
PLANTED = [  # file, line, what the message says
    ("sparse/bad.cpp", '#include "reductions/reduction.hpp"', "from sparse to reductions"),
    ("reductions/bad.hpp", '#include "engine/engine.hpp"', "from reductions to engine"),
    ("ops/deep/er/bad.hpp", '#include "replay/reader.hpp"', "from ops to replay"),
    ("replay/bad.cpp", '  #  include "tools/import.hpp"', "from replay to tools"),
    ("tools/bad.cpp", '#include "tests/support/catch.hpp"', "from tools to tests"),
    ("sparse/bad.hpp.in", '#include "ops/step.hpp"', "from sparse to ops"),
    ("ops/cells/bad.hpp", '#include "ops/plan/planner.hpp"', "from ops/cells to ops/plan"),
    ("ops/bad.cpp", '#include "ops/plan/planner.hpp"', "from ops/ to ops/plan"),
    ("engine/left/bad.cpp", '#include "engine/engine.hpp"', "from engine/left to engine/"),
    ("ops/things/bad.hpp", '#include "ops/ids.hpp"', "is no room"),
    ("ops/bad.cpp", '#include "../sparse/ring.hpp"', "relative path"),
    ("tests/ops/bad.cpp", '#include "../../ops/step.hpp"', "relative path"),
    ("ops/bad.cpp", '#include "step.hpp"', "not written from the root"),
    ("ops/bad.cpp", "#include <sparse/ring.hpp>", "in another way"),
    ("sparse/bad.cpp", "#include <sesame/ops/step.hpp>", "in another way"),
]


class CheckLayers(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.root = Path(directory.name)

    def write(self, files):
        for name, text in files.items():
            file = self.root / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")

    def check(self):
        return subprocess.run([sys.executable, CHECK, self.root], capture_output=True, text=True)

    def test_a_clean_tree_passes(self):
        self.write(CLEAN)
        done = self.check()
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_tree_without_sources_is_an_error(self):
        self.assertEqual(self.check().returncode, 2)

    def test_each_planted_violation_is_found_and_only_that(self):
        for name, line, message in PLANTED:
            with self.subTest(name=name, line=line):
                self.write({**CLEAN, name: f"#pragma once\n{line}\n"})
                done = self.check()
                (self.root / name).unlink()
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertRegex(done.stdout, f"^{name}:2: .*{message}")
                self.assertIn(" 1 violations", done.stdout)


if __name__ == "__main__":
    unittest.main()
