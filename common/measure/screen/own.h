#pragma once
/// Tells a player's own bodies in a view from those of other players.

#include <map>
#include <utility>
#include <vector>

#include "common/measure/revisions.h"

namespace seam {

/// Peer p plays the scene's player p - 1: the server gives that place while it is free. A body is
/// the peer's own if its mechanism holds, after the view's edits, the player's `vehicle`, a part
/// with the player as `owner`, a character of the player, or a part with a seat that the player
/// sits on. Authority does not count, so that all methods are compared by the same bodies. The
/// server, peer 0, has no bodies of its own.
class OwnBodies {
 public:
  /// `revisions`: must outlive this; nullptr: the scene is not known and no body has an owner.
  OwnBodies(const Recording& recording, const RevisionHistory* revisions);
  /// True if body `i` of the view is the viewer's own.
  bool Has(const View& view, std::size_t i);
  /// Returns the ids of the player's own bodies after `edits` edits, ascending.
  const std::vector<PartId>& ByScene(int edits, int player);

 private:
  struct Sitting {
    int number = 0;  // edit number
    int seat = -1, player = -1;
  };
  std::vector<PartId> Find(int edits, int player) const;

  const RevisionHistory* revisions_;
  std::vector<Sitting> sittings_;
  std::map<std::pair<int, int>, std::vector<PartId>> own_;  // by edits and player
};

}  // namespace seam
