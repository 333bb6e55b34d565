#pragma once
/// What may change in a world at run time besides motion: who is joined to whom, and what is there.
/// The authority proposes, the server orders, and every peer applies the same edits in the same
/// order; so that all have the same assemblies with the same roots.

#include <cstdint>
#include <string>

#include "common/scene/types.h"

namespace seam {

enum class EditKind : std::int8_t {
  kNothing = 0,
  kBreak = 1,   ///< `joint` is gone; of glue or a weld: its assembly falls apart
  kBond = 2,    ///< `b` becomes rigid with `a`: a glue joint of strength `amount` (0: endless),
                ///< `b` at (x, y, angle) in the frame of `a`; `joint` is a BondKind
  kInsert = 3,  ///< the [[part]]s and [[joint]]s in `text`, as a scene writes them
  kRemove = 4,  ///< part `a` leaves, and all its joints
  kFree = 5,    ///< part `a` is no longer anchored
  kPush = 6,    ///< an impulse of (x, y) N s and `angle` N m s on the assembly of `a`, at its
                ///< centre of mass; changes nobody's assembly
  kSeat = 7,    ///< `player` (-1: nobody) drives what seat `a` drives
  kBlast = 8,   ///< featherweight parts within `amount` m of (x, y) are set free, thrown
                ///< outwards at `angle` m/s
};
constexpr std::int8_t kEditKindMax = 8;

/// Why parts become rigid with each other; in Edit::joint of a bond.
enum BondKind : std::int32_t { kBondGiven = -1, kBondConnectors = 0, kBondGroup = 1 };

/// Who is to blame. An oracle finds out by itself what physics does, and is told the rest.
enum class EditCause : std::int8_t { kPhysics = 0, kOutside = 1 };

struct Edit {
  EditKind kind = EditKind::kNothing;
  EditCause cause = EditCause::kPhysics;
  PartId a = -1, b = -1;
  std::int32_t joint = -1;  ///< index into Scene::joints; of a bond, its BondKind
  std::int32_t player = -1;
  float x = 0, y = 0, angle = 0;  ///< m, m, rad, or as the kind says
  float amount = 0;
  std::string text;  ///< kInsert; at most kEditTextMax bytes
};

/// Bytes of Edit::text: the message must fit one datagram.
constexpr std::size_t kEditTextMax = 900;

}  // namespace seam
