#include "reductions/defect.hpp"

#include <algorithm>
#include <utility>

namespace sesame::reductions {

std::string Defect::to_string() const {
  return law + " fails on generator " + std::to_string(column) + " of degree " + std::to_string(degree) + " (entry " +
         std::to_string(row) + ")";
}

namespace {

using Found = std::optional<Defect>;

/// The first degree where two modules differ, as a defect of the law that says they are the same.
Found module_defect(const std::string& law, const Sizes& a, const Sizes& b) {
  const auto top = static_cast<int>(std::max(a.size(), b.size()));
  for (int p = 0; p < top; ++p) {
    if (size_at(a, p) != size_at(b, p)) {
      return Defect{law, p, 0, std::min(size_at(a, p), size_at(b, p))};
    }
  }
  return std::nullopt;
}

/// That a map has the stated degree, source and target; `law` says so in words.
template <Ring R>
Found shape_defect(const std::string& law, const GradedMap<R>& map, int degree, const Sizes& source,
                   const Sizes& target) {
  if (map.degree() != degree) {
    return Defect{law, map.degree(), 0, 0};
  }
  Found found = module_defect(law, map.source(), source);
  return found ? found : module_defect(law, map.target(), target);
}

template <Ring R>
Found inequality(std::string law, const GradedMap<R>& a, const GradedMap<R>& b) {
  if (const auto place = first_difference(a, b)) {
    return Defect{std::move(law), place->degree, place->row, place->column};
  }
  return std::nullopt;
}

Found prefixed(const std::string& prefix, Found found) {
  if (found) {
    found->law.insert(0, prefix);
  }
  return found;
}

template <Ring R>
Found complex_defect(const std::string& name, const ChainComplex<R>& complex) {
  return prefixed(name + ": ", first_defect(complex));
}

template <Ring R>
Found difference_of_complexes(const std::string& law, const ChainComplex<R>& a, const ChainComplex<R>& b) {
  Found found = module_defect(law, a.sizes(), b.sizes());
  return found ? found : inequality(law, differential(a), differential(b));
}

/// The first of a list of checks that finds something; later ones are not run.
template <class... Checks>
Found first_of(const Checks&... checks) {
  Found found;
  static_cast<void>(((found = checks()).has_value() || ...));
  return found;
}

}  // namespace

template <Ring R>
std::optional<Defect> first_nonzero(std::string law, const GradedMap<R>& residual) {
  return inequality(std::move(law), residual,
                    GradedMap<R>::zero(residual.ring(), residual.degree(), residual.source(), residual.target()));
}

template <Ring R>
std::optional<Defect> first_defect(const ChainComplex<R>& complex) {
  const GradedMap<R> d = differential(complex);
  return first_nonzero("d d = 0", d * d);
}

template <Ring R>
std::optional<Defect> first_defect(const GradedMap<R>& phi, const ChainComplex<R>& source,
                                   const ChainComplex<R>& target, const std::string& name) {
  return first_of(
      [&] {
        return shape_defect(name + " goes from its source to its target", phi, 0, source.sizes(), target.sizes());
      },
      [&] {
        return inequality("d " + name + " = " + name + " d", differential(target) * phi, phi * differential(source));
      });
}

template <Ring R>
std::optional<Defect> first_defect(const Reduction<R>& reduction) {
  const ChainComplex<R>& big = reduction.big;
  const ChainComplex<R>& small = reduction.small;
  const GradedMap<R>& f = reduction.f;
  const GradedMap<R>& g = reduction.g;
  const GradedMap<R>& h = reduction.h;
  const auto homotopy = [&] {
    const GradedMap<R> d = differential(big);
    return inequality("g f + d h + h d = 1", g * f + (d * h + h * d), identity_of(big));
  };
  return first_of([&] { return complex_defect("big", big); }, [&] { return complex_defect("small", small); },
                  [&] { return shape_defect("h: big -> big, degree 1", h, 1, big.sizes(), big.sizes()); },
                  [&] { return first_defect(f, big, small, "f"); }, [&] { return first_defect(g, small, big, "g"); },
                  [&] { return inequality("f g = 1", f * g, identity_of(small)); }, homotopy,
                  [&] { return first_nonzero("f h = 0", f * h); }, [&] { return first_nonzero("h g = 0", h * g); },
                  [&] { return first_nonzero("h h = 0", h * h); });
}

template <Ring R>
std::optional<Defect> first_defect(const Equivalence<R>& equivalence) {
  const Reduction<R>& left = equivalence.left;
  const Reduction<R>& right = equivalence.right;
  return first_of([&] { return prefixed("left: ", first_defect(left)); },
                  [&] { return prefixed("right: ", first_defect(right)); },
                  [&] { return difference_of_complexes("left and right share the big complex", left.big, right.big); });
}

template <Ring R>
std::optional<Defect> first_defect(const ExactSequence<R>& sequence) {
  const ChainComplex<R>& c0 = sequence.c0;
  const ChainComplex<R>& c1 = sequence.c1;
  const ChainComplex<R>& c2 = sequence.c2;
  const GradedMap<R>& i = sequence.i;
  const GradedMap<R>& j = sequence.j;
  const GradedMap<R>& r = sequence.r;
  const GradedMap<R>& s = sequence.s;
  return first_of([&] { return complex_defect("C0", c0); }, [&] { return complex_defect("C1", c1); },
                  [&] { return complex_defect("C2", c2); }, [&] { return first_defect(i, c0, c1, "i"); },
                  [&] { return first_defect(j, c1, c2, "j"); },
                  [&] { return shape_defect("r: C1 -> C0, degree 0", r, 0, c1.sizes(), c0.sizes()); },
                  [&] { return shape_defect("s: C2 -> C1, degree 0", s, 0, c2.sizes(), c1.sizes()); },
                  [&] { return inequality("r i = 1", r * i, identity_of(c0)); },
                  [&] { return inequality("j s = 1", j * s, identity_of(c2)); },
                  [&] { return inequality("i r + s j = 1", i * r + s * j, identity_of(c1)); });
}

#define SESAME_INSTANTIATE(R)                                                                                      \
  template std::optional<Defect> first_defect(const ChainComplex<R>&);                                             \
  template std::optional<Defect> first_defect(const GradedMap<R>&, const ChainComplex<R>&, const ChainComplex<R>&, \
                                              const std::string&);                                                 \
  template std::optional<Defect> first_defect(const Reduction<R>&);                                                \
  template std::optional<Defect> first_defect(const Equivalence<R>&);                                              \
  template std::optional<Defect> first_defect(const ExactSequence<R>&);                                            \
  template std::optional<Defect> first_nonzero(std::string, const GradedMap<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions
