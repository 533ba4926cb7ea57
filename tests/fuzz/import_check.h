// What holds for every file of a body, whatever its format: it is refused by a sentence, or weighs as much as its
// model.
#ifndef ROLLGAIT_TESTS_FUZZ_IMPORT_CHECK_H_
#define ROLLGAIT_TESTS_FUZZ_IMPORT_CHECK_H_

#include <cmath>
#include <string>

#include "client/failure.h"
#include "client/import/side_file.h"
#include "client/import/side_proposal.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "tests/fuzz/fuzz_target.h"

namespace rollgait {

// A model weighs what its tree does.
inline void CheckMass(const client::LinkTree& tree, const v1::Model& model) {
  double mass = 0, expected = 0;
  for (const v1::Joint& joint : model.joints()) mass += joint.mass_kg();
  for (const client::TreeLink& link : tree.links) expected += link.mass.mass;
  ROLLGAIT_CHECK(std::abs(mass - expected) <= 1e-9 * expected);
}

// `also` is called with the tree of a file that can be read.
template <typename Also>
void CheckImport(const std::string& path, const std::string& text, const Also& also) {
  try {
    const client::LinkTree tree = client::ReadLinkTreeText(path, text);
    also(tree);
    const client::SideProposal proposal = client::ProposeSideFile(tree);
    if (!proposal.missing.empty()) return;
    client::CheckSideFile("proposed", proposal.side, tree);
    CheckMass(tree, client::ModelOfTree(tree, "proposed", proposal.side).model);
  } catch (const client::Failure& failure) {
    ROLLGAIT_CHECK(failure.code() == client::ExitCode::kUsage && failure.what()[0] != '\0');
  }
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_FUZZ_IMPORT_CHECK_H_
