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
  std::size_t solved = 3;  ///< the first so many channels are; fewer only when stopped, the others are zero
};

/// Bytes for each pair of elements at the peak of a solve: form factor and bound, and of one channel the system's
/// factors, its matrix I − diag(ρ)F and the copy that is eliminated. The rest grows with n only, or with n times the
/// faces while the matrix is assembled, which is less.
inline constexpr double kBytesAPair = 5 * sizeof(double);

/// The system 6-9 of a scene for one channel (0 red, 1 green, 2 blue).                            @eq IU.6-9
[[nodiscard]] RadiositySystem radiosity_system(const Scene& scene, const ElementMesh& mesh,
                                               const Eigen::MatrixXd& form_factors, Eigen::Index channel);

/// Solves the three channels, one system each: reflectances differ.                               @eq IU.6-7
///
/// Contract  a complete matrix of this mesh; one thread. Stops between columns of Gaussian elimination, between channels
///           with Eigen's LU; what is solved by then is returned
/// Accuracy  per channel: ChannelRadiosity
/// Errors    those of solve_radiosity(), with the channel
[[nodiscard]] Result<SceneRadiosity> solve_scene_radiosity(const Scene& scene, const ElementMesh& mesh,
                                                           const FormFactorMatrix& matrix, DirectSolver solver,
                                                           const Execution& execution = {});

}  // namespace etendue
