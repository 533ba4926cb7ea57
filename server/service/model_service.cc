#include "server/service/model_service.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/common.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "server/base/digest.h"
#include "server/base/logging.h"
#include "server/service/request_check.h"
#include "server/service/solve_key.h"

namespace rollgait::server {
namespace {

constexpr char kModelPrefix[] = "models/";
constexpr size_t kMaxId = 64;

bool IsModelId(const std::string& id) {
  return !id.empty() && id.size() <= kMaxId && std::all_of(id.begin(), id.end(), [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
           letter == '_' || letter == '-' || letter == '.';
  });
}

Error NoSuchModel(const std::string& name) {
  return {ErrorCode::kNotFound,
          "there is no model \"" + name.substr(0, 100) +
              "\"; names have the form models/{id} or models/{id}@{version}, ListModels lists them"};
}

// The key in "models/{id}" or "models/{id}@{version}" (a number from 1 without leading zeros).
std::optional<ModelKey> ParseName(const std::string& tenant, const std::string& name) {
  if (name.rfind(kModelPrefix, 0) != 0) return std::nullopt;
  ModelKey key{tenant, name.substr(sizeof(kModelPrefix) - 1)};
  const size_t at = key.id.find('@');
  if (at != std::string::npos) {
    const std::string version = key.id.substr(at + 1);
    key.id.resize(at);
    const auto [end, error] = std::from_chars(version.data(), version.data() + version.size(), key.version);
    if (error != std::errc() || std::to_string(key.version) != version || key.version < 1) return std::nullopt;
  }
  if (!IsModelId(key.id)) return std::nullopt;
  return key;
}

void Describe(const ModelRecord& record, v1::StoredModel* stored) {
  stored->set_name(kModelPrefix + record.id + "@" + std::to_string(record.version));
  stored->set_version(record.version);
  stored->set_digest(record.digest);
  *stored->mutable_create_time() = google::protobuf::util::TimeUtil::MicrosecondsToTimestamp(record.create_time_us);
  stored->set_size_bytes(record.bytes);
}

Outcome<v1::Model> ToModel(const ModelRecord& record) {
  v1::Model model;
  if (!model.ParseFromString(record.payload)) {
    return Error{ErrorCode::kInternal, "the stored models/" + record.id + " cannot be read"};
  }
  Describe(record, model.mutable_summary()->mutable_stored());
  return model;
}

// "own.joints[3].mass_kg" of a selection is "model.joints[3].mass_kg" of a CreateModelRequest.
void OfCreate(Violations& violations) {
  constexpr char kOwn[] = "own.";
  for (Violation& violation : violations) {
    const bool of_own = violation.field.rfind(kOwn, 0) == 0;
    violation.field = "model." + violation.field.substr(of_own ? sizeof(kOwn) - 1 : 0);
  }
}

}  // namespace

bool ModelService::IsStored(const v1::ModelSelection& selection) {
  return !selection.has_own() && selection.name().rfind(kModelPrefix, 0) == 0;
}

std::optional<Error> ModelService::Resolve(const Caller& caller, const std::string& path,
                                           v1::ModelSelection* selection) {
  Outcome<v1::Model> model = GetStored(caller, *selection);
  if (!model.ok() && model.error().code == ErrorCode::kNotFound) {
    return InvalidArgument({{path + "name", "is \"" + selection->name().substr(0, 100) +
                                                "\", which is no stored model of yours; ListModels lists them"}});
  }
  if (!model.ok()) return model.error();
  selection->clear_name();
  *selection->mutable_own() = std::move(model).value();
  selection->mutable_own()->mutable_summary()->clear_stored();
  return std::nullopt;
}

Outcome<v1::Model> ModelService::GetStored(const Caller& caller, const v1::ModelSelection& selection) {
  const std::optional<ModelKey> key = ParseName(caller.tenant, selection.name());
  if (!key.has_value()) return NoSuchModel(selection.name());
  const Outcome<ModelRecord> record = store_.GetModel(*key);
  if (!record.ok()) return record.error();
  return ToModel(record.value());
}

v1::Model ModelService::Written(const v1::Model& model, const v1::GetModelRequest& request) const {
  return request.joint_chains() ? knowledge_.with_joint_chains(model) : model;
}

Outcome<v1::ListModelsResponse> ModelService::ListModels(const Caller& caller, const v1::ListModelsRequest& request) {
  Violations violations = CheckRequest(request);
  const int page_size = CheckPageSize(request.page_size(), &violations);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  const Outcome<ModelPage> page = store_.ListModels({caller.tenant, page_size, request.page_token()});
  if (!page.ok()) return page.error();
  v1::ListModelsResponse response;
  if (request.page_token().empty()) response = knowledge_.list_models();
  for (const ModelRecord& record : page.value().models) {
    v1::ModelSummary& summary = *response.add_models();
    if (!summary.ParseFromString(record.summary)) {
      return Error{ErrorCode::kInternal, "the stored summary of models/" + record.id + " cannot be read"};
    }
    Describe(record, summary.mutable_stored());
  }
  response.set_next_page_token(page.value().next_page_token);
  return response;
}

Outcome<v1::Model> ModelService::GetModel(const Caller& caller, const v1::GetModelRequest& request) {
  Violations violations = CheckRequest(request);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  if (IsStored(request.model())) {
    Outcome<v1::Model> stored = GetStored(caller, request.model());
    if (!stored.ok()) return stored;
    // Its checks refuse what else the selection says.
    v1::ModelSelection selection = request.model();
    selection.clear_name();
    *selection.mutable_own() = stored.value();
    const Result<v1::Model> checked = knowledge_.get_model(selection);
    if (checked.ok()) return Written(stored.value(), request);
    violations = checked.violations();
    AddPrefix("model.", violations);
    return InvalidArgument(std::move(violations));
  }
  const v1::ListModelsResponse models = knowledge_.list_models();
  std::string names;
  bool known = false;
  for (const v1::ModelSummary& summary : models.models()) {
    known = known || summary.name() == request.model().name();
    names += (names.empty() ? "" : ", ") + summary.name();
  }
  if (!known && !request.model().has_own()) {
    return Error{ErrorCode::kNotFound, "there is no model \"" + request.model().name().substr(0, 100) +
                                           "\"; there are: " + names + ", and stored ones as models/{id}"};
  }
  const Result<v1::Model> model = knowledge_.get_model(request.model());
  if (model.ok()) return Written(model.value(), request);
  violations = model.violations();
  AddPrefix("model.", violations);
  return InvalidArgument(std::move(violations));
}

Outcome<v1::Model> ModelService::CreateModel(const Caller& caller, const v1::CreateModelRequest& request) {
  Violations violations = CheckRequest(request);
  if (violations.empty() && !request.has_model()) violations.push_back({"model", "is missing"});
  if (!request.model_id().empty() && !IsModelId(request.model_id())) {
    violations.push_back({"model_id", "is \"" + request.model_id().substr(0, 100) + "\"; must have 1 to " +
                                          std::to_string(kMaxId) + " letters, digits, \"_\", \"-\" or \".\""});
  }
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  v1::ModelSelection selection;
  *selection.mutable_own() = request.model();
  selection.mutable_own()->mutable_summary()->clear_stored();
  Result<v1::Model> completed = knowledge_.get_model(selection);
  if (!completed.ok()) {
    violations = completed.violations();
    OfCreate(violations);
    return InvalidArgument(std::move(violations));
  }
  const v1::Model& model = completed.value();
  NewModel made;
  made.id = request.model_id().empty() ? model.summary().name() : request.model_id();
  made.payload = CanonicalBytes(model);
  made.summary = CanonicalBytes(model.summary());
  made.digest = Sha256Hex(made.payload);
  made.given_digest = Sha256Hex(CanonicalBytes(selection.own()));
  made.actor = caller.actor();
  made.max_bytes_tenant = caller.limits.max_storage_bytes;
  const Outcome<CreatedModel> created = store_.CreateModel(made);
  if (!created.ok()) return created.error();
  const ModelRecord& record = created.value().model;
  if (created.value().created) {
    LogEvent(spdlog::level::info, "model.created", {{"model", record.id}, {"version", record.version}});
  }
  return ToModel(record);
}

Outcome<google::protobuf::Empty> ModelService::DeleteModel(const Caller& caller,
                                                           const v1::DeleteModelRequest& request) {
  const std::optional<ModelKey> key = ParseName(caller.tenant, request.name());
  if (!key.has_value()) return NoSuchModel(request.name());
  if (key->version != 0) {
    return InvalidArgument(
        {{"name", "is \"" + request.name() + "\"; versions are not deleted one by one, give models/" + key->id +
                      " to delete all of them"}});
  }
  const Outcome<Done> done = store_.DeleteModel(key->id, caller.actor());
  if (!done.ok()) return done.error();
  LogEvent(spdlog::level::info, "model.deleted", {{"model", key->id}});
  return google::protobuf::Empty();
}

}  // namespace rollgait::server
