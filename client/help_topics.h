// What `rollgait help TOPIC` prints beside the help of the commands.
#ifndef ROLLGAIT_CLIENT_HELP_TOPICS_H_
#define ROLLGAIT_CLIENT_HELP_TOPICS_H_

#include <string>
#include <vector>

namespace rollgait::client {

struct HelpTopic {
  std::string name;   // "exit-codes"
  std::string title;  // a few words
  std::string text;   // lines, the last one ended
};

// exit-codes, settings, formats.
const std::vector<HelpTopic>& HelpTopics();

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_HELP_TOPICS_H_
