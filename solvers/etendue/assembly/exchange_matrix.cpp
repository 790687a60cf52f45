// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/exchange_matrix.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// Small scenes have small tiles, so that there is work for many threads; large ones large tiles, so that the cells
/// outside the triangle cost little memory.
unsigned tile_shift(std::size_t surfaces) {
  if (surfaces <= 64) return 1;
  if (surfaces <= 512) return 3;
  return surfaces <= 2048 ? 5 : 6;
}

/// The least float that is not below `bound`.
float rounded_up(double bound) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float nearest = static_cast<float>(bound);
  return static_cast<double>(nearest) < bound ? std::nextafter(nearest, kInfinity) : nearest;
}

struct Memory {
  std::vector<double> exchanges;
  std::vector<float> bounds;
  std::vector<TileRecord> records;
};

}  // namespace

TileLayout::TileLayout(std::size_t surfaces)
    : surfaces_(surfaces),
      shift_(tile_shift(surfaces)),
      side_(std::size_t{1} << shift_),
      blocks_((surfaces + side_ - 1) / side_) {}

TileLayout::Block TileLayout::block_of(std::size_t tile) const {
  std::size_t low = 0, high = blocks_ - 1;  // the last block row whose first tile is not after this one
  while (low < high) {
    const std::size_t middle = (low + high + 1) / 2;
    if (tile_of(middle, middle) <= tile) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return {low, low + (tile - tile_of(low, low))};
}

TileLayout::Range TileLayout::range(std::size_t block) const {
  return {block * side_, std::min(surfaces_, (block + 1) * side_)};
}

void add(TileReport& sum, const TileReport& part) {
  sum.averted += part.averted;
  sum.clear += part.clear;
  sum.blocked += part.blocked;
  sum.obstructed += part.obstructed;
  sum.sampled += part.sampled;
  sum.checked += part.checked;
  sum.disagreements += part.disagreements;
  sum.beyond += part.beyond;
  sum.clamped += part.clamped;
  sum.defect = std::max(sum.defect, part.defect);
}

ExchangeStorage storage_in_memory(const TileLayout& layout) {
  const std::size_t cells = layout.tiles() * layout.cells();
  auto memory = std::make_shared<Memory>(
      Memory{std::vector<double>(cells), std::vector<float>(cells), std::vector<TileRecord>(layout.tiles())});
  return {memory->exchanges, memory->bounds, memory->records, memory, {}};
}

std::size_t exchange_bytes(const TileLayout& layout) {
  return layout.tiles() * (layout.cells() * (sizeof(double) + sizeof(float)) + sizeof(TileRecord));
}

ExchangeMatrix::ExchangeMatrix(std::vector<double> areas)
    : areas_(std::move(areas)), layout_(areas_.size()), storage_(storage_in_memory(layout_)) {}

ExchangeMatrix::ExchangeMatrix(std::vector<double> areas, ExchangeStorage storage)
    : areas_(std::move(areas)), layout_(areas_.size()), storage_(std::move(storage)) {
  const std::size_t cells = layout_.tiles() * layout_.cells();
  require(storage_.exchanges.size() == cells && storage_.bounds.size() == cells &&
              storage_.records.size() == layout_.tiles(),
          "ExchangeMatrix: the storage has the size of the layout");
}

void ExchangeMatrix::set(std::size_t i, std::size_t j, const Bounded& exchange) {
  const std::size_t cell = cell_of(i, j);
  storage_.exchanges[cell] = exchange.value;
  storage_.bounds[cell] = rounded_up(exchange.bound / std::min(areas_[i], areas_[j]) * kBoundRounding);
}

/// FNV-1a over the words of the tile's cells, never 0.
std::uint64_t ExchangeMatrix::checksum(std::size_t tile) const {
  std::uint64_t state = 0xcbf29ce484222325u;
  const auto mix = [&state](std::uint64_t word) {
    state = (state ^ word) * 0x100000001b3u;
    state ^= state >> 29;  // words, not bytes: carry the upper bits down
  };
  const std::size_t first = tile * layout_.cells();
  for (std::size_t k = first; k < first + layout_.cells(); ++k) {
    mix(std::bit_cast<std::uint64_t>(storage_.exchanges[k]));
    mix(std::bit_cast<std::uint32_t>(storage_.bounds[k]));
  }
  const TileReport& report = storage_.records[tile].report;
  for (const std::uint64_t count : {report.averted, report.clear, report.blocked, report.obstructed, report.sampled,
                                    report.checked, report.disagreements, report.beyond, report.clamped}) {
    mix(count);
  }
  mix(std::bit_cast<std::uint64_t>(report.defect));
  return state == 0 ? 1 : state;
}

void ExchangeMatrix::close(std::size_t tile, const TileReport& report) {
  storage_.records[tile].report = report;
  storage_.records[tile].checksum = checksum(tile);
}

bool ExchangeMatrix::sound(std::size_t tile) const {
  return done(tile) && storage_.records[tile].checksum == checksum(tile);
}

void ExchangeMatrix::reopen(std::size_t tile) {
  storage_.records[tile] = {};
}

std::size_t ExchangeMatrix::tiles_done() const {
  return static_cast<std::size_t>(std::count_if(storage_.records.begin(), storage_.records.end(),
                                                [](const TileRecord& r) { return r.checksum != 0; }));
}

TileReport ExchangeMatrix::report() const {
  TileReport sum;
  for (const TileRecord& record : storage_.records) {
    if (record.checksum != 0) add(sum, record.report);
  }
  return sum;
}

}  // namespace etendue
