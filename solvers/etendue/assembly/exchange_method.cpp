// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/exchange_method.hpp"

#include <algorithm>
#include <cmath>

namespace etendue {

namespace {

std::vector<SurfacePair> pairs_of(const TileLayout& layout, std::size_t tile) {
  const TileLayout::Block block = layout.block_of(tile);
  const auto rows = layout.range(block.row), columns = layout.range(block.column);
  std::vector<SurfacePair> pairs;
  pairs.reserve(layout.cells());
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    for (std::size_t j = std::max(i + 1, columns.begin); j < columns.end; ++j) pairs.push_back({i, j});
  }
  return pairs;
}

}  // namespace

std::vector<std::size_t> ExchangeMethod::blockers(const SurfacePair&) const {
  return {};
}

std::string ExchangeMethod::manner(const SurfacePair&) const {
  return {};
}

bool reached(const Bounded& exchange, double area_i, double area_j, const Tolerance& tolerance) {
  return exchange.bound <=
         std::max(tolerance.absolute * std::min(area_i, area_j), tolerance.relative * std::abs(exchange.value));
}

bool fill_exchanges(ExchangeMatrix& matrix, const ExchangeMethod& method, const Tolerance& tolerance,
                    const Execution& execution) {
  const TileLayout& layout = matrix.layout();
  std::vector<std::size_t> open;
  for (std::size_t tile = 0; tile < layout.tiles(); ++tile) {
    if (!matrix.done(tile)) open.push_back(tile);
  }
  const std::size_t before = layout.tiles() - open.size();
  Execution counted = execution;
  if (execution.progress) {
    counted.progress = [&](std::size_t done, std::size_t) { execution.progress(before + done, layout.tiles()); };
  }
  return parallel_for(open.size(), counted, [&](std::size_t item) {
    const std::size_t tile = open[item];
    const std::vector<SurfacePair> pairs = pairs_of(layout, tile);
    std::vector<Bounded> exchanges(pairs.size());
    TileReport report;
    method.find(pairs, exchanges, report);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [i, j] = pairs[k];
      matrix.set(i, j, exchanges[k]);
      if (!reached(exchanges[k], matrix.areas()[i], matrix.areas()[j], tolerance)) ++report.beyond;
    }
    matrix.close(tile, report);
  });
}

std::vector<double> areas_of(const ElementMesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.elements.size());
  for (const Element& element : mesh.elements) areas.push_back(element.polygon.area());
  return areas;
}

}  // namespace etendue
