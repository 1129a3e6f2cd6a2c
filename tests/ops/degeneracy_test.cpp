#include "ops/cells/degeneracy.hpp"

#include <bit>
#include <set>

#include "tests/support/monotone_maps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

Degeneracy all_of(const CellType& type) {
  int directions = 0;
  for (const int a : type) {
    directions += a;
  }
  return (Degeneracy{1} << directions) - 1;
}

std::uint64_t factorial(int n) { return n < 2 ? 1 : static_cast<std::uint64_t>(n) * factorial(n - 1); }

/// Definition 25 says its rules of values; its operators act from the right: x.s(i, j).d(k, l) is x s^i_j d^k_l.
/// Components are counted from 1, as there.
class Simploid {
 public:
  Simploid(const Structure& structure, Value value) : structure_{&structure}, value_{value} {}

  [[nodiscard]] const CellType& type() const { return structure_->types().info(value_.type).type; }
  [[nodiscard]] int length() const { return static_cast<int>(type().size()); }
  [[nodiscard]] int a(int i) const { return type()[static_cast<std::size_t>(i - 1)]; }

  [[nodiscard]] Simploid d(int i, int j) const {
    return {*structure_, structure_->values().face(value_, face_number(type(), i - 1, j))};
  }
  /// j = -1: a new component after the i-th.
  [[nodiscard]] Simploid s(int i, int j) const {
    CellType larger = type();
    int direction = 0;
    if (j < 0) {
      larger.insert(larger.begin() + i, 1);
      direction = direction_number(larger, i, 0);
    } else {
      ++larger[static_cast<std::size_t>(i - 1)];
      direction = direction_number(larger, i - 1, j);
    }
    return {*structure_,
            {value_.cell, structure_->types().intern(larger), compose(Degeneracy{1} << direction, value_.collapsed)}};
  }
  friend bool operator==(const Simploid& x, const Simploid& y) { return x.value_ == y.value_; }
  friend std::ostream& operator<<(std::ostream& out, const Simploid& x) {
    return out << text_of(*x.structure_, x.value_);
  }

 private:
  const Structure* structure_;
  Value value_;
};

/// Every value over every face of a standard simploid of every type up to a dimension, those degenerate by up to two.
template <class Visit>
void for_each_simploid(int largest, Visit&& visit) {
  for (const CellType& type : types_of_dimension(largest)) {
    Workshop shop;
    REQUIRE(shop.apply(MakeSimploid{"q", type, {}}));
    for (const CellId c : current_cells(shop.structure())) {
      const PlainValue cell = plain_value(c, shop.structure().cells().type(c).type);
      for (const PlainValue& v : with_degeneracies(cell, std::min(largest, cell.dimension() + 2))) {
        visit(Simploid{shop.structure(), {c, shop.structure().types().intern(v.type()), v.collapsed()}});
      }
    }
  }
}

}  // namespace

TEST_CASE("composing degeneracies is composing monotone maps", "[ops]") {
  for (const CellType& type : types_up_to_dimension(6)) {
    for (Degeneracy outer = 0; outer <= all_of(type); ++outer) {
      const PlainValue first = plain_value(0, type, outer);
      REQUIRE(first.collapsed() == outer);
      const CellType underneath = first.type_underneath();
      for (Degeneracy inner = 0; inner <= all_of(underneath); ++inner) {
        REQUIRE(compose(outer, inner) == composed(first, plain_value(1, underneath, inner)).collapsed());
      }
    }
  }
}

TEST_CASE("composing is associative, with the empty set on both sides", "[ops]") {
  for (Degeneracy a = 0; a < 16; ++a) {
    CHECK(compose(a, 0) == a);
    CHECK(compose(0, a) == a);
    for (Degeneracy b = 0; b < 16; ++b) {
      for (Degeneracy c = 0; c < 16; ++c) {
        CHECK(compose(compose(a, b), c) == compose(a, compose(b, c)));
      }
    }
  }
}

TEST_CASE("the last direction that there can be is composed like the first", "[ops]") {
  const Degeneracy last = Degeneracy{1} << (largest_dimension - 1);
  CHECK(compose(0, last) == last);
  CHECK(compose(1, last >> 1) == (last | 1));
  CHECK(compose(last - 1, 1) == (last | (last - 1)));
  CHECK(without(last, 1) == last >> 1);
  CHECK(without(last | 1, last) == 1);
}

TEST_CASE("what is left of a set without some places moves up, in order", "[ops]") {
  for (Degeneracy collapsed = 0; collapsed < 128; ++collapsed) {
    for (Degeneracy dropped = 0; dropped < 128; ++dropped) {
      std::vector<bool> places;
      for (int d = 0; d < 7; ++d) {
        if ((dropped >> d & 1) == 0) {
          places.push_back((collapsed >> d & 1) != 0);
        }
      }
      Degeneracy left = 0;
      for (std::size_t k = 0; k < places.size(); ++k) {
        left |= Degeneracy{places[k]} << k;
      }
      REQUIRE(without(collapsed, dropped) == left);
    }
  }
}

TEST_CASE("what was collapsed first and composed away again is the rest", "[ops]") {
  for (Degeneracy outer = 0; outer < 64; ++outer) {
    for (Degeneracy inner = 0; inner < Degeneracy{64} >> std::popcount(outer); ++inner) {
      REQUIRE(without(compose(outer, inner), outer) == inner);
    }
  }
}

TEST_CASE("faces of degenerate cells are what they are for monotone maps", "[ops]") {
  TypeTable types;
  for (const CellType& type : types_up_to_dimension(6)) {
    const TypeInfo& info = types.info(types.intern(type));
    for (Degeneracy collapsed = 0; collapsed <= all_of(type); ++collapsed) {
      const PlainValue value = plain_value(0, type, collapsed);
      for (std::uint32_t k = 0; k < info.faces.size(); ++k) {
        std::uint32_t of_cell = DegenerateFace::itself;
        // A face of the cell underneath stays a cell of its own: so what is found are the certain directions.
        const PlainValue wanted = plain_face(value, k, [&](CellId, std::uint32_t number) {
          of_cell = number;
          const CellType underneath = value.type_underneath();
          const auto [component, vertex] = face_at(underneath, number);
          CellType smaller = underneath;
          if (--smaller[component] == 0) {
            smaller.erase(smaller.begin() + static_cast<std::ptrdiff_t>(component));
          }
          return plain_value(1, smaller);
        });
        const DegenerateFace found = face_of_degenerate(info, collapsed, k);
        REQUIRE(found.of_cell == of_cell);
        REQUIRE(types.info(found.type).type == wanted.type());
        REQUIRE(found.collapsed == wanted.collapsed());
      }
    }
  }
}

TEST_CASE("faces and directions are numbered component after component", "[ops]") {
  const CellType type{2, 1, 3};
  std::uint32_t face = 0;
  int direction = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= type[static_cast<std::size_t>(i)]; ++j) {
      CHECK(face_number(type, i, j) == face++);
      if (j > 0) {
        CHECK(direction_number(type, i, j - 1) == direction++);
      }
    }
  }
}

TEST_CASE("pairs of disjoint degeneracies come once each, and all of them", "[ops]") {
  for (int n = 0; n <= 7; ++n) {
    for (int p = 0; p <= 8; ++p) {
      for (int q = 0; q <= 8; ++q) {
        std::set<std::pair<Degeneracy, Degeneracy>> found;
        int visits = 0;
        for_each_pair_of_degeneracies(n, p, q, [&](Degeneracy l, Degeneracy r) {
          found.emplace(l, r);
          ++visits;
        });
        std::set<std::pair<Degeneracy, Degeneracy>> wanted;
        for (Degeneracy l = 0; l < Degeneracy{1} << n; ++l) {
          for (Degeneracy r = 0; r < Degeneracy{1} << n; ++r) {
            if ((l & r) == 0 && std::popcount(l) == n - p && std::popcount(r) == n - q) {
              wanted.emplace(l, r);
            }
          }
        }
        CAPTURE(n, p, q);
        REQUIRE(found == wanted);
        REQUIRE(static_cast<std::size_t>(visits) == wanted.size());
        if (p <= n && q <= n && n <= p + q) {
          REQUIRE(wanted.size() == factorial(n) / (factorial(n - p) * factorial(n - q) * factorial(p + q - n)));
        }
      }
    }
  }
}

// Its rule (II-2) for a_k = 1 is printed with the wrong index lowered: the component k is gone, so i is what is i - 1.
TEST_CASE("S. Peltier, habilitation (2023), definition 25 (II): faces of values commute as printed", "[ops]") {
  for_each_simploid(4, [](const Simploid& x) {
    for (int i = 1; i <= x.length(); ++i) {
      for (int j = 0; j <= x.a(i); ++j) {
        for (int l = 0; l < j && x.a(i) > 1; ++l) {
          REQUIRE(x.d(i, j).d(i, l) == x.d(i, l).d(i, j - 1));
        }
        for (int k = 1; k < i; ++k) {
          for (int l = 0; l <= x.a(k); ++l) {
            REQUIRE(x.d(i, j).d(k, l) == x.d(k, l).d(x.a(k) > 1 ? i : i - 1, j));
          }
        }
      }
    }
  });
}

TEST_CASE("S. Peltier, habilitation (2023), definition 25 (III): degeneracies commute as printed", "[ops]") {
  for_each_simploid(3, [](const Simploid& x) {
    const int n = x.length();
    for (int i = 0; i <= n; ++i) {
      const Simploid thick = x.s(i, -1);
      for (int k = 0; k <= i; ++k) {
        REQUIRE(thick.s(k, -1) == x.s(k, -1).s(i + 1, -1));
      }
      for (int k = 1; k <= n + 1; ++k) {
        for (int l = 0; k != i + 1 && l <= thick.a(k); ++l) {
          REQUIRE(thick.s(k, l) == (k <= i ? x.s(k, l).s(i, -1) : x.s(k - 1, l).s(i, -1)));
        }
      }
      REQUIRE(thick.s(i + 1, 0) == thick.s(i + 1, 1));
    }
    for (int i = 1; i <= n; ++i) {
      for (int j = 0; j <= x.a(i); ++j) {
        for (int k = 1; k <= n; ++k) {
          for (int l = 0; l <= (k == i ? j : x.a(k)); ++l) {
            REQUIRE(x.s(i, j).s(k, l) == (i == k ? x.s(k, l).s(i, j + 1) : x.s(k, l).s(i, j)));
          }
        }
      }
    }
  });
}

TEST_CASE("S. Peltier, habilitation (2023), definition 25 (IV): faces of one component's degeneracies", "[ops]") {
  for_each_simploid(3, [](const Simploid& x) {
    for (int i = 1; i <= x.length(); ++i) {
      for (int l = 0; l <= x.a(i); ++l) {
        const Simploid degenerate = x.s(i, l);
        REQUIRE(degenerate.d(i, l) == x);
        REQUIRE(degenerate.d(i, l + 1) == x);
        for (int j = 0; j <= x.a(i) + 1 && x.a(i) > 1; ++j) {
          if (j < l) {
            REQUIRE(degenerate.d(i, j) == x.d(i, j).s(i, l - 1));
          } else if (j > l + 1) {
            REQUIRE(degenerate.d(i, j) == x.d(i, j - 1).s(i, l));
          }
        }
      }
      if (x.a(i) == 1) {
        REQUIRE(x.s(i, 1).d(i, 0) == x.d(i, 0).s(i - 1, -1));
        REQUIRE(x.s(i, 0).d(i, 2) == x.d(i, 1).s(i - 1, -1));
      }
    }
    for (int i = 1; i <= x.length() + 1; ++i) {
      REQUIRE(x.s(i - 1, -1).d(i, 0) == x);
      REQUIRE(x.s(i - 1, -1).d(i, 1) == x);
    }
  });
}

TEST_CASE("S. Peltier, habilitation (2023), definition 25 (IV): faces of another component's degeneracies", "[ops]") {
  for_each_simploid(3, [](const Simploid& x) {
    for (int i = 1; i <= x.length(); ++i) {
      for (int j = 0; j <= x.a(i); ++j) {
        const Simploid face = x.d(i, j);
        for (int k = 1; k <= x.length(); ++k) {
          for (int l = 0; l <= x.a(k) && k != i; ++l) {
            REQUIRE(x.s(k, l).d(i, j) == face.s(k > i && x.a(i) == 1 ? k - 1 : k, l));
          }
        }
        for (int k = 0; k < i; ++k) {  // the new component comes before number i, which is number i + 1 then
          REQUIRE(x.s(k, -1).d(i + 1, j) == face.s(k, -1));
        }
        for (int k = i; k <= x.length(); ++k) {
          REQUIRE(x.s(k, -1).d(i, j) == face.s(x.a(i) == 1 ? k - 1 : k, -1));
        }
      }
    }
  });
}

TEST_CASE("a value's faces are those of the lists of vertices, through degenerate faces too", "[ops]") {
  const unsigned seed = GENERATE(range(0U, 8U));
  CAPTURE(seed);
  Workshop shop;
  RandomSteps steps(seed, {.most_cells = 30, .degeneracies = true});
  for (int k = 0; k < 25; ++k) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
  }
  const Structure& s = shop.structure();
  const auto face_of = [&](CellId c, std::uint32_t k) { return plain_value(s, s.values().of(s.faces().of(c)[k])); };
  for (const CellId c : current_cells(s)) {
    for (const PlainValue& v : with_degeneracies(plain_value(c, s.cells().type(c).type), s.dimension(c) + 2)) {
      const TypeId type = s.types().intern(v.type());
      for (std::uint32_t k = 0; k < number_of_faces(v.type()); ++k) {
        REQUIRE(plain_value(s, s.values().face({c, type, v.collapsed()}, k)) == plain_face(v, k, face_of));
      }
    }
  }
}
