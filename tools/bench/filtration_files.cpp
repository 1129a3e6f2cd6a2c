#include "replay/text/text_buffer.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/filtrations.hpp"

namespace sesame::tools {
namespace {

/// Collects numbers and hands them on in large pieces; the rest when it is destroyed.
class BinaryOutput {
 public:
  explicit BinaryOutput(std::ostream& out) : out_{out} {}
  BinaryOutput(const BinaryOutput&) = delete;
  BinaryOutput& operator=(const BinaryOutput&) = delete;
  ~BinaryOutput() { hand_on(); }

  void push(std::size_t n) {
    numbers_.push_back(static_cast<std::int64_t>(n));
    if (numbers_.size() >= 1U << 13) {
      hand_on();
    }
  }

 private:
  void hand_on() {
    out_.write(reinterpret_cast<const char*>(numbers_.data()),
               static_cast<std::streamsize>(numbers_.size() * sizeof(std::int64_t)));
    numbers_.clear();
  }

  std::ostream& out_;
  std::vector<std::int64_t> numbers_;
};

}  // namespace

void write_phat(std::ostream& out, const Filtration& filtration) {
  replay::TextBuffer text(out);
  for (std::size_t i = 0; i < filtration.size(); ++i) {
    text.add_integer(unsigned{filtration.dimensions[i]});
    for (const std::uint32_t face : filtration.faces[i]) {
      text.add(' ').add_integer(face);
    }
    text.add('\n');
  }
}

void write_phat_binary(std::ostream& out, const Filtration& filtration) {
  BinaryOutput binary(out);
  binary.push(filtration.size());
  for (std::size_t i = 0; i < filtration.size(); ++i) {
    binary.push(filtration.dimensions[i]);
    binary.push(filtration.faces[i].size());
    for (const std::uint32_t face : filtration.faces[i]) {
      binary.push(face);
    }
  }
}

void write_gudhi(std::ostream& out, const Filtration& filtration) {
  sparse::expects(filtration.is_simplicial(), "only simplices are written by their vertices");
  replay::TextBuffer text(out);
  for (std::size_t i = 0; i < filtration.size(); ++i) {
    text.add_integer(unsigned{filtration.dimensions[i]});
    for (const std::uint32_t vertex : filtration.vertices[i]) {
      text.add(' ').add_integer(vertex);
    }
    text.add(' ').add_number(filtration.values[i]);
    text.add('\n');
  }
}

void write_tower(std::ostream& out, const Filtration& filtration) {
  sparse::expects(filtration.is_simplicial(), "only simplices are written by their vertices");
  replay::TextBuffer text(out);
  for (std::size_t i = 0; i < filtration.size(); ++i) {
    text.add('i');
    for (const std::uint32_t vertex : filtration.vertices[i]) {
      text.add(' ').add_integer(vertex);
    }
    text.add('\n');
  }
}

}  // namespace sesame::tools
