#pragma once
// Kinds of motion: stretches that share their noise model.

#include "arm_rows.hpp"

namespace circlepoint {

// Names each stretch's kind: which joint moves alone, or which joints move between two rests, as each shakes the arm by its own gears
// and loads. Kinds too short for a noise model of their own are one.
void name_kinds(ArmRows& rows);

}  // namespace circlepoint
