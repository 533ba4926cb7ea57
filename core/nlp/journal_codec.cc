#include "core/nlp/journal_codec.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/base/byte_stream.h"
#include "core/nlp/termination.h"

namespace rollgait {
namespace {

// "RGJ" and the version of the format: to be raised with every change of what is written here or of what it means.
constexpr int64_t kFinished = 0x4a475201'0002, kStarted = 0x4a475202'0004;
constexpr size_t kChecksumBytes = sizeof(uint64_t);
constexpr double kLargestNumber = 1e19;  // beyond: no bound

// FNV-1a over words of eight bytes: against torn and altered bytes, not against forgers, who could write results too.
uint64_t Checksum(std::string_view bytes) {
  uint64_t sum = 0xcbf29ce484222325;
  for (; !bytes.empty(); bytes.remove_prefix(std::min<size_t>(8, bytes.size()))) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min<size_t>(8, bytes.size()));
    sum = (sum ^ word) * 0x100000001b3;
    sum ^= sum >> 29;
  }
  return sum;
}

std::string WithChecksum(const ByteWriter& writer) {
  const uint64_t sum = Checksum(writer.bytes());
  std::string bytes = writer.bytes();
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

// What the checksum is of; empty if it is not.
std::string_view Checked(const std::string& bytes) {
  if (bytes.size() < kChecksumBytes) return {};
  const std::string_view body(bytes.data(), bytes.size() - kChecksumBytes);
  uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + body.size(), sizeof sum);
  return sum == Checksum(body) ? body : std::string_view();
}

// Weight of entry i, in [-1, 1]: splitmix64.
double Weight(uint64_t i) {
  uint64_t z = (i + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>(static_cast<int64_t>(z ^ (z >> 31))) / 9.3e18;
}

NlpFingerprint::Sum SumOf(const VectorX& values) {
  NlpFingerprint::Sum sum;
  for (int i = 0; i < values.size(); ++i) {
    const double v = std::abs(values(i)) < kLargestNumber ? values(i) : std::copysign(1.0, values(i));
    sum.value += Weight(static_cast<uint64_t>(i)) * v;
    sum.magnitude += std::abs(v);
  }
  return sum;
}

void Put(const NlpFingerprint& fingerprint, ByteWriter* out) {
  for (const int64_t size : fingerprint.sizes) out->Put(size);
  out->Put(fingerprint.options);
  for (const NlpFingerprint::Sum& sum : fingerprint.sums) {
    out->Put(sum.value);
    out->Put(sum.magnitude);
  }
}

void Get(ByteReader* in, NlpFingerprint* fingerprint) {
  for (int64_t& size : fingerprint->sizes) size = in->Int();
  fingerprint->options = in->Vector();
  for (NlpFingerprint::Sum& sum : fingerprint->sums) {
    sum.value = in->Double();
    sum.magnitude = in->Double();
  }
}

int Bounded(int64_t value) { return static_cast<int>(std::clamp<int64_t>(value, -1, 1 << 30)); }

// Where an interior point method is and what it remembers: of the program, or of its restoration.
template <typename State>
void PutMethod(const State& state, ByteWriter* out) {
  for (const VectorX* part : {&state.w, &state.multipliers.y, &state.multipliers.lower, &state.multipliers.upper}) {
    out->Put(*part);
  }
  for (const int part : {state.newton.zero_failures, state.newton.skipped, state.barrier.raised}) {
    out->Put(static_cast<int64_t>(part));
  }
  for (const double part : {state.barrier.mu, state.barrier.recent_step, state.acceptance.theta_min,
                            state.acceptance.theta_max, state.newton.last_shift, state.newton.threshold}) {
    out->Put(part);
  }
  out->Put(static_cast<int64_t>(state.acceptance.corners.size()));
  for (const auto& [theta, phi] : state.acceptance.corners) {
    out->Put(theta);
    out->Put(phi);
  }
}

template <typename State>
void GetMethod(ByteReader* in, State* state) {
  for (VectorX* part : {&state->w, &state->multipliers.y, &state->multipliers.lower, &state->multipliers.upper}) {
    *part = in->Vector();
  }
  for (int* part : {&state->newton.zero_failures, &state->newton.skipped, &state->barrier.raised}) {
    *part = Bounded(in->Int());
  }
  for (double* part : {&state->barrier.mu, &state->barrier.recent_step, &state->acceptance.theta_min,
                       &state->acceptance.theta_max, &state->newton.last_shift, &state->newton.threshold}) {
    *part = in->Double();
  }
  state->acceptance.corners.clear();
  const int64_t corners = in->Int();
  for (int64_t i = 0; i < corners && in->ok(); ++i) {
    const double theta = in->Double();
    state->acceptance.corners.emplace_back(theta, in->Double());
  }
}

}  // namespace

NlpFingerprint FingerprintOf(NlpProblem& problem, const NlpStart& start, const NlpOptions& options) {
  NlpFingerprint fingerprint;
  fingerprint.sizes = {problem.variables(), problem.constraints(), problem.jacobian_pattern().size(),
                       problem.hessian_pattern().size()};
  fingerprint.options.resize(14);
  fingerprint.options << static_cast<double>(options.solver), options.tolerance, options.max_iterations,
      options.initial_barrier, options.barrier_tolerance, options.warm_push, options.barrier_exponent, options.recentre,
      options.step_residual, options.first_shift, options.worth_finishing != nullptr, options.rough_tolerance,
      options.mesh, static_cast<double>(start.constraint_multipliers.size());
  VectorX values = VectorX::Zero(problem.constraints() + 1);
  // Where the functions have no finite value the sums are 0, each time.
  const bool finite = problem.Constraints(start.x.data(), values.data()) &&
                      problem.Objective(start.x.data(), values.data() + problem.constraints());
  fingerprint.sums = {SumOf(start.x),
                      SumOf(start.constraint_multipliers),
                      SumOf(start.lower_bound_multipliers),
                      SumOf(start.upper_bound_multipliers),
                      SumOf(problem.lower_bounds() - 2 * problem.upper_bounds()),
                      SumOf(problem.constraint_lower()),
                      SumOf(problem.constraint_upper()),
                      finite ? SumOf(values) : NlpFingerprint::Sum()};
  return fingerprint;
}

bool IsSame(const NlpFingerprint& a, const NlpFingerprint& b) {
  constexpr double kRounding = 1e-8;
  if (a.sizes != b.sizes || a.options.size() != b.options.size() || a.options != b.options) return false;
  for (size_t i = 0; i < a.sums.size(); ++i) {
    const double apart =
        std::max(std::abs(a.sums[i].value - b.sums[i].value), std::abs(a.sums[i].magnitude - b.sums[i].magnitude));
    if (!(apart <= kRounding * a.sums[i].magnitude)) return false;
  }
  return true;
}

std::string Encode(const FinishedProgram& program) {
  const NlpResult& result = program.result;
  ByteWriter out;
  out.Put(kFinished);
  Put(program.fingerprint, &out);
  for (const VectorX* part :
       {&result.x, &result.constraint_multipliers, &result.lower_bound_multipliers, &result.upper_bound_multipliers}) {
    out.Put(*part);
  }
  for (const int part : {static_cast<int>(result.termination), result.iterations, result.restored_from,
                         static_cast<int>(result.rough)}) {
    out.Put(static_cast<int64_t>(part));
  }
  for (const double part : {result.objective, result.kkt_error, result.constraint_violation, result.wall_time_s,
                            result.evaluation_time_s}) {
    out.Put(part);
  }
  return WithChecksum(out);
}

bool Decode(const std::string& bytes, FinishedProgram* program) {
  ByteReader in(Checked(bytes));
  if (in.Int() != kFinished) return false;
  Get(&in, &program->fingerprint);
  NlpResult& result = program->result;
  for (VectorX* part :
       {&result.x, &result.constraint_multipliers, &result.lower_bound_multipliers, &result.upper_bound_multipliers}) {
    *part = in.Vector();
  }
  const int64_t termination = in.Int();
  if (termination < 0 || termination >= static_cast<int64_t>(Termination::kCancelled)) return false;
  result.termination = static_cast<Termination>(termination);
  result.message = Explain(result.termination);
  result.iterations = Bounded(in.Int());
  result.restored_from = Bounded(in.Int());
  result.rough = in.Int() != 0;
  for (double* part : {&result.objective, &result.kkt_error, &result.constraint_violation, &result.wall_time_s,
                       &result.evaluation_time_s}) {
    *part = in.Double();
  }
  return in.AtEnd() && result.iterations >= 0 && result.wall_time_s >= 0;
}

std::string Encode(const StartedProgram& program) {
  const InteriorPointState& state = program.state;
  ByteWriter out;
  out.Put(kStarted);
  Put(program.fingerprint, &out);
  for (const int part : {state.iteration, state.tiny_steps, static_cast<int>(state.asked)}) {
    out.Put(static_cast<int64_t>(part));
  }
  out.Put(state.elapsed_s);
  PutMethod(state, &out);
  out.Put(static_cast<int64_t>(state.moved_bounds.size()));
  for (const BarrierProblem::MovedBound& bound : state.moved_bounds) {
    out.Put(static_cast<int64_t>(bound.unknown));
    out.Put(bound.lower);
    out.Put(bound.upper);
  }
  out.Put(static_cast<int64_t>(state.restoration ? 1 : 0));
  if (state.restoration) {
    PutMethod(*state.restoration, &out);
    const ElasticVariables& elastic = state.restoration->elastic;
    for (const VectorX* part : {&elastic.p, &elastic.n, &elastic.z_p, &elastic.z_n}) out.Put(*part);
  }
  return WithChecksum(out);
}

bool Decode(const std::string& bytes, StartedProgram* program) {
  ByteReader in(Checked(bytes));
  if (in.Int() != kStarted) return false;
  Get(&in, &program->fingerprint);
  InteriorPointState& state = program->state;
  state.iteration = Bounded(in.Int());
  state.tiny_steps = Bounded(in.Int());
  state.asked = in.Int() != 0;
  state.elapsed_s = in.Double();
  GetMethod(&in, &state);
  state.moved_bounds.clear();
  const int64_t moved = in.Int();
  for (int64_t i = 0; i < moved && in.ok(); ++i) {
    BarrierProblem::MovedBound bound;
    bound.unknown = Bounded(in.Int());
    bound.lower = in.Double();
    bound.upper = in.Double();
    state.moved_bounds.push_back(bound);
  }
  state.restoration.reset();
  if (in.Int() != 0) {
    GetMethod(&in, &state.restoration.emplace());
    ElasticVariables& elastic = state.restoration->elastic;
    for (VectorX* part : {&elastic.p, &elastic.n, &elastic.z_p, &elastic.z_n}) *part = in.Vector();
  }
  return in.AtEnd();
}

}  // namespace rollgait
