#pragma once
/// Notable moments of a recording: its main contact, its greatest error, its first hand-over.

#include <optional>
#include <set>
#include <vector>

#include "render/playback/playback.h"

namespace seam {

/// A time and the bodies involved (assembly ids); empty: all.
struct ShownMoment {
  double s = 0;
  std::set<PartId> bodies;
};

/// Returns the first watched collision (by the oracle's jump of velocity), else the first strong
/// impact between moving bodies; nullopt: nothing of that kind was recorded.
std::optional<ShownMoment> ContactMoment(const std::vector<Playback>& playbacks);

/// Returns the moment of the greatest error of all views, with the worst body; nullopt: no error or
/// no oracle.
std::optional<ShownMoment> WorstMoment(const std::vector<Playback>& playbacks);

/// Returns the first change of authority from one client to another: by the server's view, else by
/// the clients' views.
std::optional<ShownMoment> HandOverMoment(const std::vector<Playback>& playbacks);

/// Returns the struck assemblies of the scene's first watched collision; empty without one.
std::set<PartId> StruckBodies(const Playback& playback);

/// Returns the main contact, else the moment of the greatest error, else the middle.
ShownMoment MainMoment(const std::vector<Playback>& playbacks);

}  // namespace seam
