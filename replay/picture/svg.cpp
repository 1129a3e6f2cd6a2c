#include "replay/picture/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

/// The palette of Okabe and Ito ("Color universal design", 2008), which people of every kind of colour vision can tell
/// apart. Yellow, hard to see on white, comes last; black is made white on dark paper.
constexpr std::array<std::string_view, 8> colours{"#0072B2", "#E69F00", "#009E73", "#D55E00",
                                                  "#CC79A7", "#56B4E9", "#000000", "#F0E442"};
constexpr std::array<std::string_view, 8> colours_on_dark{"#3D9BDB", "#E69F00", "#1DBF92", "#E8743B",
                                                          "#DB95BB", "#7CC7F0", "#FFFFFF", "#F0E442"};

std::size_t colour_of(int dimension) { return static_cast<std::size_t>(dimension) % colours.size(); }

std::string valid_utf8(std::string_view text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : valid_utf8(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        const bool is_control = (c >= '\0' && c < ' ') || c == '\x7f';
        is_control ? escaped += "\uFFFD" : escaped += c;
    }
  }
  return escaped;
}

std::string px(double x) { return number_text(std::round(x * 100) / 100); }

std::string with_separators(std::uint64_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t end = digits.size(); end > 3; end -= 3) {
    digits.insert(end - 3, ",");
  }
  return digits;
}

double text_width(std::string_view text, double font_size) {
  const auto is_start = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };  // of a code point
  return 0.64 * font_size * static_cast<double>(std::count_if(text.begin(), text.end(), is_start));
}

std::string fitted(std::string_view text, double width, double font_size) {
  if (text_width(text, font_size) <= width) {
    return std::string{text};
  }
  const double room =
      std::max(0.0, std::floor(width / text_width("x", font_size)) - 1);  // a character is a byte or more
  std::size_t start = text.size() - std::min(text.size(), static_cast<std::size_t>(room));
  while (start < text.size() && (static_cast<unsigned char>(text[start]) & 0xC0U) == 0x80U) {
    ++start;  // not inside a character
  }
  return "\u2026" + std::string{text.substr(start)};
}

Svg& Svg::line(double x1, double y1, double x2, double y2, std::string_view css_class) {
  fmt::format_to(std::back_inserter(markup_),
                 R"(<line class="{}" x1="{}" y1="{}" x2="{}" y2="{}"/>)"
                 "\n",
                 css_class, px(x1), px(y1), px(x2), px(y2));
  return *this;
}

Svg& Svg::text(double x, double y, Anchor anchor, std::string_view css_class, std::string_view text) {
  const char* const side = anchor == Anchor::start ? "" : anchor == Anchor::middle ? " middle" : " end";
  fmt::format_to(std::back_inserter(markup_), "<text class=\"{}{}\" x=\"{}\" y=\"{}\">{}</text>\n", css_class, side,
                 px(x), px(y), xml_escaped(text));
  return *this;
}

Svg& Svg::symbol(double x, double y, double radius, int dimension, std::string_view title) {
  const auto path = [&](double size, std::string_view steps) {
    return fmt::format("transform=\"translate({} {}) scale({})\" d=\"{}\"", px(x), px(y), px(size), steps);
  };
  std::string_view tag = "path";
  std::string shape;
  // After all colours the shapes move on by one, so that dimension 8 is no blue circle again.
  switch ((dimension + dimension / static_cast<int>(colours.size())) % 4) {
    case 0:
      tag = "circle";
      shape = fmt::format("cx=\"{}\" cy=\"{}\" r=\"{}\"", px(x), px(y), px(radius));
      break;
    case 1:
      shape = path(radius * 0.9, "M-1-1H1V1H-1Z");
      break;
    case 2:
      shape = path(radius * 1.15, "M0-1L1 .8H-1Z");
      break;
    default:
      shape = path(radius * 1.25, "M0-1L1 0L0 1L-1 0Z");
      break;
  }
  fmt::format_to(std::back_inserter(markup_), "<{} class=\"{}\" {}", tag, fill_class(dimension), shape);
  if (title.empty()) {
    markup_ += "/>\n";
  } else {
    fmt::format_to(std::back_inserter(markup_), "><title>{}</title></{}>\n", xml_escaped(title), tag);
  }
  return *this;
}

std::string fill_class(int dimension) { return fmt::format("f{}", colour_of(dimension)); }

std::string stroke_class(int dimension) { return fmt::format("s{}", colour_of(dimension)); }

std::string svg_style(bool dark) {
  const auto& palette = dark ? colours_on_dark : colours;
  std::string style = dark ? ""
                           : ".sesame{font-family:system-ui,\"Segoe UI\",Roboto,\"DejaVu Sans\",sans-serif;"
                             "font-size:11px}.title{font-size:17px;font-weight:600}.panel{font-size:13px;"
                             "font-weight:600}.middle{text-anchor:middle}.end{text-anchor:end}.dashed{"
                             "stroke-dasharray:5 3}.axis,.grid{stroke-width:1;fill:none}\n";
  for (std::size_t k = 0; k < palette.size(); ++k) {
    style += fmt::format(".f{0}{{fill:{1}}}.s{0}{{stroke:{1}}}\n", k, palette[k]);
  }
  style += dark ? ".paper{fill:#16181b}.ink,.title,.panel{fill:#e8e8e8}.faint{fill:#a8adb3}.axis{stroke:#9aa0a6}"
                  ".grid{stroke:#33373c}.below{fill:#1f2226}\n"
                : ".paper{fill:#ffffff}.ink,.title,.panel{fill:#222222}.faint{fill:#5f6368}.axis{stroke:#5f6368}"
                  ".grid{stroke:#e3e5e8}.below{fill:#f4f5f6}\n";
  return style;
}

}  // namespace sesame::replay
