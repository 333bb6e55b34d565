#pragma once
/// State of a script in a saved room: its table `room`, and its random numbers.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace seam {

class StateArchive;

/// A value in the table `room` of a script: a boolean, a number, a text, or a table of these.
struct ScriptValue {
  enum class Kind : std::int8_t { kBoolean, kInteger, kNumber, kText, kTable };
  Kind kind = Kind::kTable;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;
  std::string text;
  /// Keys and values; keys are integers or texts, each once: first the integers, ascending, then
  /// the texts.
  std::vector<std::pair<ScriptValue, ScriptValue>> entries;
};

struct SavedScript {
  using Random = std::array<std::uint64_t, 4>;
  bool stopped = false;
  std::string error;  ///< why it is stopped
  ScriptValue room;
  Random random{};  ///< state of math.random
};

/// Most bytes of a script's table `room`: of texts, and 16 for each key and each value.
constexpr std::size_t kScriptRoomBytesMax = 65536;
/// Most tables within each other.
constexpr int kScriptRoomDepthMax = 16;

void Persist(StateArchive& a, SavedScript* script);

}  // namespace seam
