#include "engine/zigzag/deferred_zigzag.hpp"

namespace sesame::engine {
namespace {

/// So many inclusions are remembered for each cell of the largest complex so far.
constexpr std::size_t most_generations = 40;

}  // namespace

void DeferredZigzag::include(int dimension, Slot slot, std::span<const Slot> facets, Moment moment) {
  if (online_) {
    online_->include(dimension, slot, facets, moment);
    return;
  }
  offline_->include(dimension, slot, facets, moment);
  if (offline_->inclusions() > most_generations * offline_->most_present()) {
    go_online();
  }
}

void DeferredZigzag::exclude(int dimension, Slot slot, Moment moment) {
  if (online_) {
    online_->exclude(dimension, slot, moment);
  } else {
    offline_->exclude(dimension, slot, moment);
  }
}

void DeferredZigzag::finish() {
  if (online_) {
    online_->for_each_open_bar(on_bar_);
  } else {
    offline_->for_each_bar(ring_, on_bar_);
  }
}

void DeferredZigzag::go_online() {
  online_ = make_online_zigzag_barcode(ring_, on_bar_);
  offline_->tell(*online_);
  offline_.reset();
}

}  // namespace sesame::engine
