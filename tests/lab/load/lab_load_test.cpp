/// The load of a session is reported with the number of bodies that the server and the clients
/// simulate.

#include <gtest/gtest.h>

#include "tests/lab/load/load.h"

namespace seam {
namespace lab_load_test {

/// Four players, each with a box and two crates, far from each other.
std::string Apart(int server_follow) {
  std::string text =
      "duration = 3\nbuffer = 4\nfollow = 0\nserver_follow = " + std::to_string(server_follow) +
      "\n[[part]]\nname = \"ground\"\nchain = [[-50, 0], [450, 0]]\n";
  for (int p = 0; p < 4; ++p) {
    const std::string name(1, static_cast<char>('a' + p)), x = std::to_string(50 + 100 * p);
    const std::string from = std::to_string(100 * p), to = std::to_string(100 * p + 99);
    text += "[[player]]\nname = \"" + name + "\"\nregion = [[" + from + ", -100], [" + to +
            ", 100]]\nvehicle = \"box-" + name + "\"\n";
    text += "[[part]]\nname = \"box-" + name + "\"\nbox = [1, 1]\nvelocity = [4, 0]\nposition = [" +
            x + ", 5]\n";
    text += "[[part]]\nname = \"crate-" + name + "\"\nbox = [1, 1]\nposition = [" + x +
            ", 1]\nrepeat = {count = 2, step = [0, 1.5]}\n";
  }
  return text;
}

/// An observer of the server's view.
class Onlooker : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView) override {}
};

SessionLoad LoadOf(const std::string& mode, int server_follow, Recorder* onlooker = nullptr) {
  ClusterConfig config;
  config.recorder = onlooker;
  config.scene_text = Apart(server_follow);
  config.scene = "apart";
  config.mode = mode;
  return MeasureLoad(config);
}

TEST(LabLoad, ReportsTheLoadOfServerAndClients) {
  Onlooker onlooker;
  const SessionLoad relieved = LoadOf("buffer", 0), unseen = LoadOf("buffer", 256);
  const SessionLoad doubled = LoadOf("buffer", 256, &onlooker), central = LoadOf("central", 0);
  for (const SessionLoad& load : {relieved, unseen, doubled, central}) {
    EXPECT_EQ(load.players, 4);
    EXPECT_EQ(load.bodies, 12);
    EXPECT_GT(load.awake, 0);
    EXPECT_GT(load.server_us, 0);
    EXPECT_GT(load.client_us, 0);
    EXPECT_GT(load.to_client_kbps, 0);
    EXPECT_GT(load.from_client_kbps, 0);
  }
  EXPECT_EQ(relieved.held_share, 1);
  EXPECT_EQ(relieved.stepped, 0) << "clients have all of it, and the server steps nothing";
  EXPECT_EQ(unseen.stepped, 0) << "nobody sees what the server shows";
  EXPECT_EQ(doubled.stepped, 12);
  EXPECT_EQ(central.held_share, 0);
  EXPECT_EQ(central.stepped, 12);
  EXPECT_EQ(relieved.split_share, 0) << "nobody is near another";
}

}  // namespace lab_load_test
}  // namespace seam
