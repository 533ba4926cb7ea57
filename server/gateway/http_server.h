#ifndef ROLLGAIT_SERVER_GATEWAY_HTTP_SERVER_H_
#define ROLLGAIT_SERVER_GATEWAY_HTTP_SERVER_H_

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "server/base/outcome.h"
#include "server/base/request_limit.h"
#include "server/gateway/http_exchange.h"

namespace rollgait::server {

// What a peer may take of an HttpServer before it has shown a token.
struct HttpLimits {
  unsigned connections = 256;                   // more wait in the kernel
  unsigned connections_per_peer = 64;           // of an address; not of unix sockets, whose peer is the door
  size_t connection_memory = 64 << 10;          // request line and headers; more is answered with 414 or 431
  size_t body_bytes = kMaxRequestBytes;         // more is answered with 413
  size_t short_body_bytes = 64 << 10;           // longer ones come when HttpService::Admit lets them
  std::chrono::milliseconds head_time{10'000};  // until a request line and headers are here, and between requests
  std::chrono::milliseconds body_time{8'000};   // until a body is here, and a second more for each
  size_t body_bytes_per_s = 64'000;             // of it that have come
  std::chrono::milliseconds read_time{
      30'000};  // until a pushed text is taken: then on_slow, and once more: the connection is closed
  std::chrono::milliseconds patience{2'000};    // then on_wait
  std::chrono::milliseconds heartbeat{10'000};  // a stream that is silent so long gets a comment
};

// HTTP/1.1 on libmicrohttpd: one thread for all connections, none of which it waits for. Bodies have a Content-Length.
class HttpServer {
 public:
  // Binds `listen`, "HOST:PORT" with an IP address (port 0: any free one) or "unix:PATH" (mode 0660; a socket that
  // nobody listens on any more is replaced), and serves. The service outlives the server. kUnavailable if it cannot
  // be bound.
  static Outcome<std::unique_ptr<HttpServer>> Start(const std::string& listen, const HttpLimits& limits,
                                                    HttpService& service);
  virtual ~HttpServer() = default;
  // "HOST:PORT" with the port that was bound, or "unix:PATH".
  virtual const std::string& address() const = 0;
  // No new connections; on_stop of every answer; at most `grace` for requests that are here as a whole. Those that are
  // not answered by then get a 503.
  virtual void Stop(std::chrono::milliseconds grace) = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_HTTP_SERVER_H_
