// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/bump_reader.hpp"

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "etendue/io/texture_reader.hpp"

namespace etendue {

namespace {

/// Waves, cells and copies along a coordinate, and places of a table.
constexpr long kMostAlong = 4096;
constexpr std::size_t kMostPlaces = std::size_t{1} << 20;
/// The sine that directions of a few digits leave, as for checkerboards.
constexpr double kLeastSine = 1e-6;

double height(const SceneNode& node, double scale, double otherwise) {
  const auto member = node.member("height");
  return scale * (member ? member->number(kAnyNumber).value_or(otherwise) : otherwise);
}

/// Two integers, for u and for v.
std::pair<int, int> two(const SceneNode& node, const char* key, long low, int otherwise) {
  const auto member = node.member(key);
  if (!member) return {otherwise, otherwise};
  const auto items = member->items(2, 2, "integers");
  if (items.size() != 2) return {otherwise, otherwise};
  const auto u = items[0].integer(low, kMostAlong), v = items[1].integer(low, kMostAlong);
  return {static_cast<int>(u.value_or(otherwise)), static_cast<int>(v.value_or(otherwise))};
}

/// Rows of equally many numbers, in the file's lengths.
TableRelief read_table(const SceneNode& node, double scale) {
  TableRelief table;
  const double unit = height(node, scale, 1);
  const auto rows_node = node.member("heights");
  const auto rows = rows_node ? rows_node->items(1, kMostAlong, "rows") : std::vector<SceneNode>{};
  for (const SceneNode& row : rows) {
    const auto items = row.items(1, kMostAlong, "numbers");
    const auto columns = static_cast<std::size_t>(table.columns);
    if (!table.heights.empty() && items.size() != columns) {
      row.complain("found a row of " + std::to_string(items.size()) + ", expected " + std::to_string(columns) +
                   " numbers, as many as in the first");
      break;
    }
    table.columns = static_cast<int>(items.size());
    for (const SceneNode& item : items) table.heights.push_back(unit * item.number(kAnyNumber).value_or(0));
  }
  if (table.heights.size() > kMostPlaces) rows_node->complain("found more than 2^20 heights, expected fewer");
  const auto columns = static_cast<std::size_t>(table.columns);
  table.rows = columns > 0 && !table.heights.empty() ? static_cast<int>(table.heights.size() / columns) : 0;
  std::tie(table.repeat_u, table.repeat_v) = two(node, "repeat", 1, 1);
  if (const auto edges = node.member("edges")) {
    if (edges->choice({"periodic", "clamped"}).value_or("") == "clamped") table.edges = TableEdges::clamped;
  }
  if (table.edges == TableEdges::clamped && node.member("repeat")) {
    node.complain(
        "found \"repeat\" beside \"edges\": \"clamped\", expected one of them: its first and last values go on");
  }
  return table;
}

std::optional<MaterialBump::Lay> read_lay(const SceneNode& node, double scale) {
  const auto size = node.member("size");
  if (!size) {
    for (const char* key : {"origin", "u", "v"}) {
      if (const auto member = node.member(key))
        member->complain(std::string("found \"") + key +
                         "\" without \"size\", expected the size of the square that it lays");
    }
    return std::nullopt;
  }
  MaterialBump::Lay lay;
  lay.size = scale * size->number(kPositive).value_or(1);
  if (const auto member = node.member("origin")) lay.origin = scale * member->vector().value_or(Vec3::Zero());
  if (const auto member = node.member("u")) lay.u = member->direction().value_or(lay.u);
  if (const auto member = node.member("v")) lay.v = member->direction().value_or(lay.v);
  if (!(lay.u.cross(lay.v).norm() > kLeastSine)) {
    node.complain("found \"u\" along \"v\", expected two directions of a plane");
  }
  return lay;
}

}  // namespace

std::optional<MaterialBump> read_bump(const SceneNode& node, double scale) {
  const auto type = node.kind(bump_types());
  if (!node.is(type ? keys_of(*type + "_bump") : keys_of_any({"waves_bump", "table_bump", "rough_bump"})))
    return std::nullopt;
  MaterialBump bump;
  bump.lay = read_lay(node, scale);
  const auto [waves_u, waves_v] = two(node, "waves", 0, 1);
  const auto [cells_u, cells_v] = two(node, "cells", 1, 1);
  const double amplitude = height(node, scale, 0);
  const std::uint64_t seed = read_seed(node);
  if (type == "table") {
    TableRelief table = read_table(node, scale);
    if (table.rows < 1 || table.heights.size() % static_cast<std::size_t>(table.columns) != 0) return std::nullopt;
    bump.relief = std::move(table);
  } else if (type == "rough") {
    if (static_cast<std::size_t>(cells_u) * static_cast<std::size_t>(cells_v) > kMostPlaces) {
      node.member("cells")->complain("found more than 2^20 cells, expected fewer");
      return std::nullopt;
    }
    bump.relief = random_relief(cells_u, cells_v, amplitude, seed);
  } else if (type) {
    bump.relief = WaveRelief{amplitude, waves_u, waves_v};
  } else {
    return std::nullopt;
  }
  return bump;
}

}  // namespace etendue
