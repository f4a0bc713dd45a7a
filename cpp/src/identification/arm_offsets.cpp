#include "arm_offsets.hpp"

#include <algorithm>
#include <cmath>

namespace circlepoint {

void add_term(MovingStretch& stretch, const OffsetTerm& term, const Eigen::VectorXd& position, const Eigen::VectorXd& velocity,
              const Eigen::VectorXd& acceleration) {
  const auto append = [&](Eigen::MatrixXd& shapes, const Eigen::VectorXd& shape) {
    shapes.conservativeResize(stretch.rows(), shapes.cols() + 1);
    shapes.rightCols<1>() = shape;
  };
  append(stretch.shapes.position, position);
  append(stretch.shapes.velocity, velocity);
  append(stretch.shapes.acceleration, acceleration);
  stretch.offsets.push_back(term);
}

void add_term(DwellRow& dwell, const OffsetTerm& term, double shape) {
  dwell.offsets.push_back(term);
  dwell.shape.conservativeResize(static_cast<Index>(dwell.offsets.size()));
  dwell.shape[dwell.shape.size() - 1] = shape;
}

Index add_parameters(ArmRows& rows, const Eigen::MatrixXd& covariance) {
  const Index before = rows.offset_covariance.rows();
  const Index after = before + covariance.rows();
  const auto grow = [&](Eigen::MatrixXd& all, const Eigen::MatrixXd& block) {
    Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(after, after);
    larger.topLeftCorner(before, before) = all;
    larger.bottomRightCorner(block.rows(), block.rows()) = block;
    all = std::move(larger);
  };
  grow(rows.offset_covariance, covariance);
  grow(rows.offset_information, covariance.inverse());
  return before;
}

void set_prior(ArmRows& rows, Index first, const Eigen::MatrixXd& covariance) {
  rows.offset_covariance.block(first, first, covariance.rows(), covariance.cols()) = covariance;
  rows.offset_information.block(first, first, covariance.rows(), covariance.cols()) = covariance.inverse();
}

void shift_offsets(ArmRows& rows, Index first, const Eigen::VectorXd& shift) {
  const auto amount = [&](const OffsetTerm& term) {
    return term.parameter >= first && term.parameter < first + shift.size() ? shift[term.parameter - first] : 0.0;
  };
  for (DwellRow& dwell : rows.dwells) {
    for (std::size_t k = 0; k < dwell.offsets.size(); ++k) {
      dwell.position[dwell.offsets[k].joint] += amount(dwell.offsets[k]) * dwell.shape[static_cast<Index>(k)];
    }
  }
  for (MovingStretch& stretch : rows.stretches) {
    for (std::size_t k = 0; k < stretch.offsets.size(); ++k) {
      const Index joint = stretch.offsets[k].joint;
      const double by = amount(stretch.offsets[k]);
      stretch.position.col(joint) += by * stretch.shapes.position.col(static_cast<Index>(k));
      stretch.velocity.col(joint) += by * stretch.shapes.velocity.col(static_cast<Index>(k));
      stretch.acceleration.col(joint) += by * stretch.shapes.acceleration.col(static_cast<Index>(k));
    }
  }
}

namespace {

// Rows in which one joint stands on the same count.
struct Rest {
  double position = 0.0;
  std::vector<DwellRow*> dwells;
  std::vector<MovingStretch*> stretches;
};

// Whether a joint stands still all through a stretch, and nothing is said of its error there.
bool stands(const MovingStretch& stretch, Index joint, double count) {
  const auto position = stretch.position.col(joint);
  const auto told = [&](const PositionError& error) { return error.joint == joint; };
  return !stretch.follows[static_cast<std::size_t>(joint)] && position.maxCoeff() - position.minCoeff() < one_rest * count &&
         std::none_of(stretch.errors.begin(), stretch.errors.end(), told);
}

std::vector<Rest> find_rests(ArmRows& rows, Index joint, double count) {
  std::vector<Rest> rests;
  const auto rest_at = [&](double position) -> Rest& {
    const auto same = std::find_if(rests.begin(), rests.end(),
                                   [&](const Rest& rest) { return std::abs(rest.position - position) < one_rest * count; });
    return same == rests.end() ? rests.emplace_back(Rest{position, {}, {}}) : *same;
  };
  for (DwellRow& dwell : rows.dwells) {
    if (!dwell.follows[static_cast<std::size_t>(joint)]) {
      rest_at(dwell.position[joint]).dwells.push_back(&dwell);
    }
  }
  for (MovingStretch& stretch : rows.stretches) {
    if (stands(stretch, joint, count)) {
      rest_at(stretch.position.col(joint).mean()).stretches.push_back(&stretch);
    }
  }
  return rests;
}

}  // namespace

void give_offsets(ArmRows& rows, const Eigen::VectorXd& resolution) {
  for (Index joint = 0; joint < resolution.size(); ++joint) {
    const double count = resolution[joint];
    if (count <= 0.0) {
      continue;
    }
    for (Rest& rest : find_rests(rows, joint, count)) {
      if (rest.stretches.empty() && rest.dwells.size() < 2) {
        continue;  // the dwell's own variance
      }
      const OffsetTerm term{joint, add_parameters(rows, Eigen::MatrixXd::Constant(1, 1, count * count / 12.0))};
      for (DwellRow* dwell : rest.dwells) {
        add_term(*dwell, term, 1.0);
        dwell->position_variance[joint] = 0.0;
      }
      for (MovingStretch* stretch : rest.stretches) {
        const Eigen::VectorXd zero = Eigen::VectorXd::Zero(stretch->rows());
        add_term(*stretch, term, Eigen::VectorXd::Ones(stretch->rows()), zero, zero);
      }
    }
  }
}

}  // namespace circlepoint
