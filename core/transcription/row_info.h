#ifndef ROLLGAIT_CORE_TRANSCRIPTION_ROW_INFO_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_ROW_INFO_H_

#include <string>

namespace rollgait {

// What a row of the NLP is, and where it is in time. The row is divided by `size` (in `unit`).
struct RowInfo {
  std::string name, unit;
  double size = 1;
  int phase = 0;
  double time = 0;  // s
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_ROW_INFO_H_
