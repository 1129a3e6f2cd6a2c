#include "ops/plan/layers_writer.hpp"

#include <fmt/format.h>

#include "ops/plan/cone_cells.hpp"
#include "ops/plan/new_cells.hpp"

namespace sesame::ops {
namespace {

class LayersWriter {
 public:
  LayersWriter(const std::string& name, const std::vector<CellsOfMap>& layers,
               const std::function<std::string(Dart)>& dart_text, const Structure& structure, Plan& plan)
      : name_{name}, layers_{layers}, dart_text_{dart_text}, structure_{structure}, plan_{plan} {
    plan_.first = structure.cells().size();
  }

  Result<std::shared_ptr<const DartCells>> write() {
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      nodes_.emplace_back();
      for (std::uint32_t c = 0; c < layers_[i].orbits.count(); ++c) {
        if (layers_[i].types[c] != none) {
          write_ball(i, c);
        } else if (Status s = write_cone(i, c); !s) {
          return s.error();
        }
        nodes_.back().push_back(plan_.first + (plan_.cells.size() - 1));
      }
    }
    auto cells = std::make_shared<DartCells>();
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      cells->of.emplace_back();
      for (Dart d = 0; d < layers_[i].places.size(); ++d) {
        cells->of.back().push_back({nodes_[i][layers_[i].orbits.of[d]] - plan_.first, layers_[i].places[d]});
      }
    }
    return std::shared_ptr<const DartCells>(std::move(cells));
  }

 private:
  [[nodiscard]] std::string name_of(std::size_t i, std::uint32_t c) const {
    return fmt::format("{}.{}:{}", name_, i, dart_text_(layers_[i].roots[c]));
  }

  void write_ball(std::size_t i, std::uint32_t c) {
    const std::size_t first_face = plan_.faces.size();
    for (const auto& [cell, dart] : layers_[i].faces_of(c)) {
      add_face({nodes_[i - 1][cell], structure_.maps().order_at(layers_[i - 1].types[cell], dart)}, plan_);
    }
    plan_.names += name_of(i, c);
    add_cell(layers_[i].types[c], first_face, plan_);
  }

  Status write_cone(std::size_t i, std::uint32_t c) {
    const ConeShape& shape = *layers_[i].cones.at(c);
    std::vector<Dart> dart_at(layers_[i].places.size(), no_dart);  // by place in the canonical boundary
    for (Dart d = 0; d < layers_[i].places.size(); ++d) {
      if (layers_[i].orbits.of[d] == c) {
        dart_at[layers_[i].places[d]] = d;
      }
    }
    const auto face_at = [&](int q, Dart place) -> Result<SeenFace> {
      const CellsOfMap& layer = layers_[static_cast<std::size_t>(q)];
      const Dart d = dart_at[place];
      const std::uint32_t cell = layer.orbits.of[d];
      const TypeId type = layer.types[cell];
      return SeenFace{{nodes_[static_cast<std::size_t>(q)][cell], structure_.maps().order_at(type, layer.places[d])},
                      structure_.types().seen_from(type, layer.places[d])};
    };
    return add_cone_cell(shape, name_of(i, c), structure_, face_at, plan_);
  }

  const std::string& name_;
  const std::vector<CellsOfMap>& layers_;
  const std::function<std::string(Dart)>& dart_text_;
  const Structure& structure_;
  Plan& plan_;
  std::vector<std::vector<CellId>> nodes_;  ///< by dimension and cell
};

std::int64_t count_of(const std::vector<CellsOfMap>& layers) {
  std::int64_t count = 0;
  for (const CellsOfMap& layer : layers) {
    count += layer.orbits.count();
    for (const auto& [cell, shape] : layer.cones) {
      count += static_cast<std::int64_t>(shape->generators.size()) - 1;
    }
  }
  return count;
}

}  // namespace

Result<std::shared_ptr<const DartCells>> write_layers(const std::string& name, const std::vector<CellsOfMap>& layers,
                                                      const std::function<std::string(Dart)>& dart_text,
                                                      const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_room(count_of(layers), structure, limits); !s) {
    return s.error();
  }
  return LayersWriter(name, layers, dart_text, structure, plan).write();
}

}  // namespace sesame::ops
