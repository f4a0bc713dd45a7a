#pragma once
// A chain of which only some joints' axes are known: the others are taken to stand at the reference configuration.

#include <optional>
#include <vector>

#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint {

struct PartialChain {
  std::vector<std::optional<ScrewAxis>> axes;  // in the sensor frame at the reference configuration
  Eigen::VectorXd reference_configuration;
  Eigen::Vector3d up_gravity = Eigen::Vector3d::Zero();
  Eigen::Vector3d percussion_distance = Eigen::Vector3d::Zero();

  [[nodiscard]] Index size() const { return static_cast<Index>(axes.size()); }
  [[nodiscard]] bool knows(Index joint) const { return axes[static_cast<std::size_t>(joint)].has_value(); }

  // The known joints as a chain, and the columns of a joint array that belong to it.
  [[nodiscard]] ScrewChain known(std::vector<Index>& columns) const;
};

// What an ideal sensor with the given percussion distance reads along joint trajectories, (N, 3).
Samples3 predict_readings(const PartialChain& chain, const Eigen::Ref<const SamplesX>& position,
                          const Eigen::Ref<const SamplesX>& velocity, const Eigen::Ref<const SamplesX>& acceleration);

// Reading of the whole chain minus reading with `joint` alone moving about `configuration`: what yielding joints add.
Samples3 yield_correction(const PartialChain& chain, Index joint, const Eigen::VectorXd& configuration,
                          const Eigen::Ref<const SamplesX>& position, const Eigen::Ref<const SamplesX>& velocity,
                          const Eigen::Ref<const SamplesX>& acceleration);

// The displacement that carries a line of `joint` from the sensor frame at `from` to the one at the reference configuration,
// both seen from the joint's own link; uses the known joints beyond it.
RigidTransform carry_to_reference(const PartialChain& chain, Index joint, const Eigen::VectorXd& from);

}  // namespace circlepoint
