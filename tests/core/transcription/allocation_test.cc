// The evaluations of the NLP allocate nothing. Matrices of Eigen come from malloc, which the linker wraps in this program
// (see CMakeLists.txt); everything else comes from operator new, which is replaced here.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "tests/core/transcription/planar_request.h"

namespace {
std::atomic<long> allocations = 0;
}

extern "C" {
void* __real_malloc(size_t size);
void* __real_realloc(void* block, size_t size);
void* __wrap_malloc(size_t size) {
  ++allocations;
  return __real_malloc(size);
}
void* __wrap_realloc(void* block, size_t size) {
  ++allocations;
  return __real_realloc(block, size);
}
}

// Not inlined: the compiler would take free() for the wrong partner of operator new.
__attribute__((noinline)) void* operator new(size_t size) {
  ++allocations;
  void* block = __real_malloc(size == 0 ? 1 : size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
__attribute__((noinline)) void operator delete(void* block) noexcept { std::free(block); }
__attribute__((noinline)) void operator delete(void* block, size_t) noexcept { std::free(block); }

namespace rollgait {
namespace {

TEST(AllocationCounter, SeesVectorsAndMatrices) {
  long before = allocations;
  const VectorX vector = VectorX::Random(100);  // values that the compiler cannot do without
  EXPECT_GT(vector.norm(), 0);
  EXPECT_GT(allocations, before);
  before = allocations;
  operator delete(operator new(static_cast<size_t>(vector.size())));
  EXPECT_GT(allocations, before);
}

class AllocationTest : public ::testing::TestWithParam<Scheme> {};

TEST_P(AllocationTest, EvaluationsAllocateNothing) {
  GaitRequest request = PlanarRequestWithEveryTerm();
  request.discretization.scheme = GetParam();
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
    const long before = allocations;
    finite &= evaluate();
    return allocations - before;
  };
  EXPECT_EQ(count([&] { return nlp.Objective(x.data(), &objective); }), 0);
  EXPECT_EQ(count([&] { return nlp.Gradient(x.data(), gradient.data()); }), 0);
  EXPECT_EQ(count([&] { return nlp.Constraints(x.data(), rows.data()); }), 0);
  EXPECT_EQ(count([&] { return nlp.Jacobian(x.data(), jacobian.data()); }), 0);
  EXPECT_EQ(count([&] { return nlp.Hessian(x.data(), 1, lambda.data(), hessian.data()); }), 0);
  EXPECT_TRUE(finite);
}

INSTANTIATE_TEST_SUITE_P(Schemes, AllocationTest,
                         ::testing::Values(Scheme::kRadau2, Scheme::kRadau3, Scheme::kHermiteSimpson));

}  // namespace
}  // namespace rollgait
