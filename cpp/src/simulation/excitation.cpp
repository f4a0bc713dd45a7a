#include "circlepoint/simulation/excitation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "circlepoint/core/error.hpp"
#include "circlepoint/core/random.hpp"

namespace circlepoint {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
// A sample this close to a boundary is at it, whatever the sum of durations rounded to.
constexpr double boundary_tolerance = 1e-9;

// A scalar function of time with its derivatives.
struct Jet {
  double value = 0.0;
  double rate = 0.0;
  double acceleration = 0.0;
};

// Minimum-jerk step from 0 to 1 over [0, duration], constant outside.
Jet minimum_jerk(double t, double duration) {
  const double x = t / duration;
  if (x <= 0.0) {
    return {};
  }
  if (x >= 1.0) {
    return {1.0, 0.0, 0.0};
  }
  const double y = x * (1.0 - x);
  return {x * x * x * (10.0 + x * (6.0 * x - 15.0)), 30.0 * y * y / duration,
          60.0 * y * (1.0 - 2.0 * x) / (duration * duration)};
}

Jet product(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2.0 * a.rate * b.rate + a.value * b.acceleration};
}

std::string quoted(double value) { return std::to_string(value); }

void require_positive(double value, const char* name, const char* unit) {
  require(std::isfinite(value) && value > 0.0,
          std::string(name) + " is " + quoted(value) + " " + unit + "; give a positive number");
}

// The motion in continuous time: displacement of one joint, or of all, from where the piece began.
class Timeline {
 public:
  explicit Timeline(Eigen::VectorXd start) : end_position_(std::move(start)) {}

  // `motion(joint, t)` is the displacement at t seconds into the piece; `displacement` the one it ends with.
  using Motion = std::function<Jet(Index joint, double t)>;
  void append(double duration, Motion motion, const Eigen::VectorXd& displacement) {
    pieces_.push_back({duration_, duration, end_position_, std::move(motion)});
    duration_ += duration;
    end_position_ += displacement;
  }

  void dwell(double duration) {
    append(duration, [](Index, double) { return Jet{}; }, Eigen::VectorXd::Zero(joints()));
  }

  void move_by(const Eigen::VectorXd& displacement, double duration) {
    const auto motion = [displacement, duration](Index joint, double t) {
      const Jet step = minimum_jerk(t, duration);
      return Jet{displacement[joint] * step.value, displacement[joint] * step.rate,
                 displacement[joint] * step.acceleration};
    };
    append(duration, motion, displacement);
  }

  [[nodiscard]] Index joints() const { return end_position_.size(); }
  [[nodiscard]] const Eigen::VectorXd& end_position() const { return end_position_; }

  [[nodiscard]] JointTrajectory sample(double sample_rate) const {
    const auto count = static_cast<Index>(std::floor((duration_ + boundary_tolerance) * sample_rate)) + 1;
    JointTrajectory trajectory;
    trajectory.sample_rate = sample_rate;
    trajectory.time.resize(count);
    trajectory.position.resize(count, joints());
    trajectory.velocity.resize(count, joints());
    trajectory.acceleration.resize(count, joints());
    std::size_t current = 0;
    for (Index i = 0; i < count; ++i) {
      const double t = static_cast<double>(i) / sample_rate;
      const std::size_t before = current;
      while (current + 1 < pieces_.size() && t >= pieces_[current + 1].begin - boundary_tolerance) {
        ++current;
      }
      const Piece& piece = pieces_[current];
      const bool at_boundary = current > 0 && current > before && std::abs(t - piece.begin) <= boundary_tolerance;
      const double since = std::max(t - piece.begin, 0.0);
      const double into_piece = since > piece.duration - boundary_tolerance ? piece.duration : since;
      trajectory.time[i] = t;
      for (Index joint = 0; joint < joints(); ++joint) {
        const Jet jet = piece.motion(joint, into_piece);
        trajectory.position(i, joint) = piece.start[joint] + jet.value;
        trajectory.velocity(i, joint) = jet.rate;
        trajectory.acceleration(i, joint) = jet.acceleration;
        if (at_boundary) {
          const Piece& ending = pieces_[current - 1];
          const double other_side = ending.motion(joint, ending.duration).acceleration;
          trajectory.acceleration(i, joint) = 0.5 * (jet.acceleration + other_side);
        }
      }
    }
    return trajectory;
  }

 private:
  struct Piece {
    double begin;
    double duration;
    Eigen::VectorXd start;
    Motion motion;
  };
  std::vector<Piece> pieces_;
  double duration_ = 0.0;
  Eigen::VectorXd end_position_;
};

void require_joint(Index joint, Index joints) {
  require(joint >= 0 && joint < joints,
          "joint index " + std::to_string(joint) + " is outside 0.." + std::to_string(joints - 1));
}

void append(Timeline& timeline, const Dwell& piece) {
  require_positive(piece.duration, "duration of a dwell", "s");
  timeline.dwell(piece.duration);
}

void append(Timeline& timeline, const PointToPointMove& piece) {
  require_positive(piece.duration, "duration of a move", "s");
  require(piece.target.size() == timeline.joints() && piece.target.allFinite(),
          "target of a move has " + std::to_string(piece.target.size()) + " entries for " +
              std::to_string(timeline.joints()) + " joints; give one finite number a joint");
  timeline.move_by(piece.target - timeline.end_position(), piece.duration);
}

void append(Timeline& timeline, const SteppedSweep& piece) {
  require_joint(piece.joint, timeline.joints());
  require(piece.steps >= 2,
          "steps of a stepped sweep is " + std::to_string(piece.steps) + "; give at least 2 positions");
  require(std::isfinite(piece.span) && piece.span != 0.0,
          "span of a stepped sweep is " + quoted(piece.span) + "; give a non-zero range");
  require_positive(piece.dwell, "dwell of a stepped sweep", "s");
  require_positive(piece.move, "move of a stepped sweep", "s");
  require(std::isfinite(piece.return_duration) && piece.return_duration >= 0.0,
          "return_duration of a stepped sweep is " + quoted(piece.return_duration) + " s; give 0 to stay, or a time");
  Eigen::VectorXd step = Eigen::VectorXd::Zero(timeline.joints());
  step[piece.joint] = piece.span / static_cast<double>(piece.steps - 1);
  timeline.dwell(piece.dwell);
  for (Index i = 1; i < piece.steps; ++i) {
    timeline.move_by(step, piece.move);
    timeline.dwell(piece.dwell);
  }
  if (piece.return_duration > 0.0) {
    timeline.move_by(-static_cast<double>(piece.steps - 1) * step, piece.return_duration);
  }
}

void append(Timeline& timeline, const RaisedCosine& piece) {
  require_joint(piece.joint, timeline.joints());
  require(std::isfinite(piece.span) && piece.span != 0.0,
          "span of a raised cosine is " + quoted(piece.span) + "; give a non-zero range");
  require_positive(piece.frequency, "frequency of a raised cosine", "Hz");
  require_positive(piece.duration, "duration of a raised cosine", "s");
  const double cycles = piece.frequency * piece.duration;
  require(std::abs(cycles - std::round(cycles)) < 1e-9 && cycles > 0.5,
          "a raised cosine of " + quoted(piece.frequency) + " Hz for " + quoted(piece.duration) + " s has " +
              quoted(cycles) + " cycles and would not end at rest; choose duration x frequency a whole number");
  const double omega = two_pi * piece.frequency;
  const double half = 0.5 * piece.span;
  const auto motion = [=, moving = piece.joint](Index joint, double t) {
    if (joint != moving) {
      return Jet{};
    }
    const double c = std::cos(omega * t);
    return Jet{half * (1.0 - c), half * omega * std::sin(omega * t), half * omega * omega * c};
  };
  timeline.append(piece.duration, motion, Eigen::VectorXd::Zero(timeline.joints()));
}

void append(Timeline& timeline, const MultiJointMotion& piece) {
  const Index joints = timeline.joints();
  require_positive(piece.duration, "duration of a multi-joint motion", "s");
  require(piece.amplitude.size() == joints && piece.amplitude.allFinite() && (piece.amplitude.array() >= 0.0).all(),
          "amplitude of a multi-joint motion has " + std::to_string(piece.amplitude.size()) + " entries for " +
              std::to_string(joints) + " joints; give one number a joint, zero or more");
  require_positive(piece.frequency_min, "frequency_min of a multi-joint motion", "Hz");
  require(std::isfinite(piece.frequency_max) && piece.frequency_max >= piece.frequency_min,
          "frequency_max of a multi-joint motion is " + quoted(piece.frequency_max) +
              " Hz; give at least frequency_min = " + quoted(piece.frequency_min) + " Hz");
  require(piece.harmonics >= 1, "harmonics of a multi-joint motion is " + std::to_string(piece.harmonics) +
                                    "; give at least 1");
  require(piece.ramp > 0.0 && piece.ramp <= 0.5 * piece.duration,
          "ramp of a multi-joint motion is " + quoted(piece.ramp) +
              " s; give a positive time of at most half the duration of " + quoted(piece.duration) + " s");
  RandomSource random(piece.seed);
  Eigen::MatrixXd omega(joints, piece.harmonics);
  Eigen::MatrixXd phase(joints, piece.harmonics);
  for (Index j = 0; j < joints; ++j) {
    for (Index h = 0; h < piece.harmonics; ++h) {
      omega(j, h) = two_pi * random.uniform(piece.frequency_min, piece.frequency_max);
      phase(j, h) = random.uniform(0.0, two_pi);
    }
  }
  const Eigen::VectorXd amplitude = piece.amplitude / static_cast<double>(piece.harmonics);
  const auto motion = [=, duration = piece.duration, ramp = piece.ramp](Index joint, double t) {
    Jet sum;
    for (Index h = 0; h < omega.cols(); ++h) {
      const double w = omega(joint, h);
      const double s = amplitude[joint] * std::sin(w * t + phase(joint, h));
      sum.value += s;
      sum.rate += amplitude[joint] * w * std::cos(w * t + phase(joint, h));
      sum.acceleration -= w * w * s;
    }
    Jet fade_out = minimum_jerk(duration - t, ramp);
    fade_out.rate = -fade_out.rate;
    return product(sum, product(minimum_jerk(t, ramp), fade_out));
  };
  timeline.append(piece.duration, motion, Eigen::VectorXd::Zero(joints));
}

}  // namespace

JointTrajectory joint_trajectory(const Eigen::Ref<const Eigen::VectorXd>& start, const std::vector<Excitation>& pieces,
                                 double sample_rate, double rest) {
  require(start.size() > 0 && start.allFinite(), "start has " + std::to_string(start.size()) +
                                                     " entries or one that is not finite; give a position a joint");
  require_positive(sample_rate, "sample_rate", "Hz");
  require(!pieces.empty(), "there are no pieces to append; give at least one motion or dwell");
  require(std::isfinite(rest) && rest >= 0.0, "rest is " + quoted(rest) + " s; give zero or a positive time");
  Timeline timeline(start);
  for (const Excitation& piece : pieces) {
    if (rest > 0.0) {
      timeline.dwell(rest);
    }
    std::visit([&timeline](const auto& kind) { append(timeline, kind); }, piece);
  }
  if (rest > 0.0) {
    timeline.dwell(rest);
  }
  return timeline.sample(sample_rate);
}

JointTrajectory static_poses(const Eigen::Ref<const SamplesX>& poses, double sample_rate) {
  require(poses.rows() > 0 && poses.cols() > 0, "there are no poses; give one row a pose, one column a joint");
  require(poses.allFinite(), "poses hold a value that is not finite; give every joint a position in every pose");
  require_positive(sample_rate, "sample_rate", "Hz");
  JointTrajectory trajectory;
  trajectory.sample_rate = sample_rate;
  trajectory.time = Eigen::VectorXd::LinSpaced(poses.rows(), 0.0, static_cast<double>(poses.rows() - 1)) / sample_rate;
  trajectory.position = poses;
  trajectory.velocity = SamplesX::Zero(poses.rows(), poses.cols());
  trajectory.acceleration = SamplesX::Zero(poses.rows(), poses.cols());
  return trajectory;
}

}  // namespace circlepoint
