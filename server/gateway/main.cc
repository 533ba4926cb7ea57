// rollgait-gateway: HTTP/JSON with server-sent events in front of rollgaitd, for browsers and scripts.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>

#include "server/base/end_signals.h"
#include "server/base/listen_address.h"
#include "server/base/log_flags.h"
#include "server/base/memory_return.h"
#include "server/base/solver_build.h"
#include "server/gateway/gateway.h"
#include "server/gateway/health.h"
#include "server/gateway/http_server.h"

namespace rollgait::server {
namespace {

constexpr std::chrono::milliseconds kGrace{5'000};

struct Flags {
  std::string listen = "127.0.0.1:8080";
  GatewayOptions gateway;
  double call_time_s = 60, stream_time_s = 3600, read_time_s = 30;
  LogFlags log;
  bool openapi = false, health = false;
};

void AddFlags(CLI::App& app, Flags& flags) {
  app.add_option("--listen", flags.listen,
                 "HOST:PORT of the loopback interface, port 0: any free one; or unix:PATH; printed as "
                 "`rollgait-gateway listening on ...`")
      ->capture_default_str();
  app.add_option("--server", flags.gateway.server, "rollgaitd: HOST:PORT of the loopback interface, or unix:PATH")
      ->capture_default_str();
  app.add_flag("--behind-door", flags.gateway.behind_door,
               "The door of docs/explanation/door.md is in front and alone may reach --listen unix:PATH; it says who "
               "calls, and rollgaitd is told");
  app.add_option("--allow-origin", flags.gateway.origins,
                 "Let pages of this origin ask from a browser, for example https://lab.example; may be repeated; "
                 "default: none");
  app.add_option("--call-time", flags.call_time_s, "Seconds that a call with one answer may take")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  app.add_option("--stream-time", flags.stream_time_s, "Seconds that a stream of events may take")
      ->check(CLI::Range(1.0, 86400.0))
      ->capture_default_str();
  app.add_option("--read-time", flags.read_time_s,
                 "Seconds in which a client must take what is sent to it; longer answers have more, 128 kB a second")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  app.add_option("--max-streams", flags.gateway.streams, "Streams of events that are open at once")
      ->check(CLI::Range(1, 200))
      ->capture_default_str();
  app.add_option("--max-streams-per-peer", flags.gateway.streams_per_peer,
                 "Of them those of one address; 0: half of them")
      ->check(CLI::Range(0, 200))
      ->capture_default_str();
  app.add_flag("--health", flags.health,
               "Ask the gateway that listens at --listen whether it answers, and stop; exit code 0: it does");
  app.add_flag("--openapi", flags.openapi, "Print the OpenAPI document, which /v1/openapi.json is too, and stop");
  AddLogFlags(app, flags.log);
  app.set_version_flag("--version", RollgaitVersion());
}

bool IsUnix(const std::string& address) { return address.rfind("unix:", 0) == 0; }

// Why the gateway must not run so; empty: it may.
std::string Obstacle(const Flags& flags) {
  if (!IsLoopback(flags.listen)) {
    return "--listen " + flags.listen +
           " is not a loopback address, and the gateway speaks plain text: let the door "
           "listen there (docs/explanation/door.md) and give --listen unix:/run/rollgait/gateway.sock --behind-door";
  }
  if (!IsLoopback(flags.gateway.server)) {
    return "--server " + flags.gateway.server +
           " is not on this machine: the gateway would send tokens there in plain text";
  }
  if (flags.gateway.behind_door && !IsUnix(flags.listen)) {
    return "--behind-door needs --listen unix:/PATH, a socket that only the door can reach; --listen is " +
           flags.listen;
  }
  for (const std::string& origin : flags.gateway.origins) {
    const bool has_scheme = origin.rfind("http://", 0) == 0 || origin.rfind("https://", 0) == 0;
    if (!has_scheme || origin.find('/', 8) != std::string::npos ||
        origin.find_first_of(" \t\r\n*") != std::string::npos) {
      return "--allow-origin " + origin +
             ": an origin is http:// or https:// and a host, without a path, as browsers send it";
    }
  }
  return "";
}

int Serve(const Flags& flags, const sigset_t& end_signals) {
  GatewayOptions options = flags.gateway;
  options.names_loopback = !IsUnix(flags.listen);
  options.call_time = std::chrono::milliseconds(static_cast<int64_t>(1000 * flags.call_time_s));
  options.stream_time = std::chrono::milliseconds(static_cast<int64_t>(1000 * flags.stream_time_s));
  HttpLimits limits;
  limits.read_time = std::chrono::milliseconds(static_cast<int64_t>(1000 * flags.read_time_s));
  Gateway gateway(options);
  auto server = HttpServer::Start(flags.listen, limits, gateway);
  if (!server.ok()) {
    spdlog::critical("{}", server.error().message);
    return 1;
  }
  spdlog::info("serving {} on {}", options.server, server.value()->address());
  std::printf("rollgait-gateway listening on %s\n", server.value()->address().c_str());
  std::fflush(stdout);
  const MemoryReturn memory_return;
  int received = 0;
  sigwait(&end_signals, &received);
  spdlog::info("signal {}: stopping", received);
  server.value()->Stop(kGrace);
  spdlog::info("stopped");
  return 0;
}

int Main(int argc, char** argv) {
  Flags flags;
  CLI::App app("HTTP/JSON with server-sent events in front of rollgaitd, for browsers and scripts.",
               "rollgait-gateway");
  AddFlags(app, flags);
  CLI11_PARSE(app, argc, argv);
  if (flags.openapi) {
    std::fputs(OpenApiDocument().c_str(), stdout);
    return 0;
  }
  if (flags.health) {
    const Outcome<Done> health = AskForHealth(flags.listen);
    if (!health.ok()) std::fprintf(stderr, "%s\n", health.error().message.c_str());
    return health.ok() ? 0 : 1;
  }
  const sigset_t end_signals = BlockEndSignals();
  StartLogging(flags.log.Of("rollgait-gateway"));
  if (const std::string obstacle = Obstacle(flags); !obstacle.empty()) {
    spdlog::critical("{}", obstacle);
    return 1;
  }
  return Serve(flags, end_signals);
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) { return rollgait::server::Main(argc, argv); }
