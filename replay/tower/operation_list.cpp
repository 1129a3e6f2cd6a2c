#include "replay/tower/operation_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sesame::replay {

void OperationList::add(const TowerOperation& operation, std::uint64_t line) {
  const bool is_contraction = operation.kind == TowerOperation::Kind::contract;
  has_columns_ = operation.kind == TowerOperation::Kind::column;
  dimensions_.push_back(is_contraction ? -1 : operation.dimension);
  labels_.insert(labels_.end(), operation.labels.begin(), operation.labels.end());
  first_.push_back(labels_.size());
  lines_.push_back(line);
  times_.push_back(operation.time);
}

std::span<const std::uint64_t> OperationList::labels(std::size_t operation) const {
  return std::span{labels_}.subspan(first_[operation], first_[operation + 1] - first_[operation]);
}

std::string OperationList::text(std::size_t operation) const {
  const std::string words = fmt::format("{}", fmt::join(labels(operation), " "));
  if (has_columns_) {
    return fmt::format("column {}{}{}", operation, words.empty() ? "" : ": ", words);
  }
  return (dimension(operation) < 0 ? "c " : "i ") + words;
}

}  // namespace sesame::replay
