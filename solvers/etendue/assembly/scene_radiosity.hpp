// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/radiosity/balance.hpp"
#include "etendue/radiosity/system.hpp"

namespace etendue {

/// The radiosities of one channel over a scene.
struct ChannelRadiosity {
  RadiositySolution solution;
  double bound_with_factors = 0;  ///< as RadiositySolution::bound, for the exact form factors; infinite where too loose
  PowerBalance balance;           ///< [W]
};

struct SceneRadiosity {
  std::vector<Rgb> radiosity;  ///< B of each element [W/m²]
  std::array<ChannelRadiosity, 3> channels;
};

/// The system 6-9 of a scene for one channel (0 red, 1 green, 2 blue).                            @eq IU.6-9
[[nodiscard]] RadiositySystem radiosity_system(const Scene& scene, const ElementMesh& mesh,
                                               const Eigen::MatrixXd& form_factors, Eigen::Index channel);

/// Solves the three channels, one system each: reflectances differ.                               @eq IU.6-7
///
/// Contract  a complete matrix of this mesh
/// Accuracy  per channel: ChannelRadiosity
/// Errors    those of solve_radiosity(), with the channel
[[nodiscard]] Result<SceneRadiosity> solve_scene_radiosity(const Scene& scene, const ElementMesh& mesh,
                                                           const FormFactorMatrix& matrix, DirectSolver solver);

}  // namespace etendue
