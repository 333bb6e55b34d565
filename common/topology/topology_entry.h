#pragma once
/// Entries that turn a scene into the current, edited topology: a removed part is only a count, a
/// moved part is a pose. The list grows with the existing parts, not with the age of the room.

#include <array>
#include <cstdint>
#include <string>

namespace seam {

struct TopologyEntry {
  /// Says which of `joint`, `a`, `b`, `value` and `text` are used; the rest is ignored. The value
  /// of a kind is its number in messages.
  enum class Kind : std::int8_t {
    kParts = 1,      ///< there have been `a` parts; those not yet known are removed ones
    kJoints = 2,     ///< there have been `joint` joints; unknown ones are removed ones
    kBonds = 3,      ///< like kJoints, and the unknown indices are for bonds
    kInsert = 4,     ///< `text`, as InsertEdit
    kBlast = 5,      ///< value: x, y, radius, speed, as BlastEdit
    kRemove = 6,     ///< part `a` is removed
    kFree = 7,       ///< part `a` is no longer anchored
    kBreak = 8,      ///< `joint` is removed
    kPlace = 9,      ///< part `a` is at x, y (m), angle (rad)
    kMeasured = 10,  ///< the first `joint` joints: a length "as placed" is fixed to the current one
    kBond = 11,      ///< `joint` is glue between `a` and `b`; value: strength (N), 1: grouped,
                     ///< 2: a grip, a hinge
    kEnds = 12,      ///< `joint`: anchor a, anchor b (m), axis, turn (rad), length (m)
    kSeat = 13,      ///< seat `a` is taken by player `b`; -1: empty
  };
  static constexpr std::size_t kKinds = 13, kValuesMax = 8;

  Kind kind = Kind::kParts;
  std::int32_t joint = -1;
  std::int32_t a = -1, b = -1;
  std::array<float, kValuesMax> value{};
  std::string text;
};

/// Returns how many numbers an entry of a kind has.
inline std::size_t ValuesOf(TopologyEntry::Kind kind) {
  switch (kind) {
    case TopologyEntry::Kind::kBlast: return 4;
    case TopologyEntry::Kind::kPlace: return 3;
    case TopologyEntry::Kind::kBond: return 2;
    case TopologyEntry::Kind::kEnds: return 8;
    default: return 0;
  }
}

}  // namespace seam
