/// \file
/// What the tests of meshes share.
#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/catch.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

inline std::string mesh_path(std::string_view file) {
  return std::string{SESAME_TEST_MESHES} + "/" + std::string{file};
}

inline std::string contents_at(const std::string& path) {
  std::ifstream in{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

inline std::string contents(std::string_view file) { return contents_at(mesh_path(file)); }

inline Mesh parsed(std::string_view text, std::string_view name, const ReadOptions& options = {}) {
  auto mesh = parse_mesh(text, name, options);
  INFO((mesh ? std::string{} : mesh.error().what));
  REQUIRE(mesh);
  return std::move(*mesh);
}

inline Mesh read_fixture(std::string_view file) { return parsed(contents(file), file); }

inline std::string complaint(std::string_view text, std::string_view name) {
  const auto mesh = parse_mesh(text, name);
  return mesh ? "no complaint" : mesh.error().what;
}

inline std::vector<std::vector<std::uint32_t>> faces_of(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    faces.emplace_back(mesh.faces[f].begin(), mesh.faces[f].end());
  }
  return faces;
}

/// The bytes of a value, lowest first or, for files of the other order, highest first.
template <class T>
void append_bytes(std::string& out, T value, bool highest_first = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));  // the machines that run these tests are little-endian
  if (highest_first) {
    bytes = {bytes.rbegin(), bytes.rend()};
  }
  out += bytes;
}

/// A binary STL file of the given triangles.
inline std::string binary_stl(std::string_view head,
                              const std::vector<std::array<std::array<float, 3>, 3>>& triangles) {
  std::string bytes{head};
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    for (int i = 0; i < 3; ++i) {
      append_bytes(bytes, 0.0F);
    }
    for (const auto& point : triangle) {
      for (const float x : point) {
        append_bytes(bytes, x);
      }
    }
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// A tetrahedron as binary PLY, with a skipped property in each row and a skipped element.
inline std::string binary_ply(bool big_endian) {
  std::string bytes = "ply\nformat binary_" + std::string{big_endian ? "big" : "little"} +
                      "_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty uchar red\n"
                      "property short z\nelement extra 2\nproperty list ushort float weights\nelement face 4\n"
                      "property list uchar uint vertex_indices\nproperty int8 flag\nend_header\n";
  const std::array<std::array<int, 3>, 4> points{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
  for (const auto& [x, y, z] : points) {
    append_bytes(bytes, static_cast<double>(x), big_endian);
    append_bytes(bytes, static_cast<float>(y), big_endian);
    append_bytes(bytes, std::uint8_t{200});
    append_bytes(bytes, static_cast<std::int16_t>(z), big_endian);
  }
  for (const std::uint16_t length : {std::uint16_t{2}, std::uint16_t{0}}) {
    append_bytes(bytes, length, big_endian);
    for (int i = 0; i < length; ++i) {
      append_bytes(bytes, 0.5F, big_endian);
    }
  }
  const std::array<std::array<std::uint32_t, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (const auto& face : faces) {
    append_bytes(bytes, std::uint8_t{3});
    for (const auto corner : face) {
      append_bytes(bytes, corner, big_endian);
    }
    append_bytes(bytes, std::int8_t{-1});
  }
  return bytes;
}

}  // namespace sesame::tools
