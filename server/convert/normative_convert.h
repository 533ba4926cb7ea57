#ifndef ROLLGAIT_SERVER_CONVERT_NORMATIVE_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_NORMATIVE_CONVERT_H_

#include "core/validation/normative.h"
#include "rollgait/v1/normative.pb.h"

namespace rollgait::server {

v1::NormativeComparison EncodeNormative(const NormativeComparison& comparison);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_NORMATIVE_CONVERT_H_
