/// Every program that reads a recording reports each flipped bit.

#include <gtest/gtest.h>

#include <fstream>

#include "common/base/random.h"
#include "common/record/damage.h"
#include "tests/support/program.h"

namespace seam {
namespace damaged_log_test {

constexpr double kPatience = 120;

class DamagedLog : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.Write("arena.toml", R"(title = "Boxes"
[[player]]
name = "ann"
vehicle = "car"
[[part]]
name = "ground"
box = [80, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "car"
box = [2, 0.6]
position = [-5, 0.3]
velocity = [6, 0]
owner = "ann"
[[part]]
name = "crate"
box = [0.6, 0.6]
position = [0, 0.3]
repeat = {count = [2, 3], step = [0.7, 0.6]}
)");
    Program lab({BuiltProgram("seam-lab"), "run", folder_ / "arena.toml", "--impair", "demo",
                 "--duration", "2", "-o", folder_ / "whole.lcm"});
    ASSERT_TRUE(lab.Wait(kPatience));
    ASSERT_EQ(lab.status(), 0) << lab.Story();
    std::ifstream file(folder_ / "whole.lcm", std::ios::binary);
    whole_.assign(std::istreambuf_iterator<char>(file), {});
  }
  /// Writes the log with one bit flipped; 8 * byte + bit.
  std::string Flipped(std::size_t bit) const {
    std::string bytes = whole_;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    std::ofstream(folder_ / "flipped.lcm", std::ios::binary) << bytes;
    return folder_ / "flipped.lcm";
  }

  Workspace folder_;
  std::string whole_;
};

TEST_F(DamagedLog, EveryFlippedBitIsFound) {
  EXPECT_FALSE(IsDamaged(ReadRecording(folder_ / "whole.lcm")));
  Random random(11);
  int found = 0, times = 500;
  for (int i = 0; i < times; ++i) {
    const std::size_t bit = random.Next() % (8 * whole_.size());
    const Recording recording = ReadRecording(Flipped(bit));
    EXPECT_TRUE(IsDamaged(recording)) << "bit " << bit;
    EXPECT_FALSE(DamageLines(recording).empty()) << "bit " << bit;
    found += IsDamaged(recording) ? 1 : 0;
  }
  std::printf("%d of %d flipped bits reported; the log has %zu bytes\n", found, times,
              whole_.size());
}

TEST_F(DamagedLog, EveryReaderSaysSoAndEndsWithStatus1) {
  const std::vector<std::vector<std::string>> readers = {
      {"seam-measure"},
      {"seam-measure", "--list"},
      {"seam-export", "--json", "-o", folder_ / "out.json", "--force"},
      {"seam-export", "--csv", "-o", folder_ / "out.csv", "--force"},
      {"seam-render", "--sheet", "2", "--size", "320x240", "-o", folder_ / "out.png", "--force"},
      {"seam-render", "--page", "-o", folder_ / "out.html", "--force"},
      {"seam-log", "stats"},
      {"seam-lab", "first-divergence", folder_ / "whole.lcm"}};
  Random random(5);
  for (const auto& reader : readers) {
    for (const bool damaged : {false, true}) {
      std::vector<std::string> words = reader;
      words[0] = BuiltProgram(reader[0]);
      // A bit of the last half: of a header, a pose or a checksum; the scene is before.
      const std::size_t half = 4 * whole_.size();
      words.push_back(damaged ? Flipped(half + random.Next() % half) : folder_ / "whole.lcm");
      Program program(words);
      ASSERT_TRUE(program.Wait(kPatience)) << reader[0];
      EXPECT_EQ(program.status(), damaged ? 1 : 0) << program.Story();
      const bool named = program.errors().find("tick") != std::string::npos &&
                         program.errors().find("SEAM.main.") != std::string::npos;
      EXPECT_EQ(named, damaged) << program.Story();
    }
  }
}

}  // namespace damaged_log_test
}  // namespace seam
