#include "tools/mesh/self_intersections.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "tools/mesh/geometry.hpp"
#include "tools/mesh/measure.hpp"
#include "tools/mesh/space_triangles.hpp"
#include "tools/mesh/triangle_meeting.hpp"

namespace sesame::tools {

namespace {

bool overlap(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a[1][i] < b[0][i] || b[1][i] < a[0][i]) {
      return false;
    }
  }
  return true;
}

/// Boxes in a binary tree: those of a node are in two halves, by their middles along its longest side.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes) : boxes_{boxes}, order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!boxes.empty()) {
      build(0, static_cast<std::uint32_t>(boxes.size()));
    }
  }

  /// Calls visit(k, l) for each pair of boxes that meet; until it returns false.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
    if (!nodes_.empty()) {
      open.emplace_back(0, 0);
    }
    while (!open.empty()) {
      const auto [one, other] = open.back();
      open.pop_back();
      const Node& a = nodes_[one];
      const Node& b = nodes_[other];
      if (one != other && !overlap(a.box, b.box)) {
        continue;
      }
      if (a.is_leaf() && b.is_leaf()) {
        for (std::uint32_t i = a.begin; i < a.end; ++i) {
          for (std::uint32_t j = one == other ? i + 1 : b.begin; j < b.end; ++j) {
            if (overlap(boxes_[order_[i]], boxes_[order_[j]]) && !visit(order_[i], order_[j])) {
              return;
            }
          }
        }
      } else if (one == other) {
        open.insert(open.end(), {{a.left, a.left}, {a.left, a.right}, {a.right, a.right}});
      } else if (b.is_leaf() || (!a.is_leaf() && a.end - a.begin > b.end - b.begin)) {
        open.insert(open.end(), {{a.left, other}, {a.right, other}});
      } else {
        open.insert(open.end(), {{one, b.left}, {one, b.right}});
      }
    }
  }

 private:
  struct Node {
    Box box;
    std::uint32_t begin, end;  ///< in order_
    std::uint32_t left = 0, right = 0;

    [[nodiscard]] bool is_leaf() const { return left == 0; }
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t few = 4;
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({empty_box(), begin, end});
    Box box = empty_box();
    for (std::uint32_t k = begin; k < end; ++k) {
      extend(box, boxes_[order_[k]][0]);
      extend(box, boxes_[order_[k]][1]);
    }
    nodes_[number].box = box;
    if (end - begin > few) {
      const Point size = minus(box[1], box[0]);
      const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
      const std::uint32_t middle = begin + (end - begin) / 2;
      const auto at = [this](std::uint32_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
      std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
        return boxes_[a][0][axis] + boxes_[a][1][axis] < boxes_[b][0][axis] + boxes_[b][1][axis];
      });
      const std::uint32_t left = build(begin, middle);
      const std::uint32_t right = build(middle, end);
      nodes_[number].left = left;
      nodes_[number].right = right;
    }
    return number;
  }

  const std::vector<Box>& boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace

std::size_t SelfIntersections::crossing() const {
  return static_cast<std::size_t>(
      std::count_if(meetings.begin(), meetings.end(), [](const FaceMeeting& meeting) { return meeting.crosses; }));
}

SelfIntersections self_intersections(const Mesh& mesh) {
  const std::vector<Point> points = within_one(mesh.points);
  const int exponent = binary_exponent(mesh.points);
  std::vector<PointTriple> triangles;
  std::vector<std::uint32_t> face_of;
  std::vector<Box> boxes;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    for (const CornerTriple& places : cut_in_space(points, corners)) {
      const PointTriple triangle{corners[places[0]], corners[places[1]], corners[places[2]]};
      Box& box = boxes.emplace_back(empty_box());
      for (const std::uint32_t point : triangle) {
        extend(box, points[point]);
      }
      triangles.push_back(triangle);
      face_of.push_back(f);
    }
  }
  const ExactSigns signs(points);
  const TriangleMeeting meeting(points, signs);
  SelfIntersections found;
  std::uint64_t left = 10'000'000 + 300 * static_cast<std::uint64_t>(triangles.size());
  BoxTree(boxes).for_each_pair([&](std::uint32_t one, std::uint32_t other) {
    if (left-- == 0) {
      found.is_complete = false;
      return false;
    }
    if (face_of[one] != face_of[other]) {
      const TriangleContact contact = meeting.contact(triangles[one], triangles[other]);
      if (contact.kind != Contact::none) {
        const auto [low, high] = std::minmax(face_of[one], face_of[other]);
        found.meetings.push_back({{low, high}, scaled(contact.place, exponent), contact.kind == Contact::crosses});
      }
    }
    return true;
  });
  // Of the pairs of triangles of two polygons one counts, one that crosses if there is any.
  auto& all = found.meetings;
  std::sort(all.begin(), all.end(), [](const FaceMeeting& a, const FaceMeeting& b) {
    return a.faces != b.faces ? a.faces < b.faces : a.crosses != b.crosses ? a.crosses : a.place < b.place;
  });
  all.erase(std::unique(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.faces == b.faces; }),
            all.end());
  return found;
}

}  // namespace sesame::tools
