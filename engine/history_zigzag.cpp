#include "engine/history_zigzag.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/history_audit.hpp"
#include "engine/history_maps.hpp"
#include "engine/history_names.hpp"
#include "engine/history_twins.hpp"
#include "engine/zigzag/open_chains.hpp"
#include "engine/zigzag/space_zigzag.hpp"

namespace sesame::engine {
namespace {

constexpr std::uint64_t no_map = UINT64_MAX;  ///< ends a bar that is open

/// The zigzag so far, by the numbers of its maps.
template <sparse::Ring R>
class HistoryZigzag {
 public:
  HistoryZigzag(R ring, const ops::Limits& limits, const RebasePolicy& rebases, const HistoryOptions& options)
      : ring_{ring}, options_{options}, twins_{ring, limits, rebases} {}

  Status apply(const NumberedStep& step) {
    const ops::Operation& operation = step.operation;
    if (std::holds_alternative<ops::Expect>(operation) || std::holds_alternative<ops::AskClass>(operation) ||
        std::holds_alternative<ops::Note>(operation)) {
      return Done{};  // these only ask
    }
    for (ops::Operation& part : maps_of(operation)) {
      if (Status applied = twins_.apply(std::move(part), step.number); !applied) {
        return applied;
      }
      maps_.push_back(twins_.map());
      for (std::size_t p = 0; p < twins_.degrees(); ++p) {
        follow(p);
      }
    }
    return Done{};
  }

  /// Errors: law_broken, when something is wrong and that was asked for.
  Result<Barcode> finish() {
    for (std::size_t p = 0; p < degrees_.size(); ++p) {
      std::size_t place = 0;
      degrees_[p].zigzag.for_each_open_bar([&](std::uint64_t birth) {
        const bool has_chains = degrees_[p].chains.has_value();
        add(p, birth, no_map, has_chains ? degrees_[p].chains->pieces(place, birth) : Pieces{});
        ++place;
      });
    }
    std::sort(barcode_.bars.begin(), barcode_.bars.end());
    if (options_.verifies) {
      if (const auto defect = first_wrong_bar(ring_, twins_.structure(), maps_, checked_, options_.stop)) {
        return Error{Errc::law_broken, "the barcode of the history is wrong: " + *defect + "; this is a bug"};
      }
    }
    return std::move(barcode_);
  }

 private:
  using Zigzag = SpaceZigzag<R>;
  using Chain = sparse::Terms<R, ops::CellId>;
  using Pieces = std::vector<ChainPiece<R>>;

  struct Degree {
    Zigzag zigzag;
    std::optional<OpenChains<R>> chains;  ///< where there are cycles
  };

  /// Takes in the last map, in one degree.
  void follow(std::size_t p) {
    if (p == degrees_.size()) {
      const bool has_chains = options_.verifies || wants(p);
      degrees_.push_back({Zigzag{ring_}, has_chains ? std::optional{OpenChains<R>{ring_}} : std::nullopt});
    }
    Zigzag& zigzag = degrees_[p].zigzag;
    const std::uint64_t now = maps_.size() - 1;
    const bool is_backward = maps_backward(maps_.back().kind);
    const typename Zigzag::Images images = twins_.images(p);
    const typename Zigzag::Passage passage =
        is_backward ? zigzag.backward(images, now) : zigzag.forward(images, twins_.betti(p), now);
    if (!degrees_[p].chains) {
      for (const auto& place : passage.ended) {
        add(p, place.birth, now, {});
      }
      return;
    }
    degrees_[p].chains->follow(
        passage, now, [&](std::size_t place) { return twins_.chain_of(p, zigzag.vector(place)); },
        [&](std::size_t place, const Chain& chain) {
          return is_backward ? preimage(p, place, chain) : twins_.image(chain);
        },
        [&](std::uint64_t birth, Pieces pieces) { add(p, birth, now, std::move(pieces)); });
  }

  /// What a chain becomes that a map leads back to. Where it is a cycle of the new object, too, it is sent to itself,
  /// as the map does something to copies only; so its class may be the vector.
  Chain preimage(std::size_t p, std::size_t place, const Chain& chain) {
    if (auto vector = twins_.class_after(p, chain)) {
      degrees_[p].zigzag.change_vector(place, std::move(*vector));
      return chain;
    }
    return twins_.chain_of(p, degrees_[p].zigzag.vector(place));
  }

  [[nodiscard]] bool wants(std::size_t p) const { return options_.wants && options_.wants(static_cast<int>(p)); }

  void add(std::size_t p, std::uint64_t birth, std::uint64_t death, Pieces pieces) {
    const auto time = [&](std::uint64_t map) { return map == no_map ? never : Time{maps_[map].step}; };
    const Bar bar{static_cast<int>(p), time(birth), time(death)};
    if (bar.birth != bar.death) {  // else it is a class between the two halves of a replacement
      barcode_.bars.push_back(bar);
      if (wants(p) && options_.on_cycles) {
        options_.on_cycles(bar, [&] { return named_cycles(ring_, twins_.structure(), maps_, bar, pieces); });
      }
    }
    if (options_.verifies) {
      checked_.push_back({bar.dimension, birth, death, std::move(pieces)});
    }
  }

  R ring_;
  const HistoryOptions& options_;
  HistoryTwins<R> twins_;
  std::vector<HistoryMap> maps_;
  std::vector<Degree> degrees_;
  Barcode barcode_;
  std::vector<ChainBar<R>> checked_;
};

template <sparse::Ring R>
Result<Barcode> run(R ring, const ops::Limits& limits, const RebasePolicy& rebases, std::span<const NumberedStep> steps,
                    const HistoryOptions& options) {
  HistoryZigzag<R> zigzag(ring, limits, rebases, options);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (options.stop != nullptr && options.stop->load()) {
      if (options.stopped_after != nullptr) {
        *options.stopped_after = k > 0 ? steps[k - 1].number : 0;
      }
      break;
    }
    if (const Status applied = zigzag.apply(steps[k]); !applied) {
      return applied.error();
    }
  }
  return zigzag.finish();
}

}  // namespace

Result<Barcode> barcode_of_history(const sparse::AnyRing& ring, const ops::Limits& limits, const RebasePolicy& rebases,
                                   std::span<const NumberedStep> steps, const HistoryOptions& options) {
  return std::visit(
      [&]<class R>(const R& k) -> Result<Barcode> {
        if constexpr (R::is_field) {
          return run<R>(k, limits, rebases, steps, options);
        } else {
          return Error{Errc::refused, "barcodes need a field: compute over Q or Z/p, such as Z/2, instead of Z"};
        }
      },
      ring);
}

}  // namespace sesame::engine
