// Denavit-Hartenberg parameters of an arm given as lines, in both conventions, with what the lines leave free.
#include <cstdio>
#include <numbers>

#include "circlepoint/chain/screws_to_dh.hpp"
#include "circlepoint/core/random.hpp"

namespace cp = circlepoint;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

template <class Conversion>
void show(const char* name, const Conversion& dh, const cp::ScrewChain& arm) {
  std::printf("%-10s      a mm   alpha deg        d mm   theta deg   (* free: a choice, not determined by the axes)\n",
              name);
  for (cp::Index i = 0; i < dh.chain.size(); ++i) {
    const cp::DhRow& row = dh.chain.rows[static_cast<std::size_t>(i)];
    const Eigen::Vector4d values(1e3 * row.a, row.alpha / degree, 1e3 * row.d, row.theta / degree);
    std::printf("joint %d  ", static_cast<int>(i) + 1);
    for (int k = 0; k < 4; ++k) {
      std::printf("%11.4f%c", values[k], dh.free(i, k) ? '*' : ' ');
    }
    std::puts("");
  }
  for (const cp::NearParallel& pair : dh.near_parallel) {
    std::printf("axes %d and %d enclose %.2f mrad: d is far away and ill conditioned\n",
                static_cast<int>(pair.first) + 1, static_cast<int>(pair.first) + 2, 1e3 * pair.angle);
  }
  cp::RandomSource random(1);
  const cp::SamplesX poses = cp::SamplesX::NullaryExpr(1000, arm.size(), [&] { return random.uniform(-3.0, 3.0); });
  const cp::SamplesX difference =
      cp::forward_kinematics_rows(dh.chain, poses) - cp::forward_kinematics_rows(arm, poses);
  std::printf("same poses within 1e-9: %s\n", difference.cwiseAbs().maxCoeff() < 1e-9 ? "True" : "False");
}

}  // namespace

int main() {
  cp::ScrewChain arm;
  arm.axes = {{cp::JointType::revolute, cp::make_line({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0})},
              {cp::JointType::revolute, cp::make_line({0.0, 1.0, 0.02}, {0.05, 0.0, 0.3})},
              {cp::JointType::revolute, cp::make_line({0.0005, 1.0, 0.02}, {0.45, 0.0, 0.32})}};
  arm.reference_configuration = Eigen::Vector3d::Zero();
  arm.home.translation() << 0.8, 0.1, 0.3;
  show("standard", cp::to_standard_dh(arm), arm);
  show("modified", cp::to_modified_dh(arm), arm);
}
