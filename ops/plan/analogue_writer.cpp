#include "ops/plan/analogue_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <utility>

#include "ops/plan/new_cells.hpp"

namespace sesame::ops {

AnalogueWriter::AnalogueWriter(const std::string& name, Analogue analogue, const Structure& structure, Plan& plan)
    : name_{name},
      analogue_{std::move(analogue)},
      structure_{structure},
      plan_{plan},
      all_{(IndexSet{2} << analogue_.dimension) - 1} {}

Status AnalogueWriter::write(const Limits& limits) {
  if (Status s = find_orbits(limits); !s) {
    return s;
  }
  plan_.first = structure_.cells().size();
  for (int size = 1; size <= analogue_.dimension + 1; ++size) {
    for (IndexSet set = 1; set <= all_; ++set) {
      if (std::popcount(set) == size) {
        write_simplices(set);
      }
    }
  }
  return Done{};
}

Status AnalogueWriter::find_orbits(const Limits& limits) {
  if (Status s = check_room(static_cast<std::int64_t>(all_), structure_, limits); !s) {  // one at least for each set
    return s;
  }
  first_.resize(all_ + 1);
  orbits_.resize(all_ + 1);
  std::int64_t count = 0;
  for (IndexSet set = 1; set <= all_; ++set) {
    orbits_[set] = analogue_.family(set);
    count += orbits_[set].count();
  }
  return check_room(count, structure_, limits);
}

CellId AnalogueWriter::face(IndexSet set, int without, Dart d) const {
  const IndexSet rest = set & ~(IndexSet{1} << without);
  const bool falls = rest < (IndexSet{1} << without);  // it was the largest
  return simplex(rest, falls ? analogue_.lower(d, without, static_cast<int>(std::bit_width(rest)) - 1) : d);
}

void AnalogueWriter::write_simplices(IndexSet set) {
  std::vector<int> numbers;
  for (int i = 0; i <= analogue_.dimension; ++i) {
    if ((set >> i & 1U) != 0) {
      numbers.push_back(i);
    }
  }
  first_[set] = plan_.first + plan_.cells.size();
  const TypeId type = structure_.types().simplex(static_cast<int>(numbers.size()) - 1);
  for (const Dart d : orbits_[set].first) {
    const std::size_t first_face = plan_.faces.size();
    for (std::size_t k = 0; k < numbers.size() && numbers.size() > 1; ++k) {
      add_face({face(set, numbers[k], d), same_order}, plan_);
    }
    fmt::format_to(std::back_inserter(plan_.names), "{}.<{}>:{}", name_, fmt::join(numbers, "-"), analogue_.text(d));
    add_cell(type, first_face, plan_);
  }
}

}  // namespace sesame::ops
