#include "ops/vocabulary/operation.hpp"

namespace sesame::ops {
namespace {

struct Keyword {
  std::string_view operator()(const MakeSimplex&) const { return "simplex"; }
  std::string_view operator()(const MakeSimploid&) const { return "simploid"; }
  std::string_view operator()(const MakeComplex&) const { return "complex"; }
  std::string_view operator()(const MakeCone&) const { return "cone"; }
  std::string_view operator()(const MakeSuspension&) const { return "suspend"; }
  std::string_view operator()(const Identify&) const { return "identify"; }
  std::string_view operator()(const MakeProduct&) const { return "product"; }
  std::string_view operator()(const Degenerate&) const { return "degenerate"; }
  std::string_view operator()(const Deidentify&) const { return "deidentify"; }
  std::string_view operator()(const Insert&) const { return "insert"; }
  std::string_view operator()(const Collapse&) const { return "collapse"; }
  std::string_view operator()(const Expect&) const { return "expect"; }
  std::string_view operator()(const AskClass&) const { return "class"; }
  std::string_view operator()(const Undo&) const { return "undo"; }
  std::string_view operator()(const Note&) const { return "note"; }
};

}  // namespace

std::string_view keyword(const Operation& operation) { return std::visit(Keyword{}, operation); }

}  // namespace sesame::ops
