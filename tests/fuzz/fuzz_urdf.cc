// Robots as URDF: what the client reads of a file, proposes for it, and makes of both.
#include <tinyxml2.h>

#include "client/import/urdf_document.h"
#include "client/import/xml_guard.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/import_check.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto clean = [](const std::string& urdf) {
    tinyxml2::XMLDocument xml;
    client::ParseSafeXml("again.urdf", urdf, &xml);
    return client::CheckUrdf("again.urdf", xml).xml;
  };
  CheckImport("fuzz.urdf", text, [&](const client::LinkTree& tree) {
    // What is handed to urdfdom reads back as itself.
    if (tree.format == "URDF") ROLLGAIT_CHECK(clean(clean(text)) == clean(text));
  });
  return 0;
}
