#include "engine/history_zigzag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/engine.hpp"
#include "engine/zigzag/space_zigzag.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {
namespace {

using ops::CellId;

/// What a step is made of: one map, or, where it replaces cells, the inclusions of the objects before and after it into
/// one with the cells of both and what lies between them. They are deformation retracts of that, so all classes live
/// on.
std::vector<ops::Operation> maps_of(const ops::Operation& operation) {
  const auto* replace = std::get_if<ops::Replace>(&operation);
  if (replace == nullptr || replace->fills || std::holds_alternative<ops::Replace::Contraction>(replace->move)) {
    return {operation};
  }
  const auto* flip = std::get_if<ops::Replace::Flip>(&replace->move);
  const std::string& cell = flip != nullptr ? flip->cell : std::get<ops::Replace::Subdivision>(replace->move).cell;
  return {ops::Replace{replace->move, true}, ops::Remove{{cell}, true}};
}

/// Two engines, a step apart, and the zigzag so far.
template <sparse::Ring R>
class HistoryZigzag {
 public:
  HistoryZigzag(R ring, const ops::Limits& limits, const RebasePolicy& rebases)
      : ring_{ring}, before_{make(limits, rebases)}, after_{make(limits, rebases)} {}

  Status apply(const NumberedStep& step) {
    const ops::Operation& operation = step.operation;
    if (std::holds_alternative<ops::Expect>(operation) || std::holds_alternative<ops::AskClass>(operation) ||
        std::holds_alternative<ops::Note>(operation)) {
      return Done{};  // these only ask
    }
    for (ops::Operation& part : maps_of(operation)) {
      if (Status applied = apply(std::move(part), step.number); !applied) {
        return applied;
      }
    }
    return Done{};
  }

  Barcode finish() {
    for (std::size_t p = 0; p < zigzags_.size(); ++p) {
      zigzags_[p].for_each_open_bar([&](std::uint64_t birth) {
        barcode_.bars.push_back({static_cast<int>(p), Time{birth}, never});
      });
    }
    std::sort(barcode_.bars.begin(), barcode_.bars.end());
    return std::move(barcode_);
  }

 private:
  using Vector = typename SpaceZigzag<R>::Vector;

  /// An operation that is a map, as part of a step.
  Status apply(ops::Operation operation, std::uint64_t step) {
    // The one that is behind does the step that the other has done, and this one.
    std::swap(before_, after_);
    if (last_) {
      if (const auto caught_up = after_->apply(*last_); !caught_up) {
        return caught_up.error();
      }
    }
    last_ = std::move(operation);
    const Result<StepReport> report = after_->apply(*last_);
    if (!report) {
      return report.error();
    }
    if (const char* reason = why_no_map(report->kind); reason != nullptr) {
      return Error{Errc::refused, fmt::format("there is no barcode: step {} {}", step, reason)};
    }
    const std::size_t degrees = std::max({before_->cells().size(), after_->cells().size(), zigzags_.size()});
    for (std::size_t p = 0; p < degrees; ++p) {
      if (p == zigzags_.size()) {
        zigzags_.emplace_back(ring_);
      }
      const int degree = static_cast<int>(p);
      const auto on_bar = [&](std::uint64_t birth, std::uint64_t death) {
        if (birth != death) {  // else it is a class between the two halves of a replacement
          barcode_.bars.push_back({degree, Time{birth}, Time{death}});
        }
      };
      if (maps_backward(report->kind)) {
        zigzags_[p].backward(
            images(degree, *after_, *before_, [&](CellId c) { return image_before(c, report->before.created); }), step,
            on_bar);
      } else {
        zigzags_[p].forward(images(degree, *before_, *after_, [&](CellId c) { return image_after(c); }),
                            betti(*after_, p), step, on_bar);
      }
    }
    return Done{};
  }

  [[nodiscard]] std::unique_ptr<Engine> make(const ops::Limits& limits, const RebasePolicy& rebases) const {
    return std::make_unique<Engine>(sparse::AnyRing{ring_}, limits, rebases);
  }
  static std::size_t betti(Engine& engine, std::size_t p) {
    const std::vector<std::int64_t> betti = engine.homology().betti;
    return p < betti.size() ? static_cast<std::size_t>(betti[p]) : 0;
  }

  // Both engines have the same cells, as far as there are any; the one after the step knows what it did to them.
  [[nodiscard]] ops::OrientedCell image_after(CellId c) const { return after_->structure().forest().find_oriented(c); }
  [[nodiscard]] ops::OrientedCell image_before(CellId c, CellId first_copy) const {
    return {c >= first_copy ? after_->structure().splits().copy(c)->source : c, 1};
  }

  /// The classes of the images of the generators that `from` has, in the generators of `to`.
  template <class Image>
  [[nodiscard]] std::vector<Vector> images(int degree, Engine& from, Engine& to, Image image_of) const {
    std::vector<Vector> images;
    const std::size_t dimension = betti(to, static_cast<std::size_t>(degree));
    for (const Generator& generator : from.generators(degree)) {
      std::map<CellId, Rational> sum;
      for (const auto& [coefficient, cell] : generator.cycle.terms) {
        const auto [image, sign] = image_of(cell);
        if (image != ops::none) {
          // Chains are written with the orientations that names stand for.
          const int agrees =
              sign * from.structure().directory().sign_of_name(cell) * to.structure().directory().sign_of_name(image);
          sum[image] += agrees > 0 ? coefficient : -coefficient;
        }
      }
      CellChain chain{degree, {}};
      for (const auto& [cell, coefficient] : sum) {
        if (!ring_.is_zero(sparse::from_rational(ring_, coefficient))) {
          chain.terms.push_back({coefficient, cell});
        }
      }
      Vector vector(dimension, ring_.zero());
      if (!chain.terms.empty()) {
        const ClassAnswer answer = to.classify(chain);
        sparse::expects(answer.is_cycle && answer.coefficients.size() == dimension,
                        "a chain map takes cycles to cycles");
        for (std::size_t k = 0; k < dimension; ++k) {
          vector[k] = sparse::from_rational(ring_, answer.coefficients[k]);
        }
      }
      images.push_back(std::move(vector));
    }
    return images;
  }

  R ring_;
  std::unique_ptr<Engine> before_, after_;
  std::optional<ops::Operation> last_;   ///< that `after_` has done, and `before_` has not
  std::vector<SpaceZigzag<R>> zigzags_;  ///< by degree
  Barcode barcode_;
};

template <sparse::Ring R>
Result<Barcode> run(R ring, const ops::Limits& limits, const RebasePolicy& rebases,
                    std::span<const NumberedStep> steps) {
  HistoryZigzag<R> zigzag(ring, limits, rebases);
  for (const NumberedStep& step : steps) {
    if (const Status applied = zigzag.apply(step); !applied) {
      return applied.error();
    }
  }
  return zigzag.finish();
}

}  // namespace

const char* why_no_map(ops::StepKind kind) {
  switch (kind) {
    case ops::StepKind::lazy_cone:
      return "is a cone over more cells than are written out, whose base's classes are no longer told apart";
    case ops::StepKind::product:
      return "is a product, which consumes the bodies before it";
    default:
      return nullptr;
  }
}

const char* why_no_map_forward(ops::StepKind kind) {
  switch (kind) {
    case ops::StepKind::split:
      return "splits cells, and so maps the object before it nowhere";
    case ops::StepKind::deletion:
      return "removes cells, and so maps the object after it into the one before";
    case ops::StepKind::replacement:
      return "replaces cells, and so maps the objects before and after it into a third one";
    default:
      return why_no_map(kind);
  }
}

Result<Barcode> barcode_of_history(const sparse::AnyRing& ring, const ops::Limits& limits, const RebasePolicy& rebases,
                                   std::span<const NumberedStep> steps) {
  return std::visit(
      [&]<class R>(const R& k) -> Result<Barcode> {
        if constexpr (R::is_field) {
          return run<R>(k, limits, rebases, steps);
        } else {
          return Error{Errc::refused, "barcodes need a field: compute over Q or Z/p, such as Z/2, instead of Z"};
        }
      },
      ring);
}

}  // namespace sesame::engine
