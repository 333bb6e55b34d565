#pragma once
/// Which bodies of a view are the viewer's own, and which are others'.

#include <map>
#include <utility>
#include <vector>

#include "common/measure/revisions.h"

namespace seam {

/// Peer p plays the scene's player p - 1: the server gives that place while it is free. A body is
/// the peer's own if its mechanism holds, after the view's edits, the player's `vehicle`, a part
/// whose `owner` is the player, a character of the player, or a part with a seat that the player
/// sits on. Who has authority does not count, so that all methods are judged by the same bodies.
/// The server, peer 0, has nothing of its own.
class OwnBodies {
 public:
  /// Without revisions nothing is known of the scene, and nothing is anybody's own. They must
  /// outlive this.
  OwnBodies(const Recording& recording, const RevisionHistory* revisions);
  /// Body `i` of the view.
  bool Has(const View& view, std::size_t i);
  /// The ids of the bodies that are the player's own by the scene, ascending.
  const std::vector<PartId>& ByScene(int edits, int player);

 private:
  struct Sitting {
    int number = 0;  // of the edit
    int seat = -1, player = -1;
  };
  std::vector<PartId> Find(int edits, int player) const;

  const RevisionHistory* revisions_;
  std::vector<Sitting> sittings_;
  std::map<std::pair<int, int>, std::vector<PartId>> own_;  // by edits and player
};

}  // namespace seam
