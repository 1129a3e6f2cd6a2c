/// \file
/// Random insertions and collapses, beside the plainest thing that can follow them: sets of sets of labels.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::tests {

inline ops::Operation insert(const std::vector<std::string>& labels) { return ops::Insert{{labels}}; }
inline ops::Operation collapse(const std::string& from, const std::string& to) { return ops::Collapse{from, to}; }

/// An abstract simplicial complex as the set of its simplices.
struct SetComplex {
  std::set<std::set<std::string>> simplices;
  std::set<std::string> dead;  ///< labels that were collapsed away

  void insert(const std::vector<std::string>& labels) {
    for (std::uint64_t subset = 1; subset < std::uint64_t{1} << labels.size(); ++subset) {
      std::set<std::string> face;
      for (std::size_t k = 0; k < labels.size(); ++k) {
        if ((subset >> k & 1) != 0) {
          face.insert(labels[k]);
        }
      }
      simplices.insert(face);
    }
  }
  void collapse(const std::string& from, const std::string& to) {
    std::set<std::set<std::string>> image;
    for (std::set<std::string> simplex : simplices) {
      if (simplex.erase(from) > 0) {
        simplex.insert(to);
      }
      image.insert(simplex);
    }
    simplices = std::move(image);
    dead.insert(from);
  }
  [[nodiscard]] std::vector<std::string> labels() const {
    std::vector<std::string> labels;
    for (const auto& simplex : simplices) {
      if (simplex.size() == 1) {
        labels.push_back(*simplex.begin());
      }
    }
    return labels;
  }
  [[nodiscard]] std::vector<std::uint64_t> counts() const {
    std::vector<std::uint64_t> counts;
    for (const auto& simplex : simplices) {
      counts.resize(std::max(counts.size(), simplex.size()));
      ++counts[simplex.size() - 1];
    }
    return counts;
  }
};

/// A stream of legal insertions and collapses of any two vertices. Same seed, same stream.
class RandomAbstractSteps {
 public:
  RandomAbstractSteps(unsigned seed, int vertices, int dimension, int one_collapse_in = 3)
      : random_{seed}, vertices_{vertices}, dimension_{dimension}, one_collapse_in_{one_collapse_in} {}

  [[nodiscard]] const SetComplex& complex() const { return complex_; }
  /// After an undo of the last steps that this stream made.
  void go_back_to(const SetComplex& complex) { complex_ = complex; }

  ops::Operation next() {
    const std::vector<std::string> live = complex_.labels();
    if (live.size() > 2 && random_.one_in(one_collapse_in_)) {
      const std::string u = any_of(live);
      const std::string v = any_of(live);
      if (u != v) {
        complex_.collapse(u, v);
        return tests::collapse(u, v);
      }
    }
    while (true) {
      std::set<std::string> simplex;
      const auto size = static_cast<std::size_t>(random_.in(1, dimension_ + 1));
      while (simplex.size() < size) {
        const bool is_new = live.empty() || (static_cast<int>(live.size()) < vertices_ && random_.one_in(3));
        simplex.insert(is_new || live.size() < size ? std::to_string(next_label_++) : any_of(live));
      }
      if (!complex_.simplices.contains(simplex)) {
        const std::vector<std::string> labels(simplex.begin(), simplex.end());
        complex_.insert(labels);
        return tests::insert(labels);
      }
    }
  }

 private:
  const std::string& any_of(const std::vector<std::string>& labels) {
    return labels[static_cast<std::size_t>(random_.in(0, static_cast<int>(labels.size()) - 1))];
  }

  Random random_;
  SetComplex complex_;
  int vertices_, dimension_, one_collapse_in_;
  int next_label_ = 0;
};

/// The ten triangles of the projective plane on six vertices.
inline std::vector<std::vector<std::string>> projective_plane() {
  return {{"1", "2", "3"}, {"1", "2", "4"}, {"1", "3", "5"}, {"1", "4", "6"}, {"1", "5", "6"},
          {"2", "3", "6"}, {"2", "4", "5"}, {"2", "5", "6"}, {"3", "4", "5"}, {"3", "4", "6"}};
}

}  // namespace sesame::tests
