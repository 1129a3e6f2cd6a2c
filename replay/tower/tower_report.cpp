#include "replay/tower/tower_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "replay/tower/bar_chains.hpp"

namespace sesame::replay {
namespace {

using engine::Bar;
using engine::Barcode;
using engine::never;

void add_bar(TextBuffer& text, const Bar& bar) {
  text.add('[').add_integer(bar.dimension).add(',').add_json_number(bar.birth).add(',');
  if (bar.death == never) {
    text.add("null]");
  } else {
    text.add_json_number(bar.death).add(']');
  }
}

}  // namespace

// ---- statistics

void BarStatistics::add(const Bar& bar) {
  const auto p = static_cast<std::size_t>(bar.dimension);
  if (rows_.size() <= p) {
    rows_.resize(p + 1);
  }
  Row& row = rows_[p];
  ++row.bars;
  if (bar.death == never) {
    ++row.open;
    return;
  }
  row.longest = std::max(row.longest, bar.death - bar.birth);
  if (longest_.size() < most_shown) {
    longest_.push_back(bar);
    std::ranges::push_heap(longest_, is_longer);
  } else if (is_longer(bar, longest_.front())) {
    std::ranges::pop_heap(longest_, is_longer);
    longest_.back() = bar;
    std::ranges::push_heap(longest_, is_longer);
  }
}

std::vector<Bar> BarStatistics::longest() const {
  std::vector<Bar> bars = longest_;
  std::ranges::sort(bars, is_longer);
  return bars;
}

// ---- tables

void write_tower_table(std::ostream& out, const TowerResult& result) {
  const Barcode counts{{}, result.hidden};
  out << provenance_line(counts, result.provenance) << '\n';
  const Provenance& provenance = result.provenance;
  if (provenance.added_faces > 0) {
    out << provenance.added_faces << (provenance.added_faces == 1 ? " missing face" : " missing faces") << " added\n";
  }
  if (provenance.already > 0) {
    out << provenance.already << (provenance.already == 1 ? " simplex that was" : " simplices that were")
        << " there already left out\n";
  }
  if (result.shorter > 0) {
    out << result.shorter << (result.shorter == 1 ? " shorter bar" : " shorter bars") << " left out\n";
  }
  if (result.open > 0) {
    out << result.open << (result.open == 1 ? " open bar" : " open bars") << " left out\n";
  }
  if (provenance.max_dimension) {
    out << "dimensions up to " << *provenance.max_dimension << '\n';
  }
  out << "  dim        bars        open     longest that ended\n";
  const auto& rows = result.statistics.rows();
  for (std::size_t p = 0; p < rows.size(); ++p) {
    out << fmt::format("  {:>3}  {:>10}  {:>10}  {:>10}\n", p, rows[p].bars, rows[p].open,
                       rows[p].bars == rows[p].open ? "-" : number_text(rows[p].longest));
  }
  const std::vector<Bar> longest = result.statistics.longest();
  if (!longest.empty()) {
    out << "the longest bars that ended\n";
    for (const Bar& bar : longest) {
      out << fmt::format("  H{} {}  length {}\n", bar.dimension, interval_text(bar),
                         number_text(bar.death - bar.birth));
    }
  }
}

namespace {

struct BarDifference {
  Bar bar;
  std::vector<std::uint64_t> multiplicity;  ///< per ring
};

/// The bars are sorted. Cost: their number.
std::vector<BarDifference> differences_of(std::span<const TowerResult> results) {
  std::vector<BarDifference> found;
  std::vector<std::size_t> at(results.size(), 0);
  while (true) {
    const Bar* least = nullptr;
    for (std::size_t r = 0; r < results.size(); ++r) {
      const std::vector<Bar>& bars = results[r].barcode->bars;
      if (at[r] < bars.size() && (least == nullptr || bars[at[r]] < *least)) {
        least = &bars[at[r]];
      }
    }
    if (least == nullptr) {
      return found;
    }
    BarDifference difference{*least, std::vector<std::uint64_t>(results.size(), 0)};
    for (std::size_t r = 0; r < results.size(); ++r) {
      const std::vector<Bar>& bars = results[r].barcode->bars;
      while (at[r] < bars.size() && bars[at[r]] == difference.bar) {
        ++difference.multiplicity[r];
        ++at[r];
      }
    }
    if (std::ranges::adjacent_find(difference.multiplicity, std::ranges::not_equal_to{}) !=
        difference.multiplicity.end()) {
      found.push_back(std::move(difference));
    }
  }
}

}  // namespace

void write_differences(std::ostream& out, std::span<const TowerResult> results) {
  const std::vector<BarDifference> differences = differences_of(results);
  if (differences.empty()) {
    out << "the barcodes are the same over all rings\n";
    return;
  }
  out << "bars that differ from ring to ring: there is torsion in the tower, or in how its complexes lie in one "
         "another\n ";
  for (const TowerResult& result : results) {
    out << fmt::format(" {:>8}", result.provenance.ring);
  }
  out << '\n';
  for (const BarDifference& each : differences) {
    out << ' ';
    for (const std::uint64_t times : each.multiplicity) {
      out << fmt::format(" {:>8}", times);
    }
    out << fmt::format("   H{} {}\n", each.bar.dimension, interval_text(each.bar));
  }
}

// ---- cycles

template <class Visit>
void CycleReport::for_each_bar(Visit&& visit) const {
  const BarChainNamer namer(tracker_, history_, operations_);
  for (const engine::BarCycles::TracedBar& traced : namer.cycles().bars()) {
    const Bar& bar = traced.bar;
    if (bar.birth == bar.death || !selection_.has(bar) || !options_.wants(bar.dimension)) {
      continue;
    }
    if (stop_ != nullptr && stop_->load()) {
      return;
    }
    const BarChains chains = namer.chains(traced);
    visit(bar, chains.cycle, chains.second);
  }
}

void CycleReport::write_table(std::ostream& out) const {
  for_each_bar([&](const Bar& bar, const auto& cycle, const auto& second) {
    out << fmt::format("H{} {}\n  born as  {}\n  {}  {}\n", bar.dimension, interval_text(bar),
                       chain_line(cycle, options_.most_terms), bar.death == never ? "now    " : "bounds ",
                       chain_line(second, options_.most_terms));
  });
}

void CycleReport::add_json(TextBuffer& text) const {
  text.add('[');
  bool is_first = true;
  for_each_bar([&](const Bar& bar, const auto& cycle, const auto& second) {
    text.add(is_first ? "{" : ",{")
        .add(R"("dim":)")
        .add_integer(bar.dimension)
        .add(R"(,"birth":)")
        .add_json_number(bar.birth);
    is_first = false;
    text.add(R"(,"death":)");
    if (bar.death == never) {
      text.add("null");
    } else {
      text.add_json_number(bar.death);
    }
    add_chain_member(text, "cycle", cycle, options_.most_terms);
    add_chain_member(text, bar.death == never ? "now" : "bounds", second, options_.most_terms);
    text.add('}');
  });
  text.add(']');
}

// ---- JSON

namespace {

void add_fields(TextBuffer& text, const TowerResult& result) {
  add_barcode_fields(text, selected(result.barcode.value(), result.selection), result.provenance);
  if (result.shorter > 0) {
    text.add(R"(,"shorter":)").add_integer(result.shorter);
  }
  if (result.open > 0) {
    text.add(R"(,"open":)").add_integer(result.open);
  }
}

void add_rings(TextBuffer& text, std::span<const TowerResult> results) {
  text.add(R"("rings":[)");
  bool is_first = true;
  for (const TowerResult& result : results) {
    text.add(is_first ? "{" : ",{");
    is_first = false;
    add_fields(text, result);
    text.add('}');
  }
  text.add(R"(],"differences":[)");
  is_first = true;
  for (const BarDifference& each : differences_of(results)) {
    text.add(is_first ? R"({"bar":)" : R"(,{"bar":)");
    is_first = false;
    add_bar(text, each.bar);
    text.add(R"(,"multiplicity":{)");
    for (std::size_t r = 0; r < results.size(); ++r) {
      text.add(r == 0 ? "\"" : ",\"").add(results[r].provenance.ring).add("\":").add_integer(each.multiplicity[r]);
    }
    text.add("}}");
  }
  text.add(']');
}

}  // namespace

void write_tower_json(std::ostream& out, std::span<const TowerResult> results, const ClassReport* classes,
                      std::chrono::steady_clock::time_point start) {
  TextBuffer text(out);
  text.add('{');
  if (results.size() == 1) {
    add_fields(text, results[0]);
  } else {
    add_rings(text, results);
  }
  if (classes != nullptr) {
    text.add(R"(,"generators":)");
    classes->add_json(text);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  text.add(R"(,"seconds":)").add_number(seconds.count()).add("}\n");
}

}  // namespace sesame::replay
