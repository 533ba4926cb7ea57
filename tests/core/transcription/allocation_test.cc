// The evaluations of the NLP allocate nothing.
#include <gtest/gtest.h>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/core/transcription/planar_request.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

TEST(AllocationCounter, SeesVectorsAndMatrices) {
  long before = Allocations();
  const VectorX vector = VectorX::Random(100);  // values that the compiler cannot do without
  EXPECT_GT(vector.norm(), 0);
  EXPECT_GT(Allocations(), before);
  before = Allocations();
  operator delete(operator new(static_cast<size_t>(vector.size())));
  EXPECT_GT(Allocations(), before);
}

class AllocationTest : public ::testing::TestWithParam<Scheme> {};

TEST_P(AllocationTest, EvaluationsAllocateNothing) {
  GaitRequest request = PlanarRequestWithEveryTerm(GetParam());
  request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;  // every row there is
  const auto spec = CheckRequest(request);
  ASSERT_TRUE(spec.ok());
  const auto problem = BuildProblem(spec.value());
  CollocationNlp nlp(*problem, GetParam(), Mesh::Uniform({1, 2}));
  const VectorX x = nlp.MakeStart(WalkingGuess(spec.value(), *problem));
  const VectorX lambda = VectorX::Ones(nlp.constraints());
  VectorX gradient(nlp.variables()), rows(nlp.constraints()), jacobian(nlp.jacobian_pattern().size()),
      hessian(nlp.hessian_pattern().size());
  double objective;
  bool finite = true;
  const auto count = [&finite](auto&& evaluate) {
    const long before = Allocations();
    finite &= evaluate();
    return Allocations() - before;
  };
  EXPECT_EQ(count([&] { return nlp.Objective(x.data(), &objective); }), 0);
  EXPECT_EQ(count([&] { return nlp.Gradient(x.data(), gradient.data()); }), 0);
  EXPECT_EQ(count([&] { return nlp.Constraints(x.data(), rows.data()); }), 0);
  EXPECT_EQ(count([&] { return nlp.Jacobian(x.data(), jacobian.data()); }), 0);
  EXPECT_EQ(count([&] { return nlp.Hessian(x.data(), 1, lambda.data(), hessian.data()); }), 0);
  EXPECT_TRUE(finite);
}

INSTANTIATE_TEST_SUITE_P(Schemes, AllocationTest, ::testing::ValuesIn(EveryScheme()));

}  // namespace
}  // namespace rollgait
