#ifndef ROLLGAIT_SERVER_LISTEN_MAIN_H_
#define ROLLGAIT_SERVER_LISTEN_MAIN_H_

#include <optional>
#include <string>

#include "server/access_main.h"

namespace rollgait::server {

// Where a server listens, and what stands in front of it: docs/explanation/door.md.
struct ListenFlags {
  std::string address = "127.0.0.1:50051";
  bool behind_door = false, without_door = false, insecure = false;
};
void AddListenFlags(CLI::App& app, ListenFlags& flags);

// Why a server must not listen so, and what to do; nullopt: it may.
std::optional<std::string> ListenObstacle(const ListenFlags& flags, const AccessFlags& access);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_LISTEN_MAIN_H_
