// Calls a target once for each file: so that targets, their seeds, and what once failed stay as they should be, with
// any compiler and without libFuzzer.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "tests/fuzz/target.hpp"

namespace {

bool run(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) {
    std::cerr << "cannot read " << path << '\n';
    return false;
  }
  std::cerr << path << ", " << bytes.size() << " bytes\n";  // so that it is known what ended the program
  // A block of its own, so that a sanitizer sees what is read behind the end.
  const std::string exact(bytes.begin(), bytes.end());
  return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(exact.data()), exact.size()) == 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    std::cerr << "usage: " << arguments[0] << " FILE...: runs the target once on each file\n";
    return 1;
  }
  for (int k = 1; k < count; ++k) {
    if (!run(arguments[k])) {
      return 1;
    }
  }
  return 0;
}
