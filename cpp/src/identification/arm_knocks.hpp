#pragma once
// Rows that no noise explains: something struck the arm.

#include <Eigen/Core>

#include "arm_noise.hpp"

namespace circlepoint {

// Leaves out the rows around whitened residuals beyond six standard deviations, and such dwells; how many. Where too many lie
// there the model is wrong and none is left out.
Index cut_knocks(ArmRows& rows, const StretchResiduals& whitened_residuals, const Eigen::MatrixXd& dwells_normalized);

}  // namespace circlepoint
