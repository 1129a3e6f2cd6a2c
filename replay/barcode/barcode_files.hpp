/// \file
/// Barcodes in files: `.pers`, JSON, and Betti numbers against time as CSV.
///
/// All numbers are written as a short text that reads back as the same time, and the same barcode gives the same
/// bytes (but for the seconds in JSON).
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

#include "engine/towers/barcode.hpp"
#include "replay/text/byte_source.hpp"
#include "replay/text/text_buffer.hpp"
#include "replay/text/time_reader.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// Where a barcode comes from; goes, with the version of sesame and the number of hidden bars, into every output.
struct Provenance {
  std::string ring;                            ///< as people write it: "Z/2"
  std::uint64_t operations = 0;                ///< that made the barcode
  std::string source;                          ///< the name of the input; may be empty
  std::string format = {};                     ///< as options name it; empty when it is not known
  std::uint64_t added_faces = 0, already = 0;  ///< see FaceAdder
  std::optional<int> max_dimension = {};       ///< bars above it have not been asked for
};

/// "sesame 0.1.0, coefficients Z/2, 12 operations, 3 bars of length 0 left out, from torus.tower": one line, UTF-8.
[[nodiscard]] std::string provenance_line(const engine::Barcode& barcode, const Provenance& provenance);

/// Writes lines `dim birth death`, `inf` for the death of an essential class, as bars come, between two comment lines:
/// the first says where they come from, the last how many operations there were. GUDHI reads it too.
class PersWriter {
 public:
  PersWriter(std::ostream& out, const std::string& ring, const std::string& source);
  void add(const engine::Bar& bar);
  /// After the last bar.
  void finish(std::uint64_t operations, std::uint64_t hidden);

 private:
  TextBuffer text_;
};

/// The same for a barcode, in order.
void write_pers(std::ostream& out, const engine::Barcode& barcode, const Provenance& provenance);

/// The fields of a JSON object, without the braces: ring, ops, bars ([dim,birth,death], death null when essential),
/// hidden, source, format (when it is known), added_faces and already (when there are some), max_dim (when there
/// is one) and version.
void add_barcode_fields(TextBuffer& text, const engine::Barcode& barcode, const Provenance& provenance);

/// The fields that say how an input was read: format, added_faces, already, max_dim. Each begins with a comma.
void add_reading_fields(TextBuffer& text, const Provenance& provenance);

/// The header `time,b0,b1,...` and a row for each time at which a Betti number changes; see for_each_betti_change.
void write_betti_csv(std::ostream& out, const engine::Barcode& barcode);

/// What a `.pers` file says.
struct PersFile {
  engine::Barcode barcode;     ///< bars of length 0 are only counted
  bool has_dimensions = true;  ///< false: the lines have no dimension, and it is 0 in all bars
};

/// No bar that is read has a larger dimension; a file that says so is no barcode.
inline constexpr int largest_dimension_read = 1000;

/// Reads lines `[[field] dimension] birth death`, as GUDHI writes them too: 2, 3 or 4 numbers, the same count and the
/// same field on all lines; `inf`, `Inf`, `infinity` for the death of an essential class; comments after `#`; line ends
/// \n or \r\n. Lines may stand in any order. What `sesame tower --json` prints and Ripser's text are known by their
/// first line, and read too: see barcode_dialects.hpp.
/// `times`: of this file and of those with which it will be compared.
/// Errors: `NAME:LINE: what, and what would be right` (bad_input); those of the source.
[[nodiscard]] Result<PersFile> read_pers(ByteSource source, TimeReader& times);

}  // namespace sesame::replay
