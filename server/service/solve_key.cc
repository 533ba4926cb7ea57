#include "server/service/solve_key.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include "core/base/check.h"
#include "server/base/digest.h"

namespace rollgait::server {
namespace {

// Length first, so that no two different sequences of parts give the same bytes.
std::string Part(const std::string& bytes) { return std::to_string(bytes.size()) + ":" + bytes; }

}  // namespace

std::string CanonicalBytes(const google::protobuf::Message& message) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    ROLLGAIT_CHECK(message.SerializeToCodedStream(&coded));
  }
  return bytes;
}

std::string SolveKey(const v1::SolveSpec& spec, const v1::Model& model, const std::string& solver_build,
                     const std::string& start, const std::string& tenant) {
  return Sha256Hex(Part(CanonicalBytes(spec)) + Part(CanonicalBytes(model)) + Part(solver_build) +
                   (start.empty() && tenant.empty() ? "" : Part(start)) + (tenant.empty() ? "" : Part(tenant)));
}

}  // namespace rollgait::server
