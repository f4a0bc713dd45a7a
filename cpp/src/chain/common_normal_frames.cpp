#include "common_normal_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

// Lines and rows count from 0. Frame f has its z along line f; "pair f" are the lines f-1 and f, and x_f is along their
// common normal, which ends in the origin of frame f. Row j leads from frame j to frame j+1.
//
// A revolute axis is located; a prismatic one has a direction only and is put where it costs the fewest odd numbers:
// on its parallel predecessor, or else where its neighbour's frame makes the free lengths nominal. The frame of the last
// located line is the anchor; frames before it are laid from tip to base, those after it (prismatic only) to the tip.
// An anchor that may still slide along or turn about its line (no proper common normal) is put where it makes the nearest
// undetermined d or theta nominal.

namespace circlepoint {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
/// Distance, m, below which parallel lines count as coincident.
constexpr double coincident_distance = 1e-10;

enum Column : Index { column_a = 0, column_alpha = 1, column_d = 2, column_theta = 3 };

/// Angle from u to v about the unit vector x, which is orthogonal to both.
double signed_angle(const Eigen::Vector3d& u, const Eigen::Vector3d& v, const Eigen::Vector3d& x) {
  return std::atan2(x.dot(u.cross(v)), u.dot(v));
}

Eigen::Vector3d turned(const Eigen::Vector3d& x, const Eigen::Vector3d& z, double angle) {
  return rotation_exp(angle * z) * x;
}

class FrameLayer {
 public:
  FrameLayer(const ScrewChain& chain, const FrameRules& rules)
      : chain_(chain), rules_(rules), n_(static_cast<std::size_t>(chain.size())), free_(FreeFlags::Zero(chain.size(), 4)) {
    for (const ScrewAxis& axis : chain.axes) {
      z_.push_back(axis.line.direction);
      point_.push_back(axis.line.point);
      located_.push_back(axis.type == JointType::revolute);
    }
    x_.resize(n_, Eigen::Vector3d::Zero());
    origin_.resize(n_, Eigen::Vector3d::Zero());
    foot_.resize(n_, Eigen::Vector3d::Zero());
    preset_x_.resize(n_);
    parallel_.resize(n_, false);
    for (std::size_t f = 1; f < n_; ++f) {
      parallel_[f] = z_[f - 1].cross(z_[f]).norm() < rules.parallel_tolerance;
    }
    hint_.resize(n_, RigidTransform::Identity());
    if (rules.nominal != nullptr) {
      const RigidTransform ours_from_nominal =
          chain.home * forward_kinematics(*rules.nominal, chain.reference_configuration).inverse();
      RigidTransform frame = ours_from_nominal * rules.nominal->base;
      for (std::size_t f = 0; f < n_; ++f) {
        hint_[f] = frame;
        frame = frame * standard_dh_transform(rules.nominal->rows[f], type(f), reference(f));
      }
    }
    locate_prismatic_on_predecessor();
    free_by_placement_ = free_;
  }

  /// Lays every frame, with the anchor slid (m) and turned (rad) from its hint where it may be.
  void lay(double slide, double turn) {
    free_ = free_by_placement_;
    anchor_ = n_;
    for (std::size_t i = 0; i < n_; ++i) {
      if (located_[i]) {
        anchor_ = i;
      }
    }
    if (anchor_ == n_ || anchor_ == 0) {
      anchor_ = 0;
      origin_[0] = located_[0] ? near_hint(0, 0.0) : hint_[0].translation();
      x_[0] = x_of_hint(0, 0.0);
    } else {
      lay_anchor(slide, turn);
    }
    for (std::size_t f = anchor_; f-- > 1;) {
      lay_towards_base(f);
    }
    for (std::size_t f = anchor_ + 1; f < n_; ++f) {
      lay_towards_tip(f);
    }
  }

  [[nodiscard]] bool may_slide() const { return may_slide_; }
  [[nodiscard]] bool may_turn() const { return may_turn_; }
  [[nodiscard]] std::size_t anchor() const { return anchor_; }
  [[nodiscard]] bool is_free(std::size_t row, Column column) const { return free_(static_cast<Index>(row), column); }
  void mark_free(std::size_t row, Column column) { free_(static_cast<Index>(row), column) = true; }
  [[nodiscard]] DhRow nominal(std::size_t row) const {
    return rules_.nominal != nullptr ? rules_.nominal->rows[row] : DhRow{};
  }

  /// The row as it was laid, free values set to nominal.
  [[nodiscard]] DhRow row(std::size_t j) const {
    const DhRow expected = nominal(j);
    DhRow row = expected;
    if (j + 1 < n_) {
      row.a = (origin_[j + 1] - foot_[j + 1]).dot(x_[j + 1]);
      row.alpha = nearest_turn(parallel_[j + 1] ? (z_[j].dot(z_[j + 1]) > 0.0 ? 0.0 : std::numbers::pi)
                                                : signed_angle(z_[j], z_[j + 1], x_[j + 1]),
                               expected.alpha);
      if (j > 0) {
        row.d = (foot_[j + 1] - origin_[j]).dot(z_[j]) - (type(j) == JointType::prismatic ? reference(j) : 0.0);
        row.theta = nearest_turn(
            signed_angle(x_[j], x_[j + 1], z_[j]) - (type(j) == JointType::revolute ? reference(j) : 0.0), expected.theta);
      }
    }
    row.a = is_free(j, column_a) ? expected.a : row.a;
    row.d = is_free(j, column_d) ? expected.d : row.d;
    row.theta = is_free(j, column_theta) ? expected.theta : row.theta;
    return row;
  }

  [[nodiscard]] StandardDhConversion conversion() {
    mark_free(0, column_d);
    mark_free(0, column_theta);
    free_.row(chain_.size() - 1).setConstant(true);
    StandardDhConversion result;
    result.free = free_;
    for (std::size_t j = 0; j < n_; ++j) {
      result.chain.rows.push_back(row(j));
      result.chain.types.push_back(type(j));
    }
    const std::size_t first = n_ > 1 ? 1 : 0;
    RigidTransform frame = RigidTransform::Identity();
    frame.linear() << x_[first], z_[first].cross(x_[first]), z_[first];
    frame.translation() = origin_[first];
    result.chain.base =
        n_ > 1 ? frame * standard_dh_transform(result.chain.rows[0], type(0), reference(0)).inverse() : frame;
    // The tool closes the chain at the reference configuration, whatever rounding the rows collected on the way.
    result.chain.tool = forward_kinematics(result.chain, chain_.reference_configuration).inverse() * chain_.home;
    return result;
  }

 private:
  [[nodiscard]] JointType type(std::size_t i) const { return chain_.axes[i].type; }
  [[nodiscard]] double reference(std::size_t i) const { return chain_.reference_configuration[static_cast<Index>(i)]; }
  /// Rotation about z and translation along z of a row at the reference configuration, offsets nominal.
  [[nodiscard]] double nominal_theta(std::size_t row) const {
    return nominal(row).theta + (type(row) == JointType::revolute ? reference(row) : 0.0);
  }
  [[nodiscard]] double nominal_d(std::size_t row) const {
    return nominal(row).d + (type(row) == JointType::prismatic ? reference(row) : 0.0);
  }

  [[nodiscard]] Eigen::Vector3d near_hint(std::size_t line, double slide) const {
    return point_[line] + (z_[line].dot(hint_[line].translation() - point_[line]) + slide) * z_[line];
  }

  [[nodiscard]] Eigen::Vector3d x_of_hint(std::size_t frame, double turn) const {
    const Eigen::Vector3d& z = z_[frame];
    const Eigen::Vector3d hint = hint_[frame].linear().col(0);
    const Eigen::Vector3d across = hint - hint.dot(z) * z;
    return turned(across.norm() > 0.4 ? Eigen::Vector3d(across.normalized()) : Eigen::Vector3d(tangent_basis(z).col(0)), z,
                  turn);
  }

  /// Direction of the common normal of a pair that is not parallel; `gap` leads from line f-1 to line f where both are known.
  [[nodiscard]] Eigen::Vector3d normal_direction(std::size_t f, const Eigen::Vector3d& gap) const {
    Eigen::Vector3d x = rules_.canonical_sign * z_[f - 1].cross(z_[f]).normalized();
    x = (x - x.dot(z_[f]) * z_[f]).normalized();
    if (rules_.nominal == nullptr) {
      return x;
    }
    const DhRow expected = nominal(f - 1);
    const double alpha = signed_angle(z_[f - 1], z_[f], x);
    const auto cost = [&](double sign) {
      return std::hypot(std::remainder(sign * alpha - expected.alpha, two_pi),
                        gap.isZero() ? 0.0 : sign * gap.dot(x) - expected.a);
    };
    return cost(1.0) <= cost(-1.0) ? x : Eigen::Vector3d(-x);
  }

  /// Between parallels: along the gap from foot to origin; zero when they coincide.
  [[nodiscard]] Eigen::Vector3d gap_direction(std::size_t f, const Eigen::Vector3d& gap) const {
    const double distance = gap.norm();
    if (distance <= coincident_distance) {
      return Eigen::Vector3d::Zero();
    }
    const double preferred = rules_.nominal != nullptr ? nominal(f - 1).a : 0.0;
    const double sign = preferred != 0.0 ? preferred : rules_.canonical_sign;
    const Eigen::Vector3d x = std::copysign(1.0 / distance, sign) * gap;
    return (x - x.dot(z_[f]) * z_[f]).normalized();
  }

  // A prismatic axis parallel to the one before it, and not to the one after it, goes with the one before.
  void locate_prismatic_on_predecessor() {
    for (std::size_t i = 1; i + 1 < n_; ++i) {
      if (located_[i] || !located_[i - 1] || !parallel_[i] || parallel_[i + 1]) {
        continue;
      }
      preset_x_[i + 1] = normal_direction(i + 1, Eigen::Vector3d::Zero());
      preset_x_[i] = turned(*preset_x_[i + 1], z_[i], -nominal_theta(i));
      point_[i] = point_[i - 1] + nominal(i - 1).a * *preset_x_[i];
      located_[i] = true;
      mark_free(i - 1, column_a);
      mark_free(i, column_theta);
    }
  }

  void lay_common_normal(std::size_t f) {
    const CommonNormal normal = common_normal({z_[f - 1], point_[f - 1]}, {z_[f], point_[f]}, Eigen::Vector3d::Zero(), 0.0);
    foot_[f] = normal.foot_first;
    origin_[f] = normal.foot_second;
    x_[f] = preset_x_[f] ? *preset_x_[f] : normal_direction(f, origin_[f] - foot_[f]);
  }

  /// Origin given: the foot on line f-1 and x along the gap. False when the lines coincide: x is still open then.
  bool lay_parallel(std::size_t f) {
    foot_[f] = point_[f - 1] + z_[f - 1].dot(origin_[f] - point_[f - 1]) * z_[f - 1];
    x_[f] = preset_x_[f] ? *preset_x_[f] : gap_direction(f, origin_[f] - foot_[f]);
    return !x_[f].isZero();
  }

  /// Origin and x given: the prismatic line f-1 a nominal a away.
  void place_prismatic_before(std::size_t f) {
    foot_[f] = origin_[f] - nominal(f - 1).a * x_[f];
    point_[f - 1] = foot_[f];
    mark_free(f - 1, column_a);
  }

  void lay_anchor(double slide, double turn) {
    const std::size_t f = anchor_;
    if (located_[f - 1] && !parallel_[f]) {
      lay_common_normal(f);
      return;
    }
    may_slide_ = true;
    origin_[f] = near_hint(f, slide);
    if (located_[f - 1]) {
      if (!lay_parallel(f)) {
        may_turn_ = true;
        x_[f] = x_of_hint(f, turn);
      }
      return;
    }
    may_turn_ = parallel_[f];
    x_[f] = parallel_[f] ? x_of_hint(f, turn) : normal_direction(f, Eigen::Vector3d::Zero());
    place_prismatic_before(f);
  }

  void lay_towards_base(std::size_t f) {
    if (located_[f - 1] && !parallel_[f]) {
      lay_common_normal(f);
      return;
    }
    origin_[f] = foot_[f + 1] - nominal_d(f) * z_[f];
    mark_free(f, column_d);
    const bool open = located_[f - 1] ? !lay_parallel(f) : parallel_[f];
    if (open) {
      x_[f] = turned(x_[f + 1], z_[f], -nominal_theta(f));
      mark_free(f, column_theta);
    } else if (!located_[f - 1]) {
      x_[f] = normal_direction(f, Eigen::Vector3d::Zero());
    }
    if (!located_[f - 1]) {
      place_prismatic_before(f);
    }
  }

  void lay_towards_tip(std::size_t f) {
    if (preset_x_[f]) {
      x_[f] = *preset_x_[f];
    } else if (parallel_[f]) {
      x_[f] = turned(x_[f - 1], z_[f - 1], nominal_theta(f - 1));
      mark_free(f - 1, column_theta);
    } else {
      x_[f] = normal_direction(f, Eigen::Vector3d::Zero());
    }
    foot_[f] = origin_[f - 1] + nominal_d(f - 1) * z_[f - 1];
    origin_[f] = foot_[f] + nominal(f - 1).a * x_[f];
    mark_free(f - 1, column_d);
    mark_free(f - 1, column_a);
  }

  const ScrewChain& chain_;
  const FrameRules& rules_;
  std::size_t n_;
  FreeFlags free_, free_by_placement_;
  std::vector<Eigen::Vector3d> z_, point_;                // lines; point_ of a prismatic axis once it is placed
  std::vector<bool> located_, parallel_;                  // line i; pair f
  std::vector<Eigen::Vector3d> x_, origin_, foot_;        // frame f; foot_: of its common normal on line f-1
  std::vector<std::optional<Eigen::Vector3d>> preset_x_;  // x_f where the placement of a prismatic axis depends on it
  std::vector<RigidTransform> hint_;                      // the nominal frames, or the base
  std::size_t anchor_ = 0;
  bool may_slide_ = false, may_turn_ = false;
};

}  // namespace

double nearest_turn(double angle, double reference) {
  const double away = std::remainder(angle - reference, two_pi);
  return reference + (away <= -std::numbers::pi ? away + two_pi : away);
}

StandardDhConversion lay_standard_frames(const ScrewChain& chain, const FrameRules& rules) {
  constexpr double same = 1e-9;
  FrameLayer frames(chain, rules);
  frames.lay(0.0, 0.0);
  FrameLayer probe = frames;
  const std::size_t last_row = std::min(frames.anchor(), static_cast<std::size_t>(chain.size()) - 1);
  double turn = 0.0;
  double slide = 0.0;
  std::size_t turned_row = 0;  // the first row is free as it is: 0 stands for none
  std::size_t slid_row = 0;
  for (std::size_t j = last_row; frames.may_turn() && j >= 1 && turned_row == 0; --j) {
    // theta of a row that feels the turn changes by plus or minus the turn itself.
    probe.lay(0.0, 0.5);
    const double change = std::remainder(probe.row(j).theta - frames.row(j).theta, two_pi);
    const double wanted = std::remainder(frames.nominal(j).theta - frames.row(j).theta, two_pi);
    if (frames.is_free(j, column_theta) || std::abs(std::abs(change) - 0.5) > 1e-6) {
      continue;
    }
    probe.lay(0.0, std::copysign(1.0, change) * wanted);
    if (std::abs(std::remainder(probe.row(j).theta - frames.nominal(j).theta, two_pi)) < same) {
      turn = std::copysign(1.0, change) * wanted;
      turned_row = j;
    }
  }
  frames.lay(0.0, turn);
  for (std::size_t j = last_row; frames.may_slide() && j >= 1 && slid_row == 0; --j) {
    // d of a row that feels the slide is affine in it.
    probe.lay(1.0, turn);
    const double slope = probe.row(j).d - frames.row(j).d;
    if (frames.is_free(j, column_d) || std::abs(slope) < 1e-3) {
      continue;
    }
    const double wanted = (frames.nominal(j).d - frames.row(j).d) / slope;
    probe.lay(wanted, turn);
    if (std::abs(probe.row(j).d - frames.nominal(j).d) < same * (1.0 + std::abs(wanted))) {
      slide = wanted;
      slid_row = j;
    }
  }
  frames.lay(slide, turn);
  const bool turn_holds =
      turned_row > 0 &&
      std::abs(std::remainder(frames.row(turned_row).theta - frames.nominal(turned_row).theta, two_pi)) < same;
  if (turn_holds) {
    frames.mark_free(turned_row, column_theta);
  }
  if (slid_row > 0) {
    frames.mark_free(slid_row, column_d);
  }
  return frames.conversion();
}

}  // namespace circlepoint
