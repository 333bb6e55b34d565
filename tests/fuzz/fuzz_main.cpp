/// seam-fuzz: libFuzzer's program with all targets; SEAM_FUZZ names one. `seam-fuzz seeds TARGET
/// FOLDER` writes the seeds instead of fuzzing. tests/fuzz/fuzz.sh runs it.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "tests/fuzz/targets.h"

namespace {

const seam::FuzzTarget* Find(const char* name) {
  for (const seam::FuzzTarget& target : seam::FuzzTargets()) {
    if (name != nullptr && std::strcmp(target.name, name) == 0) return &target;
  }
  std::fprintf(stderr, "seam-fuzz: SEAM_FUZZ is one of");
  for (const seam::FuzzTarget& target : seam::FuzzTargets()) {
    std::fprintf(stderr, " %s", target.name);
  }
  std::fprintf(stderr, "\n");
  std::exit(2);
}

const seam::FuzzTarget* g_target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const bool seeds = *argc == 4 && std::strcmp((*argv)[1], "seeds") == 0;
  g_target = Find(seeds ? (*argv)[2] : std::getenv("SEAM_FUZZ"));
  if (!seeds) return 0;
  int n = 0;
  for (const seam::Bytes& bytes : g_target->seeds()) {
    std::ofstream file(std::string((*argv)[3]) + "/seed-" + std::to_string(n++), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  g_target->take(seam::ByteView(data, size));
  return 0;
}
