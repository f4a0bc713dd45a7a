#pragma once
// Joint axes as lines -> Denavit-Hartenberg rows, with a Hayati row wherever the next axis is nearly parallel.
//
// Frames are laid from base to tip, each origin on its axis. Row j leads from frame j to axis j + 1:
//   dh:      d to the foot of the common normal, theta to its direction, a along it, alpha to the next axis;
//   hayati:  the next origin is where axis j + 1 pierces the x-y plane of frame j (prismatic j: as it has moved), theta
//            turns x towards it, a is the distance, alpha and beta tilt z:  z' = (sin beta, -sin alpha cos beta, cos alpha cos beta).
// A dh row amplifies an error of the axes by 1 / sin(angle), a Hayati row by 1 / cos(angle); the angle that the axes
// enclose chooses (`near_parallel_threshold`), and the row says which it is.
//
// Free are, as in the conversion to DH (chain/screws_to_dh): the placement of the base (theta of the first row; its d, or in
// a Hayati row the origin along the first axis), all of the last row, a and d (or a and theta) before a prismatic axis, and
// theta between coincident axes. They take their nominal value, else zero; base and tool close the chain.
//
// Branch. With a nominal chain: of the two directions of x the one whose (alpha, a) is nearer the nominal row's - a Hayati
// row: whose a has the nominal sign - and angles are the turns nearest the nominal ones. Without: 0 < alpha < pi in a dh row,
// a >= 0 in a Hayati row, angles in (-pi, pi].

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "circlepoint/chain/dh_chain.hpp"
#include "circlepoint/chain/hayati_chain.hpp"
#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint {

struct HayatiOptions {
  std::optional<StandardDhChain> nominal = {};  ///< same number and types of joints; branch, free values, place of the base
  double near_parallel_threshold = 0.05;        ///< rad; neighbours within it get a Hayati row
  std::vector<RowForm> forms = {};              ///< empty: chosen by the threshold; else one a row (the last is ignored)
};

/// n x 5, columns in the order a, alpha, d, theta, beta.
using HayatiFreeFlags = Eigen::Matrix<bool, Eigen::Dynamic, 5, Eigen::RowMajor>;

struct HayatiConversion {
  HayatiChain chain;     ///< with base and tool: forward kinematics as the screw chain's
  HayatiFreeFlags free;  ///< true: a choice, not determined by the axes (the zero d or beta of a row is none)
};

/// Mixed DH and Hayati rows of a screw chain. Raises InvalidInput for a chain without joints, a nominal chain or forms of
/// another size, or a nominal chain with other types of joints.
HayatiConversion to_hayati(const ScrewChain& chain, const HayatiOptions& options = {});

/// (5n x 4n) derivative of (a, alpha, d, theta, beta) of each row by the local coordinates (d1, d2, p1, p2) of each axis, by
/// central differences, on the branch and with the row forms of `at`, the conversion of this chain. Rows of free parameters
/// are zero, as are those of the d or beta a row does not have.
Eigen::MatrixXd hayati_parameter_jacobian(const ScrewChain& chain, const HayatiConversion& at, double step = 1e-6);

}  // namespace circlepoint
