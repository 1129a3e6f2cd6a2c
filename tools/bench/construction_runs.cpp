#include <algorithm>

#include "sparse/contract.hpp"
#include "tools/bench/answer_check.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/runs.hpp"

namespace sesame::tools {
namespace {

std::unique_ptr<Method> method_of(const Scenario& scenario, const std::string& name) {
  const auto entry = std::ranges::find(methods(), name, &MethodEntry::name);
  const Result<sparse::AnyRing> ring = sparse::parse_ring(scenario.ring);
  sparse::expects(entry != methods().end() && ring.has_value(), "the method of a run and the ring of a scenario exist");
  return entry->make(*ring);
}

}  // namespace

Sample run_construction(const Scenario& scenario, std::uint64_t size, const std::string& method_name,
                        const RunOptions& options, StepTimes& times) {
  const auto& construction = std::get<Construction>(scenario.input);
  const std::vector<ops::Operation> operations = construction.make(size);
  engine::Homology homology;
  std::uint64_t terms_of_cycles = 0;
  const std::unique_ptr<Method> method = method_of(scenario, method_name);
  Sample sample = measure_steps(operations.size(), options, times, [&](std::size_t k) -> Status {
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
    if (const Status right = check(homology, *answer); !right) {
      sample.remark = right.error().what;
      sample.verdict = Verdict::wrong;
    }
  }
  return sample;
}

Sample check_construction(const Scenario& scenario, std::uint64_t size, const std::string& method_name,
                          std::uint64_t steps, double most_seconds, StepTimes& times) {
  const std::vector<ops::Operation> operations = std::get<Construction>(scenario.input).make(size);
  const std::unique_ptr<Method> method = method_of(scenario, method_name);
  AnswerCheck check(scenario, size, method_name, operations.size());
  const auto checked_step = [&](std::size_t k) -> Status {
    Status status = method->apply(operations[k]);
    return status ? check.after(operations[k], method->homology()) : status;
  };
  Sample sample = measure_steps(std::min<std::size_t>(steps, operations.size()), {most_seconds}, times, checked_step);
  sample.checked = check.compared();
  return sample;
}

}  // namespace sesame::tools
