#include "tools/bench/recompute_method.hpp"

#include <variant>

#include "reductions/homology.hpp"
#include "tools/bench/present_complex.hpp"

namespace sesame::tools {
namespace {

template <sparse::Ring R>
class RecomputeMethod final : public Method {
 public:
  explicit RecomputeMethod(R ring) : ring_{ring} {}

  Status apply(const ops::Operation& operation) override {
    if (const auto* undo = std::get_if<ops::Undo>(&operation)) {
      complex_.begin_again();
      return object_.take_back(undo->steps);
    }
    if (Status planned = object_.plan(operation); !planned) {
      return planned;
    }
    object_.carry_out();
    return Done{};
  }

  /// There is neither a small nor a big complex: both sizes are those of the object.
  engine::Homology homology() override {
    const auto groups = reductions::homology_groups(matrices());
    engine::Homology homology;
    for (std::size_t p = 0; p < object_.structure().counts().size(); ++p) {
      const auto cells = static_cast<std::uint32_t>(object_.structure().counts()[p]);
      homology.betti.push_back(groups[p].rank);
      homology.torsion.push_back(groups[p].torsion);
      homology.small.push_back(cells);
      homology.big.push_back(cells);
    }
    return homology;
  }

  std::uint64_t generators() override {
    std::uint64_t terms = 0;
    for (const auto& group : reductions::homology(matrices())) {
      for (const auto& generator : group.generators) {
        terms += generator.cycle.terms().size();
      }
    }
    return terms;
  }

  [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> counts() const override {
    return {{"cells_read", complex_.cells_read()}, {"matrix_entries", matrix_entries_}};
  }

 private:
  reductions::ChainComplex<R> matrices() {
    auto complex = complex_.matrices(ring_);
    for (int p = 1; p <= complex.top(); ++p) {
      matrix_entries_ += complex.boundary(p).nonzeros();
    }
    return complex;
  }

  R ring_;
  ops::Workspace object_{written_out};
  PresentComplex complex_{object_.structure()};
  std::uint64_t matrix_entries_ = 0;
};

}  // namespace

std::unique_ptr<Method> make_recompute_method(const sparse::AnyRing& ring) {
  return std::visit(
      []<sparse::Ring R>(const R& r) -> std::unique_ptr<Method> { return std::make_unique<RecomputeMethod<R>>(r); },
      ring);
}

}  // namespace sesame::tools
