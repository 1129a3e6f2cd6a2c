#include "ops/maps/cell_insertion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace sesame::ops {

Dart CellInsertion::alpha(int k, Dart d) const {
  const auto at = images_.find({k, d});
  return at != images_.end() ? at->second : d < map_.size() ? map_.alpha(k, d) : d;
}

void CellInsertion::join(int k, Dart a, Dart b) {
  images_[{k, a}] = b;
  images_[{k, b}] = a;
}

void CellInsertion::join(int k, const std::vector<Dart>& some, const std::vector<Dart>& others) {
  for (std::size_t w = 0; w < some.size(); ++w) {
    join(k, some[w], others[w]);
  }
}

std::vector<Dart> CellInsertion::reached(Dart from, int first, int last) const {
  std::vector<Dart> found{from};
  std::unordered_set<Dart> met{from};
  for (std::size_t at = 0; at < found.size(); ++at) {
    for (int k = first; k <= last; ++k) {
      if (const Dart next = map_.alpha(k, found[at]); met.insert(next).second) {
        found.push_back(next);
      }
    }
  }
  return found;
}

Error CellInsertion::no_insertion(const std::string& why) const {
  return {Errc::refused, fmt::format("no {}-cell can be {} there: {}", map_.index(i_),
                                     map_.is_dual() ? "made by splitting" : "inserted", why)};
}

Result<CellInsertion::Side> CellInsertion::place(Dart d) {
  const int n = map_.dimension();
  const std::vector<Dart> darts = reached(d, i_ + 2, n);
  std::map<Dart, std::size_t> number;
  for (std::size_t w = 0; w < darts.size(); ++w) {
    number.emplace(darts[w], w);
  }
  Side side;
  for (const Dart dart : darts) {
    const Dart image = alpha(i_, dart);
    if (image == dart) {
      return no_insertion(fmt::format("{} is {}-free", map_.name(dart), map_.index(i_)));
    }
    if (number.contains(image) || !placed_.insert(dart).second) {
      return no_insertion(fmt::format("{} would be met twice", map_.name(dart)));
    }
  }
  for (const Dart dart : darts) {
    const Dart image = alpha(i_, dart);
    side.near.push_back(next_++);
    side.beyond.push_back(next_++);
    join(i_, dart, side.near.back());
    join(i_ + 1, side.near.back(), side.beyond.back());
    join(i_, side.beyond.back(), image);
  }
  for (int k = i_ + 2; k <= n; ++k) {
    for (std::size_t w = 0; w < darts.size(); ++w) {
      const std::size_t other = number.at(map_.alpha(k, darts[w]));
      join(k, side.near[w], side.near[other]);
      join(k, side.beyond[w], side.beyond[other]);
    }
  }
  return side;
}

Result<CellSurgery> CellInsertion::run(std::span<const Dart> darts) {
  const std::size_t most = i_ == 0 ? 1 : i_ == 1 ? 2 : SIZE_MAX;
  if (darts.empty() || darts.size() > most) {
    return no_insertion(fmt::format("{} darts are given, and it takes {}", darts.size(),
                                    i_ == 0   ? "one"
                                    : i_ == 1 ? "two, or one"
                                              : "one for each step of a closed path"));
  }
  Status done = Done{};
  if (i_ == 0) {
    const Result<Side> side = place(darts[0]);
    done = side ? done : Status{side.error()};
  } else if (i_ == 1) {
    done = darts.size() == 2 ? insert_edge(darts[0], darts[1]) : insert_loose_edge(darts[0]);
  } else {
    done = insert_face(darts);
  }
  if (!done) {
    return done.error();
  }
  if (Status s = check_commuting(); !s) {
    return s.error();
  }
  CellSurgery surgery;
  surgery.made = next_ - map_.size();
  for (const auto& [at, image] : images_) {
    surgery.images.push_back({map_.index(at.first), at.second, image});
  }
  return surgery;
}

/// Signs change with each step around the 2-cell, and the corners must be seen with opposite ones.
Status CellInsertion::insert_edge(Dart one, Dart other) {
  std::optional<Dart> end;
  Dart at = one;
  int k = 0;
  std::size_t steps = 0;
  do {
    if (map_.alpha(k, at) == at) {
      return no_insertion(fmt::format("{} is {}-free", map_.name(at), map_.index(k)));
    }
    if (at == other) {
      end = steps % 2 == 1 ? other : map_.alpha(1, other);
    }
    at = map_.alpha(k, at);
    k = 1 - k;
    ++steps;
  } while (at != one);
  if (!end) {
    return no_insertion(fmt::format("alpha_{} and alpha_{} do not lead from {} to {}", map_.index(0), map_.index(1),
                                    map_.name(one), map_.name(other)));
  }
  const Result<Side> first = place(one);
  const Result<Side> second = first ? place(*end) : first;
  if (!second) {
    return second.error();
  }
  if (first->near.size() != second->near.size()) {
    return no_insertion(fmt::format("what belongs to {} and {} is not alike", map_.name(one), map_.name(*end)));
  }
  join(0, first->near, second->near);
  join(0, first->beyond, second->beyond);
  return Done{};
}

/// A vertex that no other edge has.
Status CellInsertion::insert_loose_edge(Dart d) {
  const Result<Side> side = place(d);
  if (!side) {
    return side.error();
  }
  Side end;
  for (std::size_t w = 0; w < side->near.size(); ++w) {
    end.near.push_back(next_++);
    end.beyond.push_back(next_++);
  }
  join(0, side->near, end.near);
  join(0, side->beyond, end.beyond);
  join(1, end.near, end.beyond);
  join(2, end.near, end.beyond);
  const auto number = [](const std::vector<Dart>& list, Dart of) {
    return static_cast<std::size_t>(std::ranges::find(list, of) - list.begin());
  };
  for (int k = 3; k <= map_.dimension(); ++k) {
    for (std::size_t w = 0; w < end.near.size(); ++w) {
      const std::size_t other = number(side->near, alpha(k, side->near[w]));
      join(k, end.near[w], end.near[other]);
      join(k, end.beyond[w], end.beyond[other]);
    }
  }
  return Done{};
}

Status CellInsertion::insert_face(std::span<const Dart> path) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Dart end = map_.alpha(0, path[k]), next = path[(k + 1) % path.size()];
    const std::vector<Dart> vertex = reached(end, 1, 2);
    if (std::ranges::find(vertex, next) == vertex.end()) {
      return no_insertion(
          fmt::format("alpha_{} and alpha_{} do not lead from {}, the image of {} under alpha_{}, to {}", map_.index(1),
                      map_.index(2), map_.name(end), map_.name(path[k]), map_.index(0), map_.name(next)));
    }
  }
  std::vector<std::pair<Side, Side>> sides;  // of both ends of each edge
  for (const Dart d : path) {
    const Result<Side> begin = place(d);
    const Result<Side> end = begin ? place(map_.alpha(0, d)) : begin;
    if (!end) {
      return end.error();
    }
    sides.emplace_back(*begin, *end);
  }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto& [begin, end] = sides[k];
    const Side& next = sides[(k + 1) % sides.size()].first;
    if (begin.near.size() != end.near.size() || end.near.size() != next.near.size()) {
      return no_insertion(fmt::format("what belongs to the darts of the path is not alike, at {}", map_.name(path[k])));
    }
    join(0, begin.near, end.near);
    join(0, begin.beyond, end.beyond);
    join(1, end.near, next.near);
    join(1, end.beyond, next.beyond);
  }
  return Done{};
}

/// Where cells are folded, what is alike dart by dart may not fit together.
Status CellInsertion::check_commuting() const {
  for (const auto& [at, image] : images_) {
    const auto& [k, d] = at;
    for (int l = 0; l <= map_.dimension(); ++l) {
      if ((l >= k + 2 || k >= l + 2) && alpha(l, image) != alpha(k, alpha(l, d))) {
        return no_insertion(fmt::format("alpha_{} alpha_{} would be no involution at {}", map_.index(k), map_.index(l),
                                        d < map_.size() ? map_.name(d) : "a new dart"));
      }
    }
  }
  return Done{};
}

}  // namespace sesame::ops
