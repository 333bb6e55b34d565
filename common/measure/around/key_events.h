#pragma once
/// The events of a recording that pictures and curves are laid around.

#include <cstdint>
#include <optional>
#include <set>

#include "common/measure/oracle.h"
#include "common/record/recording.h"
#include "common/scene/scene.h"

namespace seam {

/// Change of speed from which an impact is strong, m/s.
constexpr float kStrongImpact = 3.0f;

/// Returns the tick of the collision that the scene watches, by the jump of velocity of the struck
/// assemblies in the oracle (nullptr: there is none); otherwise that of the first strong impact
/// between moving bodies; nullopt: neither was recorded.
std::optional<std::int64_t> ContactTick(const Recording& recording, const Scene& scene,
                                        const Oracle* oracle, const std::set<PartId>& struck);

/// Returns the assemblies that the scene's first watched collision strikes; empty without one.
std::set<PartId> StruckAssemblies(const Scene& scene);

struct FirstHandOver {
  std::int64_t tick = 0;
  PartId body = 0;  ///< assembly
};
/// Returns the first change of authority from one client to another: by the server's view, else by
/// the clients' views.
std::optional<FirstHandOver> FindFirstHandOver(const Recording& recording);

}  // namespace seam
