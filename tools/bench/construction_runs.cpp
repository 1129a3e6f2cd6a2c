#include <algorithm>

#include "sparse/contract.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/runs.hpp"

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

const MethodEntry& entry_of(const std::string& method) {
  const auto found = std::ranges::find(methods(), method, &MethodEntry::name);
  sparse::expects(found != methods().end(), "the method of a run exists");
  return *found;
}

}  // namespace

std::string difference(const engine::Homology& found, const Answer& answer) {
  std::vector<std::int64_t> betti = found.betti, right_betti = answer.betti;
  std::vector<std::vector<Integer>> torsion = found.torsion, right_torsion;
  for (const auto& factors : answer.torsion) {
    right_torsion.emplace_back(factors.begin(), factors.end());
  }
  for (auto* list : {&betti, &right_betti}) {
    drop_trailing(*list, std::int64_t{0});
  }
  for (auto* list : {&torsion, &right_torsion}) {
    drop_trailing(*list, {});
  }
  if (betti == right_betti && torsion == right_torsion) {
    return "";
  }
  return "found " + text_of(betti, torsion) + "; right is " + text_of(right_betti, right_torsion);
}

Sample run_construction(const Scenario& scenario, std::uint64_t size, const std::string& method_name,
                        const RunOptions& options) {
  const auto& construction = std::get<Construction>(scenario.input);
  const std::vector<ops::Operation> operations = construction.make(size);
  const Result<sparse::AnyRing> ring = sparse::parse_ring(scenario.ring);
  sparse::expects(ring.has_value(), "the ring of a scenario exists");
  engine::Homology homology;
  std::uint64_t terms_of_cycles = 0;
  const std::unique_ptr<Method> method = entry_of(method_name).make(*ring);
  Sample sample = measure_steps(operations.size(), options, [&](std::size_t k) -> Status {
    if (Status status = method->apply(operations[k]); !status) {
      return status;
    }
    homology = method->homology();
    if (construction.generators_every > 0 && (k + 1) % construction.generators_every == 0) {
      terms_of_cycles += method->generators();
    }
    return Done{};
  });
  sample.counts = method->counts();
  if (construction.generators_every > 0) {
    sample.counts.emplace_back("terms_of_generators", terms_of_cycles);
  }
  const std::optional<Answer> answer = scenario.answer(size);
  if (sample.verdict == Verdict::right && answer) {
    sample.remark = difference(homology, *answer);
    sample.verdict = sample.remark.empty() ? Verdict::right : Verdict::wrong;
  }
  return sample;
}

}  // namespace sesame::tools
