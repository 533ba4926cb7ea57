#include "client/text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/failure.h"
#include "client/progress.h"

namespace rollgait::client {
namespace {

TEST(TextTest, Durations) {
  EXPECT_EQ(FormatDuration(3.4e-4), "340 µs");
  EXPECT_EQ(FormatDuration(0.0123), "12.3 ms");
  EXPECT_EQ(FormatDuration(4.56), "4.56 s");
  EXPECT_EQ(FormatDuration(200), "3 min 20 s");
  EXPECT_EQ(FormatDuration(7322), "2 h 2 min");
}

TEST(TextTest, Times) {
  google::protobuf::Timestamp time;
  EXPECT_EQ(FormatTime(time), "-");
  time.set_seconds(1795242660);
  EXPECT_EQ(FormatTime(time), "2026-11-21 06:31:00 UTC");
}

TEST(TextTest, RoundingErrorsAreZero) {
  EXPECT_EQ(FormatVisible(1.2e-17, 1e-12), "0");
  EXPECT_EQ(FormatVisible(-1.2e-17, 1e-12), "0");
  EXPECT_EQ(FormatVisible(-0.25, 1e-12), "-0.25");
  EXPECT_EQ(FormatVisible(1e-12, 1e-12), "1e-12");
  EXPECT_EQ(FormatVisible(1.0 / 3, 1e-12, 2), "0.33");
}

TEST(TextTest, EnumeratorsAsWords) {
  EXPECT_EQ(StateName(v1::SOLVE_STATE_RUNNING), "running");
  EXPECT_EQ(TerminationName(v1::TERMINATION_ITERATION_LIMIT), "iteration limit");
  EXPECT_EQ(VerdictName(v1::VERDICT_WITHIN), "within");
  EXPECT_EQ(VerdictName(v1::VERDICT_EXCEEDED), "exceeded");
  EXPECT_EQ(VerdictName(v1::VERDICT_NOT_JUDGED), "not judged");
  EXPECT_EQ(VerdictName(v1::VERDICT_UNSPECIFIED), "not judged") << "of a version before 0.4.0";
  EXPECT_EQ(ErrorKindName(v1::SolveError::KIND_MEMORY_LIMIT), "memory limit");
  EXPECT_EQ(StatusCodeName(grpc::StatusCode::UNAUTHENTICATED), "UNAUTHENTICATED");
}

TEST(TextTest, Schemes) {
  using v1::Discretization;
  EXPECT_EQ(SchemeName(Discretization::SCHEME_RADAU2), "Radau IIA, 2 points");
  EXPECT_EQ(SchemeName(Discretization::SCHEME_LOBATTO5), "Lobatto IIIA, 5 points");
  EXPECT_EQ(SchemeName(Discretization::SCHEME_HERMITE_SIMPSON), "Hermite–Simpson");
  EXPECT_EQ(SchemeName(Discretization::SCHEME_SHOOTING_LINEAR), "direct multiple shooting, linear efforts");
}

TEST(TextTest, SolveNames) {
  EXPECT_EQ(SolveName("1a"), "solves/1a");
  EXPECT_EQ(SolveName("solves/1a"), "solves/1a");
  EXPECT_THROW(SolveName(""), Failure);
}

TEST(TextTest, TablesCountCharactersNotBytes) {
  EXPECT_EQ(FormatTable({{"a°", "1", "x"}, {"bcd", "22"}}, "lr"), "a°    1  x\nbcd  22\n");
}

TEST(TextTest, Utf8IsStrict) {
  for (const char* good : {"", "knee", "Hüfte", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) EXPECT_TRUE(IsUtf8(good)) << good;
  for (const char* bad : {"\xff",
                          "H\xfc"
                          "fte",
                          "\x80", "\xc3", "\xe2\x82", "\xc0\xaf", "\xe0\x80\xaf", "\xf0\x80\x80\xaf", "\xed\xa0\x80",
                          "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80"}) {
    EXPECT_FALSE(IsUtf8(bad)) << testing::PrintToString(std::string(bad));
  }
}

TEST(TextTest, ControlCharactersAreReplaced) {
  EXPECT_EQ(WithoutControls("a\x1b[31m\n\x7f\tü"), "a?[31m???ü");
  EXPECT_EQ(WithoutControls(""), "");
}

TEST(ProgressTest, IterationsFitTheirHeader) {
  v1::Iteration iteration;
  iteration.set_index(12345);
  iteration.set_objective(-1234.5);
  iteration.set_restoration(true);
  iteration.set_elapsed_s(123.4);
  const std::string line = FormatIteration(iteration);
  EXPECT_EQ(line.size(), IterationHeader().size()) << IterationHeader() << "\n" << line;
  EXPECT_NE(line.find("12345r"), std::string::npos);
  EXPECT_EQ(FormatLiveIteration(iteration, 30).size(), 30u);
}

}  // namespace
}  // namespace rollgait::client
