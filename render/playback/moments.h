#pragma once
/// Moments of a recording that somebody wants to see: its main contact, when it was most wrong,
/// when authority changed hands.

#include <optional>
#include <set>
#include <vector>

#include "render/playback/playback.h"

namespace seam {

/// When, and which bodies it is about (assembly ids); empty: all.
struct ShownMoment {
  double s = 0;
  std::set<PartId> bodies;
};

/// When the first watched collision happens (by the oracle's jump of velocity), else the first
/// strong impact between things that move; nullopt: nothing of that kind was recorded.
std::optional<ShownMoment> ContactMoment(const std::vector<Playback>& playbacks);

/// When the views were most wrong, and the body that was; nullopt: never, or nobody knows.
std::optional<ShownMoment> WorstMoment(const std::vector<Playback>& playbacks);

/// The first change of authority from one client to another, as the server shows it.
std::optional<ShownMoment> HandOverMoment(const std::vector<Playback>& playbacks);

/// Assemblies that the scene's first watch looks at; empty without one.
std::set<PartId> StruckBodies(const Playback& playback);

/// The main contact, else the worst moment, else the middle.
ShownMoment MainMoment(const std::vector<Playback>& playbacks);

}  // namespace seam
