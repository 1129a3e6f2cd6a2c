/// \file
/// Pictures of barcodes, as SVG files.
///
/// Every dimension has a colour of a palette for all kinds of colour vision, and in the diagram a shape as well. The
/// same barcode gives the same bytes. The size of a picture is bounded: at most 2,000 bars are drawn as lines, points
/// in the diagram that cannot be told apart are one, and curves have a few steps per pixel. Cost: O(n * log n) for n
/// bars.
#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "engine/towers/barcode.hpp"
#include "replay/barcode/barcode_files.hpp"
#include "replay/barcode/bars.hpp"

namespace sesame::replay {

/// How a great number of bars of one dimension and one length is drawn: see take_wall.
enum class Walls {
  thin,   ///< in a few lines, with their number
  whole,  ///< as other bars are
};

struct DrawingOptions {
  std::string title;                    ///< empty: the source's name, or else "Barcode"
  std::string time_name = "operation";  ///< what births and deaths count, for the axes
  BarSelection selection = {};          ///< of the bars; the Betti curves are those of all
  Walls walls = Walls::thin;
  /// The dimension of the cells of a filtration that may have been cut off there, as Rips complexes are. Nothing ends
  /// its bars: where it has two at least they are left out, of the curves too, and the picture says so. One alone is
  /// drawn; it is the class of a closed manifold as a rule.
  std::optional<int> top_dimension = std::nullopt;
};

/// All three pictures in one file: the bars, and below them the diagram beside the Betti curves.
void write_svg(std::ostream& out, const engine::Barcode& barcode, const Provenance& provenance,
               const DrawingOptions& options);

/// A line for each bar; of very many the longest, which the picture says.
void write_barcode_svg(std::ostream& out, const engine::Barcode& barcode, const Provenance& provenance,
                       const DrawingOptions& options);

/// A point for each bar, with the diagonal, and a line for those that never end.
void write_diagram_svg(std::ostream& out, const engine::Barcode& barcode, const Provenance& provenance,
                       const DrawingOptions& options);

/// Betti numbers against time.
void write_betti_svg(std::ostream& out, const engine::Barcode& barcode, const Provenance& provenance,
                     const DrawingOptions& options);

}  // namespace sesame::replay
