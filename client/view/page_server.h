// Serves one page to the browsers of this machine.
#ifndef ROLLGAIT_CLIENT_VIEW_PAGE_SERVER_H_
#define ROLLGAIT_CLIENT_VIEW_PAGE_SERVER_H_

#include <functional>
#include <memory>
#include <string>

#include "client/view/live_feed.h"

namespace rollgait::client {

// Whether a request's Host is this machine's own at the port; clients leave port 80 out.
bool NamesServer(const std::string& host, int port);

// Listens on 127.0.0.1 and answers GET of http://127.0.0.1:PORT/TOKEN/ with the page, and of events below it with what
// the feed tells. TOKEN is 128 random bits, so that neither another user of the machine nor a page of another site
// reaches it; a Host that NamesServer does not know is refused (DNS rebinding). Eight connections are served at once,
// four of them streams; others wait, and further streams are refused. Other users of the machine can connect without
// the token, and so disturb the page by slow or long requests, though not read it. Threads of its own.
class PageServer {
 public:
  // Called for every request of the page, in any thread, with a nonce of its own: text of HTML.
  using MakePage = std::function<std::string(const std::string& nonce)>;

  // port 0: any free one. The feed outlives the server. Throws Failure(kUsage) if the port is in use or may not be
  // used.
  PageServer(int port, MakePage make_page, LiveFeed& feed);
  // Ends streams and connections, whatever their peers do.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  std::string url() const;
  // An address that leads to url() once, and to nothing then: for the arguments of a program, which other users of the
  // machine can read. Takes the place of the one before.
  std::string MakeUrlForOneUse();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_VIEW_PAGE_SERVER_H_
