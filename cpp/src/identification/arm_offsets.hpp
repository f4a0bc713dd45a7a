#pragma once
// Unknown errors of joints' positions that rows share, and their prior.

#include <Eigen/Core>

#include "arm_rows.hpp"

namespace circlepoint {

// Adds a term of constant or given shape.
void add_term(MovingStretch& stretch, const OffsetTerm& term, const Eigen::VectorXd& position, const Eigen::VectorXd& velocity,
              const Eigen::VectorXd& acceleration);
void add_term(DwellRow& dwell, const OffsetTerm& term, double shape);

// Adds parameters with the given prior; the first one's index.
Index add_parameters(ArmRows& rows, const Eigen::MatrixXd& covariance);

// Gives parameters from `first` on another prior, and the rows the part of them that is no longer unknown.
void set_prior(ArmRows& rows, Index first, const Eigen::MatrixXd& covariance);
void shift_offsets(ArmRows& rows, Index first, const Eigen::VectorXd& shift);

// Gives every rest, the same joint on the same count, an offset of its own, which all its rows share; but one of a single dwell.
void give_offsets(ArmRows& rows, const Eigen::VectorXd& resolution);

}  // namespace circlepoint
