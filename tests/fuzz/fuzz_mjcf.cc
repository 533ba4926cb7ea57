// Models of MuJoCo: what the client reads of a file, proposes for it, and makes of both.
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/import_check.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  CheckImport("fuzz.xml", std::string(reinterpret_cast<const char*>(data), size), [](const client::LinkTree& tree) {
    // No reader leaves a number that a model cannot have.
    for (const client::TreeLink& link : tree.links) {
      ROLLGAIT_CHECK(std::isfinite(link.mass.mass) && link.mass.center.allFinite() && link.mass.inertia.allFinite());
    }
    for (const client::TreeJoint& joint : tree.joints) {
      ROLLGAIT_CHECK(joint.origin.rotation.allFinite() && joint.end.rotation.allFinite() && std::isfinite(joint.zero));
    }
  });
  return 0;
}
