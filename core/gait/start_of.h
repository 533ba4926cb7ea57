#ifndef ROLLGAIT_CORE_GAIT_START_OF_H_
#define ROLLGAIT_CORE_GAIT_START_OF_H_

namespace rollgait {

// What a program starts from.
enum class StartOf {
  kGuess,         // a guess that knows nothing of the solution
  kNeighbour,     // the solution of a problem that differs a little: smoother powers, pairs of bodies that were free
  kSmoother,      // the solution of this problem with smoother powers, on a coarser mesh
  kOtherRequest,  // the solution of another request
  kFinerMesh,     // the solution of this problem on a coarser mesh
  kImage,         // the solution of half of this problem and its mirror image
  kSameMesh,      // the solution of this problem on a mesh whose intervals are nowhere longer
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_START_OF_H_
