#ifndef ROLLGAIT_CORE_NLP_JOURNAL_CODEC_H_
#define ROLLGAIT_CORE_NLP_JOURNAL_CODEC_H_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/nlp/interior_point_state.h"
#include "core/nlp/nlp_options.h"
#include "core/nlp/problem.h"
#include "core/nlp/result.h"

namespace rollgait {

// What a program is known by: its sizes, how it is to be solved, and its functions and bounds at its start, each as one
// weighted sum. Two of the same program differ by rounding at most, also on another processor; other meshes, costs or
// starts differ by more.
struct NlpFingerprint {
  struct Sum {
    double value = 0, magnitude = 0;  // Σ weight · v and Σ |v|
  };
  std::array<int64_t, 4> sizes = {};  // variables, rows, entries of the Jacobian, of the Hessian
  VectorX options;                    // all but the time, which no result depends on
  std::array<Sum, 8> sums = {};
};

NlpFingerprint FingerprintOf(NlpProblem& problem, const NlpStart& start, const NlpOptions& options);
// Sizes and options are equal, and sums to 1e-8 of their magnitudes.
bool IsSame(const NlpFingerprint& a, const NlpFingerprint& b);

// A finished program, and one under way, as bytes that this version of the format reads again.
struct FinishedProgram {
  NlpFingerprint fingerprint;
  NlpResult result;
};
struct StartedProgram {
  NlpFingerprint fingerprint;
  InteriorPointState state;
};
std::string Encode(const FinishedProgram& program);
std::string Encode(const StartedProgram& program);
// False, and nothing is promised of *program, if the bytes are torn, altered, of another version or of another kind.
// Allocates no more than a few times the bytes that are there.
bool Decode(const std::string& bytes, FinishedProgram* program);
bool Decode(const std::string& bytes, StartedProgram* program);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_JOURNAL_CODEC_H_
