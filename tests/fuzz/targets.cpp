#include "tests/fuzz/targets.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace seam {

const std::vector<FuzzTarget>& FuzzTargets() {
  static const std::vector<FuzzTarget> targets = {
      {"message", TakeMessage, MessageSeeds},   {"packed", TakePacked, PackedSeeds},
      {"session", TakeSession, SessionSeeds},   {"scene", TakeScene, SceneSeeds},
      {"script", TakeScript, ScriptSeeds},      {"log", TakeLog, LogSeeds},
      {"snapshot", TakeSnapshot, SnapshotSeeds}};
  return targets;
}

bool HasHole() {
  static const char* const told = std::getenv("SEAM_FUZZ_HOLE");
  return told != nullptr && std::strcmp(told, "1") == 0;
}

void Hole(bool fallen) {
  if (!fallen || !HasHole()) return;
  std::fprintf(stderr, "the hole was found\n");
  std::abort();
}

}  // namespace seam
