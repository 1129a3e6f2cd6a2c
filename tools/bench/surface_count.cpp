#include "tools/bench/surface_count.hpp"

#include <variant>

#include "ops/cells/cell_type.hpp"

namespace sesame::tools {

void SurfaceCount::Classes::add() {
  parent.push_back(static_cast<Number>(parent.size()));
  ++count;
}

SurfaceCount::Number SurfaceCount::Classes::root(Number x) {
  while (parent[x] != x) {
    x = parent[x] = parent[parent[x]];
  }
  return x;
}

bool SurfaceCount::Classes::unite(Number a, Number b) {
  a = root(a);
  b = root(b);
  if (a == b) {
    return false;
  }
  parent[b] = a;
  --count;
  return true;
}

void SurfaceCount::take(const ops::Operation& operation) {
  if (!is_known_) {
    return;
  }
  if (const auto* undo = std::get_if<ops::Undo>(&operation)) {
    has_undone_ = true;
    is_known_ = undo->steps <= answers_.size();
    answers_.resize(is_known_ ? answers_.size() - undo->steps : 0);
    return;
  }
  if (const auto* simplex = std::get_if<ops::MakeSimplex>(&operation)) {
    is_known_ = make(simplex->name, {simplex->dimension});
  } else if (const auto* simploid = std::get_if<ops::MakeSimploid>(&operation)) {
    is_known_ = make(simploid->name, simploid->type);
  } else {
    const auto* identify = std::get_if<ops::Identify>(&operation);
    is_known_ = identify != nullptr && glue(*identify);
  }
  is_known_ = is_known_ && !has_undone_;
  answers_.push_back(count());
}

std::optional<Answer> SurfaceCount::answer() const {
  if (!is_known_) {
    return std::nullopt;
  }
  return answers_.empty() ? Answer{{}} : answers_.back();
}

/// Takes note of the corners and sides that a tile of this type has.
void SurfaceCount::begin(const ops::CellType& type) {
  type_ = type;
  ops::TypeTable types;
  const ops::TypeId id = types.intern(type);
  const ops::StandardCell& standard = types.standard(id);
  std::vector<Number> numbers;  // of the cells that are no tiles, in their dimension
  for (const ops::StandardFace& cell : standard.cells) {
    const int dimension = types.info(cell.type).dimension;
    if (dimension < 2) {
      Number& next = dimension == 0 ? corners_of_a_tile_ : sides_of_a_tile_;
      Part part{dimension, next++, {}, 0};
      if (dimension == 1) {
        part.corners = {numbers[cell.faces[0]], numbers[cell.faces[1]]};
      }
      numbers.push_back(part.number);
      parts_.emplace(cell.suffix, part);
    }
  }
  const ops::StandardFace& tile = standard.cells.back();
  for (std::size_t k = 0; k < tile.faces.size(); ++k) {
    parts_.at(standard.cells[tile.faces[k]].suffix).sign = types.info(id).faces[k].sign;
  }
}

bool SurfaceCount::make(const std::string& name, const ops::CellType& type) {
  if (type != ops::CellType{2} && type != ops::CellType{1, 1}) {
    return false;
  }
  if (type_.empty()) {
    begin(type);
  }
  const auto tile = static_cast<Number>(tiles_.size());
  if (type != type_ || !tiles_.emplace(name, tile).second) {
    return false;
  }
  for (Number k = 0; k < corners_of_a_tile_; ++k) {
    corners_.add();
  }
  for (Number k = 0; k < sides_of_a_tile_; ++k) {
    sides_.add();
    glued_.push_back(1);
  }
  components_.add();
  tile_parent_.emplace_back(tile, 1);
  pieces_.push_back({sides_of_a_tile_, true});
  return true;
}

bool SurfaceCount::glue(const ops::Identify& identify) {
  for (const auto& [one, other] : identify.pairs) {
    if (!glue(one, other)) {
      return false;
    }
  }
  return true;
}

bool SurfaceCount::glue(const std::string& one, const std::string& other) {
  const auto first = find(one), second = find(other);
  if (!first || !second || first->second.dimension != second->second.dimension) {
    return false;
  }
  const auto& [a, x] = *first;
  const auto& [b, y] = *second;
  components_.unite(a, b);
  if (x.dimension == 0) {
    corners_.unite(a * corners_of_a_tile_ + x.number, b * corners_of_a_tile_ + y.number);
    return true;
  }
  for (const std::size_t end : {0U, 1U}) {
    corners_.unite(a * corners_of_a_tile_ + x.corners[end], b * corners_of_a_tile_ + y.corners[end]);
  }
  const Number side = sides_.root(a * sides_of_a_tile_ + x.number), its = sides_.root(b * sides_of_a_tile_ + y.number);
  const Number together = glued_[side] + glued_[its];
  if (sides_.unite(side, its)) {
    glued_[side] = together;
    join(a, b, -x.sign * y.sign);
    return together == 2;
  }
  return true;
}

/// Two tiles have a side in common: in one orientation of both together, the second has the sign of the first, or not.
void SurfaceCount::join(Number a, Number b, int sign) {
  const auto [p, sign_of_a] = root_of(a);
  const auto [q, sign_of_b] = root_of(b);
  Piece& piece = pieces_[p];
  if (p != q) {
    tile_parent_[q] = {p, sign * sign_of_a * sign_of_b};
    piece.free_sides += pieces_[q].free_sides;
    piece.is_orientable = piece.is_orientable && pieces_[q].is_orientable;
  } else {
    piece.is_orientable = piece.is_orientable && sign == sign_of_a * sign_of_b;
  }
  piece.free_sides -= 2;
  if (piece.free_sides == 0) {
    ++(piece.is_orientable ? closed_ : closed_one_sided_);
  }
}

std::pair<SurfaceCount::Number, int> SurfaceCount::root_of(Number tile) {
  int sign = 1;
  Number root = tile;
  while (tile_parent_[root].first != root) {
    sign *= tile_parent_[root].second;
    root = tile_parent_[root].first;
  }
  for (int rest = sign; tile != root;) {  // all on the path point to the root from now on
    const auto [next, step] = tile_parent_[tile];
    tile_parent_[tile] = {root, rest};
    rest *= step;
    tile = next;
  }
  return {root, sign};
}

std::optional<std::pair<SurfaceCount::Number, SurfaceCount::Part>> SurfaceCount::find(const std::string& name) const {
  const std::size_t point = name.find('.');
  const auto tile = tiles_.find(name.substr(0, point));
  const auto part = point == std::string::npos ? parts_.end() : parts_.find(name.substr(point + 1));
  if (tile == tiles_.end() || part == parts_.end()) {
    return std::nullopt;
  }
  return std::pair{tile->second, part->second};
}

AnswerAfter counted(std::vector<ops::Operation> operations) {
  return [count = SurfaceCount{}, operations = std::move(operations)](std::size_t step) mutable {
    count.take(operations.at(step));
    return count.answer();
  };
}

Answer SurfaceCount::count() const {
  const std::int64_t euler = std::int64_t{corners_.count} - sides_.count + static_cast<std::int64_t>(tiles_.size());
  return {{components_.count, components_.count + closed_ - euler, closed_},
          {{}, std::vector<std::int64_t>(static_cast<std::size_t>(closed_one_sided_), 2)}};
}

}  // namespace sesame::tools
