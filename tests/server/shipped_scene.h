#ifndef ROLLGAIT_TESTS_SERVER_SHIPPED_SCENE_H_
#define ROLLGAIT_TESTS_SERVER_SHIPPED_SCENE_H_

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "rollgait/v1/simulation.pb.h"

namespace rollgait::server {

// A file of scenes/, whose path the build passes as ROLLGAIT_SCENES.
inline v1::SimulationScene ReadShipped(const std::string& name) {
  std::ifstream file(std::string(ROLLGAIT_SCENES "/") + name);
  std::ostringstream text;
  text << file.rdbuf();
  v1::SimulationScene scene;
  const auto status = google::protobuf::util::JsonStringToMessage(text.str(), &scene);
  EXPECT_TRUE(status.ok()) << name << ": " << status.ToString();
  return scene;
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_SHIPPED_SCENE_H_
