// Which body, and where on it, the frames of an .osim file are.
#ifndef ROLLGAIT_CLIENT_IMPORT_OSIM_FRAMES_H_
#define ROLLGAIT_CLIENT_IMPORT_OSIM_FRAMES_H_

#include <map>
#include <string>
#include <vector>

#include "client/import/osim_values.h"

namespace rollgait::client {

struct OsimPlace {
  int link = -1;
  Pose pose{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};  // in its frame
};

class OsimFrames {
 public:
  // A body or the ground, and the frames among its components. Doubled names are for FinishTree to refuse.
  void AddBody(const OsimElement& body, const std::string& name, int link);

  // The frame of a path such as "/bodyset/tibia_r", "ground_offset" or "../femur_r/knee"; `own` are the
  // PhysicalOffsetFrames of the element that asks. Throws Failure(kUsage) for a path to nothing, and for
  // frames that are in each other.
  OsimPlace Find(const OsimElement& user, const std::string& path, const std::vector<OsimElement>& own) const {
    return Find(user, path, own, 0);
  }

 private:
  OsimPlace Find(const OsimElement& user, const std::string& path, const std::vector<OsimElement>& own,
                 int depth) const;

  std::map<std::string, int> bodies_;
  std::map<std::string, OsimPlace> components_;  // by "body/frame"
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_OSIM_FRAMES_H_
