#include "circlepoint/chain/kdl.hpp"

#include <kdl/segment.hpp>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

KDL::Vector to_kdl_vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string joint_name(std::size_t i) { return "joint" + std::to_string(i + 1); }

KDL::Segment fixed_segment(const std::string& name, const KDL::Frame& frame) {
  return KDL::Segment(name, KDL::Joint(name, KDL::Joint::Fixed), frame);
}

KDL::Segment z_segment(std::size_t i, JointType type, const KDL::Frame& tip) {
  const auto kind = type == JointType::revolute ? KDL::Joint::RotZ : KDL::Joint::TransZ;
  return KDL::Segment("link" + std::to_string(i + 1), KDL::Joint(joint_name(i), kind), tip);
}

template <class DhChain>
void require_types(const DhChain& chain) {
  require(chain.types.size() == chain.rows.size(), "DH chain has " + std::to_string(chain.rows.size()) + " rows and " +
                                                       std::to_string(chain.types.size()) +
                                                       " joint types; give one type per row");
}

}  // namespace

KDL::Frame to_kdl(const RigidTransform& transform) {
  const auto& m = transform.matrix();
  return {KDL::Rotation(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)),
          to_kdl_vector(transform.translation())};
}

RigidTransform from_kdl(const KDL::Frame& frame) {
  RigidTransform transform = RigidTransform::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      transform.linear()(row, column) = frame.M(row, column);
    }
    transform.translation()[row] = frame.p(row);
  }
  return transform;
}

KDL::Chain to_kdl(const StandardDhChain& chain) {
  require_types(chain);
  KDL::Chain result;
  result.addSegment(fixed_segment("base", to_kdl(chain.base)));
  for (std::size_t i = 0; i < chain.rows.size(); ++i) {
    const DhRow& row = chain.rows[i];
    result.addSegment(z_segment(i, chain.types[i], KDL::Frame::DH(row.a, row.alpha, row.d, row.theta)));
  }
  result.addSegment(fixed_segment("tool", to_kdl(chain.tool)));
  return result;
}

KDL::Chain to_kdl(const ModifiedDhChain& chain) {
  require_types(chain);
  KDL::Chain result;
  result.addSegment(fixed_segment("base", to_kdl(chain.base)));
  for (std::size_t i = 0; i < chain.rows.size(); ++i) {
    // KDL's joint comes first in its segment, Craig's after a and alpha: those go into a segment of their own.
    const DhRow& row = chain.rows[i];
    result.addSegment(fixed_segment("offset" + std::to_string(i + 1), KDL::Frame::DH_Craig1989(row.a, row.alpha, 0.0, 0.0)));
    result.addSegment(z_segment(i, chain.types[i], KDL::Frame::DH_Craig1989(0.0, 0.0, row.d, row.theta)));
  }
  result.addSegment(fixed_segment("tool", to_kdl(chain.tool)));
  return result;
}

KDL::Chain to_kdl(const HayatiChain& chain) {
  require_types(chain);
  KDL::Chain result;
  result.addSegment(fixed_segment("base", to_kdl(chain.base)));
  for (std::size_t i = 0; i < chain.rows.size(); ++i) {
    const HayatiRow& row = chain.rows[i];
    const KDL::Frame tilt(KDL::Rotation::RotY(row.beta));
    result.addSegment(z_segment(i, chain.types[i], KDL::Frame::DH(row.a, row.alpha, row.d, row.theta) * tilt));
  }
  result.addSegment(fixed_segment("tool", to_kdl(chain.tool)));
  return result;
}

KDL::Chain to_kdl(const ScrewChain& chain) {
  require(chain.reference_configuration.size() == chain.size(),
          "reference_configuration has " + std::to_string(chain.reference_configuration.size()) +
              " entries for a chain of " + std::to_string(chain.size()) + " joints; give one per joint, base to tip");
  KDL::Chain result;
  for (std::size_t i = 0; i < chain.axes.size(); ++i) {
    const ScrewAxis& axis = chain.axes[i];
    const auto kind = axis.type == JointType::revolute ? KDL::Joint::RotAxis : KDL::Joint::TransAxis;
    const KDL::Joint joint(joint_name(i), to_kdl_vector(axis.line.point), to_kdl_vector(axis.line.direction), kind);
    // KDL's segment is at its tip when the joint reads zero.
    const RigidTransform at_zero = screw_exp(axis, -chain.reference_configuration[static_cast<Index>(i)]);
    result.addSegment(KDL::Segment("link" + std::to_string(i + 1), joint, to_kdl(at_zero)));
  }
  result.addSegment(fixed_segment("home", to_kdl(chain.home)));
  return result;
}

}  // namespace circlepoint
