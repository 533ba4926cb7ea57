#include "server/base/notify.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <filesystem>
#include <optional>
#include <string>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

bool Readable(const NotifyReceiver& receiver) {
  pollfd entry{receiver.fd(), POLLIN, 0};
  return poll(&entry, 1, 0) == 1;
}

TEST(NotifyTest, HintsArriveInOrderAndOnce) {
  const TemporaryDirectory directory;
  NotifyReceiver receiver = NotifyReceiver::Create(directory.path(), "a.sock").value();
  const NotifySender sender = NotifySender::Create(directory.path(), "a.sock").value();
  EXPECT_TRUE(receiver.Drain().empty());
  EXPECT_FALSE(Readable(receiver));
  EXPECT_TRUE(sender.Send("one"));
  EXPECT_TRUE(sender.Send("two"));
  EXPECT_TRUE(sender.Send("one"));
  EXPECT_TRUE(Readable(receiver));
  EXPECT_EQ(receiver.Drain(), (std::vector<std::string>{"one", "two"}));
  EXPECT_FALSE(Readable(receiver));
}

TEST(NotifyTest, SendingToNobodyOrToAFullSocketReturns) {
  const TemporaryDirectory directory;
  const NotifySender sender = NotifySender::Create(directory.path(), "a.sock").value();
  EXPECT_FALSE(sender.Send("early"));
  const NotifyReceiver receiver = NotifyReceiver::Create(directory.path(), "a.sock").value();
  bool refused = false;
  for (int i = 0; i < 100'000 && !refused; ++i) refused = !sender.Send("hint");
  EXPECT_TRUE(refused);
}

TEST(NotifyTest, TheNewestReceiverTakesOverAndTheOldOneLeavesItAlone) {
  const TemporaryDirectory directory;
  const NotifySender sender = NotifySender::Create(directory.path(), "a.sock").value();
  std::optional<NotifyReceiver> old_receiver = NotifyReceiver::Create(directory.path(), "a.sock").value();
  NotifyReceiver new_receiver = NotifyReceiver::Create(directory.path(), "a.sock").value();
  EXPECT_TRUE(sender.Send("x"));
  EXPECT_TRUE(old_receiver->Drain().empty());
  EXPECT_EQ(new_receiver.Drain().size(), 1u);
  old_receiver.reset();
  EXPECT_TRUE(sender.Send("y")) << "the socket of the new receiver is still there";
}

TEST(NotifyTest, LongDirectoriesWork) {
  const TemporaryDirectory directory;
  const std::string deep = directory.path() + "/" + std::string(200, 'd');
  std::filesystem::create_directory(deep);
  NotifyReceiver receiver = NotifyReceiver::Create(deep, "a.sock").value();
  EXPECT_TRUE(NotifySender::Create(deep, "a.sock").value().Send(std::string(1000, 'z')));
  EXPECT_EQ(receiver.Drain(), std::vector<std::string>{std::string(kNotifyMaxBytes, 'z')});
}

TEST(NotifyTest, AMissingDirectoryIsReported) {
  EXPECT_EQ(NotifyReceiver::Create("/no/such/directory", "a").error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(NotifySender::Create("/no/such/directory", "a").error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace rollgait::server
