#include "tools/bench/answer_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <variant>

#include "sparse/contract.hpp"

namespace sesame::tools {
namespace {

using sparse::Integer;

std::string text_of(const std::vector<std::int64_t>& betti, const std::vector<std::vector<Integer>>& torsion) {
  std::string text = "Betti numbers";
  for (const std::int64_t b : betti) {
    text += " " + std::to_string(b);
  }
  text += ", torsion";
  for (const auto& factors : torsion) {
    text += " [";
    for (const Integer& factor : factors) {
      text += (text.back() == '[' ? "" : ",") + factor.to_string();
    }
    text += "]";
  }
  return text;
}

template <class T>
void drop_trailing(std::vector<T>& list, const T& nothing) {
  while (!list.empty() && list.back() == nothing) {
    list.pop_back();
  }
}

Status check(std::vector<std::int64_t> betti, std::vector<std::vector<Integer>> torsion,
             std::vector<std::int64_t> right_betti, std::vector<std::vector<Integer>> right_torsion) {
  for (auto* list : {&betti, &right_betti}) {
    drop_trailing(*list, std::int64_t{0});
  }
  for (auto* list : {&torsion, &right_torsion}) {
    drop_trailing(*list, {});
  }
  if (betti == right_betti && torsion == right_torsion) {
    return Done{};
  }
  return Error{Errc::expectation,
               "found " + text_of(betti, torsion) + "; right is " + text_of(right_betti, right_torsion)};
}

std::unique_ptr<Method> method_to_compare_with(const std::string& method, const std::string& ring_name) {
  const auto entry = std::ranges::find(methods(), method == "recompute" ? "live" : "recompute", &MethodEntry::name);
  const Result<sparse::AnyRing> ring = sparse::parse_ring(ring_name);
  sparse::expects(entry != methods().end() && ring.has_value(), "there are a method and a ring to compare with");
  return entry->make(*ring);
}

}  // namespace

Status check(const engine::Homology& found, const Answer& answer) {
  std::vector<std::vector<Integer>> torsion;
  for (const auto& factors : answer.torsion) {
    torsion.emplace_back(factors.begin(), factors.end());
  }
  return check(found.betti, found.torsion, answer.betti, std::move(torsion));
}

Status check(const std::vector<std::uint64_t>& betti, const Answer& answer) {
  return check(engine::Homology{{betti.begin(), betti.end()}, {}, {}, {}}, answer);
}

AnswerCheck::AnswerCheck(const Scenario& scenario, std::uint64_t size, const std::string& method, std::size_t steps)
    : last_{scenario.answer(size)}, steps_{steps} {
  if (const auto& construction = std::get<Construction>(scenario.input); construction.follow) {
    known_ = construction.follow(size);
  } else {
    other_ = method_to_compare_with(method, scenario.ring);
  }
}

Status AnswerCheck::after(const ops::Operation& operation, const engine::Homology& homology) {
  if (Status followed = follow(operation); !followed) {
    return followed;
  }
  ++done_;
  Status right = check_euler(homology);
  if (right) {
    right = check_groups(homology);
  }
  if (right && done_ == steps_ && last_) {
    right = check(homology, *last_);
  }
  if (!right) {
    return Error{Errc::expectation, fmt::format("after step {} of {}: {}", done_, steps_, right.error().what)};
  }
  return right;
}

Status AnswerCheck::follow(const ops::Operation& operation) {
  if (other_) {
    if (Status status = other_->apply(operation); !status) {
      return status;
    }
  }
  if (const auto* undo = std::get_if<ops::Undo>(&operation)) {
    return object_.take_back(undo->steps);
  }
  if (Status planned = object_.plan(operation); !planned) {
    return planned;
  }
  object_.carry_out();
  return Done{};
}

Status AnswerCheck::check_euler(const engine::Homology& homology) const {
  const std::int64_t found = alternating_sum(homology.betti);
  const std::int64_t right = ops::euler_characteristic(object_.structure());
  if (found != right) {
    return Error{Errc::expectation,
                 fmt::format("found Betti numbers {} with the Euler characteristic {}; that of the cells is {}",
                             fmt::join(homology.betti, " "), found, right)};
  }
  return Done{};
}

Status AnswerCheck::check_groups(const engine::Homology& homology) {
  if (known_) {
    const std::optional<Answer> answer = known_(done_ - 1);
    compared_ += answer ? 1 : 0;
    return answer ? check(homology, *answer) : Done{};
  }
  const auto counts = object_.structure().counts();
  const double cells = std::accumulate(counts.begin(), counts.end(), 1.0);
  effort_ += most_cells / static_cast<double>(steps_);
  if (cells > effort_) {
    return Done{};
  }
  effort_ -= cells;
  ++compared_;
  const engine::Homology right = other_->homology();
  return check(homology.betti, homology.torsion, right.betti, right.torsion);
}

}  // namespace sesame::tools
