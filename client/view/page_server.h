// Serves one page to the browsers of this machine.
#ifndef ROLLGAIT_CLIENT_VIEW_PAGE_SERVER_H_
#define ROLLGAIT_CLIENT_VIEW_PAGE_SERVER_H_

#include <functional>
#include <memory>
#include <string>

#include "client/view/live_feed.h"

namespace rollgait::client {

// Listens on 127.0.0.1 and answers GET of http://127.0.0.1:PORT/TOKEN/ with the page, and of events below it with what
// the feed tells. TOKEN is 128 random bits, so that neither another user of the machine nor a page of another site
// reaches it; a Host other than 127.0.0.1:PORT or localhost:PORT is refused (DNS rebinding). Eight connections are
// served at once, four of them streams; others wait, and further streams are refused. Threads of its own.
class PageServer {
 public:
  // Called for every request of the page, in any thread, with a nonce of its own: text of HTML.
  using MakePage = std::function<std::string(const std::string& nonce)>;

  // port 0: any free one. The feed outlives the server. Throws Failure(kUsage) if the port is in use or may not be
  // used.
  PageServer(int port, MakePage make_page, LiveFeed& feed);
  // Ends streams and connections.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  std::string url() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_VIEW_PAGE_SERVER_H_
