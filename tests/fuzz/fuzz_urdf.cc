// Robots as URDF: what the client reads of a file, proposes for it, and makes of both.
#include <cmath>

#include "client/failure.h"
#include "client/import/side_file.h"
#include "client/import/side_proposal.h"
#include "client/import/urdf_model.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const client::UrdfTree tree = client::ReadUrdfText("fuzz.urdf", text);
    // What is handed to urdfdom reads back as itself.
    ROLLGAIT_CHECK(client::ReadUrdfText("again.urdf", tree.document.xml).document.xml == tree.document.xml);
    const client::SideProposal proposal = client::ProposeSideFile(tree);
    if (!proposal.missing.empty()) return 0;
    client::CheckSideFile("proposed", proposal.side, tree);
    const v1::Model model = client::ModelOfUrdf(tree, "proposed", proposal.side).model;
    double mass = 0, expected = 0;
    for (const v1::Joint& joint : model.joints()) mass += joint.mass_kg();
    for (const client::UrdfLink& link : tree.links) expected += link.mass.mass;
    ROLLGAIT_CHECK(std::abs(mass - expected) <= 1e-9 * expected);
  } catch (const client::Failure& failure) {
    ROLLGAIT_CHECK(failure.code() == client::ExitCode::kUsage && failure.what()[0] != '\0');
  }
  return 0;
}
