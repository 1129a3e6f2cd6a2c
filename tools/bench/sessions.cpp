#include "tools/bench/sessions.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::tools {

// ---- gluings

void Gluings::add(std::string name, Incidence incidence) {
  places_.push_back({std::move(name), {incidence}});
  position_.push_back(0);
  insert(static_cast<std::uint32_t>(places_.size() - 1));
}

ops::Operation Gluings::glue(std::size_t a, std::size_t b) {
  sparse::expects(a != b, "what is made one was two");
  const std::uint32_t kept = present_[a], gone = present_[b];
  changes_.push_back({kept, gone, false, places_[kept].incidences});
  auto& incidences = places_[kept].incidences;
  incidences.insert(incidences.end(), places_[gone].incidences.begin(), places_[gone].incidences.end());
  remove(gone);
  return ops::Identify{{{places_[kept].name, places_[gone].name}}};
}

ops::Operation Gluings::split(std::size_t a, const std::vector<bool>& goes) {
  const std::uint32_t kept = present_[a];
  changes_.push_back({kept, static_cast<std::uint32_t>(places_.size()), true, places_[kept].incidences});
  Place copy{"x" + std::to_string(++copies_), {}};
  std::vector<Incidence> stay;
  ops::Deidentify::Split split{places_[kept].name, copy.name, {}};
  for (std::size_t k = 0; k < goes.size(); ++k) {
    const Incidence incidence = places_[kept].incidences[k];
    (goes[k] ? copy.incidences : stay).push_back(incidence);
    if (goes[k]) {
      split.moves.emplace_back(letter_ + std::to_string(incidence.cell), incidence.face);
    }
  }
  sparse::expects(!copy.incidences.empty() && !stay.empty(), "a split leaves something and takes something");
  places_[kept].incidences = std::move(stay);
  places_.push_back(std::move(copy));
  position_.push_back(0);
  insert(changes_.back().other);
  return ops::Deidentify{{std::move(split)}};
}

void Gluings::undo(std::size_t changes) {
  for (; changes > 0; --changes) {
    Change& last = changes_.back();
    places_[last.kept].incidences = std::move(last.before);
    if (last.is_split) {
      remove(last.other);
      places_.pop_back();
      position_.pop_back();
    } else {
      insert(last.other);
    }
    changes_.pop_back();
  }
}

void Gluings::remove(std::uint32_t place) {
  const std::uint32_t last = present_.back();
  present_[position_[place]] = last;
  position_[last] = position_[place];
  present_.pop_back();
}

void Gluings::insert(std::uint32_t place) {
  position_[place] = static_cast<std::uint32_t>(present_.size());
  present_.push_back(place);
}

namespace {

/// Glues two cells at random or splits one, as likely the one as the other.
ops::Operation random_change(Gluings& gluings, Draws& draws) {
  std::vector<bool> goes;
  while (true) {
    const std::size_t a = draws.below(gluings.size());
    if (draws.below(2) == 0) {
      if (const std::size_t b = draws.below(gluings.size()); a != b) {
        return gluings.glue(a, b);
      }
      continue;
    }
    goes.resize(gluings[a].incidences.size());
    std::generate(goes.begin(), goes.end(), [&] { return draws.below(2) == 0; });
    const auto going = std::count(goes.begin(), goes.end(), true);
    if (going > 0 && static_cast<std::size_t>(going) < goes.size()) {
      return gluings.split(a, goes);
    }
  }
}

}  // namespace

// ---- graphs

ops::Operation GraphEditing::next() {
  if (made_ < edges_) {
    const std::string name = "e" + std::to_string(made_);
    vertices_.add(name + ".0", {made_, 1});
    vertices_.add(name + ".1", {made_, 0});
    ++made_;
    return ops::MakeSimplex{name, 1, {}};
  }
  constexpr std::size_t enough = 300;
  if (with_undo_ && vertices_.undoable() > enough && draws_.below(100) == 0) {
    constexpr std::array<std::size_t, 3> lengths{3, 50, 250};
    const std::size_t steps = lengths.at(draws_.below(lengths.size()));
    vertices_.undo(steps);
    return ops::Undo{steps};
  }
  return random_change(vertices_, draws_);
}

std::uint32_t GraphEditing::components() const {
  std::vector<std::uint32_t> parent(vertices_.size()), vertex_of(made_, UINT32_MAX);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) {
      v = parent[v] = parent[parent[v]];
    }
    return v;
  };
  std::uint32_t components = vertices();
  for (std::uint32_t v = 0; v < vertices(); ++v) {
    for (const auto& [edge, end] : vertices_[v].incidences) {
      if (vertex_of[edge] == UINT32_MAX) {
        vertex_of[edge] = v;
      } else if (const std::uint32_t a = root(v), b = root(vertex_of[edge]); a != b) {
        parent[a] = b;
        --components;
      }
    }
  }
  return components;
}

// ---- contractions

ops::Operation GraphContraction::insert_vertex() {
  present_.push_back(static_cast<std::uint32_t>(adjacent_.size()));
  adjacent_.emplace_back();
  return ops::Insert{{{std::to_string(present_.back())}}};
}

/// The vertex at a place becomes another one.
ops::Operation GraphContraction::collapse(std::size_t from, std::uint32_t to) {
  const std::uint32_t gone = present_[from];
  present_[from] = present_.back();
  present_.pop_back();
  for (const std::uint32_t neighbour : std::exchange(adjacent_[gone], {})) {
    adjacent_[neighbour].erase(gone);
    if (neighbour == to || !adjacent_[to].insert(neighbour).second) {
      --edges_;
    } else {
      adjacent_[neighbour].insert(to);
    }
  }
  return ops::Collapse{std::to_string(gone), std::to_string(to)};
}

ops::Operation GraphContraction::next() {
  if (adjacent_.size() < vertices_at_first_) {
    return insert_vertex();
  }
  while (true) {
    const std::size_t at = draws_.below(present_.size());
    const std::uint32_t a = present_[at], b = present_[draws_.below(present_.size())];
    const std::uint32_t kind = draws_.below(20);
    if (kind == 0 || vertices() < 3) {
      return insert_vertex();
    }
    if (a == b || (kind > 2 && adjacent_[a].contains(b))) {
      continue;
    }
    if (kind <= 2) {
      return collapse(at, b);
    }
    adjacent_[a].insert(b);
    adjacent_[b].insert(a);
    ++edges_;
    return ops::Insert{{{std::to_string(a), std::to_string(b)}}};
  }
}

std::uint32_t GraphContraction::components() const {
  std::vector<bool> met(adjacent_.size());
  std::vector<std::uint32_t> pending;
  std::uint32_t components = 0;
  for (const std::uint32_t first : present_) {
    if (met[first]) {
      continue;
    }
    ++components;
    met[first] = true;
    pending.push_back(first);
    while (!pending.empty()) {
      const std::uint32_t vertex = pending.back();
      pending.pop_back();
      for (const std::uint32_t neighbour : adjacent_[vertex]) {
        if (!met[neighbour]) {
          met[neighbour] = true;
          pending.push_back(neighbour);
        }
      }
    }
  }
  return components;
}

// ---- triangles

Operations glued_triangles(std::uint32_t triangles, std::uint64_t seed) {
  sparse::expects(triangles >= 1, "there is a triangle");
  Operations operations;
  Gluings sides("t");
  ops::Identify vertices;
  for (std::uint32_t number = 0; number < triangles; ++number) {
    const std::string name = "t" + std::to_string(number);
    operations.emplace_back(ops::MakeSimplex{name, 2, {}});
    for (const std::uint32_t face : {0U, 1U, 2U}) {
      constexpr std::array<const char*, 3> without{".1-2", ".0-2", ".0-1"};
      sides.add(name + without.at(face), {number, face});
      if (const std::string vertex = name + "." + std::to_string(face); vertex != "t0.0") {
        vertices.pairs.emplace_back("t0.0", vertex);
      }
    }
  }
  operations.emplace_back(std::move(vertices));
  Draws draws(seed);
  for (std::uint32_t step = 0; step < 10 * triangles; ++step) {
    operations.push_back(random_change(sides, draws));
  }
  for (std::size_t a = 0; a < sides.size();) {
    std::vector<bool> goes(sides[a].incidences.size());
    if (goes.size() == 1) {
      ++a;
    } else {
      goes.back() = true;
      operations.push_back(sides.split(a, goes));
    }
  }
  return operations;
}

}  // namespace sesame::tools
