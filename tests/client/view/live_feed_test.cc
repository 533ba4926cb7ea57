#include "client/view/live_feed.h"

#include <gtest/gtest.h>

#include <thread>

namespace rollgait::client {
namespace {

using std::chrono::milliseconds;

v1::Iteration Iteration(int index) {
  v1::Iteration iteration;
  iteration.set_index(index);
  iteration.set_objective(0.5);
  return iteration;
}

TEST(LiveFeedTest, TellsEachStreamEverythingOnce) {
  LiveFeed feed;
  LiveFeed::Position first, late;
  EXPECT_EQ(feed.Wait(&first, milliseconds(0)), "event: begin\ndata: null\n\n");
  EXPECT_EQ(feed.Wait(&first, milliseconds(0)), "") << "there is nothing new";
  feed.SetState("waits\nstill");
  feed.Add(Iteration(0));
  feed.Add(Iteration(1));
  const std::string events =
      "event: state\ndata: \"waits\\nstill\"\n\n"
      "event: iterations\ndata: [[0,0,0.5,0.0,0.0,0.0,0.0],[1,0,0.5,0.0,0.0,0.0,0.0]]\n\n";
  EXPECT_EQ(feed.Wait(&first, milliseconds(0)), events);
  EXPECT_EQ(feed.Wait(&late, milliseconds(0)), "event: begin\ndata: null\n\n" + events);
  feed.Add(Iteration(2));
  EXPECT_EQ(feed.Wait(&first, milliseconds(0)), "event: iterations\ndata: [[2,0,0.5,0.0,0.0,0.0,0.0]]\n\n");
}

TEST(LiveFeedTest, LeavesOutIteratesThatAStreamWasTooSlowFor) {
  LiveFeed feed;
  LiveFeed::Position position;
  feed.Wait(&position, milliseconds(0));
  for (int i = 0; i < 5; ++i) feed.ShowIterate({{"index", i}});
  EXPECT_EQ(feed.Wait(&position, milliseconds(0)), "event: iterate\ndata: {\"index\":4}\n\n");
  EXPECT_EQ(feed.Wait(&position, milliseconds(0)), "");
}

TEST(LiveFeedTest, WaitsForWhatComesAndTellsTheEndLast) {
  LiveFeed feed;
  LiveFeed::Position position;
  feed.Wait(&position, milliseconds(0));
  std::thread teller([&feed] {
    std::this_thread::sleep_for(milliseconds(30));
    feed.Add(Iteration(7));
    feed.End();
  });
  std::string events;
  while (!position.ended) events += feed.Wait(&position, std::chrono::seconds(30));
  teller.join();
  EXPECT_EQ(events,
            "event: iterations\ndata: [[7,0,0.5,0.0,0.0,0.0,0.0]]\n\n"
            "event: end\ndata: null\n\n");
}

}  // namespace
}  // namespace rollgait::client
