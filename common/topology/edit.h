#pragma once
/// What may change in a world at run time besides motion: who is joined to whom, and what is there.
/// The authority proposes, the server orders, and every peer applies the same edits in the same
/// order; so that all have the same assemblies with the same roots.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "common/scene/types.h"

namespace seam {

/// A joint is gone; of glue or a weld: its assembly falls apart.
struct BreakEdit {
  std::int32_t joint = -1;  ///< index into Scene::joints
};

/// Why parts become rigid with each other; kGrip: why one holds the other.
enum class BondCause : std::int8_t { kGiven = -1, kConnectors = 0, kGroup = 1, kGrip = 2 };

/// `b` becomes rigid with `a`, by a glue joint. kGrip: the hand `b` holds `a` by a hinge, at
/// `position` in the frame of `a` (grip.h); the angle is 0.
struct BondEdit {
  PartId a = -1, b = -1;
  Vec2 position{0, 0};  ///< m, of `b` in the frame of `a`
  float angle = 0;      ///< rad, of `b` against `a`
  float strength = 0;   ///< N; 0: nothing breaks it
  BondCause cause = BondCause::kGiven;
};

/// [[part]]s and [[joint]]s as a scene writes them.
struct InsertEdit {
  std::string text;  ///< at most kEditTextMax bytes
};

/// A part leaves, and all its joints.
struct RemoveEdit {
  PartId part = -1;
  bool left_bounds = false;  ///< why: it was outside the scene's bounds
};

/// A part is no longer anchored.
struct FreeEdit {
  PartId part = -1;
};

/// An impulse on the assembly of a part; changes nobody's assembly. An active character may go limp
/// by it: by its size (docs/scenes.md), or because `limp` says so.
struct PushEdit {
  PartId part = -1;
  Vec2 impulse{0, 0};  ///< N s, at the assembly's centre of mass
  float turn = 0;      ///< N m s
  float limp = 0;      ///< s for which the part's character is limp; below 0: no longer
};

/// s of PushEdit::limp: until another one ends it.
constexpr float kLimpForGood = 1e9f;

/// A player drives what a seat drives.
struct SeatEdit {
  std::int32_t seat = -1;    ///< index into Scene::seats
  std::int32_t player = -1;  ///< index into Scene::players; -1: nobody
};

/// Featherweight bricks are set free and thrown outwards, and what the blast sees is pushed.
struct BlastEdit {
  Vec2 centre{0, 0};  ///< m
  float radius = 0;   ///< m: bricks whose middle is within it, and bodies that reach into it
  float speed = 0;    ///< m/s of bricks in the centre, falling to 0 at the radius
  float impulse = 0;  ///< N s for each metre of silhouette in the centre, falling likewise
};

/// The index of a kind in the variant is its number in messages.
using AnyEdit = std::variant<std::monostate, BreakEdit, BondEdit, InsertEdit, RemoveEdit, FreeEdit,
                             PushEdit, SeatEdit, BlastEdit>;
constexpr std::int8_t kEditKindMax = std::variant_size_v<AnyEdit> - 1;

/// What caused an edit. An oracle finds by itself what physics does; it is told the rest.
enum class EditCause : std::int8_t { kPhysics = 0, kOutside = 1 };

struct Edit {
  Edit() = default;  ///< changes nothing
  explicit Edit(AnyEdit edit, EditCause why = EditCause::kPhysics);

  AnyEdit what;
  EditCause cause = EditCause::kPhysics;

  /// The edit as the kind that it is; nullptr: it is another.
  template <class Kind>
  const Kind* As() const {
    return std::get_if<Kind>(&what);
  }
  template <class Kind>
  Kind* As() {
    return std::get_if<Kind>(&what);
  }
};

/// What an edit is about: its number in AnyEdit, then joint (of a bond: why), a, b; -1 where it has
/// none. Two proposals of one key are one.
using EditKey = std::array<std::int32_t, 4>;
EditKey KeyOf(const Edit& edit);

/// Calls what is written for the edit's kind: Overloaded{[](const BreakEdit&) ..., ...}.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

/// Bytes of InsertEdit::text: the message must fit one datagram.
constexpr std::size_t kEditTextMax = 900;

}  // namespace seam
