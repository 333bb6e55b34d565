#pragma once
/// Edits: changes of a world at run time besides motion, of its parts and of its joints. The
/// authority proposes, the server orders, and every peer applies the same edits in the same order;
/// so all peers have the same assemblies with the same roots.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "common/scene/types.h"

namespace seam {

/// Removes a joint. If it is glue or a weld, its assembly falls apart.
struct BreakEdit {
  std::int32_t joint = -1;  ///< index into Scene::joints
};

/// Cause of a bond between parts; kGrip: a hand holds a part.
enum class BondCause : std::int8_t { kGiven = -1, kConnectors = 0, kGroup = 1, kGrip = 2 };

/// Makes `b` rigid with `a` by a glue joint. With kGrip instead, the hand `b` holds `a` by a hinge
/// at `position` in the frame of `a` (grip.h), and the angle is 0.
struct BondEdit {
  PartId a = -1, b = -1;
  Vec2 position{0, 0};  ///< m, of `b` in the frame of `a`
  float angle = 0;      ///< rad, of `b` against `a`
  float strength = 0;   ///< N; 0: unbreakable
  BondCause cause = BondCause::kGiven;
};

/// Adds [[part]]s and [[joint]]s, written as in a scene file.
struct InsertEdit {
  std::string text;  ///< at most kEditTextMax bytes
};

/// Removes a part and all its joints.
struct RemoveEdit {
  PartId part = -1;
  bool left_bounds = false;  ///< reason: the part was outside the scene's bounds
};

/// Makes an anchored part movable.
struct FreeEdit {
  PartId part = -1;
};

/// Applies an impulse to the assembly of a part; the composition stays the same. An active
/// character may go limp: because of the impulse's size (docs/scenes.md), or as `limp` says.
struct PushEdit {
  PartId part = -1;
  Vec2 impulse{0, 0};  ///< N s, at the assembly's centre of mass
  float turn = 0;      ///< N m s
  float limp = 0;      ///< s for which the part's character is limp; below 0: ends the limpness
};

/// Value of PushEdit::limp, s: limp until another push ends it.
constexpr float kLimpUntilReleased = 1e9f;

/// Puts a player into a seat; the player then drives everything that the seat drives.
struct SeatEdit {
  std::int32_t seat = -1;    ///< index into Scene::seats
  std::int32_t player = -1;  ///< index into Scene::players; -1: empties the seat
};

/// Sets featherweight bricks free, throws them outwards and pushes bodies within sight of the
/// blast.
struct BlastEdit {
  Vec2 centre{0, 0};  ///< m
  float radius = 0;   ///< m: acts on brick centres within, and on bodies that reach into it
  float speed = 0;    ///< m/s of bricks in the centre, falling to 0 at the radius
  float impulse = 0;  ///< N s for each metre of silhouette in the centre, falling likewise
};

/// The index of a kind in the variant is its number in messages.
using AnyEdit = std::variant<std::monostate, BreakEdit, BondEdit, InsertEdit, RemoveEdit, FreeEdit,
                             PushEdit, SeatEdit, BlastEdit>;
constexpr std::int8_t kEditKindMax = std::variant_size_v<AnyEdit> - 1;

/// Cause of an edit. An oracle finds edits by physics itself; it receives the rest.
enum class EditCause : std::int8_t { kPhysics = 0, kOutside = 1 };

struct Edit {
  Edit() = default;  ///< changes nothing
  explicit Edit(AnyEdit edit, EditCause why = EditCause::kPhysics);

  AnyEdit what;
  EditCause cause = EditCause::kPhysics;

  /// Returns the edit as a `Kind`; nullptr if it is of another kind.
  template <class Kind>
  const Kind* As() const {
    return std::get_if<Kind>(&what);
  }
  template <class Kind>
  Kind* As() {
    return std::get_if<Kind>(&what);
  }
};

/// Subject of an edit: its index in AnyEdit, then joint (of a bond: cause), a, b; -1 where unused.
/// Two proposals with the same key are the same proposal.
using EditKey = std::array<std::int32_t, 4>;
EditKey KeyOf(const Edit& edit);

/// Set of functions, one per kind of edit: Overloaded{[](const BreakEdit&) ..., ...}.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

/// Bytes of InsertEdit::text: the message must fit one datagram.
constexpr std::size_t kEditTextMax = 900;

}  // namespace seam
