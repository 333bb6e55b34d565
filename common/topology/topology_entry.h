#pragma once
/// A world that has become by edits, as a list of entries that make it of its scene: what has left
/// is a number, what edits have moved is where it is. It is as long as what is there, however long
/// the room has run.

#include <array>
#include <cstdint>
#include <string>

namespace seam {

struct TopologyEntry {
  /// `joint`, `a`, `b`, `value` and `text` as said; what is not said is not looked at. The place of
  /// a kind is its number in messages.
  enum class Kind : std::int8_t {
    kParts = 1,      ///< there are `a` parts; those that are not known have left
    kJoints = 2,     ///< there are `joint` joints; likewise
    kBonds = 3,      ///< likewise, and the places are bonds'
    kInsert = 4,     ///< `text`, as InsertEdit
    kBlast = 5,      ///< value: x, y, radius, speed, as BlastEdit
    kRemove = 6,     ///< part `a` has left
    kFree = 7,       ///< part `a` is no longer anchored
    kBreak = 8,      ///< `joint` is gone
    kPlace = 9,      ///< part `a` is at x, y (m), angle (rad)
    kMeasured = 10,  ///< of the first `joint` joints, the lengths "as placed" are what they are now
    kBond = 11,      ///< `joint` is glue between `a` and `b`; value: strength (N), 1: grouped,
                     ///< 2: a grip, a hinge
    kEnds = 12,      ///< of `joint`: anchor a, anchor b (m), axis, turn (rad), length (m)
    kSeat = 13,      ///< seat `a` is player `b`'s, -1: nobody's
  };
  static constexpr std::size_t kKinds = 13, kValuesMax = 8;

  Kind kind = Kind::kParts;
  std::int32_t joint = -1;
  std::int32_t a = -1, b = -1;
  std::array<float, kValuesMax> value{};
  std::string text;
};

/// How many numbers an entry of a kind has.
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
