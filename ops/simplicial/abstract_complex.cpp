#include "ops/simplicial/abstract_complex.hpp"

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {

using sparse::expects;

namespace {

/// A word per vertex: as good as random, and the same in every run. Source: the generator splitmix64 of G. Steele,
/// D. Lea and C. Flood, "Fast splittable pseudorandom number generators" (2014).
std::uint64_t word_of(VertexId vertex) {
  std::uint64_t word = (std::uint64_t{vertex} + 1) * 0x9e37'79b9'7f4a'7c15U;
  word = (word ^ word >> 30U) * 0xbf58'476d'1ce4'e5b9U;
  word = (word ^ word >> 27U) * 0x94d0'49bb'1331'11ebU;
  return word ^ word >> 31U;
}

bool is_integer(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }) &&
         (text.size() == 1 || text.front() != '0');
}

}  // namespace

std::strong_ordering compare_labels(std::string_view a, std::string_view b) {
  const bool a_is_integer = is_integer(a);
  if (a_is_integer != is_integer(b)) {
    return a_is_integer ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  if (a_is_integer && a.size() != b.size()) {
    return a.size() <=> b.size();
  }
  return a.compare(b) <=> 0;  // of unsigned characters
}

bool is_label(std::string_view text) { return is_name(text) && text.find_first_of("{},") == std::string_view::npos; }

std::vector<std::uint8_t> places_in(std::span<const VertexId> other, std::span<const VertexId> one) {
  std::vector<std::uint8_t> places;
  for (const VertexId v : one) {
    places.push_back(static_cast<std::uint8_t>(std::find(other.begin(), other.end(), v) - other.begin()));
  }
  return places;
}

// ------------------------------------------------------------------------------------------------------------ labels

LabelId AbstractComplex::label(std::string_view text) const {
  const NameTable::Name* found = texts_.find(text);
  return found == nullptr ? none : found->cell;
}

LabelId AbstractComplex::root(LabelId label) const {
  while (labels_[label].parent != label) {
    label = labels_[label].parent;
  }
  return label;
}

VertexId AbstractComplex::vertex(LabelId label) const { return labels_[root(label)].vertex; }

LabelId AbstractComplex::add_label(std::string_view text) {
  const LabelId label = labels();
  texts_.add(text, label, none);
  labels_.push_back({label, 1, label});
  vertices_.push_back({word_of(label), label});
  journal_.push_back({Change::Kind::label});
  return label;
}

void AbstractComplex::join_labels(LabelId from, LabelId to, VertexId kept) {
  LabelId above = root(from);
  LabelId below = root(to);
  expects(above != below, "labels of different vertices are joined");
  if (labels_[above].below < labels_[below].below) {
    std::swap(above, below);
  }
  joints_.push_back({above, below, labels_[above].vertex, kept, vertices_[kept].label});
  journal_.push_back({Change::Kind::joint});
  labels_[below].parent = above;
  labels_[above].below += labels_[below].below;
  labels_[above].vertex = kept;
  vertices_[kept].label = to;
}

// ------------------------------------------------------------------------------------------------------------- cells

std::uint32_t AbstractComplex::end_of(std::uint32_t number) const {
  return number + 1 < cells_.size() ? cells_[number + 1].first : static_cast<std::uint32_t>(vertex_.size());
}

std::span<const VertexId> AbstractComplex::vertices_of(std::uint32_t number) const {
  return std::span{vertex_}.subspan(cells_[number].first, end_of(number) - cells_[number].first);
}

std::uint32_t AbstractComplex::find_number(std::span<const VertexId> vertices) const {
  std::uint64_t sum = 0;
  for (const VertexId v : vertices) {
    sum += vertices_[v].word;
  }
  touched_ += vertices.size();
  const auto [first, last] = by_sum_.equal_range(sum);
  const auto found = std::find_if(first, last, [&](const auto& entry) {
    const auto of_cell = vertices_of(entry.second);
    return of_cell.size() == vertices.size() && std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) {
             return std::find(of_cell.begin(), of_cell.end(), v) != of_cell.end();
           });
  });
  return found == last ? none : found->second;
}

CellId AbstractComplex::find(std::span<const VertexId> vertices) const {
  const std::uint32_t number = find_number(vertices);
  return number == none ? none : cells_[number].id;
}

std::optional<std::vector<VertexId>> AbstractComplex::vertices_named(std::string_view name) const {
  if (empty() || name.size() < 3 || name.front() != '{' || name.back() != '}') {
    return std::nullopt;
  }
  std::vector<LabelId> labels;
  std::vector<VertexId> vertices;
  for (std::string_view rest = name.substr(1, name.size() - 2);;) {
    const std::string_view text = rest.substr(0, rest.find(','));
    const LabelId known = label(text);
    if (known == none || std::find(labels.begin(), labels.end(), known) != labels.end() ||
        static_cast<int>(labels.size()) > largest_dimension) {
      return std::nullopt;
    }
    labels.push_back(known);
    vertices.push_back(vertex(known));
    if (text.size() == rest.size()) {
      return vertices;
    }
    rest.remove_prefix(text.size() + 1);
  }
}

std::optional<AbstractComplex::Named> AbstractComplex::find_named(std::string_view name) const {
  const auto listed = vertices_named(name);
  if (!listed) {
    return std::nullopt;
  }
  std::vector<VertexId> different = *listed;
  std::sort(different.begin(), different.end());
  different.erase(std::unique(different.begin(), different.end()), different.end());
  const std::uint32_t number = find_number(different);
  return number == none ? std::nullopt
                        : std::optional{Named{cells_[number].id, places_in(vertices_of(number), *listed)}};
}

std::vector<CellId> AbstractComplex::star(VertexId vertex) const {
  std::vector<CellId> cells;
  for (std::uint32_t i = vertices_[vertex].first; i != none; i = incidences_[i].after) {
    cells.push_back(cells_[incidences_[i].cell].id);
  }
  touched_ += cells.size();
  return cells;
}

// ------------------------------------------------------------------------------------------------------------ change

void AbstractComplex::link(std::uint32_t incidence) {
  Vertex& vertex = vertices_[vertex_[incidence]];
  incidences_[incidence].before = none;
  incidences_[incidence].after = vertex.first;
  if (vertex.first != none) {
    incidences_[vertex.first].before = incidence;
  }
  vertex.first = incidence;
  ++vertex.star_size;
  ++touched_;
}

void AbstractComplex::unlink(std::uint32_t incidence) {
  Vertex& vertex = vertices_[vertex_[incidence]];
  const auto [cell, before, after] = incidences_[incidence];
  (before == none ? vertex.first : incidences_[before].after) = after;
  if (after != none) {
    incidences_[after].before = before;
  }
  --vertex.star_size;
  ++touched_;
}

void AbstractComplex::enter(std::uint32_t number) { by_sum_.emplace(cells_[number].sum, number); }

void AbstractComplex::leave(std::uint32_t number) {
  const auto [first, last] = by_sum_.equal_range(cells_[number].sum);
  by_sum_.erase(std::find_if(first, last, [number](const auto& entry) { return entry.second == number; }));
}

void AbstractComplex::set_vertex(std::uint32_t incidence, VertexId vertex) {
  const std::uint32_t number = incidences_[incidence].cell;
  leave(number);
  unlink(incidence);
  cells_[number].sum += vertices_[vertex].word - vertices_[vertex_[incidence]].word;
  vertex_[incidence] = vertex;
  link(incidence);
  enter(number);
}

void AbstractComplex::add(CellId cell, std::span<const VertexId> vertices) {
  const auto number = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back({cell, static_cast<std::uint32_t>(vertex_.size()), 0});
  for (const VertexId v : vertices) {
    vertex_.push_back(v);
    incidences_.push_back({number, none, none});
    cells_[number].sum += vertices_[v].word;
    link(static_cast<std::uint32_t>(vertex_.size() - 1));
  }
  enter(number);
  if (number_.size() <= cell) {
    number_.resize(cell + std::size_t{1}, none);
  }
  number_[cell] = number;
  journal_.push_back({Change::Kind::cell});
}

void AbstractComplex::remove(CellId cell) {
  const std::uint32_t number = number_[cell];
  leave(number);
  for (std::uint32_t i = cells_[number].first; i < end_of(number); ++i) {
    unlink(i);
  }
  journal_.push_back({Change::Kind::removal, number});
}

void AbstractComplex::replace(CellId cell, VertexId before, VertexId after) {
  std::uint32_t incidence = cells_[number_[cell]].first;
  while (vertex_[incidence] != before) {
    ++incidence;
  }
  set_vertex(incidence, after);
  journal_.push_back({Change::Kind::replacement, incidence, before});
}

void AbstractComplex::undo(const Change& change) {
  switch (change.kind) {
    case Change::Kind::label:
      texts_.pop_back();
      labels_.pop_back();
      vertices_.pop_back();
      break;
    case Change::Kind::cell: {
      const auto number = static_cast<std::uint32_t>(cells_.size() - 1);
      leave(number);
      while (vertex_.size() > cells_[number].first) {
        unlink(static_cast<std::uint32_t>(vertex_.size() - 1));
        vertex_.pop_back();
        incidences_.pop_back();
      }
      number_[cells_[number].id] = none;
      cells_.pop_back();
      break;
    }
    case Change::Kind::removal:
      for (std::uint32_t i = cells_[change.what].first; i < end_of(change.what); ++i) {
        link(i);
      }
      enter(change.what);
      break;
    case Change::Kind::replacement:
      set_vertex(change.what, change.before);
      break;
    case Change::Kind::joint: {
      const Joint& joint = joints_.back();
      labels_[joint.child].parent = joint.child;
      labels_[joint.root].below -= labels_[joint.child].below;
      labels_[joint.root].vertex = joint.before;
      vertices_[joint.kept].label = joint.label_before;
      joints_.pop_back();
      break;
    }
  }
}

void AbstractComplex::truncate(std::uint32_t mark) {
  while (journal_.size() > mark) {
    undo(journal_.back());
    journal_.pop_back();
  }
}

}  // namespace sesame::ops
