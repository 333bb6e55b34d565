#pragma once
/// A recording made ready for drawing: shapes by body, poses at any time, errors by peer.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/record/recording.h"
#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/stages/kinematic.h"
#include "common/sync/mode.h"
#include "common/topology/feather_store.h"
#include "render/canvas/shapes.h"

namespace seam {

/// A displayed body.
struct Shown {
  Pose pose;
  int role = kRoleRemote;
  int authority = 0;
};

/// Two neighbouring views of one peer and how far the moment lies between them.
struct Moment {
  const View* before = nullptr;  ///< nullptr: this peer showed nothing yet
  const View* after = nullptr;
  float blend = 0;  ///< 0 at before, 1 at after
  double tick = 0;  ///< what was asked for
};

/// Poses are interpolated between the views on either side, never extrapolated: where a view is
/// missing at the end, the last one stays.
class Playback {
 public:
  /// Without an oracle there are no ghosts and no errors. Parses recording.room.scene_text; throws
  /// OperatorError when that is no scene.
  Playback(Recording recording, std::optional<Oracle> oracle);
  /// The same for a scene that needs no parsing.
  Playback(Recording recording, Scene scene, std::optional<Oracle> oracle);
  /// Of a recording that still grows and that the caller owns. Its errors are not measured at
  /// once; MeasureTick adds them.
  Playback(const Recording* growing, std::optional<Oracle> oracle);

  const Recording& recording() const { return *recording_; }
  const Scene& scene() const { return scene_; }
  /// At first, before any edit.
  const std::vector<BodyShapes>& moving() const { return revisions_->first->moving; }
  const std::vector<BodyShapes>& anchored() const { return revisions_->first->anchored; }
  /// After so many edits of the recording.
  std::shared_ptr<const DrawnRevision> RevisionAfter(int edits) const;
  /// What the moment's view is made of.
  std::shared_ptr<const DrawnRevision> RevisionOf(const Moment& moment) const;
  /// Scene and composition of the same.
  std::shared_ptr<const SceneRevision> WorldOf(const Moment& moment) const;
  bool has_oracle() const { return oracle_.has_value(); }
  const Oracle& oracle() const { return *oracle_; }

  /// Nothing when the recording names one that we do not know.
  std::optional<Mode> mode() const { return FindMode(recording_->room.mode); }
  int tick_hz() const { return recording_->room.tick_hz; }
  /// The tick of a time; a whole number where rounding alone keeps it from one.
  double TickAt(double seconds) const;
  double first_s() const;
  double last_s() const;
  /// Peers that showed something, ascending.
  std::vector<int> peers() const;
  /// `peer` if it showed something, else the lowest that did, else -1.
  int PeerOr(int peer) const;
  /// The scene's player that a peer drives (by the authority over its vehicle), -1: none.
  int PlayerOf(int peer) const;
  /// Of the scene as it was at first; "" for what came later.
  const std::string& PartName(PartId part) const;
  /// By player, as the scene says them (common/scene/player_colours.h); empty where it says none.
  const std::vector<std::string>& player_colours() const { return player_colours_; }
  /// "server", "ann (peer 1)" or "peer 3".
  std::string PeerName(int peer) const;
  /// "buffer · retrospect", "strict", "oracle".
  std::string Label() const;

  Moment MomentAt(int peer, double tick) const;
  std::optional<Shown> Find(const Moment& moment, PartId id) const;
  /// Of any part.
  std::optional<Pose> Truth(PartId id, double tick) const;
  /// Where an anchored body is: at its start, unless it is kinematic.
  Pose Anchored(const BodyShapes& body, double tick) const;
  /// A part as shown, whichever body it is in.
  std::optional<Pose> FindPart(const Moment& moment, PartId part) const;
  /// How old what a peer's view shows of others is, on average over the recording, ms; empty
  /// without an oracle, and where nothing tells it (docs/metrics.md).
  std::optional<double> ViewAgeMs(int peer) const;

  /// RMS error of a peer's view at a tick, m; peer -1: of all views. NaN where the oracle or the
  /// views know nothing; empty without an oracle.
  const std::vector<double>& ErrorByTick(int peer) const;
  /// Tick of the first entry of ErrorByTick.
  std::int64_t ErrorFirstTick() const { return error_first_tick_; }
  std::optional<double> ErrorAt(int peer, double tick) const;
  /// Adds the errors of a tick that came in, live. Ticks must ascend; skipped ones are unknown.
  void MeasureTick(std::int64_t tick);
  /// Empty without an oracle.
  const std::optional<Measures>& measures() const { return measures_; }

 private:
  void Prepare();
  void MeasureErrors();
  bool Compared(int peer, std::int64_t tick) const;
  void Keep(int peer, const Measures& measures);

  std::shared_ptr<const Recording> recording_;
  Scene scene_;
  std::optional<Oracle> oracle_;
  /// Shapes by revision, a bounded number of them.
  struct KnownRevisions {
    std::size_t edits = 0;  // of the recording, when `all` was made
    std::unique_ptr<RevisionHistory> all;
    std::shared_ptr<const DrawnRevision> first;
    std::map<int, std::shared_ptr<const DrawnRevision>> drawn;  // by key
  };
  /// Of all edits heard so far.
  const RevisionHistory& AllRevisions() const;
  std::shared_ptr<const DrawnRevision> Drawn(
      const std::shared_ptr<const SceneRevision>& revision) const;
  std::shared_ptr<KnownRevisions> revisions_;
  std::shared_ptr<const FeatherStore> bricks_;  // before any edit
  std::vector<std::string> player_colours_;
  std::optional<ImposedMotions> imposed_;
  std::optional<Measures> measures_;
  std::map<int, std::vector<double>> errors_;  // by peer; -1: all
  std::map<int, double> view_ages_ms_;         // by peer
  std::int64_t error_first_tick_ = 0;
};

}  // namespace seam
