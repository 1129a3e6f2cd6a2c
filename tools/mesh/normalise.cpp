#include "tools/mesh/normalise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <numeric>
#include <span>
#include <utility>

#include "tools/mesh/text.hpp"

namespace sesame::tools {

namespace {

using Corners = std::vector<std::uint32_t>;

/// To which faces something happened.
struct Tally {
  std::vector<std::uint32_t> faces;

  void add(std::size_t which) { faces.push_back(static_cast<std::uint32_t>(which)); }
  [[nodiscard]] std::size_t count() const { return faces.size(); }
};

/// `kind` stands before the noun, as in "left out 2 duplicate faces"; it may be empty.
void remark(Mesh& mesh, const Tally& tally, std::string_view verb, std::string_view kind, std::string_view reason) {
  if (tally.faces.empty()) {
    return;
  }
  mesh.remarks.push_back(fmt::format("{} {} {}{} ({}), the first is face {}, counted from 0", verb, tally.count(), kind,
                                     tally.count() == 1 ? "face" : "faces", reason, tally.faces.front()));
}

/// The corners without those that repeat the one before them, around the cycle.
void without_repeats_in_a_row(std::span<const std::uint32_t> face, Corners& corners) {
  corners.clear();
  for (const auto corner : face) {
    if (corners.empty() || corners.back() != corner) {
      corners.push_back(corner);
    }
  }
  while (corners.size() > 1 && corners.back() == corners.front()) {
    corners.pop_back();
  }
}

/// Whether nothing is left of the walk along the boundary once every step that the next one takes back is dropped.
bool folds_up(const Corners& corners, Corners& path) {
  path.assign(1, corners.front());
  for (std::size_t i = 1; i <= corners.size(); ++i) {
    const auto corner = corners[i % corners.size()];
    if (path.size() > 1 && path[path.size() - 2] == corner) {
      path.pop_back();
    } else {
      path.push_back(corner);
    }
  }
  return path.size() == 1;
}

void mend_faces(Mesh& mesh, Cleaning& cleaning, std::vector<std::uint32_t>& origin) {
  Faces kept;
  Tally shortened;
  Tally degenerate;
  Tally segments;
  Tally folded;
  Corners corners;
  Corners scratch;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    without_repeats_in_a_row(face, corners);
    if (face.size() == 2 && corners.size() == 2) {
      segments.add(f);
      mesh.lines.push_back({corners[0], corners[1]});
    } else if (corners.size() < 3) {
      degenerate.add(f);
    } else {
      if (corners.size() < face.size()) {
        shortened.add(f);
      }
      if (folds_up(corners, scratch)) {
        folded.add(f);
      }
      kept.push_face(corners);
      origin.push_back(static_cast<std::uint32_t>(f));
    }
  }
  mesh.faces = std::move(kept);
  cleaning.shortened_faces = shortened.count();
  cleaning.degenerate_faces = degenerate.count();
  cleaning.segments = segments.count();
  cleaning.folded_faces = folded.count();
  remark(mesh, segments, "took as lines", "", "two corners bound no surface");
  remark(mesh, shortened, "shortened", "", "a corner is repeated in a row; it was kept once");
  remark(mesh, degenerate, "left out", "degenerate ", "fewer than three corners, but for repeats in a row");
  remark(mesh, folded, "kept", "folded ", "the boundary runs back over itself, so the face is a sphere of its own");
  cleaning.degenerate = std::move(degenerate.faces);
  cleaning.folded = std::move(folded.faces);
}

/// Where the least of the rotations of a cyclic word begins. Of two candidates one is ruled out, with all places that
/// were compared, at each difference: O(length).
std::size_t least_rotation(std::span<const std::uint32_t> word) {
  const std::size_t length = word.size();
  std::size_t a = 0;
  std::size_t b = 1;
  std::size_t same = 0;
  while (a < length && b < length && same < length) {
    const auto at_a = word[(a + same) % length];
    const auto at_b = word[(b + same) % length];
    if (at_a == at_b) {
      ++same;
      continue;
    }
    (at_a > at_b ? a : b) += same + 1;
    if (a == b) {
      ++b;
    }
    same = 0;
  }
  return std::min(a, b);
}

void to_least_rotation(std::span<std::uint32_t> word) {
  std::rotate(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(least_rotation(word)), word.end());
}

/// The least of all words that a cycle can be written as, from any corner and in either direction.
void to_canonical_cycle(std::span<std::uint32_t> cycle, Corners& scratch) {
  scratch.assign(cycle.rbegin(), cycle.rend());
  to_least_rotation(scratch);
  to_least_rotation(cycle);
  if (std::lexicographical_compare(scratch.begin(), scratch.end(), cycle.begin(), cycle.end())) {
    std::copy(scratch.begin(), scratch.end(), cycle.begin());
  }
}

void drop_duplicates(Mesh& mesh, Cleaning& cleaning, std::vector<std::uint32_t>& origin) {
  const std::size_t count = mesh.faces.size();
  const auto corners = mesh.faces.corners();
  Corners cycles{corners.begin(), corners.end()};
  const auto cycle = [&](std::size_t f) {
    return std::span{cycles}.subspan(mesh.faces.start(f), mesh.faces.start(f + 1) - mesh.faces.start(f));
  };
  Corners scratch;
  for (std::size_t f = 0; f < count; ++f) {
    to_canonical_cycle(cycle(f), scratch);
  }

  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  const auto compare = [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare_three_way(cycle(a).begin(), cycle(a).end(), cycle(b).begin(), cycle(b).end());
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto sign = compare(a, b);
    return std::is_neq(sign) ? std::is_lt(sign) : a < b;
  });
  std::vector<bool> doubled(count, false);
  for (std::size_t i = 1; i < count; ++i) {
    doubled[order[i]] = std::is_eq(compare(order[i - 1], order[i]));
  }

  Tally duplicates;
  Faces kept;
  std::vector<std::uint32_t> origin_of_kept;
  for (std::size_t f = 0; f < count; ++f) {
    if (doubled[f]) {
      duplicates.add(origin[f]);
    } else {
      kept.push_face(mesh.faces[f]);
      origin_of_kept.push_back(origin[f]);
    }
  }
  if (duplicates.faces.empty()) {
    return;
  }
  mesh.faces = std::move(kept);
  origin = std::move(origin_of_kept);
  cleaning.duplicate_faces = duplicates.count();
  remark(mesh, duplicates, "left out", "duplicate ", "an earlier face has the same corners in the same order");
  cleaning.duplicates = std::move(duplicates.faces);
}

Edge ordered(Edge edge) { return edge[0] < edge[1] ? edge : Edge{edge[1], edge[0]}; }

void drop_lines(Mesh& mesh, Cleaning& cleaning) {
  if (mesh.lines.empty()) {
    return;
  }
  std::vector<Edge> sides;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      sides.push_back(ordered({face[i], face[(i + 1) % face.size()]}));
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::pair<Edge, std::size_t>> order;
  for (std::size_t l = 0; l < mesh.lines.size(); ++l) {
    order.emplace_back(ordered(mesh.lines[l]), l);
  }
  std::sort(order.begin(), order.end());

  std::vector<bool> redundant(order.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& [edge, line] = order[i];
    redundant[line] = edge[0] == edge[1] || (i > 0 && order[i - 1].first == edge) ||
                      std::binary_search(sides.begin(), sides.end(), edge);
  }
  std::vector<Edge> kept;
  for (std::size_t l = 0; l < mesh.lines.size(); ++l) {
    if (!redundant[l]) {
      kept.push_back(mesh.lines[l]);
    }
  }
  cleaning.redundant_lines = mesh.lines.size() - kept.size();
  mesh.lines = std::move(kept);
  if (cleaning.redundant_lines == 0) {
    return;
  }
  mesh.remarks.push_back(fmt::format("left out {} (without length, listed before, or a side of a face)",
                                     counted(cleaning.redundant_lines, "line", "lines")));
}

void drop_points(Mesh& mesh, Cleaning& cleaning) {
  if (mesh.faces.empty() && mesh.lines.empty()) {
    return;
  }
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto corner : mesh.faces.corners()) {
    used[corner] = true;
  }
  for (const auto& line : mesh.lines) {
    for (const auto point : line) {
      used[point] = true;
    }
  }
  std::vector<std::uint32_t> to(mesh.points.size());
  std::size_t kept = 0;
  std::size_t first_unused = mesh.points.size();
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    to[p] = static_cast<std::uint32_t>(kept);
    if (used[p]) {
      mesh.points[kept++] = mesh.points[p];
    } else {
      first_unused = std::min(first_unused, p);
    }
  }
  cleaning.unused_points = mesh.points.size() - kept;
  if (cleaning.unused_points == 0) {
    return;
  }
  mesh.points.resize(kept);
  mesh.faces.renumber(to);
  for (auto& line : mesh.lines) {
    line = {to[line[0]], to[line[1]]};
  }
  mesh.remarks.push_back(fmt::format("left out {} on no face and no line, the first is point {}, counted from 0",
                                     counted(cleaning.unused_points, "point", "points"), first_unused));
}

}  // namespace

Cleaning normalise(Mesh& mesh) {
  std::vector<std::uint32_t> origin;
  return normalise(mesh, origin);
}

Cleaning normalise(Mesh& mesh, std::vector<std::uint32_t>& origin) {
  Cleaning cleaning;
  origin.clear();
  mend_faces(mesh, cleaning, origin);
  drop_duplicates(mesh, cleaning, origin);
  drop_lines(mesh, cleaning);
  drop_points(mesh, cleaning);
  return cleaning;
}

}  // namespace sesame::tools
