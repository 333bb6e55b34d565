/// A session has the same bytes on processors with and without fused multiply-adds.

#include <gtest/gtest.h>

#include <string>

#include "common/base/plain_file.h"
#include "tests/support/program.h"

namespace seam {
namespace numerics_test {

/// glibc's setting that hides these instructions from libm.
constexpr const char* kPlain = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2,-FMA4";

std::string LogOf(const std::string& scene, const Workspace& folder, const char* environment) {
  const std::string path = folder / "session.lcm";
  Program run({"env", environment, BuiltProgram("seam-lab"), "run", scene, "--drive", "bot",
               "--seed", "2", "--duration", "4", "--force", "-o", path});
  EXPECT_TRUE(run.Wait(60) && run.status() == 0) << run.Story();
  return ReadPlainFile(path, 1 << 26);
}

/// derby parted at tick 136 while the exact joints had libm's sines.
TEST(Numerics, SessionsAreTheSameWithoutFusedMultiplyAdds) {
  const Workspace folder;
  for (const char* scene : {"derby", "harbour"}) {
    const std::string fused = LogOf(scene, folder, "SEAM_NOTHING=1");
    EXPECT_GT(fused.size(), 10000u);
    EXPECT_TRUE(fused == LogOf(scene, folder, kPlain)) << scene;
  }
}

}  // namespace numerics_test
}  // namespace seam
