#ifndef ROLLGAIT_TESTS_SUPPORT_SCRAPE_H_
#define ROLLGAIT_TESTS_SUPPORT_SCRAPE_H_

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace rollgait {

// What a GET of /metrics at "127.0.0.1:PORT" answers, without the head; empty if nobody answers.
inline std::string Scrape(const std::string& address) {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) {
    const std::string request = "GET /metrics HTTP/1.0\r\n\r\n";
    if (write(fd, request.data(), request.size()) == static_cast<ssize_t>(request.size())) {
      char block[4096];
      for (ssize_t count; (count = read(fd, block, sizeof block)) > 0;)
        answer.append(block, static_cast<size_t>(count));
    }
  }
  close(fd);
  const size_t body = answer.find("\r\n\r\n");
  return body == std::string::npos ? "" : answer.substr(body + 4);
}

// The samples of a text in the Prometheus exposition format: "name{label=\"value\",...}" → value. Throws on a line that
// is none, and on a sample whose family was not announced by a # TYPE line.
inline std::map<std::string, double> ParseExposition(const std::string& text) {
  std::map<std::string, double> samples;
  std::map<std::string, std::string> types;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    if (line[0] == '#') {
      std::istringstream words(line);
      std::string mark, kind, name, type;
      words >> mark >> kind >> name >> type;
      if (kind == "TYPE") types[name] = type;
      continue;
    }
    const size_t space = line.rfind(' ');
    if (space == std::string::npos) throw std::runtime_error("no value: " + line);
    size_t used = 0;
    samples[line.substr(0, space)] = std::stod(line.substr(space + 1), &used);
    if (used != line.size() - space - 1) throw std::runtime_error("no number: " + line);
    std::string family = line.substr(0, line.find_first_of("{ "));
    for (const std::string suffix : {"_bucket", "_sum", "_count"}) {
      if (!types.contains(family) && family.ends_with(suffix)) family.resize(family.size() - suffix.size());
    }
    if (!types.contains(family)) throw std::runtime_error("no # TYPE before: " + line);
  }
  return samples;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_SCRAPE_H_
