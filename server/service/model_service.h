#ifndef ROLLGAIT_SERVER_SERVICE_MODEL_SERVICE_H_
#define ROLLGAIT_SERVER_SERVICE_MODEL_SERVICE_H_

#include <google/protobuf/empty.pb.h>

#include <optional>
#include <string>

#include "rollgait/v1/gait_service.pb.h"
#include "server/access/caller.h"
#include "server/base/outcome.h"
#include "server/service/gait_knowledge.h"
#include "server/store/model_store.h"

namespace rollgait::server {

// The use cases of models, one method an RPC; what the errors mean is in gait_service.proto. A stored model belongs to
// its creator's tenant: for others, administrators included, it does not exist. Scopes are not looked at here. Any
// thread may call; every call may block on the store.
class ModelService {
 public:
  // Both outlive it.
  ModelService(ModelStore& store, const GaitKnowledge& knowledge) : store_(store), knowledge_(knowledge) {}

  Outcome<v1::ListModelsResponse> ListModels(const Caller& caller, const v1::ListModelsRequest& request);
  Outcome<v1::Model> GetModel(const Caller& caller, const v1::GetModelRequest& request);
  Outcome<v1::Model> CreateModel(const Caller& caller, const v1::CreateModelRequest& request);
  Outcome<google::protobuf::Empty> DeleteModel(const Caller& caller, const v1::DeleteModelRequest& request);

  // Whether the selection names a stored model.
  static bool IsStored(const v1::ModelSelection& selection);
  // Puts the stored model that the selection names into it, without its name in the store: what a request asks depends
  // on the model's content alone. `path` leads to the selection in the request, for the kInvalidArgument of a model
  // that is not there. nullopt: done.
  std::optional<Error> Resolve(const Caller& caller, const std::string& path, v1::ModelSelection* selection);

 private:
  Outcome<v1::Model> GetStored(const Caller& caller, const v1::ModelSelection& selection);
  // A good model as the request wants it written.
  v1::Model Written(const v1::Model& model, const v1::GetModelRequest& request) const;

  ModelStore& store_;
  const GaitKnowledge& knowledge_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_MODEL_SERVICE_H_
