// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "etendue/assembly/hemicube_exchange.hpp"
#include "etendue/assembly/ray_exchange.hpp"
#include "etendue/core/bounded.hpp"
#include "options.hpp"

namespace etendue::cli {

/// What `etendue form-factors` is asked.
struct FormFactorsRequest {
  static constexpr int kNotGiven = -1;

  CommonOptions common;
  std::filesystem::path scene;
  std::string method = "exact";
  Tolerance tolerance{kNotGiven, kNotGiven};
  std::pair<std::string, std::string> pair;  ///< as given; empty: the whole matrix
  std::string unit;                          ///< of the file's lengths; empty: as the file says, if it does
  bool resume = false;
  bool repair = false;
  double drop = 0;
  int rays = kNotGiven;
  int seed = kNotGiven;
  HemicubeSettings pixels{.resolution = kNotGiven, .points = kNotGiven};

  bool by_pixels() const { return method == "hemicube" || method == "tetrahedron"; }
  bool rough() const { return method == "rays" || by_pixels(); }

  void declare(Options& options);
  /// What was not given takes its default; the sentence of a usage error where an option would be of no use.
  [[nodiscard]] std::optional<std::string> complete();
};

}  // namespace etendue::cli
