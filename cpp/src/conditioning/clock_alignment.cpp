#include "circlepoint/conditioning/clock_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "activity_correlation.hpp"
#include "circlepoint/core/error.hpp"
#include "clock_line.hpp"
#include "delay_profile.hpp"
#include "motion_stretches.hpp"
#include "uniform_stream.hpp"

namespace circlepoint {
namespace {

using namespace detail;

constexpr double enough_rate = 200.0;   // Hz, for delays measured on signals below the cut-off
constexpr double first_range = 0.4;     // s, how far the correlation of activities may be off
constexpr double largest_std = 0.03;    // s, delays known worse than this are not used
constexpr double least_path_std = 0.005;   // s, of a delay from a motion along a path: its model is approximate
constexpr double least_window_std = 0.01;  // s, of a delay from the correlation of activities alone
constexpr double lever = 1.0;              // m, of joints that yield
constexpr double least_correlation = 0.3;  // of the activities over the whole overlap

constexpr const char* what_to_record =
    "record a motion of one joint alone (a few seconds, 0.5 rad or more, the others at rest) at the start of the log "
    "and another at its end, with both loggers running";

struct Measured {
  const MotionModel* model = nullptr;
  DelayProfile::Estimate estimate;
  ClockPoint point;
};

class Alignment {
 public:
  // `encoder_step`: rad or m. Joints may yield by so much unseen; gravity's turn and the acceleration at a lever of a
  // metre are then an error in phase with the motion, which the residual alone does not show.
  Alignment(const UniformStream& joints, const UniformStream& sensor, double encoder_step,
      const ClockAlignmentOptions& options)
      : joints_(joints), sensor_(sensor), options_(options), encoder_step_(encoder_step), margin_(4.0
          * gaussian_sigma(options.cutoff)),
        smooth_sensor_(smooth(sensor, sensor.values, gaussian_sigma(options.cutoff), 0)) {}

  // The clock under which all motions together leave the least residual, around `start`: a search in two dimensions,
  // because one motion alone may fit better at a wrong delay.
  RelativeClock consensus(const std::vector<MotionModel>& models, const RelativeClock& start) const {
    constexpr double step = 0.01;
    constexpr double most = 50.0;  // what one motion may say
    struct Profile {
      double centre = 0.0;
      std::vector<double> loss;
    };
    std::vector<Profile> profiles;
    const auto half = static_cast<Index>(std::lround(first_range / step));
    for (const MotionModel& model : models) {
      const auto profile = DelayProfile::make(model, joints_, sensor_, smooth_sensor_, start, first_range, margin_,
                                              model.joint < 0 ? model.regressors.cols() : own_regressors);
      if (!profile) {
        continue;
      }
      Profile loss{0.5 * (joints_.time(model.moving.begin) + joints_.time(model.moving.end - 1)), {}};
      for (Index k = -half; k <= half; ++k) {
        loss.loss.push_back(profile->cost(step * static_cast<double>(k)));
      }
      const double least = *std::min_element(loss.loss.begin(), loss.loss.end());
      const double samples = profile->effective_samples(options_.cutoff);
      for (double& value : loss.loss) {
        value = least > 0.0 ? std::min(most, 0.5 * samples * std::log(value / least)) : 0.0;
      }
      profiles.push_back(std::move(loss));
    }
    if (profiles.empty()) {
      return start;
    }
    const auto [first, last] = std::minmax_element(profiles.begin(), profiles.end(),
                                                   [](const Profile& a,
                                                       const Profile& b) { return a.centre < b.centre; });
    const double middle = 0.5 * (first->centre + last->centre);
    const double reach = std::max(0.5 * (last->centre - first->centre), 1.0);
    double least = std::numeric_limits<double>::infinity();
    RelativeClock best = start;
    for (Index i = -half; i <= half; ++i) {
      for (Index k = -half; k <= half; ++k) {
        const double level = step * static_cast<double>(i), slope = step * static_cast<double>(k) / reach;
        if (std::abs(start.rate * (1.0 + slope) - 1.0) > options_.max_rate_deviation) {
          continue;
        }
        double total = 0.0;
        for (const Profile& profile : profiles) {
          const double x = (level + slope * (profile.centre - middle)) / step + static_cast<double>(half);
          const auto cell = static_cast<Index>(std::floor(x));
          if (cell < 0 || cell >= 2 * half) {
            total += most;
          } else {
            const double t = x - static_cast<double>(cell);
            total += (1.0 - t) * profile.loss[static_cast<std::size_t>(cell)] + t
                * profile.loss[static_cast<std::size_t>(cell + 1)];
          }
        }
        if (total < least) {
          least = total;
          best.rate = start.rate * (1.0 + slope);
          best.shift = start.sensor(middle + level) - best.rate * middle;
        }
      }
    }
    return best;
  }

  // Delays of all motions under a clock, each within +- range of it: searched there, or followed from the clock's own.
  std::vector<Measured> measure(const std::vector<MotionModel>& models, const RelativeClock& clock, double range,
      bool search) const {
    std::vector<Measured> measured;
    for (const MotionModel& model : models) {
      const auto profile = DelayProfile::make(model, joints_, sensor_, smooth_sensor_, clock, range, margin_,
          model.regressors.cols());
      if (!profile) {
        continue;
      }
      const double unseen = encoder_step_ / std::sqrt(12.0) * (standard_gravity + lever * model.squared_frequency);
      const DelayProfile::Estimate estimate = profile->minimise(search ? 10 : 0, unseen);
      const double least_std = model.joint < 0 ? least_path_std : 0.0;
      if (estimate.interior && std::isfinite(estimate.std) && estimate.std > 0.0 && estimate.std < largest_std) {
        measured.push_back({&model, estimate,
                            {estimate.centre - estimate.delay, clock.sensor(estimate.centre), std::hypot(least_std,
                                estimate.std * clock.rate), 0.0, 1.0}});
      }
    }
    return measured;
  }

  // Delays from the correlation of activities alone, in windows of joint time.
  std::vector<ClockPoint> correlation_windows(const Activity& joints, const Activity& sensor,
      const RelativeClock& clock) const {
    const double end = std::min(joints_.duration(), clock.joint(sensor_.duration()));
    const double begin = std::max(0.0, clock.joint(0.0));
    const double length = std::clamp((end - begin) / 8.0, 3.0, 15.0);
    std::vector<ClockPoint> points;
    for (double t = begin; t + length <= end + 1e-9; t += length) {
      const WindowDelay found = window_delay(joints, sensor, clock, t, t + length, first_range);
      if (found.correlation > 0.5) {
        const double middle = t + 0.5 * length;
        const double std = found.width * std::sqrt((1.0 - found.correlation * found.correlation) / (2.0 * length));
        points.push_back({middle, clock.sensor(middle + found.delay), std::max(least_window_std, std), 0.0, 1.0});
      }
    }
    return points;
  }

 private:
  const UniformStream& joints_;
  const UniformStream& sensor_;
  const ClockAlignmentOptions& options_;
  double encoder_step_;
  double margin_;
  SamplesX smooth_sensor_;
};

std::vector<ClockPoint> points_of(const std::vector<Measured>& measured) {
  std::vector<ClockPoint> points;
  for (const Measured& m : measured) {
    points.push_back(m.point);
  }
  return points;
}

// The largest of the joints' encoder steps: the least change between samples of each joint that moves.
double encoder_step(const Eigen::Ref<const SamplesX>& positions) {
  double largest = 0.0;
  for (Index j = 0; j < positions.cols(); ++j) {
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 1; i < positions.rows(); ++i) {
      const double change = std::abs(positions(i, j) - positions(i - 1, j));
      least = change > 0.0 ? std::min(least, change) : least;
    }
    largest = std::isfinite(least) ? std::max(largest, least) : largest;
  }
  return largest;
}

ClockAlignment absolute(const ClockLine& line, const UniformStream& joints, const UniformStream& sensor) {
  ClockAlignment result;
  result.rate = line.clock.rate;
  result.offset = sensor.start + line.clock.shift - line.clock.rate * joints.start;
  result.reference_time = joints.start + line.centre;
  result.reference_std = line.level_std;
  result.rate_std = line.rate_std;
  const double level = line.level_std * line.level_std, rate = line.rate_std * line.rate_std;
  const double arm = result.reference_time;
  result.covariance << level + arm * arm * rate, -arm * rate, -arm * rate, rate;
  result.offset_std = std::sqrt(result.covariance(0, 0));
  result.rate_determined = line.rate_determined;
  result.residual = line.residual;
  return result;
}

void describe(ClockAlignment& result, const char* kind, const ClockLine& line) {
  std::ostringstream text;
  text.precision(3);
  text << "clocks aligned on " << result.tests.size() << " " << kind << "; they scatter by " << 1e3 * line.residual <<
      " ms";
  result.notes.push_back(text.str());
  const auto outliers = std::count_if(result.tests.begin(), result.tests.end(),
      [](const DelayTest& t) { return t.weight < 0.1; });
  if (outliers > 0) {
    result.notes.push_back(std::to_string(outliers) + " of them contradict the others and were not used");
  }
  if (!result.rate_determined) {
    result.notes.push_back(std::string("the rate between the clocks is hardly determined: ") + what_to_record);
  }
}

void validate(const Eigen::Ref<const Eigen::VectorXd>& joint_time, const Eigen::Ref<const SamplesX>& joint_positions,
              const Eigen::Ref<const Eigen::VectorXd>& sensor_time, const Eigen::Ref<const Samples3>& specific_force,
              const ClockAlignmentOptions& options) {
  require(joint_positions.cols() > 0, "there are no joint positions");
  require(joint_positions.rows() == joint_time.size(), "joint positions have "
      + std::to_string(joint_positions.rows()) +
                                                           " rows, joint time has "
                                                               + std::to_string(joint_time.size()));
  require(specific_force.rows() == sensor_time.size(), "specific force has " + std::to_string(specific_force.rows()) +
                                                           " rows, sensor time has "
                                                               + std::to_string(sensor_time.size()));
  require(joint_positions.allFinite(), "joint positions must be finite: remove or repair rows that are not");
  require(specific_force.allFinite(), "specific force must be finite: remove or repair rows that are not");
  require(options.cutoff > 0.0 && options.max_rate_deviation > 0.0 && options.max_rate_deviation < 0.5,
          "cutoff must be positive and max_rate_deviation between 0 and 0.5, got " + std::to_string(options.cutoff)
              + " Hz, " +
              std::to_string(options.max_rate_deviation));
}

}  // namespace

ClockAlignment align_clocks(const Eigen::Ref<const Eigen::VectorXd>& joint_time,
                            const Eigen::Ref<const SamplesX>& joint_positions,
                            const Eigen::Ref<const Eigen::VectorXd>& sensor_time,
                            const Eigen::Ref<const Samples3>& specific_force, const ClockAlignmentOptions& options) {
  validate(joint_time, joint_positions, sensor_time, specific_force, options);
  const UniformStream joints = make_stream(joint_time, joint_positions, enough_rate);
  const UniformStream sensor = make_stream(sensor_time, specific_force, enough_rate);
  const Activity moving = joint_activity(joints);
  const Activity felt = sensor_activity(sensor);
  const CoarseAlignment coarse = correlate(moving, felt, options.max_rate_deviation);
  if (!(coarse.correlation > least_correlation)) {
    std::ostringstream text;
    text.precision(2);
    text << "no motion of the joints is recognised in the specific force (correlation " << coarse.correlation <<
        " at best): "
         << what_to_record;
    throw NotIdentifiable(text.str());
  }
  const Alignment alignment(joints, sensor, encoder_step(joint_positions), options);

  for (const bool single : {true, false}) {
    const std::vector<MotionModel> models = single ? single_joint_stretches(joints, options) : path_stretches(joints,
        options);
    if (models.empty()) {
      continue;
    }
    RelativeClock clock = alignment.consensus(models, coarse.clock);
    std::vector<Measured> measured;
    std::vector<ClockPoint> points;
    ClockLine line;
    bool converged = false;
    for (int pass = 0; pass < 12 && !converged; ++pass) {
      constexpr std::array<double, 3> ranges{0.15, 0.08, 0.06};  // s
      measured = alignment.measure(models, clock, ranges[static_cast<std::size_t>(std::min(pass, 2))], pass < 2);
      if (measured.empty()) {
        break;
      }
      points = points_of(measured);
      line = fit_clock_line(points, options.max_rate_deviation);
      const double change = std::max(std::abs(line.clock.sensor(0.0) - clock.sensor(0.0)),
                                     std::abs(line.clock.sensor(joints.duration()) - clock.sensor(joints.duration())));
      converged = pass >= 2 && change < 1e-6;
      clock = line.clock;
    }
    if (measured.empty()) {
      continue;
    }
    ClockAlignment result = absolute(line, joints, sensor);
    result.single_joint = single;
    result.converged = converged;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const MotionModel& model = *measured[i].model;
      result.tests.push_back({model.joint, joints.start + joints.time(model.moving.begin),
                              joints.start + joints.time(model.moving.end - 1), joints.start + points[i].joint,
                              sensor.start + points[i].sensor, points[i].std, points[i].residual, points[i].weight,
                              measured[i].estimate.model_residual});
    }
    describe(result, single ? "single-joint motions"
        : "motions of several joints along one path, for want of single-joint ones",
             line);
    return result;
  }

  std::vector<ClockPoint> points = alignment.correlation_windows(moving, felt, coarse.clock);
  if (points.empty()) {
    throw NotIdentifiable(std::string("no motion shows the delay between the clocks: ") + what_to_record);
  }
  const ClockLine line = fit_clock_line(points, options.max_rate_deviation);
  ClockAlignment result = absolute(line, joints, sensor);
  result.converged = true;
  for (const ClockPoint& p : points) {
    result.tests.push_back({-1, joints.start + p.joint, joints.start + p.joint, joints.start + p.joint, sensor.start
        + p.sensor,
                            p.std, p.residual, p.weight, 0.0});
  }
  describe(result, "windows by the correlation of activities, for want of single-joint motions", line);
  return result;
}

}  // namespace circlepoint
