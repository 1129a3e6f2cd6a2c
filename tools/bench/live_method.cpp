#include "tools/bench/live_method.hpp"

namespace sesame::tools {
namespace {

class LiveMethod final : public Method {
 public:
  explicit LiveMethod(const sparse::AnyRing& ring) : engine_{ring} {}

  Status apply(const ops::Operation& operation) override {
    const Result<engine::StepReport> report = engine_.apply(operation);
    return report ? Status{Done{}} : Status{report.error()};
  }
  engine::Homology homology() override { return engine_.homology(); }
  std::uint64_t generators() override {
    std::uint64_t terms = 0;
    for (int degree = 0; degree < static_cast<int>(engine_.cells().size()); ++degree) {
      for (const engine::Generator& generator : engine_.generators(degree)) {
        terms += generator.cycle.terms.size();
      }
    }
    return terms;
  }
  [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> counts() const override {
    const engine::Work work = engine_.work();
    return {{"boundary_entries", work.boundary_entries},
            {"rewritten_terms", work.rewritten_terms},
            {"rule_terms", work.rule_terms},
            {"path_links", work.path_links},
            {"rebases", engine_.rebases()}};
  }

 private:
  engine::Engine engine_;
};

}  // namespace

std::unique_ptr<Method> make_live_method(const sparse::AnyRing& ring) { return std::make_unique<LiveMethod>(ring); }

}  // namespace sesame::tools
