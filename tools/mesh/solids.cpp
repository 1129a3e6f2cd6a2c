// The formats: P. J. Frey, "MEDIT: an interactive mesh visualization software", INRIA RT-0253 (2001); "The VTK User's
// Guide", file formats, and for version 5.1 its OFFSETS and CONNECTIVITY.
#include "tools/mesh/solids.hpp"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <set>
#include <utility>

#include "tools/mesh/number_reader.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

using Corners = std::vector<std::uint32_t>;
using FacesOfSolid = std::vector<Corners>;

/// A base with its corners first, then the other one, and the sides.
FacesOfSolid faces_of_prism(std::uint32_t sides) {
  FacesOfSolid faces(2);
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t next = (k + 1) % sides;
    faces[0].push_back(k);
    faces[1].push_back(sides + k);
    faces.push_back({k, next, sides + next, sides + k});
  }
  return faces;
}

class MeditReader {
 public:
  MeditReader(std::string_view bytes, std::string_view name)
      : name_{name}, in_{LineReader{bytes, name}, WordReader::Comments::hash} {}

  Result<Solids> read() {
    for (std::string_view word = in_.word(); !word.empty() && word != "End";
         word = next_.empty() ? in_.word() : next_) {
      next_ = {};
      if (Status s = read_section(word); !s) {
        return s.error();
      }
    }
    if (!has_points_) {
      return in_.error("there is no section `Vertices`, which a MEDIT mesh has");
    }
    if (Status s = check_corners(solids_, name_, 1); !s) {
      return s.error();
    }
    for (const std::string& section : left_out_) {
      solids_.remarks.push_back(fmt::format("left out the section {}", shown(section)));
    }
    return std::move(solids_);
  }

 private:
  Status read_section(std::string_view section) {
    static const std::map<std::string_view, std::size_t> corners{{"Tetrahedra", 4}, {"Pyramids", 5},  {"Prisms", 6},
                                                                 {"Wedges", 6},     {"Hexahedra", 8}, {"Hexaedra", 8}};
    if (is_number(section)) {
      return in_.error(fmt::format("{} is no name of a section, such as `Vertices` or `Tetrahedra`", shown(section)));
    }
    if (section == "MeshVersionFormatted") {
      return ignored(in_.count(section));
    }
    if (section == "Dimension") {
      return ignored(in_.whole("Dimension of a mesh of solids", 3, 3));
    }
    if (section == "Vertices") {
      return read_points();
    }
    if (const auto solid = corners.find(section); solid != corners.end()) {
      return read_solids(section, solid->second);
    }
    skip_section(section);
    return Done{};
  }

  static Status ignored(const Result<std::int64_t>& number) { return number ? Status{Done{}} : Status{number.error()}; }

  Status read_points() {
    if (std::exchange(has_points_, true)) {
      return in_.error("there is a second section `Vertices`, and there should be one");
    }
    const Result<std::int64_t> count = in_.count("the number of vertices");
    for (std::int64_t k = 0; count && k < *count; ++k) {
      const Result<Point> point = in_.point();
      if (!point) {
        return point.error();
      }
      solids_.points.push_back(*point);
      if (Status s = read_reference(); !s) {
        return s;
      }
    }
    return ignored(count);
  }

  /// The number of a material or the like, which every vertex and solid has.
  Status read_reference() {
    const std::string_view word = in_.word();
    return is_number(word) ? Status{Done{}}
                           : Status{in_.error(fmt::format("{} should be a reference, a number that is behind each "
                                                          "vertex and each cell",
                                                          shown(word)))};
  }

  Status read_solids(std::string_view section, std::size_t corners) {
    const Result<std::int64_t> count = in_.count(fmt::format("the number of {}", section));
    Corners read(corners);
    for (std::int64_t k = 0; count && k < *count; ++k) {
      std::size_t line = 0;
      for (std::uint32_t& corner : read) {
        const Result<std::int64_t> vertex =
            in_.whole("a vertex of a solid", 1, std::numeric_limits<std::uint32_t>::max() - 1);
        if (!vertex) {
          return vertex.error();
        }
        corner = static_cast<std::uint32_t>(*vertex - 1);
        line = line == 0 ? in_.line() : line;
      }
      if (Status s = read_reference(); !s) {
        return s;
      }
      add_solid(faces_of_solid(corners), read, line, solids_);
    }
    return ignored(count);
  }

  /// Up to the next word that is no number.
  void skip_section(std::string_view section) {
    left_out_.emplace(section);
    do {
      next_ = in_.word();
    } while (is_number(next_));
  }

  std::string_view name_;
  NumberReader in_;
  std::string_view next_;
  bool has_points_ = false;
  std::set<std::string> left_out_;
  Solids solids_;
};

}  // namespace

const std::vector<std::vector<std::uint32_t>>& faces_of_solid(std::size_t corners) {
  static const std::map<std::size_t, FacesOfSolid> solids{
      {4, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}},
      {5, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
      {6, faces_of_prism(3)},
      {8, faces_of_prism(4)},
      {10, faces_of_prism(5)},
      {12, faces_of_prism(6)},
  };
  static const FacesOfSolid none;
  const auto found = solids.find(corners);
  return found == solids.end() ? none : found->second;
}

void add_solid(const std::vector<std::vector<std::uint32_t>>& faces, const std::vector<std::uint32_t>& corners,
               std::size_t line, Solids& solids) {
  for (const Corners& face : faces) {
    for (const std::uint32_t k : face) {
      solids.faces.push_corner(corners[k]);
    }
    solids.faces.close_face();
  }
  solids.first_face.push_back(static_cast<std::uint32_t>(solids.faces.size()));
  solids.lines.push_back(line);
}

Status check_corners(const Solids& solids, std::string_view name, std::uint32_t first) {
  for (std::size_t s = 0; s < solids.size(); ++s) {
    for (std::uint32_t face = solids.first_face[s]; face < solids.first_face[s + 1]; ++face) {
      for (const std::uint32_t corner : solids.faces[face]) {
        if (corner >= solids.points.size()) {
          return Error{Errc::bad_input,
                       fmt::format("{}:{}: a solid has the point {}, and there are {} points, counted from {}", name,
                                   solids.lines[s], std::uint64_t{corner} + first, solids.points.size(), first)};
        }
      }
    }
  }
  return Done{};
}

Result<Solids> read_medit(std::string_view bytes, std::string_view name) { return MeditReader{bytes, name}.read(); }

Result<Solids> parse_solids(std::string_view bytes, std::string_view name, Format format) {
  return format == Format::vtk ? read_vtk(bytes, name) : read_medit(bytes, name);
}

}  // namespace sesame::tools
