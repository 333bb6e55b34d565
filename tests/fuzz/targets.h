#pragma once
/// What reads from outside, each as a function of bytes: for libFuzzer (`make fuzz`), and for the
/// tests with its seeds. A target that takes bytes returns, whatever they are: Box2D's and our own
/// assertions, and the sanitizers, end the program.

#include <string>
#include <vector>

#include "common/base/bytes.h"

namespace seam {

struct FuzzTarget {
  const char* name;
  void (*take)(ByteView bytes);
  /// Returns valid inputs to begin with.
  std::vector<Bytes> (*seeds)();
};
const std::vector<FuzzTarget>& FuzzTargets();

/// True with SEAM_FUZZ_HOLE=1: each target then has a fault that was put there, behind valid
/// input, so that a fuzzer that gets nowhere shows.
bool HasHole();
/// Ends the program if HasHole() and `fallen`.
void Hole(bool fallen);

// The targets and their seeds. A file each, but for the short ones.

/// A message, as Decode gets it.
void TakeMessage(ByteView bytes);
std::vector<Bytes> MessageSeeds();
/// Datagrams of packed states and inputs, one after another: first byte 0 inputs, 1 states; then
/// its length in two bytes.
void TakePacked(ByteView bytes);
std::vector<Bytes> PackedSeeds();
/// What a joined client says in its sealed session, and a stranger beside it, while the room runs:
/// operations of session_target.cpp.
void TakeSession(ByteView bytes);
std::vector<Bytes> SessionSeeds();
/// A scene file, which then runs for 20 ticks.
void TakeScene(ByteView bytes);
std::vector<Bytes> SceneSeeds();
/// A script in a room that runs for 30 ticks.
void TakeScript(ByteView bytes);
std::vector<Bytes> ScriptSeeds();
/// A log file, read as seam-measure reads it.
void TakeLog(ByteView bytes);
std::vector<Bytes> LogSeeds();
/// A saved room, which then goes on for 5 ticks.
void TakeSnapshot(ByteView bytes);
std::vector<Bytes> SnapshotSeeds();

}  // namespace seam
