#include "core/simulation/periodic_gait.h"

#include <gtest/gtest.h>

#include <complex>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/passive_walker.h"

namespace rollgait {
namespace {

// Fixed points and eigenvalues of the reference data (quadruple precision, an independent model in minimal
// coordinates), rounded to double.
struct KnownWalker {
  std::string name;
  PassiveWalker walker;
  double period, step_length, lift_speed;
  std::vector<std::complex<double>> eigenvalues;
};

const KnownWalker kKnown[] = {
    {"ellipse_SI_a0.10_b0.04_0.6deg",
     {40.0, 10.0, 0.5, 0.4, 0.86, 0.1, 0.04, 0.0, 9.81, 0.010471975511965978, 0.23402060082734957, -0.8801980898696707,
      -0.23402060082734957, -0.704425380545593},
     0.8035280510832883,
     0.41842615156392093,
     0.24972754642868186,
     {{0.3439698445763, 0.18235625379412}, {0.3439698445763, -0.18235625379412}, {0.15725306050191, 0}}},
    {"bhounsule_point_M1000",
     {1000.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.009, 0.2001610721697057, -0.19990606008763767,
      -0.2001610721697057, -0.18410058685968358},
     3.88194000127686,
     0.3976543793347295,
     0.07635096242612383,
     {{-0.19666817812886, 0.54472677422491}, {-0.19666817812886, -0.54472677422491}, {0, 0}}},
    {"ellipse_a0.1_b0.2_g0.005",
     {1.0, 0.5, 0.02, 0.5, 0.8, 0.1, 0.2, 0.0, 1.0, 0.005, 0.13507901252057075, -0.19486304699261922,
      -0.13507901252057075, -0.17480712577908653},
     2.4614014846503163,
     0.2693783337817326,
     0.04727663632100315,
     {{0.66476186378104, 0}, {0.16634760756731, 0.23407183330289}, {0.16634760756731, -0.23407183330289}}},
    {"ellipse_fwd_a0.2_b0.1_f0.01_g0.01",
     {1.0, 0.5, 0.02, 0.5, 1.0, 0.2, 0.1, 0.01, 1.0, 0.01, 0.21724965396198317, -0.2724898944235896,
      -0.24469764957312928, -0.20752369738926874},
     2.650104725931795,
     0.5052688099721981,
     0.08004376168674994,
     {{0.64639328820416, 0}, {-0.10849661019435, 0.26083715823306}, {-0.10849661019435, -0.26083715823306}}},
    {"goswami_3deg_g9.8",
     {10.0, 5.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 9.8, 0.05235987755982989, 0.2710286804988204, -1.0918266774895748,
      -0.2710286804988204, -0.37718155840327655},
     0.7347209621553588,
     0.5354454154300095,
     0.39328686256887657,
     {{-0.19972612683003, 0.54447606209474}, {-0.19972612683003, -0.54447606209474}, {0.13157262407718, 0}}},
    {"round_r0.2_I0.02_g0.01",
     {1.0, 0.5, 0.02, 0.5, 1.0, 0.2, 0.2, 0.0, 1.0, 0.01, 0.1894382832527027, -0.23901098781294336, -0.1894382832527027,
      -0.18761398146815364},
     2.427955842629363,
     0.452389827272699,
     0.08033657772697839,
     {{0.43344486966563, 0}, {0.37046538495291, 0.18370391576759}, {0.37046538495291, -0.18370391576759}}}};

void PrintTo(const KnownWalker& known, std::ostream* out) { *out << known.name; }

class PeriodicGaitTest : public ::testing::TestWithParam<KnownWalker> {};

TEST_P(PeriodicGaitTest, FindsTheFixedPointAndItsEigenvalues) {
  const KnownWalker& known = GetParam();
  PassiveWalker start = known.walker;
  start.stance *= 1.002, start.stance_rate *= 0.998, start.swing_rate *= 1.001;
  const SimulationScene scene = SceneOf(start);
  ASSERT_TRUE(CheckScene(scene).empty());
  const Result<PeriodicGait> result = FindPeriodicGait(scene, {});
  ASSERT_TRUE(result.ok()) << result.violations()[0].message;
  const PeriodicGait& gait = result.value();
  EXPECT_TRUE(gait.converged) << gait.residual;
  EXPECT_GT(gait.iterations, 1);
  EXPECT_NEAR(gait.q[2], known.walker.stance, 1e-10);
  EXPECT_NEAR(gait.q[3], known.walker.swing, 1e-10);
  EXPECT_NEAR(gait.v[2], known.walker.stance_rate, 1e-10);
  EXPECT_NEAR(gait.v[3], known.walker.swing_rate, 1e-10);
  EXPECT_NEAR(gait.period, known.period, 1e-9);
  EXPECT_NEAR(gait.step_length, known.step_length, 1e-10);
  ASSERT_EQ(gait.eigenvalues.size(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(gait.eigenvalues[i] - known.eigenvalues[i]), 2e-9) << i;
  // What the heel strike did: the old foot was released, it lifts, and the new one pushes.
  ASSERT_EQ(gait.heel_strike.released, std::vector<int>{0});
  EXPECT_NEAR(gait.heel_strike.released_gap_rates[0], known.lift_speed, 1e-9);
  EXPECT_GT(gait.heel_strike.impulses[1].z(), 0);
  EXPECT_TRUE(gait.heel_strike.consistent);
  EXPECT_GT(gait.report.min_normal_force, 0);
  EXPECT_LT(gait.report.max_energy_error, 1e-10 * (1 + std::abs(gait.report.energy_initial)));
}

INSTANTIATE_TEST_SUITE_P(Walkers, PeriodicGaitTest, ::testing::ValuesIn(kKnown));

TEST(PeriodicGait, SaysWhenTheWalkerFalls) {
  PassiveWalker walker = kKnown[1].walker;
  walker.stance_rate = 0;
  const Result<PeriodicGait> result = FindPeriodicGait(SceneOf(walker), {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.violations()[0].field, "joints");
}

TEST(PeriodicGait, RefusesMovingGroundAndAScenesWithoutStance) {
  SimulationScene scene = SceneOf(kKnown[1].walker);
  scene.ground[0].rate = 1;
  scene.contacts[0].active = false;
  const Result<PeriodicGait> result = FindPeriodicGait(scene, {});
  ASSERT_FALSE(result.ok());
  ASSERT_EQ(result.violations().size(), 2u);
  EXPECT_EQ(result.violations()[0].field, "contacts");
  EXPECT_EQ(result.violations()[1].field, "ground[0]");
}

}  // namespace
}  // namespace rollgait
