#include "arm_home.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace circlepoint {
namespace {

constexpr Index functions = 11;
constexpr double most_yield = 50.0;        // counts, of a joint that only yields
constexpr double weakest_function = 1e-3;  // of the basis, relative
constexpr double lead_in = 0.6;            // s of motion before a stretch that its lagging deflections may still show

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
  const Eigen::ArrayXd tolerance = (1.5 * resolution.array()).max(1e-4);
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
    const Index lead = std::min(mine.begin - span.samples.begin, static_cast<Index>(lead_in * rows.sample_rate));
    const Index begin = mine.begin - lead - span.samples.begin;
    const Index size = lead + mine.size();
    const SmoothJoints& joints = span.joints[smoothing_for_yields(span, mine, moving_joints(span, mine, motion.joint, resolution))];
    const Eigen::VectorXd velocity = joints.derivative(1, motion.joint, begin, size);
    const Eigen::VectorXd acceleration = joints.derivative(2, motion.joint, begin, size);
    motion.phi.push_back(raw_functions(joints.position.col(motion.joint).segment(begin, size).array(), velocity.array(),
                                       acceleration.array())
                             .rowwise() -
                         motion.home);
    motion.lead.push_back(lead);
    const auto inside = motion.phi.back().bottomRows(mine.size());
    scatter += inside.transpose() * inside;
    count += static_cast<double>(mine.size());
  }
  const Eigen::VectorXd scale = (scatter.diagonal() / count).cwiseMax(1e-300).cwiseSqrt();
  const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * (scatter / count) * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const double limit = weakest_function * weakest_function * solver.eigenvalues()[functions - 1];
  const auto kept = (solver.eigenvalues().array() > limit).count();
  motion.combination = scale.cwiseInverse().asDiagonal() * solver.eigenvectors().rightCols(kept) *
                       solver.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  motion.resolve = solver.eigenvalues().tail(kept).cwiseSqrt().asDiagonal() * solver.eigenvectors().rightCols(kept).transpose() *
                   scale.asDiagonal();
}

// How many joints at rest change their count in a test.
Index yielding_joints(const TestMotion& motion, const ArmRows& rows, const Recording& recording, const Eigen::VectorXd& resolution) {
  Eigen::Array<bool, Eigen::Dynamic, 1> changes = Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(resolution.size(), false);
  for (const std::size_t s : motion.stretches) {
    const MovingStretch& stretch = rows.stretches[s];
    const auto encoders =
        recording.joint_positions.middleRows(first_sample(stretch), end_sample(stretch) - first_sample(stretch));
    const Eigen::ArrayXd range = (encoders.colwise().maxCoeff() - encoders.colwise().minCoeff()).transpose();
    changes = changes || (resolution.array() > 0.0 && range > 0.5 * resolution.array());
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
  Eigen::ArrayXd log_likelihood(steps);
  Eigen::ArrayXd square(steps);
  for (Index i = 0; i < steps; ++i) {
    const double mean = smallest_mean * std::pow(largest_mean / smallest_mean, (static_cast<double>(i) + 0.5) / static_cast<double>(steps));
    const Eigen::ArrayXd quiet = (-range / mean).exp() / mean * (1.0 - range) / static_cast<double>(steps);
    const double chance = std::clamp(quiet.sum(), 1e-12, 1.0 - 1e-12);
    log_likelihood[i] = static_cast<double>(changed) * std::log1p(-chance) + static_cast<double>(pairs - changed) * std::log(chance);
    square[i] = (quiet * range.square()).sum() / chance;
  }
  const Eigen::ArrayXd likelihood = (log_likelihood - log_likelihood.maxCoeff()).exp();
  return rms_of_range * std::sqrt((likelihood * square).sum() / likelihood.sum());
}

// Home by its dwells' counts: the one seen most.
double home_count(const HomeGroup& group, const ArmRows& rows, Index joint) {
  std::vector<double> at_home;
  for (const std::size_t i : group.dwells) {
    at_home.push_back(rows.dwells[i].position[joint]);
  }
  std::nth_element(at_home.begin(), at_home.begin() + static_cast<Index>(at_home.size() / 2), at_home.end());
  return at_home[at_home.size() / 2];
}

}  // namespace

HomeTests find_home_tests(const ArmRows& rows, const Recording& recording, const Segmentation& segmentation,
                          const std::vector<SmoothSpan>& spans, const Eigen::VectorXd& resolution) {
  HomeTests tests;
  tests.groups = find_groups(rows, segmentation, resolution);
  Index pairs = 0;
  std::vector<TestMotion*> unmoved;  // in which no joint at rest changes its count
  for (HomeGroup& group : tests.groups) {
    for (Index joint = 0; joint < recording.joints(); ++joint) {
      if (resolution[joint] > 0.0) {
        group.home[joint] = home_count(group, rows, joint);
      }
    }
    for (TestMotion& motion : group.tests) {
      prepare(motion, group.home, rows, spans, resolution);
      const Index here = yielding_joints(motion, rows, recording, resolution);
      if (here == 0) {
        unmoved.push_back(&motion);
      }
      tests.changed += here;
      pairs += (resolution.array() > 0.0).count() - (resolution[motion.joint] > 0.0 ? 1 : 0);
    }
  }
  const double quiet = quiet_std(tests.changed, pairs);
  for (TestMotion* motion : unmoved) {
    motion->quiet = quiet;
  }
  return tests;
}

Eigen::MatrixXd dwell_functions(const TestMotion& motion, const DwellRow& dwell) {
  const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(1);
  return (raw_functions(dwell.position.segment(motion.joint, 1).array(), zero, zero) - motion.home) * motion.combination;
}

Eigen::MatrixXd functions_of(const TestMotion& motion, std::size_t stretch, double lag, double rate) {
  const Eigen::MatrixXd& phi = motion.phi[stretch];
  const Index lead = motion.lead[stretch];
  if (lag <= 0.0) {
    return phi.bottomRows(phi.rows() - lead) * motion.combination;
  }
  Eigen::MatrixXd combined = phi * motion.combination;
  const double decay = std::exp(-1.0 / (lag * rate));
  const double mean = (1.0 - decay) * lag * rate;  // of the decay, between two samples
  Eigen::RowVectorXd former = combined.row(0);
  for (Index k = 1; k < combined.rows(); ++k) {
    const Eigen::RowVectorXd now = combined.row(k);
    combined.row(k) = decay * combined.row(k - 1) + (1.0 - mean) * now + (mean - decay) * former;
    former = now;
  }
  return combined.bottomRows(phi.rows() - lead);
}

RestingFit GroupReader::read(Index joint, double count, double lag, bool apart) const {
  std::vector<CountRows> counts(group_.tests.size());
  std::vector<std::size_t> holding;
  for (std::size_t t = 0; t < group_.tests.size(); ++t) {
    const TestMotion& motion = group_.tests[t];
    if (motion.joint == joint) {
      continue;
    }
    const auto encoder = [&](Index begin, Index size) {
      return Eigen::VectorXd((recording_.joint_positions.col(joint).segment(begin, size).array() - group_.home[joint]) / count);
    };
    double reach = 0.0;
    for (std::size_t s = 0; s < motion.stretches.size(); ++s) {
      const MovingStretch& stretch = rows_.stretches[motion.stretches[s]];
      const Eigen::VectorXd here = encoder(first_sample(stretch), end_sample(stretch) - first_sample(stretch));
      reach = std::max(reach, here.cwiseAbs().maxCoeff());
      read_counts(counts[t], functions_of(motion, s, lag, rows_.sample_rate), here, 5);
    }
    for (const std::size_t i : motion.dwells) {
      const IndexRange& samples = segmentation_.dwells[i].samples;
      const Eigen::MatrixXd phi = dwell_functions(motion, rows_.dwells[i]).replicate(samples.size(), 1);
      read_counts(counts[t], phi, encoder(samples.begin, samples.size()), samples.size());
    }
    count_repeats(counts[t]);
    counts[t].small = !apart;
    if (motion.quiet > 0.0) {
      counts[t].within_std = motion.quiet;
    }
    if (reach < most_yield) {
      holding.push_back(t);
    }
  }
  RestingFit resting;
  resting.joint = joint;
  resting.fit = fit_and_judge(counts, holding);
  for (const std::size_t t : resting.fit.tests) {
    resting.moving.push_back(group_.tests[t].joint);
    resting.resolve.push_back(group_.tests[t].resolve);
  }
  return resting;
}

}  // namespace circlepoint
