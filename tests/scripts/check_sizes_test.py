#!/usr/bin/env python3
"""The size check counts what it says it counts, and fails on a file and a class that are too large."""
import contextlib
import io
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
import check_sizes

SMALL = '''
/// A class; with (brackets) { in comments.
class Small final : public Base<int> {
 public:
  Small() = default;
  explicit Small(int n) : n_{n}, text_{"{;(public:"} {}
  Small& operator=(const Small&) = delete;
  [[nodiscard]] int n() const { return n_ > 0 ? f(n_) : 0; }
  template <class Visit>
  void visit(Visit&& visit) const {
    for (int k = 0; k < n_; ++k) { visit(k); }
  }
  friend bool operator==(const Small&, const Small&) = default;
  bool operator()(int a, int b) const;
  struct Inner {
    int a = 0;
    int sum() const { return a; }
  };
  int field = g(3);
  static constexpr int limit = 3;
  using Name = std::function<void(int)>;

 private:
  void hidden();
  int n_;
};
enum class Kind { one, two };
int free_function(int a);
'''


class Sizes(unittest.TestCase):
    def test_public_functions_are_counted_and_nothing_else(self):
        self.assertEqual(check_sizes.public_functions(SMALL), {"Small": 4, "Inner": 1})

    def test_what_is_too_large_is_named_and_exceptions_that_are_not_needed_too(self):
        with tempfile.TemporaryDirectory() as name:
            root = Path(name)
            (root / "ops").mkdir()
            (root / "ops" / "small.hpp").write_text(SMALL)
            check = lambda: subprocess.run([sys.executable, check_sizes.__file__, root], capture_output=True, text=True)
            self.assertNotIn("small.hpp", check().stdout)
            (root / "ops" / "long.cpp").write_text("\n" * 401)
            functions = "".join(f"  int f{k}() const;\n" for k in range(31))
            (root / "ops" / "wide.hpp").write_text(f"class Wide {{\n public:\n{functions}}};\n")
            done = check()
            self.assertEqual(done.returncode, 1)
            self.assertIn("ops/long.cpp has 401 lines, more than 400", done.stdout)
            self.assertIn("Wide has 31 public functions, more than 30", done.stdout)
            with mock.patch.dict(check_sizes.LARGE_FILES, {"ops/gone.cpp": (500, "a list"), "ops/small.hpp": (500, "?")}):
                with contextlib.redirect_stdout(io.StringIO()) as said:
                    self.assertEqual(check_sizes.main(root), 1)
            self.assertIn("ops/gone.cpp is an exception, and no file", said.getvalue())
            self.assertRegex(said.getvalue(), r"ops/small.hpp has \d+ lines and needs no exception any more")
        self.assertEqual(subprocess.run([sys.executable, check_sizes.__file__, name], capture_output=True).returncode, 2)


if __name__ == "__main__":
    unittest.main()
