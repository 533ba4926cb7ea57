// What tenants see, use up and may change of one another's.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "server/service/solve_message.h"
#include "server/service/solve_service.h"
#include "tests/server/service/service_fixture.h"

namespace rollgait::server {
namespace {

TEST(TenantTest, ASolveOfAnotherTenantDoesNotExist) {
  ServiceBench bench;
  SolveService& service = bench.service();
  v1::CreateSolveRequest create;
  *create.mutable_spec() = PlanarSpec();
  const std::string name = service.CreateSolve(CallerOf("acme"), create).value().name();
  const std::string id = SolveId(name).value();
  const auto get = Named<v1::GetSolveRequest>(name);
  const auto cancel = Named<v1::CancelSolveRequest>(name);
  const auto remove = Named<v1::DeleteSolveRequest>(name);
  ASSERT_TRUE(service.GetSolve(CallerOf("acme"), get, kHoldAll).ok());
  EXPECT_EQ(service.FindFor(CallerOf("acme"), name).value(), id);
  const Error none = service.GetSolve(CallerOf("rival"), get, kHoldNone).error();
  EXPECT_EQ(none.code, ErrorCode::kNotFound);
  EXPECT_EQ(service.CancelSolve(CallerOf("rival"), cancel).error().message, none.message);
  EXPECT_EQ(service.DeleteSolve(CallerOf("rival"), remove).error().message, none.message);
  EXPECT_EQ(service.FindFor(CallerOf("rival"), name).error().message, none.message);
  EXPECT_EQ(service.ListSolves(CallerOf("rival"), {}).value().solves_size(), 0);
  EXPECT_EQ(service.ListSolves(CallerOf("acme"), {}).value().solves_size(), 1);
  EXPECT_EQ(service.GetServerInfo(CallerOf("rival"), {}).value().queued(), 0);
  EXPECT_EQ(service.GetServerInfo(CallerOf("acme"), {}).value().queued(), 1);
  // In the store's own words for what is not there.
  ASSERT_TRUE(service.CancelSolve(CallerOf("acme"), cancel).ok());
  ASSERT_TRUE(service.DeleteSolve(CallerOf("acme"), remove).ok());
  EXPECT_EQ(service.GetSolve(CallerOf("acme"), get, kHoldAll).error().message, none.message);
}

TEST(TenantTest, AnAdministratorListsCancelsAndDeletesForEveryTenant) {
  ServiceBench bench;
  SolveService& service = bench.service();
  v1::CreateSolveRequest create;
  *create.mutable_spec() = PlanarSpec();
  const std::string name = service.CreateSolve(CallerOf("acme"), create).value().name();
  ASSERT_TRUE(service.CreateSolve(CallerOf("rival"), create).ok());
  const Caller administrator = CallerOf("operators", kAllScopes);
  const auto listed = [&](const Caller& caller, const std::string& tenant) {
    v1::ListSolvesRequest list;
    list.set_tenant(tenant);
    const Outcome<v1::ListSolvesResponse> response = service.ListSolves(caller, list);
    std::string tenants;
    if (!response.ok()) return std::string("refused");
    for (const v1::Solve& solve : response.value().solves()) tenants += solve.tenant() + " ";
    return tenants;
  };
  EXPECT_EQ(listed(administrator, ""), "");
  EXPECT_EQ(listed(administrator, "acme"), "acme ");
  EXPECT_EQ(listed(administrator, "-"), "rival acme ");
  EXPECT_EQ(listed(CallerOf("acme"), "acme"), "acme ");
  EXPECT_EQ(listed(CallerOf("acme"), "rival"), "refused");
  EXPECT_EQ(listed(CallerOf("acme"), "-"), "refused");
  EXPECT_EQ(listed(Caller(), "-"), "rival acme ") << "where it is not asked who calls";
  v1::ListSolvesRequest others;
  others.set_tenant("rival");
  const Error refused = service.ListSolves(CallerOf("acme"), others).error();
  EXPECT_EQ(refused.code, ErrorCode::kPermissionDenied);
  EXPECT_NE(refused.message.find("scope admin"), std::string::npos);

  const auto get = Named<v1::GetSolveRequest>(name);
  const auto cancel = Named<v1::CancelSolveRequest>(name);
  const auto remove = Named<v1::DeleteSolveRequest>(name);
  EXPECT_TRUE(service.GetSolve(administrator, get, kHoldAll).ok());
  EXPECT_EQ(service.CancelSolve(administrator, cancel).value().state(), v1::SOLVE_STATE_CANCELLED);
  EXPECT_TRUE(service.DeleteSolve(administrator, remove).ok());
  EXPECT_EQ(listed(administrator, "-"), "rival ");
  const std::vector<AuditRow> audit = bench.store().ReadAudit(0, 100).value();
  ASSERT_FALSE(audit.empty());
  EXPECT_EQ(audit.back().action, "delete");
  EXPECT_EQ(audit.back().actor.tenant, "operators");
  EXPECT_EQ(audit.back().detail, "of tenant acme");
}

TEST(TenantTest, APriorityIsChangedByItsTenantAndByAnAdministrator) {
  ServiceBench bench;
  v1::CreateSolveRequest create;
  *create.mutable_spec() = PlanarSpec();
  auto set = Named<v1::SetSolvePriorityRequest>(bench.service().CreateSolve(CallerOf("acme"), create).value().name());
  set.set_priority(5);
  const Error none = bench.service().SetSolvePriority(CallerOf("rival"), set).error();
  EXPECT_EQ(none.code, ErrorCode::kNotFound);
  EXPECT_EQ(none.message,
            bench.service().CancelSolve(CallerOf("rival"), Named<v1::CancelSolveRequest>(set.name())).error().message);
  EXPECT_EQ(bench.service().SetSolvePriority(CallerOf("acme"), set).value().priority(), 5);
  set.set_priority(-5);
  const Caller administrator = CallerOf("operators", kAllScopes);
  EXPECT_EQ(bench.service().SetSolvePriority(administrator, set).value().priority(), -5);
  const AuditRow audit = bench.store().ReadAudit(0, 100).value().back();
  EXPECT_EQ(audit.action + ": " + audit.actor.tenant + ", " + audit.detail,
            "set priority: operators, of tenant acme, 5 to -5");
}

TEST(TenantTest, ResultsAndRequestIdsAreOfOneTenant) {
  ServiceBench bench;
  v1::CreateSolveRequest create;
  *create.mutable_spec() = PlanarSpec();
  create.set_request_id("mine");
  const std::string first = bench.service().CreateSolve(CallerOf("acme"), create).value().name();
  bench.Finish(bench.Claim());
  const v1::Solve rival = bench.service().CreateSolve(CallerOf("rival"), create).value();
  EXPECT_NE(rival.name(), first);
  EXPECT_FALSE(rival.from_cache());
  EXPECT_EQ(bench.service().CreateSolve(CallerOf("acme"), create).value().name(), first);
  create.set_request_id("mine too");
  EXPECT_TRUE(bench.service().CreateSolve(CallerOf("acme"), create).value().from_cache());
  v1::CreateSolveRequest warm;
  *warm.mutable_spec() = PlanarSpec();
  warm.mutable_spec()->set_warm_start(first);
  EXPECT_EQ(bench.service().CreateSolve(CallerOf("rival"), warm).error().violations[0].field, "spec.warm_start");
}

TEST(TenantTest, TheQuotaOfATenantIsHisOwn) {
  ServiceBench bench;
  Caller acme = CallerOf("acme");
  acme.limits.max_queued = 1;
  v1::CreateSolveRequest create;
  *create.mutable_spec() = PlanarSpec(0.1);
  ASSERT_TRUE(bench.service().CreateSolve(acme, create).ok());
  *create.mutable_spec() = PlanarSpec(0.2);
  const Error full = bench.service().CreateSolve(acme, create).error();
  EXPECT_EQ(full.code, ErrorCode::kResourceExhausted);
  ASSERT_TRUE(full.quota.has_value());
  EXPECT_EQ(full.quota->subject, "tenant:acme");
  EXPECT_TRUE(full.retry_after.has_value());
  EXPECT_TRUE(bench.service().CreateSolve(CallerOf("rival"), create).ok());
}

}  // namespace
}  // namespace rollgait::server
