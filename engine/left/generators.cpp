#include "engine/left/generators.hpp"

namespace sesame::engine {

ops::BodyId Generators::body_of(GeneratorId generator) const {
  if (is_removal(generator) || is_deletion(generator)) {
    return structure_.body_of(structure_.forest().removed(LinkId{origin_[generator]}));
  }
  if (is_of_family(generator)) {
    return structure_.bodies().find(structure_.lazy().family(family(generator)).body);
  }
  return structure_.body_of(cell(generator));
}

GeneratorId Generators::append(Kind kind, std::uint32_t origin, int degree) {
  origin_.push_back(origin);
  kind_and_degree_.push_back(
      static_cast<std::uint8_t>(static_cast<unsigned>(kind) << degree_bits |
                                static_cast<unsigned>(kind == Kind::deletion ? degree + 1 : degree)));
  if (degree >= static_cast<int>(counts_.size())) {
    counts_.resize(static_cast<std::size_t>(degree) + 1, 0);
  }
  if (degree >= 0) {
    ++counts_[static_cast<std::size_t>(degree)];
  }
  return size() - 1;
}

void Generators::truncate(const Mark& mark) {
  while (size() > mark.generators) {
    if (const int p = degree(size() - 1); p >= 0) {
      --counts_[static_cast<std::size_t>(p)];
    }
    origin_.pop_back();
    kind_and_degree_.pop_back();
  }
  while (!counts_.empty() && counts_.back() == 0) {
    counts_.pop_back();
  }
  of_cell_.resize(mark.cells - window_.begin().created);
  of_link_.resize(mark.links - window_.begin().links);
}

}  // namespace sesame::engine
