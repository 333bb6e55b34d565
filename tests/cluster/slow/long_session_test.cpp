/// A room that clients join and leave for a long time: its memory does not grow.

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/base/random.h"
#include "tests/support/soak.h"
#include "tests/support/soak/paired_boxes.h"

#ifdef __SANITIZE_ADDRESS__
// Declared in <sanitizer/allocator_interface.h>, which g++ 12 lacks.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#endif

namespace seam {
namespace long_session_test {

/// Bytes that are allocated now.
std::size_t HeapBytes() {
#ifdef __SANITIZE_ADDRESS__  // its allocator stands in for malloc's
  return __sanitizer_get_current_allocated_bytes();
#else
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#endif
}

/// The absent client returns and another leaves, `every_ticks` apart.
class ComingAndGoing {
 public:
  ComingAndGoing(Cluster& cluster, std::uint64_t seed) : cluster_(cluster), random_(seed) {}

  /// Runs half a minute: for 22 s clients join and leave, then all are present and calm down.
  void RunHalfMinute() {
    const std::int64_t begin = cluster_.server().tick();
    for (std::int64_t tick = begin + kEveryTicks; tick < begin + 22 * 60; tick += kEveryTicks) {
      cluster_.RunToTick(tick);
      Come();
      away_ =
          static_cast<int>(random_.Next() % static_cast<std::uint64_t>(cluster_.client_count()));
      if (random_.Chance(0.5)) {
        cluster_.Leave(away_);
      } else {
        cluster_.Kill(away_);
      }
      ++departures_;
    }
    Come();
    cluster_.RunToTick(begin + 30 * 60);
  }
  int departures() const { return departures_; }

 private:
  static constexpr std::int64_t kEveryTicks = 100;
  void Come() {
    if (away_ >= 0) cluster_.Revive(away_);
    away_ = -1;
  }

  Cluster& cluster_;
  Random random_;
  int away_ = -1;
  int departures_ = 0;
};

/// Bytes at the end of each half minute.
std::vector<std::size_t> RunFor(const std::string& scene, int minutes, int* departures) {
  ClusterConfig config;
  config.scene = scene;
  config.impair = "delay=40ms,jitter=10ms,loss=5%";
  config.drive = Drive::kBot;
  config.spectators = 2;
  config.keep = false;
  // A returning client has one of four addresses: the simulated network remembers each for good.
  Cluster* running = nullptr;
  std::uint16_t turn = 0;
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) {
    if (running == nullptr) return net;
    const auto port = static_cast<std::uint16_t>(30000 + 4 * client + ++turn % 4);
    return running->Attach(Address{0x7f000001, port});
  };
  Cluster cluster(config);
  running = &cluster;
  ComingAndGoing people(cluster, 1);
  std::vector<std::size_t> bytes;
  for (int i = 0; i < 2 * minutes; ++i) {
    people.RunHalfMinute();
    for (int c = 0; c < cluster.client_count(); ++c) {
      EXPECT_TRUE(cluster.client(c)->running())
          << scene << ", client " << c << ", half minute " << i;
    }
    bytes.push_back(HeapBytes());
    EXPECT_EQ(cluster.server().client_count(), cluster.client_count()) << "no session is left over";
    EXPECT_LE(cluster.server().accounts().size(), static_cast<std::size_t>(cluster.client_count()));
  }
  *departures = people.departures();
  return bytes;
}

/// Runs three minutes, or an hour: after the first sixth the allocated bytes stay within 2 %.
TEST(LongSessionCluster, MemoryIsFlatWhilePeopleComeAndGo) {
  const int minutes = Soak(3) > 3 ? 60 : 3;
  for (const char* scene : {"crossing"}) {
    SCOPED_TRACE(scene);
    int departures = 0;
    const std::vector<std::size_t> bytes = RunFor(scene, minutes, &departures);
    const auto sixth = static_cast<std::ptrdiff_t>(bytes.size() / 6);
    const auto middle = bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2);
    // Data in flight varies from moment to moment.
    const auto mean = [](auto from, auto to) {
      return std::accumulate(from, to, std::size_t{0}) / static_cast<std::size_t>(to - from);
    };
    const std::size_t early = mean(bytes.begin() + sixth, middle);
    const std::size_t late = mean(middle, bytes.end());
    ASSERT_GT(early, 0U) << "what is allocated can be read";
    std::printf("  %s: %d min, %d left and came back: %zu kB, then %zu kB\n", scene, minutes,
                departures, early / 1000, late / 1000);
    EXPECT_GT(departures, 10 * minutes);
    EXPECT_LT(static_cast<double>(late), 1.02 * static_cast<double>(early));
    if (std::getenv("SEAM_SOAK_ALL") == nullptr) continue;
    for (const std::size_t b : bytes) std::printf(" %zu", b / 1000);
    std::printf("\n");
  }
}

const std::string kPairs = std::string(R"(
duration = 60
gravity = [0, 0]
[[player]]
name = "ann"
[[player]]
name = "bob"
)") + kPairedBoxes;
constexpr PartId kFirst = 0;

/// 480 edits a second; bob is away for a while in every half minute. From 8192 edits on, of which
/// the server knows the compositions, nothing grows.
TEST(LongSessionCluster, MemoryIsFlatWhilePartsAreBondedAndBreak) {
  const int minutes = Soak(1) > 1 ? 60 : 1;
  ClusterConfig config;
  config.scene_text = kPairs;
  config.impair = "delay=20ms,loss=2%";
  config.drive = Drive::kNone;
  config.keep = false;
  Cluster cluster(config);
  cluster.RunToTick(60);
  std::vector<std::size_t> bytes;
  for (int i = 0; i < 4 * minutes; ++i) {
    BondAndBreak(&cluster, kFirst, 200);
    cluster.Kill(1);
    BondAndBreak(&cluster, kFirst, 100);
    cluster.Revive(1);
    cluster.RunToTick(cluster.server().tick() + 300);
    ASSERT_TRUE(cluster.client(1)->running());
    const World& world = cluster.server().replica().world();
    for (int c = 0; c < 2; ++c) {
      EXPECT_EQ(cluster.client(c)->replica()->world().composition().hash, world.composition().hash);
    }
    EXPECT_LE(world.scene().joints.size(), static_cast<std::size_t>(kPairCount));
    bytes.push_back(HeapBytes());
  }
  const int edits = cluster.server().replica().revision();
  EXPECT_EQ(edits, 4 * minutes * 300 * 2 * kPairCount);
  // The first quarter fills the histories.
  const std::size_t early = *std::min_element(bytes.begin() + minutes, bytes.begin() + 2 * minutes);
  const std::size_t late = *std::min_element(bytes.begin() + 2 * minutes, bytes.end());
  std::printf("  %d edits: %zu kB, then %zu kB\n", edits, early / 1000, late / 1000);
  EXPECT_LT(static_cast<double>(late), 1.02 * static_cast<double>(early));
}

}  // namespace long_session_test
}  // namespace seam
