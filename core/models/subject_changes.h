#ifndef ROLLGAIT_CORE_MODELS_SUBJECT_CHANGES_H_
#define ROLLGAIT_CORE_MODELS_SUBJECT_CHANGES_H_

#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/models/body_selection.h"
#include "core/models/foot.h"
#include "core/models/segment_table.h"
#include "core/multibody/model.h"

namespace rollgait {

// The tables of the left side (and the middle) and of the right side.
struct SidedTables {
  SegmentTable left, right;
  const SegmentTable& Of(BodySide side) const { return side == BodySide::kRight ? right : left; }
};

// The tables with the lengths of the selection. Violations name segment_lengths_m["NAME"]: no such segment, a length
// out of range.
SidedTables TablesOf(const BodySelection& selection, Violations* violations);

// The surfaces of the feet on each side. Violations name foot_semi_axes_m["NAME"] and foot_exponents["NAME"]: no
// surface of such feet, a semi-axis or an exponent out of range. Contract: the tables are those of the selection.
struct SidedFeet {
  FootOutlines left, right;
};
SidedFeet FeetOf(const BodySelection& selection, const SidedTables& tables, Violations* violations);

// The joints of the whole human with the changes of the selection: loads are lumped with the links, efforts weakened,
// springs added. Violations name loads[i].field, joint_strengths["NAME"] and joint_springs["NAME"].field. Contract:
// `human` is that of the tables; `fixed` are the joints that do not move, by name.
std::vector<Joint> ChangedJoints(const Model& human, const SidedTables& tables, const BodySelection& selection,
                                 const std::map<std::string, double>& fixed, Violations* violations);

// "the human has no joint of that name", the one of `known` that may have been meant, and all of them.
std::string NoSuchJoint(const std::string& name, const std::vector<std::string>& known);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SUBJECT_CHANGES_H_
