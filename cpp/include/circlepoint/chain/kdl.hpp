#pragma once
// The chains as KDL chains: the one public header that shows another library.
//
// Joint values are the same raw encoder values. A fixed segment before the first joint and after the last one carry base
// and tool where the form has them, so the number of segments is not the number of joints.

#include <kdl/chain.hpp>

#include "circlepoint/chain/dh_chain.hpp"
#include "circlepoint/chain/hayati_chain.hpp"
#include "circlepoint/chain/screw_chain.hpp"

namespace circlepoint {

/// Raises InvalidInput when the chain does not have one joint type per row.
KDL::Chain to_kdl(const StandardDhChain& chain);
KDL::Chain to_kdl(const ModifiedDhChain& chain);
KDL::Chain to_kdl(const HayatiChain& chain);
/// Raises InvalidInput when reference_configuration does not have one entry per joint.
KDL::Chain to_kdl(const ScrewChain& chain);

/// A KDL frame as a rigid transform, and back.
RigidTransform from_kdl(const KDL::Frame& frame);
KDL::Frame to_kdl(const RigidTransform& transform);

}  // namespace circlepoint
