#pragma once
// Joint axes as lines <-> Denavit-Hartenberg parameters, by common normals (circle point analysis, docs/method).
//
// Four parameters a joint are more than the lines determine. What the lines leave free is set to zero - or, with a nominal
// chain, to its value there - and marked in `free`; base and tool take up the rest, so that forward kinematics equals
// the product of exponentials. Free are:
//   - the placement of the base: standard d_1, theta_1; modified all four of the first row;
//   - the placement of the tool frame: standard all four of the last row; modified d_n, theta_n;
//   - the offset of a prismatic axis, of which only the direction acts: two lengths each;
//   - between exactly parallel neighbours, the position of the common normal along them: the d of the later row (where
//     that is free already, the d of the row before); between coincident ones, also a theta.
// A free parameter is a convention, not a measurement: it has no standard deviation.
//
// Branch. A common normal has two directions; flipping x_i changes the signs of a and alpha and turns two thetas by pi.
// With a nominal chain: the direction whose (alpha, a) is nearer the nominal row's, and each angle the multiple of 2 pi
// nearest the nominal one. Without: 0 < alpha < pi, a of either sign (nothing jumps when neighbours come to intersect);
// parallel neighbours a >= 0, alpha = 0 or pi; theta in (-pi, pi].
//
// Failure. Nearly parallel neighbours have far-away common normals: the parameters are then exact but ill conditioned
// (d of the order of gap / angle), which `near_parallel` reports. Below parallel_tolerance the angle is dropped: forward
// kinematics is then off by angle x reach, and above it by rounding x gap / angle; the default balances the two at 1e-8.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "circlepoint/chain/dh_chain.hpp"
#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint {

template <class DhChain>
struct DhOptions {
  std::optional<DhChain> nominal = {};    ///< same number and types of joints; its rows choose the branch and the free values
  double parallel_tolerance = 1e-8;       ///< rad, neighbours within it count as exactly parallel
  double near_parallel_threshold = 1e-3;  ///< rad, neighbours within it are reported
};
using StandardDhOptions = DhOptions<StandardDhChain>;
using ModifiedDhOptions = DhOptions<ModifiedDhChain>;

/// Neighbouring axes `first` and `first + 1` (from 0) whose directions are nearly parallel or anti-parallel.
struct NearParallel {
  Index first = 0;
  double angle = 0.0;     ///< rad, enclosed by the two undirected axes: 0 to pi/2
  bool parallel = false;  ///< within parallel_tolerance: the foot of the common normal was a choice
};

/// n x 4, columns in the order a, alpha, d, theta.
using FreeFlags = Eigen::Matrix<bool, Eigen::Dynamic, 4, Eigen::RowMajor>;

template <class DhChain>
struct DhConversion {
  DhChain chain;                            ///< with base and tool: forward kinematics as the screw chain's
  FreeFlags free;                           ///< true: a choice, not determined by the axes
  std::vector<NearParallel> near_parallel;  ///< base to tip
};
using StandardDhConversion = DhConversion<StandardDhChain>;
using ModifiedDhConversion = DhConversion<ModifiedDhChain>;

/// Standard DH parameters of a screw chain. Raises InvalidInput for a chain without joints, or a nominal chain whose
/// number or types of joints differ.
StandardDhConversion to_standard_dh(const ScrewChain& chain, const StandardDhOptions& options = {});
/// Modified (Craig) DH parameters of a screw chain; raises as to_standard_dh.
ModifiedDhConversion to_modified_dh(const ScrewChain& chain, const ModifiedDhOptions& options = {});

/// Which frame the lines of a screw chain are given in.
enum class BaseFrame {
  chain_base,           ///< the DH chain's base frame; home = T_base_sensor at the reference configuration
  sensor_at_reference,  ///< the sensor frame at the reference configuration; home = identity (calibration results)
};

/// The screw chain of a DH chain at a reference configuration (rad or m, raw encoder values).
ScrewChain to_screws(const StandardDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& reference_configuration,
                     BaseFrame base_frame);
ScrewChain to_screws(const ModifiedDhChain& chain, const Eigen::Ref<const Eigen::VectorXd>& reference_configuration,
                     BaseFrame base_frame);

/// (4n x 4n) derivative of the DH parameters (a, alpha, d, theta of each row, base to tip) by the local coordinates
/// (d1, d2, p1, p2 of each axis, geometry/joint_axis.hpp), by central differences of step `step` (rad, m; less where
/// neighbours are near-parallel), on the branch of `at`, which must be the conversion of this chain. Covariance of the
/// parameters: J C J^T. Rows of free parameters are zero. Parameters that have no derivative because their neighbours
/// are exactly parallel (any disturbance moves the common normal to far away) have rows of NaN.
Eigen::MatrixXd dh_parameter_jacobian(const ScrewChain& chain, const StandardDhConversion& at, double step = 1e-6);
Eigen::MatrixXd dh_parameter_jacobian(const ScrewChain& chain, const ModifiedDhConversion& at, double step = 1e-6);

}  // namespace circlepoint
