#ifndef ROLLGAIT_SERVER_GATEWAY_OPENAPI_H_
#define ROLLGAIT_SERVER_GATEWAY_OPENAPI_H_

#include <google/protobuf/descriptor.h>

#include <string>

namespace rollgait::server {

// The OpenAPI 3.0 document of kRoutes, JSON in lines. Texts are the comments of the .proto files, so `pool` must hold
// gait_service.proto and what it imports with their comments (protoc --include_source_info).
std::string MakeOpenApi(const google::protobuf::DescriptorPool& pool, const std::string& version);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_OPENAPI_H_
