#ifndef ROLLGAIT_CORE_GAIT_MESH_SEQUENCE_H_
#define ROLLGAIT_CORE_GAIT_MESH_SEQUENCE_H_

#include <chrono>

#include "core/gait/gait_solver.h"
#include "core/ocp/problem.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

// What all nonlinear programs of one request share: observer and stop flag, the limits on iterations and time, and the
// numbering of the programs (IterationInfo::mesh). Starts its clock when it is made.
class SolveBudget {
 public:
  SolveBudget(const GaitSpec& spec, const SolveControl& control);

  // Solves the next program from `start`, as far as the budget goes, which is filled into the options.
  NlpResult Run(CollocationNlp& nlp, const NlpStart& start, NlpOptions options);
  double elapsed() const;  // s
  // False once the iterations or the time are used up, or the stop flag is set: what runs then ends at once.
  bool Left() const;

 private:
  const SolveControl& control_;
  std::chrono::steady_clock::time_point begin_;
  double max_wall_time_;
  int iterations_left_;
  int programs_ = 0;
};

bool Converged(Termination termination);

// True if the surfaces slip between nodes at a fair part of the speed of the motion: the optimiser has found a motion that
// exists on its mesh only.
bool IsArtefact(const GaitSpec& spec, const GaitSolution& solution);

// Solves the problem of the spec from a guess on `mesh`, and on finer meshes started from its solution until gap and slip
// between the nodes are within the bounds of the request. One entry of GaitSolution::meshes for each program.
GaitSolution SolveOnMeshes(const GaitSpec& spec, const OptimalControlProblem& problem, const MotionGuess& guess, Mesh mesh,
                           SolveBudget* budget);

// The same from the warm start of the spec. The first mesh is that of its trajectory, where gap and slip are bounded and it is
// nowhere coarser than what the request asks for.
GaitSolution SolveFromWarmStart(const GaitSpec& spec, const OptimalControlProblem& problem, SolveBudget* budget);

// The mesh that the request asks for.
Mesh RequestedMesh(const GaitSpec& spec);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MESH_SEQUENCE_H_
