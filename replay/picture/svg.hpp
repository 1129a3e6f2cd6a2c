/// \file
/// Pieces of SVG: escaped text, coordinates, the colours and shapes of the dimensions.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sesame::replay {

/// With entities for what XML and HTML reserve, and U+FFFD for what is not UTF-8 or not allowed in XML.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// A coordinate in pixels, to a hundredth.
[[nodiscard]] std::string px(double x);

/// "1,234,567".
[[nodiscard]] std::string with_separators(std::uint64_t n);

/// About the width of a text in a sans-serif font, rather too much than too little.
[[nodiscard]] double text_width(std::string_view text, double font_size);

/// The text, or, when it is wider than that, as much of its end as fits.
[[nodiscard]] std::string fitted(std::string_view text, double width, double font_size);

enum class Anchor { start, middle, end };

/// The font size of tick labels, legends and everything that is not a title.
inline constexpr double small_text = 11;
/// That of the titles of panels.
inline constexpr double panel_title = 13;

/// Content of an SVG picture as it grows. Colours are classes: `fK` fills and `sK` strokes with the colour of dimension
/// K (modulo the number of colours); the page around the picture may redefine them.
class Svg {
 public:
  Svg& raw(std::string_view markup) {
    markup_ += markup;
    return *this;
  }
  Svg& line(double x1, double y1, double x2, double y2, std::string_view css_class);
  /// `y` is that of the base line.
  Svg& text(double x, double y, Anchor anchor, std::string_view css_class, std::string_view text);
  /// A symbol for a dimension, of about the radius given: circle, square, triangle, diamond in turn. `title` is shown
  /// when the mouse rests on it; empty: none.
  Svg& symbol(double x, double y, double radius, int dimension, std::string_view title);

  [[nodiscard]] const std::string& markup() const { return markup_; }

 private:
  std::string markup_;
};

/// The classes for the colour of a dimension: "f3", "s3".
[[nodiscard]] std::string fill_class(int dimension);
[[nodiscard]] std::string stroke_class(int dimension);

/// Style rules for all classes, on white paper; `dark` instead for light ink on dark paper.
[[nodiscard]] std::string svg_style(bool dark);

}  // namespace sesame::replay
