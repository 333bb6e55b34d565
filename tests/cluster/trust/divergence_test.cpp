/// Where peers differ is on the bus, with the peer that knew less.

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "client/embed/cluster.h"
#include "common/codec/codec.h"
#include "common/measure/contents/divergence_table.h"
#include "common/record/recorder.h"
#include "tests/lab/attack/attack.h"

namespace seam {
namespace divergence_test {

class DivergenceRecorder : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView bytes) override {
    const AnyMessage any = Decode(bytes);
    if (const auto* told = std::get_if<Divergence>(&any)) all.push_back(*told);
  }
  std::vector<Divergence> all;
};

/// Greatest distance that a peer tells of, m, at ticks whose inputs it knew (or did not know).
float Greatest(const std::vector<Divergence>& all, int peer, bool known) {
  float greatest = 0;
  for (const Divergence& told : all) {
    for (std::size_t i = 0; told.peer == peer && i < told.body.size(); ++i) {
      if ((told.missing[i] == 0) == known) greatest = std::max(greatest, told.apart[i]);
    }
  }
  return greatest;
}

ClusterConfig Room(const std::string& impair, Recorder* recorder) {
  ClusterConfig config;
  config.scene = "crossing";
  config.impair = impair;
  config.drive = Drive::kBot;
  config.duration_s = 8;
  config.keep = false;
  config.recorder = recorder;
  return config;
}

TEST(DivergenceCluster, PeersThatKnowAllInputsDoNotDiffer) {
  DivergenceRecorder perfect, late;
  Cluster(Room("perfect", &perfect)).Run();
  Cluster(Room("4g", &late)).Run();
  for (const int peer : {0, 1, 2}) {
    EXPECT_LT(Greatest(perfect.all, peer, true), 0.02f) << peer;
    EXPECT_LT(Greatest(late.all, peer, true), 0.1f) << peer;
  }
}

TEST(DivergenceCluster, TheServerSaysWhereALieDiffers) {
  DivergenceRecorder recorder;
  const AttackOutcome outcome = RunAttack(Room("demo", &recorder), "x1.5");
  EXPECT_GT(outcome.lies, 10);
  EXPECT_GT(Greatest(recorder.all, 0, true), 0.2f);
  Recording recording;
  recording.divergences = recorder.all;
  const std::string text = FormatDivergences(recording, LoadScene("scenes/crossing.toml"));
  EXPECT_NE(text.find("server   peer 1   car "), std::string::npos) << text;
}

}  // namespace divergence_test
}  // namespace seam
