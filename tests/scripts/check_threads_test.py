#!/usr/bin/env python3
"""The check of what classes say of threads fails on those that should say something and do not."""
import sys
import unittest

sys.dont_write_bytecode = True
import check_threads

HEADER = '''
/// Keeps what it finds.{says}
class Memo {
 public:
  int find(int n) const;

 private:
  mutable std::vector<int> found_;
};

/// Reads one.
template <class T>
class Reader final : public Base<T> {
 public:
  explicit Reader(const Memo& memo) : memo_{memo} {}
  static Memo made() { return {}; }

 private:
  const Memo& memo_;
};

struct Holder {
  std::unique_ptr<Reader<int>> reader = nullptr;  ///< one
};

/// Only a lock.
class Locked {
  mutable std::mutex mutex_;
  int n_ = 0;
};
'''


def named_in(text):
    classes = [("header", *found) for found in check_threads.classes_in(text)]
    return [line.split()[1] for line in check_threads.violations(classes)]


class CheckThreads(unittest.TestCase):
    def test_members_that_const_functions_change_and_whoever_holds_or_reads_them(self):
        self.assertEqual(named_in(HEADER.replace("{says}", "")), ["Memo", "Reader", "Holder"])

    def test_what_is_said_is_enough(self):
        self.assertEqual(named_in(HEADER.replace("{says}", "\n///\n/// Threads: one at a time.")), ["Reader", "Holder"])

    def test_all_classes_are_found(self):
        self.assertEqual([name for name, *_ in check_threads.classes_in(HEADER)],
                         ["Memo", "Reader", "Holder", "Locked"])


if __name__ == "__main__":
    unittest.main()
