#include "arm_yield.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "arm_counts.hpp"
#include "circlepoint/conditioning/differentiate.hpp"

namespace circlepoint {
namespace {

constexpr Index functions = 11;
constexpr double most_yield = 50.0;        // counts, of a joint that only yields
constexpr double weakest_function = 1e-3;  // of the basis, relative
constexpr double negligible = 0.005;       // counts rms: not worth a parameter

// phi of joint positions, velocities and accelerations, a row each.
Eigen::MatrixXd raw_functions(const Eigen::ArrayXd& position, const Eigen::ArrayXd& velocity, const Eigen::ArrayXd& acceleration) {
  Eigen::MatrixXd phi(position.size(), functions);
  const Eigen::ArrayXd cosine = position.cos();
  const Eigen::ArrayXd sine = position.sin();
  Index column = 0;
  const auto put = [&](const Eigen::ArrayXd& values) { phi.col(column++) = values; };
  put(cosine);
  put(sine);
  for (const Eigen::ArrayXd& factor : {acceleration, Eigen::ArrayXd(velocity.square()), velocity}) {
    put(factor);
    put(factor * cosine);
    put(factor * sine);
  }
  return phi;
}

// One test's motion of its joint.
struct TestMotion {
  Index test = 0;
  Index joint = 0;
  std::vector<std::size_t> stretches;
  std::vector<std::size_t> dwells;   // its own, home excepted
  Eigen::RowVectorXd home;           // (functions) at home
  Eigen::MatrixXd combination;       // (functions, r): of unit rms and uncorrelated over the test
  std::vector<Eigen::MatrixXd> phi;  // of every stretch, at each of its samples: raw, relative to home
};

// All tests that share one home position.
struct HomeGroup {
  Eigen::VectorXd home;  // (n)
  std::vector<std::size_t> dwells;
  std::vector<TestMotion> tests;
};

const SmoothSpan* span_of(const std::vector<SmoothSpan>& spans, Index sample) {
  const auto found = std::find_if(spans.begin(), spans.end(), [&](const SmoothSpan& span) {
    return span.samples.begin <= sample && sample < span.samples.end;
  });
  return found == spans.end() ? nullptr : &*found;
}

Index first_sample(const MovingStretch& stretch) { return stretch.sample[0]; }
Index end_sample(const MovingStretch& stretch) { return stretch.sample[stretch.rows() - 1] + 1; }

// Dwells that several tests share are home; those at one place belong together.
std::vector<HomeGroup> find_groups(const ArmRows& rows, const Segmentation& segmentation, const Eigen::VectorXd& resolution) {
  std::vector<int> shared(rows.dwells.size(), 0);
  for (const JointTest& test : segmentation.tests) {
    for (const Index dwell : test.dwells) {
      ++shared[static_cast<std::size_t>(dwell)];
    }
  }
  const Eigen::ArrayXd tolerance = 1.5 * resolution.array();
  std::vector<HomeGroup> groups;
  std::vector<Index> group_of(rows.dwells.size(), -1);
  for (std::size_t i = 0; i < rows.dwells.size(); ++i) {
    if (shared[i] < 2) {
      continue;
    }
    const Eigen::VectorXd& here = rows.dwells[i].position;
    auto same = std::find_if(groups.begin(), groups.end(), [&](const HomeGroup& group) {
      return ((group.home - here).array().abs() < tolerance).all();
    });
    if (same == groups.end()) {
      groups.push_back({here, {}, {}});
      same = std::prev(groups.end());
    }
    same->dwells.push_back(i);
    group_of[i] = same - groups.begin();
  }
  for (std::size_t t = 0; t < segmentation.tests.size(); ++t) {
    TestMotion motion;
    motion.test = static_cast<Index>(t);
    motion.joint = segmentation.tests[t].joint;
    std::vector<Index> votes(groups.size(), 0);
    for (const Index dwell : segmentation.tests[t].dwells) {
      const auto at = static_cast<std::size_t>(dwell);
      if (shared[at] == 1) {
        motion.dwells.push_back(at);
      } else if (group_of[at] >= 0) {
        ++votes[static_cast<std::size_t>(group_of[at])];
      }
    }
    for (std::size_t i = 0; i < rows.stretches.size(); ++i) {
      if (rows.stretches[i].test == motion.test) {
        motion.stretches.push_back(i);
      }
    }
    const auto most = std::max_element(votes.begin(), votes.end());
    if (motion.stretches.empty() || most == votes.end() || *most == 0) {
      continue;
    }
    groups[static_cast<std::size_t>(most - votes.begin())].tests.push_back(std::move(motion));
  }
  return groups;
}

Eigen::MatrixXd dwell_functions(const TestMotion& motion, const DwellRow& dwell) {
  const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(1);
  return (raw_functions(dwell.position.segment(motion.joint, 1).array(), zero, zero) - motion.home) * motion.combination;
}

void prepare(TestMotion& motion, const Eigen::VectorXd& home, const ArmRows& rows, const std::vector<SmoothSpan>& spans,
             const Eigen::VectorXd& resolution) {
  const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(1);
  motion.home = raw_functions(home.segment(motion.joint, 1).array(), zero, zero);
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(functions, functions);
  double count = 0.0;
  for (const std::size_t i : motion.stretches) {
    const MovingStretch& stretch = rows.stretches[i];
    const SmoothSpan& span = *span_of(spans, first_sample(stretch));
    const IndexRange mine{first_sample(stretch), end_sample(stretch)};
    const Index begin = mine.begin - span.samples.begin;
    const Index size = mine.size();
    const SmoothJoints& joints = span.joints[smoothing_for_motion(span, mine, resolution)];
    const Eigen::VectorXd velocity = joints.derivative(1, motion.joint, begin, size);
    const Eigen::VectorXd acceleration = joints.derivative(2, motion.joint, begin, size);
    motion.phi.push_back(raw_functions(joints.position.col(motion.joint).segment(begin, size).array(), velocity.array(),
                                       acceleration.array())
                             .rowwise() -
                         motion.home);
    scatter += motion.phi.back().transpose() * motion.phi.back();
    count += static_cast<double>(size);
  }
  const Eigen::VectorXd scale = (scatter.diagonal() / count).cwiseMax(1e-300).cwiseSqrt();
  const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * (scatter / count) * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const double limit = weakest_function * weakest_function * solver.eigenvalues()[functions - 1];
  const auto kept = (solver.eigenvalues().array() > limit).count();
  motion.combination = scale.cwiseInverse().asDiagonal() * solver.eigenvectors().rightCols(kept) *
                       solver.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

// Puts one joint's fitted motion under the rows.
void apply(ArmRows& rows, const HomeGroup& group, const JointFit& fit, Index joint, double count, double rate) {
  // Directions of every test's c that still make a difference, and h.
  std::vector<Eigen::MatrixXd> directions;
  Index parameters = 1;
  for (std::size_t k = 0; k < fit.tests.size(); ++k) {
    const Index size = group.tests[fit.tests[k]].combination.cols();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(fit.covariance.block(fit.first[k], fit.first[k], size, size));
    const auto kept = (solver.eigenvalues().array() > negligible * negligible).count();
    directions.emplace_back(solver.eigenvectors().rightCols(kept));
    parameters += kept;
  }
  Eigen::MatrixXd reduce = Eigen::MatrixXd::Zero(parameters, fit.estimate.size());
  reduce(0, 0) = 1.0;
  std::vector<Index> first;
  Index at = 1;
  for (std::size_t k = 0; k < fit.tests.size(); ++k) {
    first.push_back(at);
    reduce.block(at, fit.first[k], directions[k].cols(), directions[k].rows()) = directions[k].transpose();
    at += directions[k].cols();
  }
  const Index offset = add_parameters(rows, count * count * reduce * fit.covariance * reduce.transpose());
  const auto slot = static_cast<std::size_t>(joint);
  const double home = group.home[joint] + count * fit.estimate[0];
  const auto take = [&](DwellRow& dwell, double position) {
    dwell.position[joint] = position;
    dwell.position_variance[joint] = 0.0;
    dwell.follows[slot] = true;
    add_term(dwell, {joint, offset}, 1.0);
  };
  for (const std::size_t i : group.dwells) {
    take(rows.dwells[i], home);
  }
  for (std::size_t k = 0; k < fit.tests.size(); ++k) {
    const TestMotion& motion = group.tests[fit.tests[k]];
    const Eigen::VectorXd c = fit.estimate.segment(fit.first[k], motion.combination.cols());
    for (const std::size_t i : motion.dwells) {
      DwellRow& dwell = rows.dwells[i];
      const Eigen::MatrixXd phi = dwell_functions(motion, dwell);
      take(dwell, home + count * (phi * c)[0]);
      const Eigen::MatrixXd shape = phi * directions[k];
      for (Index d = 0; d < shape.cols(); ++d) {
        add_term(dwell, {joint, offset + first[k] + d}, shape(0, d));
      }
    }
    for (std::size_t s = 0; s < motion.stretches.size(); ++s) {
      MovingStretch& stretch = rows.stretches[motion.stretches[s]];
      const Eigen::ArrayXi index = stretch.sample - stretch.sample[0];
      const SamplesX phi = motion.phi[s] * motion.combination;
      const Eigen::MatrixXd position = phi(index, Eigen::all);
      const Eigen::MatrixXd velocity = savgol_filter(phi, 7, 6, 1, 1.0 / rate)(index, Eigen::all);
      const Eigen::MatrixXd acceleration = savgol_filter(phi, 7, 6, 2, 1.0 / rate)(index, Eigen::all);
      stretch.position.col(joint) = (home + count * (position * c).array()).matrix();
      stretch.velocity.col(joint) = count * velocity * c;
      stretch.acceleration.col(joint) = count * acceleration * c;
      stretch.jerk.col(joint).setZero();
      stretch.follows[slot] = true;
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(stretch.rows());
      add_term(stretch, {joint, offset}, Eigen::VectorXd::Ones(stretch.rows()), zero, zero);
      for (Index d = 0; d < directions[k].cols(); ++d) {
        add_term(stretch, {joint, offset + first[k] + d}, position * directions[k].col(d), velocity * directions[k].col(d),
                 acceleration * directions[k].col(d));
      }
    }
  }
}

// How many joints at rest change their count in a test.
Index yielding_joints(const TestMotion& motion, const ArmRows& rows, const Recording& recording, const Eigen::VectorXd& resolution) {
  Eigen::Array<bool, Eigen::Dynamic, 1> changes = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(resolution.size(), false);
  for (const std::size_t s : motion.stretches) {
    const MovingStretch& stretch = rows.stretches[s];
    const auto encoders =
        recording.joint_positions.middleRows(first_sample(stretch), end_sample(stretch) - first_sample(stretch));
    const Eigen::ArrayXd range = (encoders.colwise().maxCoeff() - encoders.colwise().minCoeff()).transpose();
    changes = changes || range > 0.5 * resolution.array();
  }
  changes[motion.joint] = false;
  return changes.count();
}

// Counts rms that a joint at rest deflects by in a test in which none changes its count. A range of R < 1 counts shows no change
// with the chance 1 - R. Ranges are taken to be exponentially distributed; their mean, of any order of magnitude beforehand, follows
// from how many of all pairs of a test and a joint at rest show a change.
double quiet_std(Index changed, Index pairs) {
  constexpr double smallest_mean = 0.01;  // counts
  constexpr double largest_mean = 3.0;
  constexpr double rms_of_range = 0.4;    // of a deflection that swings over the range
  constexpr Index steps = 200;
  const Eigen::ArrayXd range = Eigen::ArrayXd::LinSpaced(steps, 0.5, static_cast<double>(steps) - 0.5) / static_cast<double>(steps);
  double weight = 0.0;
  double squares = 0.0;
  for (Index i = 0; i < steps; ++i) {
    const double mean = smallest_mean * std::pow(largest_mean / smallest_mean, (static_cast<double>(i) + 0.5) / static_cast<double>(steps));
    const Eigen::ArrayXd quiet = (-range / mean).exp() / mean * (1.0 - range) / static_cast<double>(steps);
    const double chance = std::clamp(quiet.sum(), 1e-12, 1.0 - 1e-12);
    const double log_likelihood = static_cast<double>(changed) * std::log1p(-chance) + static_cast<double>(pairs - changed) * std::log(chance);
    const double likelihood = std::exp(log_likelihood);
    weight += likelihood;
    squares += likelihood * (quiet * range.square()).sum() / chance;
  }
  return rms_of_range * std::sqrt(squares / weight);
}

}  // namespace

void follow_yields(ArmRows& rows, const Recording& recording, const Segmentation& segmentation,
                   const std::vector<SmoothSpan>& spans, const Eigen::VectorXd& resolution) {
  std::vector<HomeGroup> groups = find_groups(rows, segmentation, resolution);
  std::vector<std::vector<bool>> yields(groups.size());  // a flag a test
  Index pairs = 0;
  Index changed = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (TestMotion& motion : groups[g].tests) {
      prepare(motion, groups[g].home, rows, spans, resolution);
      const Index here = yielding_joints(motion, rows, recording, resolution);
      yields[g].push_back(here > 0);
      changed += here;
      pairs += recording.joints() - 1;
    }
  }
  rows.yields = changed > 0;
  const double quiet = quiet_std(changed, pairs);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    HomeGroup& group = groups[g];
    for (Index joint = 0; joint < recording.joints(); ++joint) {
      const double count = resolution[joint];
      if (count <= 0.0) {
        continue;
      }
      // Home by its dwells' counts: the one seen most.
      std::vector<double> at_home;
      for (const std::size_t i : group.dwells) {
        at_home.push_back(rows.dwells[i].position[joint]);
      }
      std::nth_element(at_home.begin(), at_home.begin() + static_cast<Index>(at_home.size() / 2), at_home.end());
      group.home[joint] = at_home[at_home.size() / 2];
      std::vector<CountRows> counts(group.tests.size());
      std::vector<std::size_t> holding;
      for (std::size_t t = 0; t < group.tests.size(); ++t) {
        const TestMotion& motion = group.tests[t];
        if (motion.joint == joint) {
          continue;
        }
        const auto encoder = [&](Index begin, Index size) {
          return Eigen::VectorXd((recording.joint_positions.col(joint).segment(begin, size).array() - group.home[joint]) / count);
        };
        double reach = 0.0;
        for (std::size_t s = 0; s < motion.stretches.size(); ++s) {
          const MovingStretch& stretch = rows.stretches[motion.stretches[s]];
          const Eigen::VectorXd here = encoder(first_sample(stretch), end_sample(stretch) - first_sample(stretch));
          reach = std::max(reach, here.cwiseAbs().maxCoeff());
          read_counts(counts[t], motion.phi[s] * motion.combination, here, 5);
        }
        for (const std::size_t i : motion.dwells) {
          const IndexRange& samples = segmentation.dwells[i].samples;
          const Eigen::MatrixXd phi = dwell_functions(motion, rows.dwells[i]).replicate(samples.size(), 1);
          read_counts(counts[t], phi, encoder(samples.begin, samples.size()), samples.size());
        }
        count_repeats(counts[t]);
        if (!yields[g][t]) {
          counts[t].within_std = quiet;
        }
        if (reach < most_yield) {
          holding.push_back(t);
        }
      }
      const JointFit fit = fit_and_judge(counts, holding);
      if (!fit.tests.empty()) {
        apply(rows, group, fit, joint, count, recording.sample_rate);
      }
    }
  }
}

}  // namespace circlepoint
