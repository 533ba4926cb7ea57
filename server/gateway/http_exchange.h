// One request of HTTP and its answer, whoever reads and writes the bytes.
#ifndef ROLLGAIT_SERVER_GATEWAY_HTTP_EXCHANGE_H_
#define ROLLGAIT_SERVER_GATEWAY_HTTP_EXCHANGE_H_

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/base/door_headers.h"
#include "server/gateway/places.h"

namespace rollgait::server {

using HttpHeaders = std::vector<std::pair<std::string, std::string>>;

struct HttpRequest {
  std::string verb;                            // "GET"
  std::string uri;                             // as it came, with the query
  std::map<std::string, std::string> headers;  // names in lower case; only those of kHeadersRead
  std::string body;
  std::string peer;  // who is connected, as PeerKey says it
  Place place;       // of a long body, until what was made of it is gone, too

  // Empty: it has none.
  std::string Header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? "" : found->second;
  }
};

// What a request is asked for; a request that has one of them twice is refused.
inline constexpr const char* kHeadersRead[] = {"authorization", "content-type",  "content-length", "transfer-encoding",
                                               "origin",        "host",          "last-event-id",  "traceparent",
                                               kDoorPeer,       kDoorCertificate};

struct HttpResponse {
  int status = 200;
  HttpHeaders headers;
  std::string content_type;  // empty: no body
  std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
};

// Where the answer to one request goes: Send once, or Begin, Push any number of times, and End once; before them, while
// HttpService::Admit is asked, TakeBody. Any thread; after the client is gone calls have no effect.
class HttpAnswer {
 public:
  // Called in threads of the server, which they must not hold up; never while a call of this object is under way in the
  // same thread.
  struct Listener {
    std::function<void()> on_wait;    // HttpLimits::patience is over and nothing is answered yet
    std::function<void()> on_read;    // all that was pushed has been taken
    std::function<void()> on_slow;    // what was pushed was not taken in time
    std::function<void()> on_stop;    // the server stops: what has no end by itself should end now; once
    std::function<void()> on_closed;  // the client is gone, has everything, or waited in vain at a stop; last, once
  };
  virtual ~HttpAnswer() = default;
  // Before the first answer, after TakeBody once more. False: the client is gone already; nothing will be called.
  virtual bool Listen(Listener listener) = 0;
  // The long body may come; the request that has it will have `place`.
  virtual void TakeBody(Place place) = 0;
  virtual void Send(HttpResponse response) = 0;
  // Server-sent events follow.
  virtual void Begin(HttpHeaders headers) = 0;
  // Texts are taken in their order; who pushes waits for on_read before the next one, so that one at a time is held.
  virtual void Push(std::string text) = 0;
  virtual void End(std::string text) = 0;
};

// What an HttpServer serves. Called in its thread, which it must not hold up.
class HttpService {
 public:
  virtual ~HttpService() = default;
  // Headers of the answers that the server itself gives to `head`.
  virtual HttpHeaders HeadersFor(const HttpRequest& head) const = 0;
  // A long body will follow `head`: TakeBody or Send, in its own time.
  virtual void Admit(const HttpRequest& head, std::shared_ptr<HttpAnswer> answer) = 0;
  virtual void Handle(HttpRequest request, std::shared_ptr<HttpAnswer> answer) = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_HTTP_EXCHANGE_H_
