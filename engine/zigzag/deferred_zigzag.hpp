/// \file
/// The barcode of a zigzag that is asked for at its end.
#pragma once

#include <memory>
#include <utility>

#include "engine/zigzag/offline_zigzag.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"

namespace sesame::engine {

/// Finds the barcode of a zigzag of which nobody wants to know anything on the way, in the way that is quicker.
///
/// The filtration of OfflineZigzag has two cells for each that has been there, however long ago; it is reduced in the
/// end. When there have been many times as many cells as were ever there at once, all is handed over to an online
/// barcode, which follows the rest: so memory is that of the present complex, but for a factor.
class DeferredZigzag final : public ZigzagTracker {
 public:
  /// Requires: the ring is a field.
  DeferredZigzag(const sparse::AnyRing& ring, ZigzagBarcode::OnBar on_bar) : ring_{ring}, on_bar_{std::move(on_bar)} {}

  void include(int dimension, Slot slot, std::span<const Slot> facets, Moment moment) override;
  void exclude(int dimension, Slot slot, Moment moment) override;
  /// Visits all bars that have not been visited, those that end by the order of their deaths, then the others; the last
  /// call.
  void finish();

  [[nodiscard]] bool is_online() const { return online_ != nullptr; }

 private:
  void go_online();

  sparse::AnyRing ring_;
  ZigzagBarcode::OnBar on_bar_;
  std::unique_ptr<OfflineZigzag> offline_ = std::make_unique<OfflineZigzag>();  ///< null when the other is there
  std::unique_ptr<ZigzagBarcode> online_;
};

}  // namespace sesame::engine
