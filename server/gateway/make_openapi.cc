// Writes the OpenAPI document that the gateway serves:  rollgait_make_openapi DESCRIPTORS VERSION OUTPUT
// DESCRIPTORS is a FileDescriptorSet of gait_service.proto with its imports and comments.
#include <google/protobuf/descriptor.pb.h>

#include <fstream>
#include <iostream>

#include "server/gateway/openapi.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "rollgait_make_openapi DESCRIPTORS VERSION OUTPUT\n";
    return 2;
  }
  std::ifstream input(argv[1], std::ios::binary);
  google::protobuf::FileDescriptorSet files;
  google::protobuf::DescriptorPool pool;
  bool read = files.ParseFromIstream(&input);
  for (const auto& file : files.file()) read = read && pool.BuildFile(file) != nullptr;
  if (!read) {
    std::cerr << argv[1] << ": is no set of descriptors that belong together\n";
    return 1;
  }
  std::ofstream output(argv[3], std::ios::trunc);
  output << rollgait::server::MakeOpenApi(pool, argv[2]);
  output.close();
  return output ? 0 : 1;
}
