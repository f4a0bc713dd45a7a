#include "arm_kinds.hpp"

#include <gtest/gtest.h>

namespace circlepoint {
namespace {

// A second from `begin`, in which the joints go so far; 60 rows.
MovingStretch stretch_from(double begin, const Eigen::Vector3d& far, Index alone = -1) {
  MovingStretch stretch;
  stretch.joint = alone;
  stretch.time = Eigen::VectorXd::LinSpaced(60, begin, begin + 1.0);
  stretch.position = Eigen::VectorXd::LinSpaced(60, 0.0, 1.0) * far.transpose();
  return stretch;
}

DwellRow rest_at(double time) {
  DwellRow dwell;
  dwell.position = Eigen::Vector3d::Zero();
  dwell.time = time;
  return dwell;
}

TEST(ArmKindsTest, MotionsOfTheSameJointsAreOfOneKindAndShortOnesOfAnother) {
  const Eigen::Vector3d first(1.0, 0.0, 0.0);
  const Eigen::Vector3d both(0.0, 1.0, 1.0);
  ArmRows rows;
  rows.stretches = {stretch_from(0.0, first, 0), stretch_from(2.0, both), stretch_from(4.0, first, 0), stretch_from(6.0, both),
                    stretch_from(8.0, {1.0, 0.01, 1.0})};
  rows.dwells = {rest_at(1.5), rest_at(3.5), rest_at(5.5), rest_at(7.5)};
  name_kinds(rows);
  EXPECT_EQ(rows.stretches[0].noise, 0);
  EXPECT_EQ(rows.stretches[2].noise, 0);
  EXPECT_EQ(rows.stretches[1].noise, 1);
  EXPECT_EQ(rows.stretches[3].noise, 1);
  EXPECT_EQ(rows.stretches[4].noise, 2);  // another pair, of 60 rows
}

// One violent part of a motion must not pass for noise of its own.
TEST(ArmKindsTest, WhatNoRestDividesIsOfOneKind) {
  ArmRows rows;
  rows.stretches = {stretch_from(0.0, {1.0, 1.0, 1.0}), stretch_from(1.1, {1.0, 1.0, 1.0}), stretch_from(2.2, {0.0, 1.0, 0.0}),
                    stretch_from(3.3, {0.0, 1.0, 0.0})};
  rows.dwells = {rest_at(-1.0), rest_at(5.0)};
  name_kinds(rows);
  for (const MovingStretch& stretch : rows.stretches) {
    EXPECT_EQ(stretch.noise, 0);
  }
}

TEST(ArmKindsTest, NoiseOfAJointAtRestIsNoMotion) {
  ArmRows rows;
  rows.stretches = {stretch_from(0.0, {1.0, 1.0, 1e-4}), stretch_from(2.0, {1.0, 1.0, 1e-6})};
  rows.stretches.push_back(stretch_from(4.0, {1.0, 1.0, 1e-6}));
  rows.dwells = {rest_at(1.5), rest_at(3.5)};
  name_kinds(rows);
  EXPECT_EQ(rows.stretches[0].noise, rows.stretches[1].noise);
  EXPECT_EQ(rows.stretches[0].noise, rows.stretches[2].noise);
}

}  // namespace
}  // namespace circlepoint
