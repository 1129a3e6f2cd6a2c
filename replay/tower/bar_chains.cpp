#include "replay/tower/bar_chains.hpp"

namespace sesame::replay {

BarChainNamer::BarChainNamer(engine::BarcodeTracker& tracker, const TowerHistory& history, std::uint64_t operations)
    : cycles_{*tracker.cycles()},
      history_{history},
      operations_{operations},
      characteristic_{std::visit([](const auto& ring) { return ring.characteristic(); }, tracker.ring())} {}

std::uint64_t BarChainNamer::moment_of_birth(const engine::BarCycles::TracedBar& traced) const {
  return cycles_.last_operation_with(traced.born_by);
}

std::uint64_t BarChainNamer::moment_of_death(const engine::BarCycles::TracedBar& traced) const {
  return traced.bar.death == engine::never ? operations_ - 1 : cycles_.last_operation_with(traced.killed_by);
}

BarChains BarChainNamer::chains(const engine::BarCycles::TracedBar& traced) const {
  const engine::InclusionChain cycle = cycles_.cycle(traced);
  const engine::InclusionChain second = traced.bar.death == engine::never ? cycle : cycles_.bounded_chain(traced);
  return {history_.image(cycle, moment_of_birth(traced), characteristic_),
          history_.image(second, moment_of_death(traced), characteristic_)};
}

}  // namespace sesame::replay
