/// \file
/// The published method: every map of the equivalence a matrix, kept current at every step.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reductions/equivalence.hpp"
#include "tools/bench/eager_equivalence.hpp"
#include "tools/bench/method.hpp"

namespace sesame::tools {

/// Reads the exact sequence of each step off the cells that it touches and applies the theorem to the matrices.
///
/// Takes construction steps but products, which the published method leaves open; and, when only what the small
/// complex needs is kept, no de-identifications, whose formulas need gS and hS. An undo does what is left of the
/// construction once more: matrices changed in place cannot be changed back.
///
/// Counts    `entries_touched` by additions and products, `entries_held` by all matrices now.
template <sparse::Ring R>
class EagerMethod final : public Method {
 public:
  EagerMethod(R ring, Keep keep) : ring_{ring}, keep_{keep}, equivalence_{ring, keep} {}

  Status apply(const ops::Operation& operation) override;
  engine::Homology homology() override { return equivalence_.homology(object_.structure().counts().size()); }
  /// Nothing, when only what the small complex needs is kept.
  std::uint64_t generators() override { return keep_ == Keep::all_maps ? equivalence_.map_generators() : 0; }
  [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> counts() const override;

  /// All of the equivalence. Requires: all maps are kept. Cost: its size.
  [[nodiscard]] reductions::Equivalence<R> matrices() const;

 private:
  using Terms = sparse::Terms<R>;
  using Index = sparse::Index;

  Status construct(const ops::Operation& operation);
  Status take_back(std::uint64_t steps);
  [[nodiscard]] Status check() const;
  void add_cells();
  void remove_cells();
  void split_cells();
  [[nodiscard]] Terms boundary(ops::CellId cell, const ops::Moment& moment) const;

  R ring_;
  Keep keep_;
  ops::Workspace object_{written_out};
  EagerEquivalence<R> equivalence_;
  std::vector<ops::Operation> done_;       ///< the steps that are not undone
  std::uint64_t touched_before_undo_ = 0;  ///< entries, by matrices that are no more
};

/// Every map a matrix.
[[nodiscard]] std::unique_ptr<Method> make_eager_method(const sparse::AnyRing& ring);
/// Only the maps from which the next small complex is computed: generators cannot be mapped back.
[[nodiscard]] std::unique_ptr<Method> make_small_eager_method(const sparse::AnyRing& ring);

}  // namespace sesame::tools
