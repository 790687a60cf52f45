// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/core/result.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

/// How the pairs i ≤ j of n surfaces are divided into square tiles, the unit of work, of progress and of a checkpoint.
/// Depends on n alone.
class TileLayout {
 public:
  explicit TileLayout(std::size_t surfaces);

  struct Block {
    std::size_t row, column;  ///< of the tile, in tiles; row ≤ column
  };
  struct Range {
    std::size_t begin, end;  ///< surfaces
  };

  std::size_t surfaces() const { return surfaces_; }
  std::size_t side() const { return side_; }
  std::size_t blocks() const { return blocks_; }
  std::size_t tiles() const { return blocks_ * (blocks_ + 1) / 2; }
  std::size_t cells() const { return side_ * side_; }  ///< of a tile, those outside the triangle too
  std::size_t pairs() const { return surfaces_ * (surfaces_ - (surfaces_ > 0 ? 1 : 0)) / 2; }

  std::size_t tile_of(std::size_t block_row, std::size_t block_column) const {
    return block_row * blocks_ - block_row * (block_row + 1) / 2 + block_column;
  }
  Block block_of(std::size_t tile) const;
  Range range(std::size_t block) const;
  /// Where the pair i ≤ j lies among all cells.
  std::size_t cell_of(std::size_t i, std::size_t j) const {
    const std::size_t inside = side_ - 1;
    return (tile_of(i >> shift_, j >> shift_) << 2 * shift_) + ((i & inside) << shift_) + (j & inside);
  }

 private:
  std::size_t surfaces_;
  unsigned shift_;  ///< side_ = 2^shift_
  std::size_t side_, blocks_;
};

/// What happened to the pairs of a tile.
struct TileReport {
  std::uint64_t averted = 0;        ///< cannot see each other's front
  std::uint64_t clear = 0;          ///< nothing between them
  std::uint64_t blocked = 0;        ///< one face hides all
  std::uint64_t obstructed = 0;     ///< computed with blockers
  std::uint64_t sampled = 0;        ///< found by sampling
  std::uint64_t checked = 0;        ///< computed from both sides
  std::uint64_t disagreements = 0;  ///< of these, beyond what their bounds allow
  std::uint64_t beyond = 0;         ///< pairs whose bound exceeds what was asked for
  std::uint64_t clamped = 0;        ///< pairs whose value was held at 0, at the free factor or at min(1, A_j/A_i)
  double defect = 0;                ///< max |A_i F_ij − A_j F_ji| / max(A_i, A_j) of the checked
};
void add(TileReport& sum, const TileReport& part);

struct TileRecord {
  std::uint64_t checksum = 0;  ///< of the tile's cells; 0: not done
  TileReport report;
};

/// Where a matrix lies: its own memory, or a mapped file that `keeper` unmaps.
struct ExchangeStorage {
  std::span<double> exchanges;    ///< TileLayout::tiles() · cells()
  std::span<float> bounds;        ///< the same
  std::span<TileRecord> records;  ///< TileLayout::tiles()
  std::shared_ptr<void> keeper;
  std::function<Result<Done>()> detach;  ///< from now on what is changed does not reach the file; empty: there is none
};
[[nodiscard]] ExchangeStorage storage_in_memory(const TileLayout& layout);

/// The exchange areas A_i F_ij = A_j F_ji of n surfaces, each pair once: reciprocity is not computed but stored. 12 bytes a
/// pair, three quarters of a dense matrix of doubles.                                               @eq IU.6-5
///
/// A bound is kept as a float, rounded up, on the larger of the two factors F_ij and F_ji.
class ExchangeMatrix {
 public:
  explicit ExchangeMatrix(std::vector<double> areas);
  /// In `storage`, with whatever it already holds. Contract: of the size that the layout of areas.size() wants
  ExchangeMatrix(std::vector<double> areas, ExchangeStorage storage);

  std::size_t size() const { return areas_.size(); }
  const std::vector<double>& areas() const { return areas_; }
  const TileLayout& layout() const { return layout_; }

  /// A_i F_ij [length²]; 0 where i = j, but for composed surfaces that see themselves.
  double exchange(std::size_t i, std::size_t j) const { return storage_.exchanges[cell_of(i, j)]; }
  /// Bound on its absolute error, rounding of the storage included [length²].
  double exchange_bound(std::size_t i, std::size_t j) const {
    return storage_.bounds[cell_of(i, j)] * std::min(areas_[i], areas_[j]) * kBoundRounding;
  }
  /// F_ij, at most 1: the fraction of the power leaving i that arrives at j, and its bound.        @eq IU.6-3
  Bounded factor(std::size_t i, std::size_t j) const {
    const double value = exchange(i, j) / areas_[i];
    // A composed surface may come out above 1 by its bound; the truth does not.
    return {std::min(1.0, value), exchange_bound(i, j) / areas_[i] * kBoundRounding + kUnitRoundoff * value};
  }

  /// Contract: i and j not both in different threads' tiles; bound not negative
  void set(std::size_t i, std::size_t j, const Bounded& exchange);
  /// Says that the tile is done, by its checksum.
  void close(std::size_t tile, const TileReport& report);

  bool done(std::size_t tile) const { return storage_.records[tile].checksum != 0; }
  /// Does what the tile holds match its checksum? (false for one that is not done)
  bool sound(std::size_t tile) const;
  /// Forgets a tile that is not sound.
  void reopen(std::size_t tile);
  /// From now on changes stay in memory: a file keeps what it holds. Takes memory for what is changed only.
  ///
  /// Errors    input_output, of the file
  [[nodiscard]] Result<Done> detach() { return storage_.detach ? storage_.detach() : Done{}; }
  std::size_t tiles_done() const;
  bool complete() const { return tiles_done() == layout_.tiles(); }
  /// The sum over all tiles that are done, in their order.
  TileReport report() const;

 private:
  /// Roundings on the way of a bound into its float and out again: a division, a product, each side.
  static constexpr double kBoundRounding = 1 + 8 * kUnitRoundoff;

  std::size_t cell_of(std::size_t i, std::size_t j) const { return layout_.cell_of(std::min(i, j), std::max(i, j)); }
  std::uint64_t checksum(std::size_t tile) const;

  std::vector<double> areas_;
  TileLayout layout_;
  ExchangeStorage storage_;
};

/// Bytes that a matrix of n surfaces takes.
[[nodiscard]] std::size_t exchange_bytes(const TileLayout& layout);

}  // namespace etendue
