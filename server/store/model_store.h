#ifndef ROLLGAIT_SERVER_STORE_MODEL_STORE_H_
#define ROLLGAIT_SERVER_STORE_MODEL_STORE_H_

#include <cstdint>
#include <string>
#include <vector>

#include "server/base/outcome.h"
#include "server/store/audit.h"

namespace rollgait::server {

// One version of a tenant's model as it is stored. Blobs are serialized protobuf.
struct ModelRecord {
  std::string id;              // "models/{id}" without the prefix
  int version = 0;             // 1, 2, 3 … of an id
  std::string digest;          // equal digests: equal models
  int64_t create_time_us = 0;  // wall clock, µs since 1970
  int64_t bytes = 0;           // of summary and payload
  std::string summary;         // v1::ModelSummary
  std::string payload;         // v1::Model; empty in lists
};

struct NewModel {
  std::string id, digest, summary, payload;
  // Of the model as the caller gave it, where that differs: a version with either digest is the same model.
  std::string given_digest = {};
  Actor actor = {};                // its tenant is the model's
  int64_t max_bytes_tenant = 0;    // refuse if what the tenant stores takes more with this one; 0: no limit
  int max_versions_tenant = 1000;  // refuse if the tenant has so many versions, of all ids, already
};

struct CreatedModel {
  ModelRecord model;
  bool created = true;  // false: the id has this content, and this is the version that has it
};

struct ModelKey {
  std::string tenant, id;
  int version = 0;  // 0: the newest
};

struct ModelQuery {
  std::string tenant;
  int page_size = 50;
  std::string page_token;  // from the previous page; empty: first page
};

struct ModelPage {
  std::vector<ModelRecord> models;  // the newest version of each id, youngest first; `payload` is left empty
  std::string next_page_token;      // empty: last page
};

// Where tenants' own models live. A model is seen by its tenant alone. Calls are as those of SolveStore: one
// transaction each, durable, from any thread and process; what is changed leaves a row in `audit` with it.
class ModelStore {
 public:
  virtual ~ModelStore() = default;

  // Stores the first or the next version of an id, or finds the one with this content. kResourceExhausted: the tenant's
  // storage or number of versions, or no room on the disk.
  virtual Outcome<CreatedModel> CreateModel(const NewModel& model) = 0;
  // kNotFound.
  virtual Outcome<ModelRecord> GetModel(const ModelKey& key) = 0;
  // kInvalidArgument: the page token.
  virtual Outcome<ModelPage> ListModels(const ModelQuery& query) = 0;
  // All versions. kNotFound.
  virtual Outcome<Done> DeleteModel(const std::string& id, const Actor& actor) = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_MODEL_STORE_H_
