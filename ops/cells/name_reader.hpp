/// \file
/// What names denote: those that were given, and those that are put together from others.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>

#include "ops/cells/lineage.hpp"
#include "ops/cells/name_text.hpp"
#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// Reads one name.
///
/// Names that were given come first. Others are put together: {a,b} from labels, t.2-0 from vertices of a standard
/// simploid, v*c from any name of a cell that the cone from v was taken over, P.(a|b) from any names of two cells of
/// the factors. A sign in a part is one of the whole. No two apexes or products have names of which one could begin the
/// other's cells' names (Directory::is_ambiguous_prefix), so brackets that match leave no choice.
///
/// What v*c denotes it goes on denoting: it is the cone over the cell that c was when the cone was taken; or, if c was
/// none that is coned, over the one that it met first.
///
/// Cost: look-ups proportional to the length of the name, for each v*c of the last kind the nodes that c has become one
/// with. When names with odd brackets have been given (Directory::odd_names) and one is part of this name, all bars are
/// tried, up to a limit.
///
/// Threads: one at a time, for queries too.
class NameReader {
 public:
  /// Products and cones in a name, one within the other. More are not read, and no product or cone is made that has
  /// cells with such names.
  static constexpr int most_nested = 256;

  NameReader(const Structure& structure, std::string_view name)
      : structure_{structure}, text_{name}, looked_up_before_{structure.directory().looked_up()} {}

  /// A value of the node that the name was given to, or that is what the name describes: not in normal form.
  [[nodiscard]] std::optional<Value> read();
  enum class Failure : std::uint8_t { unknown, nested, ambiguous };
  /// Why `read` gave nothing.
  [[nodiscard]] Failure failure() const { return failure_; }

 private:
  struct Part {
    std::size_t begin, end;
  };
  [[nodiscard]] std::string_view text(Part part) const { return text_.substr(part.begin, part.end - part.begin); }
  [[nodiscard]] std::optional<Directory::Named> find(Part part) const;

  std::optional<Value> read(Part part);
  std::optional<Value> read_once(Part part);
  std::optional<Value> read_standard(Part part);
  std::optional<Value> read_seen(Part part);
  std::optional<Value> read_derived(Part part);
  std::optional<Value> read_coned(const Cone& cone, Part base);
  std::optional<Value> read_pair(FamilyId product, Part inside);
  std::optional<Value> read_pair(FamilyId product, Part left, Part right);
  std::optional<Value> read_factor(Part part, BodyId body, bool is_simplicial);
  bool enter();
  [[nodiscard]] bool contains_odd_name() const;

  [[nodiscard]] Value given(CellId cell) const;
  [[nodiscard]] Value value_of(const Incidence& incidence) const;
  [[nodiscard]] std::optional<Value> simplicial_pair(FamilyId product, const Value& left, const Value& right) const;
  /// What was a cell of one of some bodies, which are frozen.
  [[nodiscard]] std::optional<Value> in_bodies(Value value, std::span<const BodyId> bodies) const;
  [[nodiscard]] std::optional<Value> coned(const Cone& cone, Value base) const;
  [[nodiscard]] std::optional<Value> cone_over(const Cone& cone, const Value& value) const;
  [[nodiscard]] CellId written_cone_over(const Cone& cone, CellId base) const;

  const Structure& structure_;
  Lineage lineage_{structure_};
  std::string_view text_;
  std::uint64_t looked_up_before_;
  std::optional<PartHashes> hashes_;  // these two when parts are looked at
  std::optional<Brackets> brackets_;
  bool tries_all_bars_ = false;
  std::unordered_map<std::uint64_t, std::optional<Value>> known_;  // per part, when all bars are tried
  std::uint64_t readings_ = 0;
  int depth_ = 0;
  Failure failure_ = Failure::unknown;
};

}  // namespace sesame::ops
