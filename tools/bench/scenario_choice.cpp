// Scenarios and methods by their names.
#include <algorithm>

#include "tools/bench/method.hpp"
#include "tools/bench/runs.hpp"
#include "tools/bench/scenarios.hpp"

namespace sesame::tools {
namespace {

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

std::vector<std::string> all_method_names() {
  std::vector<std::string> names;
  for (const MethodEntry& entry : methods()) {
    names.push_back(entry.name);
  }
  names.insert(names.end(), tracker_methods().begin(), tracker_methods().end());
  names.insert(names.end(), zigzag_methods().begin(), zigzag_methods().end());
  names.insert(names.end(), program_methods().begin(), program_methods().end());
  return names;
}

}  // namespace

Result<std::vector<const Scenario*>> find_scenarios(const std::vector<std::string>& names) {
  std::vector<const Scenario*> found;
  const auto is_meant = [&](const Scenario& scenario) {
    return names.empty() || std::ranges::find(names, scenario.name) != names.end() ||
           std::ranges::find(names, scenario.family) != names.end();
  };
  for (const Scenario& scenario : scenarios()) {
    if (is_meant(scenario)) {
      found.push_back(&scenario);
    }
  }
  for (const std::string& name : names) {
    const auto has_name = [&](const Scenario* s) { return s->name == name || s->family == name; };
    if (std::ranges::none_of(found, has_name)) {
      std::vector<std::string> known;
      for (const Scenario& scenario : scenarios()) {
        known.push_back(scenario.name);
      }
      return Error{Errc::unknown_name,
                   "there is no scenario or family \"" + name + "\"; there are scaling, " + list_of(known)};
    }
  }
  return found;
}

std::vector<std::string> methods_of(const Scenario& scenario) {
  std::vector<std::string> names;
  if (std::holds_alternative<Construction>(scenario.input)) {
    for (const MethodEntry& entry : methods()) {
      names.push_back(entry.name);
    }
    return names;
  }
  if (std::holds_alternative<Zigzag>(scenario.input)) {
    return {zigzag_methods().begin(), zigzag_methods().end()};
  }
  names.assign(tracker_methods().begin(), tracker_methods().end());
  if (std::holds_alternative<CellFiltration>(scenario.input)) {
    names.insert(names.end(), program_methods().begin(), program_methods().end());
  }
  return names;
}

Status check_method_names(const std::vector<std::string>& names) {
  const std::vector<std::string> known = all_method_names();
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end()) {
      return Error{Errc::unknown_name, "there is no method \"" + name + "\"; there are " + list_of(known)};
    }
  }
  return Done{};
}

}  // namespace sesame::tools
