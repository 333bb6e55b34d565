/// The fuzzing targets with their seeds, with damaged ones, and with those that were once found.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "common/base/plain_file.h"
#include "common/base/random.h"
#include "tests/fuzz/targets.h"
#include "tests/support/soak.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace fuzz_test {

class Fuzz : public ::testing::TestWithParam<FuzzTarget> {};

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, ::testing::ValuesIn(FuzzTargets()),
                         [](const auto& target) { return std::string(target.param.name); });

/// Changes, removes or repeats some bytes.
Bytes Damaged(Bytes bytes, Random* random) {
  for (std::uint64_t n = 1 + random->Next() % 4; n > 0 && !bytes.empty(); --n) {
    const auto at = static_cast<std::ptrdiff_t>(random->Next() % bytes.size());
    const auto place = bytes.begin() + at;
    switch (random->Next() % 4) {
      case 0: *place = static_cast<std::uint8_t>(random->Next()); break;
      case 1: *place ^= static_cast<std::uint8_t>(1 << random->Next() % 8); break;
      case 2: bytes.erase(place); break;
      default: bytes.insert(place, *place); break;
    }
  }
  return bytes;
}

TEST_P(Fuzz, SeedsAndDamagedSeedsAreTaken) {
  Random random(1);
  const std::vector<Bytes> seeds = GetParam().seeds();
  ASSERT_FALSE(seeds.empty());
  for (const Bytes& seed : seeds) {
    EXPECT_FALSE(seed.empty());
    GetParam().take(seed);
    const int rounds = Soak(40) / static_cast<int>(seeds.size()) + 1;
    for (int i = 0; i < rounds; ++i) GetParam().take(Damaged(seed, &random));
  }
}

TEST_P(Fuzz, InputsThatWereFoundOnceAreTaken) {
  const std::filesystem::path kept = Root() / "tests/fuzz/kept" / GetParam().name;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(kept, error)) {
    const std::string text = ReadPlainFile(entry.path().string(), 1 << 20);
    GetParam().take(Bytes(text.begin(), text.end()));
  }
}

}  // namespace fuzz_test
}  // namespace seam
