/// \file
/// What names denote, by the plainest reader: the slow twin of ops::NameReader.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "ops/cells/degeneracy.hpp"
#include "ops/cells/name_text.hpp"
#include "ops/cells/structure.hpp"

namespace sesame::tests {

/// The rules for names as plainly as they can be said: a name that was given comes first, then a list of labels, then
/// every way to take the name apart is tried, shorter beginnings first. Exponential. Cones that are written out have
/// only the names that were given.
class PlainReader {
 public:
  explicit PlainReader(const ops::Structure& structure) : structure_{structure} {}

  [[nodiscard]] std::optional<ops::Value> read(std::string_view name) const {
    const auto node = node_of(name);
    if (!node) {
      return std::nullopt;
    }
    ops::Value v = structure_.values().of(*node);
    for (auto up = base_above(v); up; up = base_above(v)) {
      v = *up;
    }
    return v;
  }

  /// What a name denotes that was a cell of one of some bodies, which are frozen.
  [[nodiscard]] std::optional<ops::Value> in_bodies(std::string_view name,
                                                    const std::vector<ops::BodyId>& bodies) const {
    const auto node = node_of(name);
    for (auto v = node ? std::optional{structure_.values().of(*node)} : std::nullopt; v; v = base_above(*v)) {
      if (!is_deleted(structure_.forest(), v->cell) &&
          std::find(bodies.begin(), bodies.end(), structure_.body_of(v->cell)) != bodies.end()) {
        return v;
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<ops::Value> base_above(const ops::Value& v) const {
    const ops::FamilyId family = structure_.bodies().consumed_by(structure_.body_of(v.cell));
    if (family == ops::none || is_deleted(structure_.forest(), v.cell) ||
        structure_.lazy().family(family).kind != ops::FamilyKind::cone) {
      return std::nullopt;
    }
    return structure_.values().of(structure_.lazy().cell(family, ops::LazyPart::base, v));
  }

  [[nodiscard]] std::optional<ops::CellId> node_of(std::string_view name) const {
    if (const auto found = structure_.directory().find(name); found && found->cell != ops::none) {
      return found->cell;
    }
    for (std::size_t k = 1; k < name.size(); ++k) {
      for (ops::FamilyId f = 0; f < structure_.lazy().families(); ++f) {
        const ops::LazyFamily& family = structure_.lazy().family(f);
        const std::string_view rest = name.substr(k);
        if (family.name != name.substr(0, k)) {
          continue;
        }
        std::optional<ops::CellId> cell;
        if (family.kind == ops::FamilyKind::cone && rest.front() == '*') {
          const auto base = in_bodies(rest.substr(1), family.bodies);
          cell = base ? std::optional{structure_.lazy().cell(f, ops::LazyPart::coned, *base)} : std::nullopt;
        } else if (family.kind != ops::FamilyKind::cone && rest.starts_with(".(") && rest.back() == ')') {
          cell = pair(f, rest.substr(2, rest.size() - 3));
        }
        if (cell) {
          return cell;
        }
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ops::CellId> pair(ops::FamilyId f, std::string_view inside) const {
    const ops::LazyFamily& family = structure_.lazy().family(f);
    const bool is_simplicial = family.kind == ops::FamilyKind::simplicial_product;
    for (std::size_t k = 0; k < inside.size(); ++k) {
      if (inside[k] == '|') {
        const auto left = factor(inside.substr(0, k), family.bodies[0], is_simplicial);
        const auto right = factor(inside.substr(k + 1), family.bodies[1], is_simplicial);
        if (left && right && (!is_simplicial || left->type == right->type)) {
          return structure_.lazy().cell(f, ops::LazyPart::pair, *left, *right);
        }
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ops::Value> factor(std::string_view text, ops::BodyId body, bool is_simplicial) const {
    if (const auto found = in_bodies(text, {body})) {
      return found;
    }
    const auto split = is_simplicial ? ops::split_directions(text) : std::nullopt;
    const auto found = split ? in_bodies(text.substr(0, split->length), {body}) : std::nullopt;
    if (!found) {
      return std::nullopt;
    }
    int n = structure_.types().info(found->type).dimension;
    for (int d = 0; d <= ops::largest_dimension; ++d) {
      n += static_cast<int>(split->collapsed >> d & 1);
    }
    return n > ops::largest_dimension || split->collapsed >> n != 0
               ? std::nullopt
               : std::optional{ops::Value{found->cell, structure_.types().simplex(n),
                                          ops::compose(split->collapsed, found->collapsed)}};
  }

  const ops::Structure& structure_;
};

}  // namespace sesame::tests
