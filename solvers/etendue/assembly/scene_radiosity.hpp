// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/radiosity/balance.hpp"
#include "etendue/radiosity/solve.hpp"
#include "etendue/radiosity/system.hpp"

namespace etendue {

/// How good the radiosities of one channel over a scene are.
struct ChannelRadiosity {
  RadiositySolution solution;     ///< for the form factors as computed
  double bound_with_factors = 0;  ///< as RadiositySolution::bound, for the exact form factors; infinite where too loose
  PowerBalance balance;           ///< [W]
};

struct SceneRadiosity {
  std::vector<Rgb> radiosity;   ///< B of each element [W/m²]
  std::vector<Rgb> irradiance;  ///< H = F B of each element [W/m²]
  std::array<ChannelRadiosity, 3> channels;
  std::size_t solved = 3;  ///< the first so many channels are; fewer only when stopped, the others are zero
  RadiosityStatus status = RadiosityStatus::reached;  ///< of an iteration; of direct solvers, of the last channel
  Eigen::Index steps = 0;                             ///< of an iteration
};

/// Bytes for each pair of elements at the peak of a solve: form factor and bound, the factors by rows, and of one channel
/// the matrix I − diag(ρ)F and the copy that is eliminated. The rest grows with n only, or with n times the
/// faces while the matrix is assembled, which is less.
inline constexpr double kBytesAPair = 5 * sizeof(double);

/// The equation of a scene: red, green and blue, areas in m².                                      @eq IU.6-9
[[nodiscard]] RadiosityEquation radiosity_equation(const Scene& scene, const ElementMesh& mesh,
                                                   std::shared_ptr<const FormFactors> factors);

/// Solves the three channels: reflectances differ, form factors do not.                            @eq IU.6-7
///
/// Contract  a complete matrix of this mesh; goal.may_go_on and goal.rules are set here. Products run on the threads of
///           `execution`, eliminations on one. Stops between columns of Gaussian elimination, channels of Eigen's LU, steps
///           of iterations; channels that are solved by then are returned (of an iteration none)
/// Accuracy  per channel: ChannelRadiosity
/// Errors    those of solve_radiosity(), with the channel
[[nodiscard]] Result<SceneRadiosity> solve_scene_radiosity(const Scene& scene, const ElementMesh& mesh,
                                                           const FormFactorMatrix& matrix, const RadiosityGoal& goal,
                                                           const Execution& execution = {});

}  // namespace etendue
