// The steps of a soak that change cells which are there.
#include <algorithm>

#include "ops/cells/cofaces.hpp"
#include "tools/bench/soak_steps.hpp"

namespace sesame::tools {
namespace {

/// In the names of what is multiplied or coned, as the new names have these in them.
constexpr std::size_t most_letters = 40;

using Incidence = std::pair<ops::CellId, std::uint32_t>;

/// The incidences of the same cell that some face law says are the same one seen from above.
std::vector<Incidence> tied_to(const ops::Structure& structure, const Incidence& incidence) {
  std::vector<Incidence> tied;
  for (const ops::CellId coface : ops::cofaces(structure, incidence.first)) {
    const auto faces = structure.faces().of(coface);
    for (const ops::FaceLaw& law : structure.cells().type(coface).laws) {
      const ops::Value one = structure.values().of(faces[law.first]);
      const ops::Value other = structure.values().of(faces[law.other_first]);
      const Incidence first{one.cell, law.second};
      const Incidence second{other.cell, law.other_second};
      if (!one.is_degenerate() && !other.is_degenerate() && (first == incidence || second == incidence)) {
        tied.push_back(first == incidence ? second : first);
      }
    }
  }
  return tied;
}

template <class T>
bool contains(const std::vector<T>& list, const T& element) {
  return std::find(list.begin(), list.end(), element) != list.end();
}

}  // namespace

std::optional<ops::Operation> SoakSteps::cone(bool is_suspension) {
  std::vector<std::string> over;
  for (std::uint32_t wanted = 1 + draws_.below(2); wanted > 0; --wanted) {
    if (const CellId cell = pick();
        cell != ops::none && structure().dimension(cell) <= 2 && structure().name(cell).size() <= most_letters) {
      over.push_back(structure().name(cell));
    }
  }
  if (over.empty()) {
    return std::nullopt;
  }
  if (is_suspension) {
    return ops::MakeSuspension{{fresh(), fresh()}, std::move(over), {}};
  }
  return ops::MakeCone{fresh(), std::move(over), {}};
}

std::optional<ops::Operation> SoakSteps::product() {
  const CellId one = pick(), other = pick();
  if (one == ops::none) {
    return std::nullopt;
  }
  const ops::BodyId left = structure().body_of(one), right = structure().body_of(other);
  const ops::Bodies& bodies = structure().bodies();
  const auto& directory = structure().directory();
  if (sum_of(bodies.counts(left)) * sum_of(bodies.counts(right)) > cells_of_patch ||
      bodies.counts(left).size() + bodies.counts(right).size() > 6 ||
      bodies.nesting(left) + bodies.nesting(right) > 0 ||
      structure().name(one).size() + structure().name(other).size() > most_letters) {
    return std::nullopt;
  }
  return ops::MakeProduct{fresh(), std::string{directory.name_of_body(left)},
                          std::string{directory.name_of_body(right)}, one_in(3)};
}

std::optional<ops::Operation> SoakSteps::identification() {
  const CellId cell = pick();
  const std::vector<CellId>& cells = patches_[patch_];
  if (cell == ops::none) {
    return std::nullopt;
  }
  const ops::TypeId type = structure().cells().type_id(cell);
  ops::Identify operation;
  for (std::uint32_t pairs = one_in(5) ? 2 : 1, begin = draws_.below(cells.size()), k = 0;
       pairs > 0 && k < cells.size(); ++k) {
    const CellId other = cells[(begin + k) % cells.size()];
    if (other != cell && is_there(other) && structure().cells().type_id(other) == type) {
      operation.pairs.emplace_back(structure().name(cell), structure().name(other));
      --pairs;
    }
  }
  if (operation.pairs.empty()) {
    return std::nullopt;
  }
  constexpr std::uint64_t steps_remembered = 500;
  if (const auto& [name, step] = removed_[patch_]; !name.empty() && accepted_ < step + steps_remembered && one_in(10)) {
    operation.pairs[0].second = name;
  } else if (const ops::CellType& of = structure().cells().type(cell).type; of.size() == 1 && one_in(8)) {
    std::vector<int> order(static_cast<std::size_t>(of[0]) + 1);
    for (std::size_t k = 0; k < order.size(); ++k) {
      order[k] = static_cast<int>(k);
    }
    draws_.shuffle_to_front(order, order.size());
    operation.maps.emplace(0, ops::Identify::Map{std::move(order)});
  }
  return operation;
}

std::optional<ops::Operation> SoakSteps::degeneration() {
  const CellId cell = pick();
  if (cell == ops::none || structure().dimension(cell) == 0) {
    return std::nullopt;
  }
  const ops::CellType& type = structure().cells().type(cell).type;
  const std::uint32_t component = draws_.below(type.size());
  return ops::Degenerate{structure().name(cell), static_cast<int>(component) + 1,
                         static_cast<int>(draws_.below(static_cast<std::uint64_t>(type[component])))};
}

/// Of an open star.
std::optional<ops::Operation> SoakSteps::removal() {
  const CellId cell = pick();
  return cell == ops::none ? std::nullopt : std::optional<ops::Operation>{ops::Remove{{structure().name(cell)}, true}};
}

/// Of any cell; many have no star that can be flipped, and the step is refused.
std::optional<ops::Operation> SoakSteps::replacement() {
  const CellId cell = pick();
  if (cell == ops::none || structure().name(cell).size() > most_letters) {
    return std::nullopt;
  }
  if (one_in(3)) {
    return ops::Replace{ops::Replace::Subdivision{structure().name(cell), fresh(), {}}};
  }
  return ops::Replace{ops::Replace::Flip{structure().name(cell), fresh(), {}}};
}

/// A cell of which some incidences go to a copy: those that the face laws tie to one of them.
std::optional<ops::Operation> SoakSteps::split() {
  constexpr std::size_t most_incidences = 60;
  const CellId cell = pick();
  if (cell == ops::none) {
    return std::nullopt;
  }
  std::vector<Incidence> incidences;
  for (const CellId coface : ops::cofaces(structure(), cell)) {
    const auto faces = structure().faces().of(coface);
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
      const ops::Value face = structure().values().of(faces[k]);
      if (face.cell == cell && !face.is_degenerate()) {
        incidences.emplace_back(coface, k);
      }
    }
  }
  if (incidences.empty() || incidences.size() > most_incidences) {
    return std::nullopt;
  }
  ops::Deidentify::Split split{structure().name(cell), fresh(), {}};
  std::vector<Incidence> moved{incidences[draws_.below(incidences.size())]};
  for (std::size_t done = 0; done < moved.size(); ++done) {
    for (const Incidence& tied : tied_to(structure(), moved[done])) {
      if (!contains(moved, tied)) {
        moved.push_back(tied);
      }
    }
  }
  for (const auto& [coface, k] : moved) {
    split.moves.emplace_back(structure().name(coface), k);
  }
  return ops::Deidentify{{std::move(split)}};
}

/// A cell comes away from the rest: every cell of its closure gets a copy, and all incidences within the closure go to
/// these. Refused when it is a face itself and the laws say so.
std::optional<ops::Operation> SoakSteps::tear() {
  const CellId top = pick();
  if (top == ops::none || structure().dimension(top) == 0) {
    return std::nullopt;
  }
  std::vector<CellId> closure{top};
  for (std::size_t done = 0; done < closure.size(); ++done) {
    for (const CellId face : structure().faces().of(closure[done])) {
      const ops::Value value = structure().values().of(face);
      if (value.is_degenerate()) {
        return std::nullopt;
      }
      if (!contains(closure, value.cell)) {
        closure.push_back(value.cell);
      }
    }
  }
  ops::Deidentify operation;
  std::vector<std::string> names{structure().name(top)};
  for (std::size_t k = 1; k < closure.size(); ++k) {
    names.push_back(fresh());
    operation.splits.push_back({structure().name(closure[k]), names.back(), {}});
  }
  for (std::size_t k = 0; k < closure.size(); ++k) {
    const auto faces = structure().faces().of(closure[k]);
    for (std::uint32_t slot = 0; slot < faces.size(); ++slot) {
      const CellId face = structure().values().of(faces[slot]).cell;
      const auto at = std::find(closure.begin(), closure.end(), face) - closure.begin();
      operation.splits[static_cast<std::size_t>(at) - 1].moves.emplace_back(names[k], slot);
    }
  }
  return operation;
}

std::string SoakSteps::label_of(CellId cell) {
  const ops::AbstractComplex& abstract = structure().abstract();
  const auto vertices = abstract.vertices(cell);
  return std::string{abstract.text(abstract.label_of(vertices[draws_.below(vertices.size())]))};
}

std::optional<ops::Operation> SoakSteps::abstract_step(bool is_large) {
  const CellId one = pick(), other = pick();
  if (one == ops::none || (!is_large && !one_in(6))) {
    return abstract_growth();
  }
  std::string from = label_of(one), to = label_of(other);
  if (from == to) {
    return std::nullopt;
  }
  return ops::Collapse{std::move(from), std::move(to)};
}

/// Simplices on vertices that are there, and now and then a new one.
std::optional<ops::Operation> SoakSteps::abstract_growth() {
  std::vector<std::string> labels;
  for (std::uint32_t wanted = 1 + draws_.below(4); wanted > 0; --wanted) {
    const CellId cell = pick();
    std::string label = cell == ops::none || one_in(3) ? fresh("p") : label_of(cell);
    if (!contains(labels, label)) {
      labels.push_back(std::move(label));
    }
  }
  ops::Insert operation;
  operation.simplices.push_back(labels);
  operation.exist_ok = true;
  return operation;
}

}  // namespace sesame::tools
