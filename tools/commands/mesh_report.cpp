#include "tools/commands/mesh_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>

#include "replay/script/groups.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

using sparse::Integer;

constexpr std::size_t generators_shown_by_default = 20;

/// Coordinates that are zero but for rounding, measured by the size of the generator and its distance, read 0.
std::string point_text(const Point& point, const std::array<Point, 2>& box) {
  double size = 0;
  for (const Point& corner : box) {
    for (const double x : corner) {
      size = std::max(size, std::abs(x));
    }
  }
  const auto shown = [size](double x) { return std::abs(x) < 1e-12 * size ? 0 : x; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", shown(point[0]), shown(point[1]), shown(point[2]));
}

std::string place_text(const MeshGenerator& generator) {
  return fmt::format("centre {}, box {} to {}", point_text(generator.centre, generator.box),
                     point_text(generator.box[0], generator.box), point_text(generator.box[1], generator.box));
}

/// How often the mesh meets itself, and where first.
std::string meetings_text(const SelfIntersections& found) {
  const std::size_t count = found.meetings.size();
  if (count == 0) {
    return found.is_complete ? "none" : "none found, of too many pairs of faces to look at all";
  }
  const auto& [faces, place, crosses] = found.meetings.front();
  return fmt::format(
      "{}{}, of which {} cross and the others touch; the first are faces {} and {}, at ({:.6g}, {:.6g}, "
      "{:.6g})",
      found.is_complete ? "" : "at least ", counted(count, "pair of faces", "pairs of faces"), found.crossing(),
      faces[0], faces[1], place[0], place[1], place[2]);
}

/// Where the tunnels of a surface come from; empty for what is not an orientable surface.
std::string origin_of_tunnels(const Validity& validity) {
  std::size_t handles = 0;
  for (const Component& component : validity.components) {
    const auto genus = component.genus();
    if (!genus) {
      return {};
    }
    handles += static_cast<std::size_t>(*genus);
  }
  std::string text =
      handles == 0 ? "" : counted(handles, "handle", "handles") + ", with a loop around and one along each";
  if (validity.boundary_loops > 0) {
    text += fmt::format("{}{}, of which all but one of each piece that has any", text.empty() ? "" : "; ",
                        counted(validity.boundary_loops, "boundary loop", "boundary loops"));
  }
  return text;
}

/// What a group means, a line each.
std::vector<std::string> meaning(const MeshHomology& found, std::size_t degree) {
  const auto betti = static_cast<std::size_t>(found.homology.betti[degree]);
  const bool has_torsion = !found.homology.torsion[degree].empty();
  if (degree == 0) {
    return {counted(betti, "connected piece", "connected pieces")};
  }
  if (degree == 2) {
    return {betti == 0 ? "no cavities: no closed surface encloses anything"
                       : counted(betti, "cavity: a closed surface that encloses space",
                                 "cavities: closed surfaces that enclose space")};
  }
  std::vector<std::string> lines;
  if (betti > 0) {
    lines.push_back(
        counted(betti, "tunnel: a loop that nothing fills in", "tunnels: independent loops that nothing fills in"));
    if (const std::string origin = origin_of_tunnels(found.validity); !origin.empty()) {
      lines.push_back(origin);
    }
  } else {
    lines.emplace_back(has_torsion ? "no tunnels" : "no tunnels: every loop is filled in");
  }
  if (has_torsion) {
    lines.emplace_back("torsion: loops that are filled in only when they are run several times");
  }
  return lines;
}

void print_groups(std::ostream& out, const MeshHomology& found) {
  const sparse::AnyRing& ring = found.ring;
  const std::vector<std::string> groups = replay::group_names(found.homology, ring);
  std::size_t width = 0;
  for (const std::string& group : groups) {
    width = std::max(width, group.size());
  }
  out << "\nhomology over " << sparse::ring_name(ring) << '\n';
  for (std::size_t degree = 0; degree < groups.size(); ++degree) {
    std::string head = fmt::format("  H{} = {:<{}}  ", degree, groups[degree], width);
    for (const std::string& line : meaning(found, degree)) {
      out << head << line << '\n';
      head.assign(head.size(), ' ');
    }
  }
  if (std::holds_alternative<sparse::Rationals>(ring)) {
    out << "  over Q loops that are filled in when they are run several times are no tunnels; --ring Z shows them\n";
  } else if (!std::holds_alternative<sparse::Integers>(ring)) {
    out << "  over a field, torsion of its characteristic counts as tunnels and cavities; --ring Z tells them apart\n";
  }
}

void print_generator(std::ostream& out, const MeshGenerator& generator, std::size_t number,
                     const ops::Structure& structure, bool cells) {
  constexpr std::size_t most_terms = 12;
  if (generator.degree == 0) {
    out << fmt::format("  {:>4}  vertex {}; {}\n", number, generator.vertices.front(), place_text(generator));
    return;
  }
  if (generator.degree == 2) {
    out << fmt::format("  {:>4}  {}, area {}", number,
                       cells ? counted(generator.faces.size(), "face", "faces")
                             : counted(generator.triangles, "triangle", "triangles"),
                       to_text(generator.area));
    if (generator.volume) {
      out << fmt::format(", volume {}{}", to_text(*generator.volume),
                         generator.volume->value < 0 ? " (the faces point inwards)" : "");
    }
    out << "; " << place_text(generator) << '\n';
    return;
  }
  out << fmt::format(
      "  {:>4}  {}length {}, {}{}; {}\n", number, generator.side ? std::string{side_name(*generator.side)} + ", " : "",
      to_text(generator.length), counted(generator.chain.terms.size(), "edge", "edges"),
      generator.order.is_zero() ? "" : ", of order " + generator.order.to_string(), place_text(generator));
  if (generator.vertices.empty()) {
    out << "        not one loop: " << replay::chain_text(generator.chain, structure, most_terms) << '\n';
  } else {
    out << fmt::format("        vertices {}\n", fmt::join(generator.vertices, " "));
  }
}

/// What handle and tunnel mean, and which components have neither.
void print_sides(std::ostream& out, const MeshHomology& found, bool any_side) {
  constexpr std::size_t most_components = 10;
  if (any_side) {
    out << "A handle loop bounds inside its surface, so a disc there would cut a handle; a tunnel loop bounds outside, "
           "so\n"
           "a disc there would close a tunnel. Each closed surface is looked at as if it were alone.\n";
  }
  std::set<std::uint32_t> without;
  for (const MeshGenerator& generator : found.generators) {
    if (generator.degree == 1 && !generator.side) {
      without.insert(generator.part);
    }
  }
  std::size_t unsorted = 0;
  for (const std::uint32_t part : without) {
    if (const std::string& why_not = found.sorting[part].why_not; !why_not.empty() && ++unsorted <= most_components) {
      out << fmt::format("The loops of component {} have no side: {}.\n", part, why_not);
    }
  }
  if (unsorted > most_components) {
    out << fmt::format("Nor have those of {}.\n",
                       counted(unsorted - most_components, "other component", "other components"));
  }
}

void print_notes(std::ostream& out, const MeshHomology& found, const MeshReportOptions& options) {
  const bool is_obj = options.source.ends_with(".obj") || options.source.ends_with(".OBJ");
  out << fmt::format(
      "\nVertices are counted from 0 as the file lists them{}; of welded points only the first counts.\n",
      is_obj ? " (OBJ itself counts from 1)" : "");
  const auto short_ones = std::count_if(found.generators.begin(), found.generators.end(),
                                        [](const MeshGenerator& g) { return g.is_short; });
  const bool any_side = std::any_of(found.generators.begin(), found.generators.end(),
                                    [](const MeshGenerator& g) { return g.side.has_value(); });
  const auto others = std::count_if(found.generators.begin(), found.generators.end(),
                                    [](const MeshGenerator& g) { return g.degree == 1 && !g.is_short; });
  if (short_ones + others > 0) {
    out << "Generators are not unique: other loops through the same tunnels, and sums of them, would do as well.\n";
  }
  if (short_ones > 0) {
    out << fmt::format(
        "The loops are short: the shortest that can generate H1{} together, of {} loops along edges that were\n"
        "compared. Shorter ones may exist: this is a search, not a proof.\n",
        any_side ? ", or the half of it that bounds on one side," : "", found.loops_tried);
  }
  if (short_ones + others > 0) {
    print_sides(out, found, any_side);
  }
  if (options.shorter_than) {
    out << fmt::format("Left out: {} of length {} or more (--shorter-than).\n",
                       counted(options.loops_left_out, "loop", "loops"), *options.shorter_than);
  }
  if (others > 0) {
    out << fmt::format("{} of H1 {} not shortened: what is listed is any cycle of the class.\n",
                       counted(static_cast<std::size_t>(others), "generator", "generators"),
                       others == 1 ? "was" : "were");
  }
}

}  // namespace

void write_text(std::ostream& out, const MeshHomology& found, const MeshReportOptions& options) {
  out << options.source << '\n' << to_text(found.validity);
  if (found.validity.faces > 0) {
    out << "self-intersections    " << meetings_text(found.meetings) << '\n';
  }
  for (const std::string& remark : found.remarks) {
    out << "remark                " << remark << '\n';
  }
  print_groups(out, found);
  const std::size_t limit = options.generators_limit.value_or(generators_shown_by_default);
  const std::array<const char*, 3> titles{"one vertex per piece", "loops that together generate it", "closed surfaces"};
  for (int degree = 0; degree < 3; ++degree) {
    std::size_t number = 0;
    for (const MeshGenerator& generator : found.generators) {
      if (generator.degree != degree) {
        continue;
      }
      if (number == 0 && limit > 0) {
        out << fmt::format("\ngenerators of H{}: {}\n", degree, titles[static_cast<std::size_t>(degree)]);
      }
      if (number++ < limit) {
        print_generator(out, generator, number, found.engine->structure(), options.cells);
      }
    }
    if (limit > 0 && number > limit) {
      out << fmt::format("        and {} more; --generators-limit {} shows all\n", number - limit, number);
    }
  }
  if (limit > 0) {
    print_notes(out, found, options);
  }
  out << fmt::format("{:.2f} s\n", options.seconds);
}

}  // namespace sesame::tools
