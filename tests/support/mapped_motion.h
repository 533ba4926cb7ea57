#ifndef ROLLGAIT_TESTS_SUPPORT_MAPPED_MOTION_H_
#define ROLLGAIT_TESTS_SUPPORT_MAPPED_MOTION_H_

#include <gtest/gtest.h>

#include "core/contact/pair_kinematics.h"

namespace rollgait {

// A frame and its motion mapped by Q in space (axial vectors by axial · Q), stretched by `length` and sped up by
// `rate`.
inline FrameMotion Mapped(const FrameMotion& body, const Matrix3& Q, double axial, double length, double rate) {
  FrameMotion mapped;
  mapped.R_WB = Q * body.R_WB * (axial < 0 ? Q.transpose() : Matrix3(Matrix3::Identity()));
  mapped.p_WB = length * (Q * body.p_WB);
  mapped.w_WB = rate * axial * (Q * body.w_WB);
  mapped.v_WB = rate * length * (Q * body.v_WB);
  mapped.alpha_WB = rate * rate * axial * (Q * body.alpha_WB);
  mapped.a_WB = rate * rate * length * (Q * body.a_WB);
  return mapped;
}

// Everything mapped by Q in space, stretched by `length` and sped up by `rate`: the same bits.
inline void ExpectMapped(const PairKinematics& one, const PairKinematics& other, const Matrix3& Q, double length,
                         double rate) {
  ASSERT_EQ(one.regular, other.regular);
  EXPECT_EQ(other.p_1, length * (Q * one.p_1));
  EXPECT_EQ(other.p_2, length * (Q * one.p_2));
  EXPECT_EQ(other.normal, Q * one.normal);
  EXPECT_EQ(other.gap, length * one.gap);
  EXPECT_EQ(other.gap_rate, rate * length * one.gap_rate);
  EXPECT_EQ(other.slip, rate * length * (Q * one.slip));
  if (!one.regular) return;
  EXPECT_EQ(other.p_dot_1, rate * length * (Q * one.p_dot_1));
  EXPECT_EQ(other.p_dot_2, rate * length * (Q * one.p_dot_2));
  EXPECT_EQ(other.normal_dot, rate * (Q * one.normal_dot));
  EXPECT_EQ(other.drift, rate * rate * length * (Q * one.drift));
  EXPECT_EQ(other.gap_acceleration, rate * rate * length * one.gap_acceleration);
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_MAPPED_MOTION_H_
