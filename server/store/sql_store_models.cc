// Tenants' own models.
#include <optional>
#include <utility>

#include "server/store/page_token.h"
#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {
namespace {

using LockMode = SqlConnection::LockMode;

#define ROLLGAIT_MODEL_COLUMNS "number, id, version, digest, create_time_us, bytes, summary "
constexpr int kModelColumns = 7;

ModelRecord ReadModel(const Query& query) {
  ModelRecord model;
  model.id = query.Bytes(1);
  model.version = static_cast<int>(query.Int(2));
  model.digest = query.Bytes(3);
  model.create_time_us = query.Int(4);
  model.bytes = query.Int(5);
  model.summary = query.Bytes(6);
  return model;
}

std::string NameOf(const std::string& id, int version) {
  return "models/" + id + (version == 0 ? "" : "@" + std::to_string(version));
}

Error NoSuchModel(const std::string& id, int version) {
  return {ErrorCode::kNotFound, "there is no model \"" + NameOf(id, version) + "\"; ListModels lists those that are"};
}

// Tokens of lists of models: no tenant's name has a space, so they are none of a list of solves.
ListQuery TokenQuery(const ModelQuery& query) { return {1, query.page_token, std::nullopt, "models " + query.tenant}; }

std::optional<Error> TooMany(SqlConnection& connection, const NewModel& model) {
  Query query(connection, "SELECT COUNT(*) FROM models WHERE tenant = ?", model.actor.tenant);
  const int64_t count = query.Step() ? query.Int(0) : 0;
  if (count < model.max_versions_tenant) return std::nullopt;
  const std::string text = "tenant \"" + model.actor.tenant + "\" has " + std::to_string(count) +
                           " versions of models, the limit is " + std::to_string(model.max_versions_tenant);
  Error error{ErrorCode::kResourceExhausted, text + "; delete models that are not needed any more (DeleteModel)"};
  error.quota = {"tenant:" + model.actor.tenant, text};
  return error;
}

}  // namespace

Outcome<CreatedModel> SqlStore::CreateModel(const NewModel& model) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<CreatedModel> {
    const std::string& tenant = model.actor.tenant;
    connection.Lock("models of tenant " + tenant, LockMode::kExclusive);
    {
      Query same(connection,
                 "SELECT " ROLLGAIT_MODEL_COLUMNS
                 ", payload FROM models WHERE tenant = ? AND id = ? AND digest IN (?, ?) ORDER BY version LIMIT 1",
                 tenant, model.id, model.digest, model.given_digest);
      if (same.Step()) {
        ModelRecord known = ReadModel(same);
        known.payload = same.Bytes(kModelColumns);
        return CreatedModel{std::move(known), false};
      }
    }
    if (std::optional<Error> full = room_.Refusal()) return *full;
    if (std::optional<Error> many = TooMany(connection, model)) return *many;
    ModelRecord record{model.id, 1, model.digest, clock_.WallMicros(), 0, model.summary, model.payload};
    record.bytes = static_cast<int64_t>(model.summary.size() + model.payload.size());
    if (std::optional<Error> full = storage_use_.Refusal(connection, {tenant, record.bytes, model.max_bytes_tenant})) {
      return *full;
    }
    {
      Query newest(connection, "SELECT COALESCE(MAX(version), 0) FROM models WHERE tenant = ? AND id = ?", tenant,
                   model.id);
      if (newest.Step()) record.version = static_cast<int>(newest.Int(0)) + 1;
    }
    Query::Do(connection,
              "INSERT INTO models (tenant, id, version, digest, create_time_us, bytes, summary, payload) "
              "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
              tenant, record.id, record.version, record.digest, record.create_time_us, record.bytes,
              Blob{record.summary}, Blob{record.payload});
    AddAudit(connection, {model.actor, "create model", "", "stored", NameOf(record.id, record.version)},
             record.create_time_us);
    return CreatedModel{std::move(record), true};
  });
}

Outcome<ModelRecord> SqlStore::GetModel(const ModelKey& key) {
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<ModelRecord> {
    Query query(connection,
                "SELECT " ROLLGAIT_MODEL_COLUMNS
                ", payload FROM models WHERE tenant = ? AND id = ? AND (version = ? OR ? = 0) "
                "ORDER BY version DESC LIMIT 1",
                key.tenant, key.id, key.version, key.version);
    if (!query.Step()) return NoSuchModel(key.id, key.version);
    ModelRecord model = ReadModel(query);
    model.payload = query.Bytes(kModelColumns);
    return model;
  });
}

Outcome<ModelPage> SqlStore::ListModels(const ModelQuery& query) {
  int64_t before = INT64_MAX;
  const ListQuery token = TokenQuery(query);
  if (!query.page_token.empty()) {
    const std::optional<int64_t> parsed = ParsePageToken(token, page_secret_);
    if (!parsed.has_value()) {
      const std::string message = "is not a token of this list: give back next_page_token unchanged";
      return Error{ErrorCode::kInvalidArgument, "page_token " + message, {{"page_token", message}}};
    }
    before = *parsed;
  }
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<ModelPage> {
    Query rows(connection,
               "SELECT " ROLLGAIT_MODEL_COLUMNS
               "FROM models AS m WHERE tenant = ? AND number < ? AND NOT EXISTS (SELECT 1 FROM models AS n WHERE "
               "n.tenant = m.tenant AND n.id = m.id AND n.version > m.version) ORDER BY number DESC LIMIT ?",
               query.tenant, before, query.page_size + 1);
    ModelPage page;
    int64_t last_number = 0;
    size_t bytes = 0;
    while (rows.Step()) {
      if (static_cast<int>(page.models.size()) == query.page_size || bytes > kMaxPageBytes) {
        page.next_page_token = MakePageToken(last_number, token, page_secret_);
        break;
      }
      last_number = rows.Int(0);
      page.models.push_back(ReadModel(rows));
      bytes += page.models.back().summary.size();
    }
    return page;
  });
}

Outcome<Done> SqlStore::DeleteModel(const std::string& id, const Actor& actor) {
  return WriteForRoom([&](SqlConnection& connection) -> Outcome<Done> {
    connection.Lock("models of tenant " + actor.tenant, LockMode::kExclusive);
    Query removal(connection, "DELETE FROM models WHERE tenant = ? AND id = ?", actor.tenant, id);
    const int versions = removal.Run();
    if (versions == 0) return NoSuchModel(id, 0);
    storage_use_.Forget();
    const std::string detail = NameOf(id, 0) + ", versions: " + std::to_string(versions);
    AddAudit(connection, {actor, "delete model", "", "deleted", detail}, clock_.WallMicros());
    return Done{};
  });
}

}  // namespace rollgait::server
