#include "ops/simplicial/abstract_complex.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {

using sparse::expects;

namespace {

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

LabelId AbstractComplex::label(std::string_view text) const { return LabelId{texts_.number_of(text)}; }

LabelId AbstractComplex::root(LabelId label) const {
  while (labels_[label].parent != label) {
    label = labels_[label].parent;
  }
  return label;
}

VertexId AbstractComplex::vertex(LabelId label) const { return labels_[root(label)].vertex; }

LabelId AbstractComplex::add_label(std::string_view text) {
  const LabelId label{labels()};
  texts_.add(text, none, none);
  labels_.push_back({label, 1, VertexId{labels()}});
  label_of_.push_back(label);
  journal_.push_back({Change::Kind::label});
  return label;
}

void AbstractComplex::contract_labels(LabelId from, LabelId to, VertexId kept) {
  LabelId above = root(from);
  LabelId below = root(to);
  expects(above != below, "labels of different vertices are contracted");
  if (labels_[above].below < labels_[below].below) {
    std::swap(above, below);
  }
  contractions_.push_back({above, below, labels_[above].vertex, kept, label_of_[kept]});
  journal_.push_back({Change::Kind::contraction});
  labels_[below].parent = above;
  labels_[above].below += labels_[below].below;
  labels_[above].vertex = kept;
  label_of_[kept] = to;
}

// ------------------------------------------------------------------------------------------------------------- cells

CellId AbstractComplex::find(std::span<const VertexId> vertices) const {
  const SimplexIndex::Slot slot = simplices_.find(SimplexIndex::key(vertices));
  return slot == SimplexIndex::nothing ? none : cells_[vertices.size() - 1][slot];
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
  const CellId cell = find(different);
  return cell == none ? std::nullopt : std::optional{Named{cell, places_in(vertices(cell), *listed)}};
}

std::vector<CellId> AbstractComplex::star(VertexId vertex) const {
  std::vector<CellId> cells;
  cells.reserve(star_size(vertex));
  simplices_.for_each_in_star(
      vertex, [&](std::size_t dimension, SimplexIndex::Slot slot) { cells.push_back(cells_[dimension][slot]); });
  return cells;
}

AbstractComplex::Fate AbstractComplex::fate_of(CellId cell, VertexId moved, VertexId kept) const {
  const auto [slot, dimension] = place_[cell];
  const SimplexIndex::Change change = simplices_.change_of(dimension, slot, moved, kept);
  const bool is_merged = change.fate == SimplexIndex::Fate::merged;
  return {change.fate, change.moved_at, is_merged ? cells_[dimension][change.survivor] : none};
}

// ------------------------------------------------------------------------------------------------------------ change

void AbstractComplex::include(CellId cell, std::span<const VertexId> vertices) {
  const std::size_t dimension = vertices.size() - 1;
  const SimplexIndex::Slot slot = simplices_.slots(dimension);
  simplices_.include(SimplexIndex::key(vertices), slot);
  if (cells_.size() <= dimension) {
    cells_.resize(dimension + 1);
  }
  cells_[dimension].push_back(cell);
  if (place_.size() <= cell) {
    place_.resize(cell + std::size_t{1});
  }
  place_[cell] = {slot, static_cast<std::uint8_t>(dimension)};
  journal_.push_back({Change::Kind::inclusion, 0, place_[cell]});
}

void AbstractComplex::exclude(CellId cell) {
  simplices_.exclude(place_[cell].dimension, place_[cell].slot);
  journal_.push_back({Change::Kind::exclusion, 0, place_[cell]});
}

void AbstractComplex::rename(CellId cell, VertexId moved, VertexId kept) {
  const auto own = vertices(cell);
  const auto at = static_cast<std::size_t>(std::find(own.begin(), own.end(), moved) - own.begin());
  put_vertex(place_[cell], at, kept);
  journal_.push_back({Change::Kind::renaming, static_cast<std::uint8_t>(at), place_[cell], moved});
}

void AbstractComplex::put_vertex(const Place& place, std::size_t at, VertexId vertex) {
  std::array<VertexId, largest_dimension + 1> vertices;
  const auto old = simplices_.vertices(place.dimension, place.slot);
  std::copy(old.begin(), old.end(), vertices.begin());
  vertices[at] = vertex;
  simplices_.rename(place.dimension, place.slot, {vertices.data(), old.size()});
}

// -------------------------------------------------------------------------------------------------------------- undo

void AbstractComplex::undo_inclusion(const Place& place) {
  simplices_.exclude(place.dimension, place.slot);
  simplices_.drop_last_slot(place.dimension);
  std::vector<CellId>& cells = cells_[place.dimension];
  place_[cells.back()] = {};
  cells.pop_back();
}

void AbstractComplex::undo_contraction() {
  const Contraction& last = contractions_.back();
  labels_[last.child].parent = last.child;
  labels_[last.root].below -= labels_[last.child].below;
  labels_[last.root].vertex = last.before;
  label_of_[last.kept] = last.label_before;
  contractions_.pop_back();
}

void AbstractComplex::undo(const Change& change) {
  switch (change.kind) {
    case Change::Kind::label:
      texts_.pop_back();
      labels_.pop_back();
      return label_of_.pop_back();
    case Change::Kind::inclusion:
      return undo_inclusion(change.place);
    case Change::Kind::exclusion:
      return simplices_.include_again(change.place.dimension, change.place.slot);
    case Change::Kind::renaming:
      return put_vertex(change.place, change.at, change.before);
    case Change::Kind::contraction:
      return undo_contraction();
  }
}

void AbstractComplex::truncate(std::uint32_t mark) {
  while (journal_.size() > mark) {
    undo(journal_.back());
    journal_.pop_back();
  }
}

// --------------------------------------------------------------------------------------------------------- archives

void AbstractComplex::save(sparse::ArchiveWriter& to) const {
  texts_.save(to);
  to.put_list(labels_);
  to.put_list(label_of_);
  simplices_.save(to);
  for (const std::vector<CellId>& cells : cells_) {
    to.put_list(cells);
  }
}

void AbstractComplex::load(sparse::ArchiveReader& from, const std::function<bool(CellId, std::size_t)>& is_simplex) {
  texts_.load(from);
  labels_ = from.get_list<std::vector<Label>>();
  label_of_ = from.get_list<std::vector<LabelId>>();
  if (!from.check(labels_.size() == texts_.size() && label_of_.size() == labels_.size(), "each vertex has a label")) {
    label_of_.clear();
    return;
  }
  for (LabelId label = 0; label < labels() && from.is_good(); ++label) {
    from.check(is_sound(labels_[label], label) && label_of_[label] < labels(), "labels denote vertices");
  }
  simplices_.load(from, label_of_.size());
  cells_.resize(simplices_.dimensions());
  for (std::size_t dimension = 0; dimension < cells_.size() && from.is_good(); ++dimension) {
    cells_[dimension] = from.get_list<std::vector<CellId>>();
    from.check(cells_[dimension].size() == simplices_.slots(dimension), "each simplex is a cell");
    for (std::size_t slot = 0; slot < cells_[dimension].size() && from.is_good(); ++slot) {
      const CellId cell = cells_[dimension][slot];
      if (!from.check(is_simplex(cell, dimension) && !contains(cell), "each simplex is a cell of its own")) {
        return;
      }
      place_.resize(std::max(place_.size(), std::size_t{std::uint32_t{cell}} + 1));
      place_[cell] = {static_cast<SimplexIndex::Slot>(slot), static_cast<std::uint8_t>(dimension)};
    }
  }
}

/// Parents have at least twice as many labels below them: so one comes to an end, and soon.
bool AbstractComplex::is_sound(const Label& label, LabelId itself) const {
  return label.parent < labels_.size() && label.below > 0 && label.vertex < labels_.size() &&
         (label.parent == itself || labels_[label.parent].below / 2 >= label.below);
}

}  // namespace sesame::ops
