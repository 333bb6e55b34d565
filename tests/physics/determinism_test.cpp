/// The determinism contract: the same scene and inputs give the same bits, in any world, process
/// and build. tests/physics/golden_hashes.txt holds what every build must compute; after a change
/// that is meant to change behaviour, rewrite it with
///   SEAM_GOLDEN=write build/release/seam-tests --gtest_filter='Determinism.*'
/// look at the difference, and say in the commit message which hash changed and why.
/// SEAM_GOLDEN_FILE names another file (tests/hashes.sh).

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include "tests/support/scripted_world.h"

namespace seam {
namespace determinism_test {

constexpr const char* kScenes[] = {"crossing", "wall",    "stack",   "cradle",  "relay",
                                   "harbour",  "regatta", "skyline", "titanic", "gluehouse",
                                   "headon",   "rally",   "seesaw",  "scrum",   "heap",
                                   "train",    "gas",     "derby",   "relay8"};
/// Scenes that are also computed with soft contacts.
constexpr const char* kSoftScenes[] = {"stack", "wall", "heap", "crossing", "gas", "pile"};

std::string GoldenFile() {
  const char* other = std::getenv("SEAM_GOLDEN_FILE");
  return other != nullptr ? other : "tests/physics/golden_hashes.txt";
}
constexpr std::int64_t kTicks = 600, kHardTicks = 120;

/// Hashes after every tick, so that a failure says when two runs part.
std::vector<std::uint64_t> Hashes(ScriptedWorld& run, std::int64_t ticks) {
  std::vector<std::uint64_t> hashes;
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    run.Step();
    hashes.push_back(run.world.Hash());
  }
  return hashes;
}

std::vector<std::uint64_t> Hashes(const std::string& scene) {
  ScriptedWorld run(scene);
  return Hashes(run, kTicks);
}

/// The first tick at which two runs differ; -1 if they do not.
std::int64_t FirstDifference(const std::vector<std::uint64_t>& a,
                             const std::vector<std::uint64_t>& b) {
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    if (a[i] != b[i]) return static_cast<std::int64_t>(i) + 1;
  }
  return a.size() == b.size() ? -1 : 0;
}

TEST(Determinism, TheSameRunTwiceGivesTheSameBits) {
  for (const char* scene : kScenes) {
    EXPECT_EQ(FirstDifference(Hashes(scene), Hashes(scene)), -1) << scene;
  }
}

TEST(Determinism, WorldsSteppedInTurnAreIndependent) {
  for (const char* scene : kScenes) {
    const std::vector<std::uint64_t> alone = Hashes(scene);
    ScriptedWorld one(scene);
    ScriptedWorld late(scene);
    std::vector<std::uint64_t> of_one, of_late;
    // The second begins 100 ticks after the first, and bits of memory come and go between.
    for (std::int64_t tick = 0; tick < kTicks + 100; ++tick) {
      const auto litter = std::make_unique<char[]>(static_cast<std::size_t>(16 + 37 * (tick % 50)));
      litter[0] = 1;
      if (tick < kTicks) of_one.push_back(Hashes(one, 1)[0]);
      if (tick >= 100) of_late.push_back(Hashes(late, 1)[0]);
    }
    EXPECT_EQ(FirstDifference(alone, of_one), -1) << scene;
    EXPECT_EQ(FirstDifference(alone, of_late), -1) << scene;
  }
}

TEST(Determinism, AnotherProcessComputesTheSameBits) {
  for (const char* scene : kScenes) {
    int fds[2];
    ASSERT_EQ(pipe(fds), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const std::uint64_t hash = Hashes(scene).back();
      const bool sent = write(fds[1], &hash, sizeof hash) == sizeof hash;
      _exit(sent ? 0 : 1);
    }
    close(fds[1]);
    std::uint64_t theirs = 0;
    const ssize_t bytes = read(fds[0], &theirs, sizeof theirs);
    close(fds[0]);
    int status = -1;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0) << scene;
    ASSERT_EQ(bytes, static_cast<ssize_t>(sizeof theirs)) << scene;
    EXPECT_EQ(theirs, Hashes(scene).back()) << scene;
  }
}

TEST(Determinism, TheHashSeesOneBitOfOneBody) {
  ScriptedWorld run("crossing");
  run.StepTo(10);
  const std::uint64_t before = run.world.Hash();
  BodyState state = run.world.Read(0);
  run.world.Write(0, state);
  EXPECT_EQ(run.world.Hash(), before);
  state.velocity.x() = std::nextafter(state.velocity.x(), 1000.0f);
  run.world.Write(0, state);
  EXPECT_NE(run.world.Hash(), before);
}

TEST(Determinism, EveryBuildComputesTheGoldenHashes) {
#if !defined(__x86_64__)
  GTEST_SKIP() << "the golden hashes are of amd64; elsewhere Debian's Box2D may fuse operations";
#endif
  std::map<std::string, std::string> computed;
  for (const auto& [folder, ticks] : {std::pair{"scenes", kTicks}, {"scenes/hard", kHardTicks}}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string path = entry.path().generic_string();
      ScriptedWorld run(LoadScene(path));
      char hash[24];
      std::snprintf(hash, sizeof hash, "%016" PRIx64, Hashes(run, ticks).back());
      computed[path.substr(std::string("scenes/").size())] = hash;
    }
  }
  for (const char* name : kSoftScenes) {
    Scene scene = LoadScene(std::string("scenes/") + name + ".toml");
    scene.solver.contacts = ContactSolving::kSoft;
    scene.solver.skin = 0.0025f;
    ScriptedWorld run(scene);
    char hash[24];
    std::snprintf(hash, sizeof hash, "%016" PRIx64, Hashes(run, kHardTicks).back());
    computed[std::string("soft/") + name + ".toml"] = hash;
  }
  const char* request = std::getenv("SEAM_GOLDEN");
  if (request != nullptr && std::string(request) == "write") {
    std::ofstream out(GoldenFile());
    out << "# World::Hash() of each scene with its scripts, alone, after " << kTicks
        << " ticks, in hard/ and with soft contacts in soft/ " << kHardTicks << ".\n";
    for (const auto& [scene, hash] : computed) out << scene << ' ' << hash << '\n';
    ASSERT_TRUE(out.good()) << "cannot write " << GoldenFile();
  }
  std::map<std::string, std::string> golden;
  std::ifstream in(GoldenFile());
  ASSERT_TRUE(in) << "cannot read " << GoldenFile();
  std::string line;
  std::getline(in, line);
  for (std::string scene, hash; in >> scene >> hash;) golden[scene] = hash;
  EXPECT_EQ(computed, golden) << "see the head of this file";
}

}  // namespace determinism_test
}  // namespace seam
