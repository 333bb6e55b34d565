/// The world in a terminal: bodies are dots in their holder's colour.

#include "client/terminal_view.h"

#include <gtest/gtest.h>

#include "tests/support/two_sides.h"

namespace seam {
namespace terminal_view_test {

std::string Stripped(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\033') {
      while (i < text.size() && text[i] != 'm' && text[i] != 'K') ++i;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

TEST(BrailleCanvas, DotsFollowUnicode) {
  BrailleCanvas canvas(2, 1);
  EXPECT_EQ(canvas.width(), 4);
  EXPECT_EQ(canvas.height(), 4);
  canvas.Dot(0, 0, 33);
  canvas.Dot(1, 3, 33);
  EXPECT_EQ(Stripped(canvas.Text()), "\u2881 \r\n");
  canvas.Dot(2, 0, 40);
  canvas.Dot(-1, 0, 40), canvas.Dot(4, 0, 40), canvas.Dot(0, 4, 40);  // outside
  EXPECT_EQ(Stripped(canvas.Text()), "\u2881\u2801\r\n");
  EXPECT_NE(canvas.Text().find("\033[38;5;40m"), std::string::npos);
}

TEST(BrailleCanvas, ALineOfAnyLengthIsCutAtTheRim) {
  BrailleCanvas canvas(3, 2);
  canvas.Line({-1e6f, 2.5f}, {1e6f, 2.5f}, 33);
  EXPECT_EQ(Stripped(canvas.Text()), "\u2824\u2824\u2824\r\n   \r\n");
  canvas.Line({-5, -5}, {-1, 100}, 33);  // passes beside it
  EXPECT_EQ(Stripped(canvas.Text()), "\u2824\u2824\u2824\r\n   \r\n");
}

TEST(TerminalView, ShowsTheOwnVehicleInTheMiddleInItsHoldersColour) {
  ClusterConfig config;
  config.scene = "crossing";
  Cluster cluster(config);
  cluster.RunToTick(60);
  BrailleCanvas canvas(80, 24);
  DrawInTerminal(*cluster.client(0), nullptr, &canvas);
  const std::string text = canvas.Text();
  EXPECT_NE(text.find("\033[38;5;" + std::to_string(TerminalColour(1)) + "m"), std::string::npos);
  BrailleCanvas other(80, 24);
  cluster.RunToTick(90);
  DrawInTerminal(*cluster.client(0), nullptr, &other);
  EXPECT_NE(text, other.Text()) << "it moves";
}

TEST(WatchOrPlay, AnUnknownNameIsFatalUnlessItOnlyWatches) {
  for (const bool watch : {false, true}) {
    ClusterConfig config;
    config.scene = "crossing";
    Cluster cluster(config);
    cluster.RunToTick(5);
    ClientConfig guest;
    guest.server = cluster.server_address();
    guest.name = "zoe";
    guest.watch = watch;
    auto endpoint = cluster.Attach({0x0a000001, 4000});
    OsEntropy entropy;
    MemoryRecorder recorder;
    Client client(guest, *endpoint, recorder, entropy);
    for (int i = 0; i < 300 && client.fatal().empty() && !client.running(); ++i) {
      client.Tick(cluster.now_us(), 0);
      cluster.RunToTick(6 + i);
    }
    if (watch) {
      EXPECT_TRUE(client.running()) << client.fatal();
    } else {
      EXPECT_EQ(client.fatal(),
                "there is no player \"zoe\" here; no player is free; --watch only looks on");
    }
  }
}

}  // namespace terminal_view_test
}  // namespace seam
