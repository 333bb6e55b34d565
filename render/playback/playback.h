#pragma once
/// A recording prepared for drawing: shapes by body, poses at any time, errors by peer.

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
#include "common/sync/method.h"
#include "common/topology/feather_store.h"
#include "render/canvas/shapes.h"

namespace seam {

/// A displayed body.
struct Shown {
  Pose pose;
  int role = kRoleRemote;
  int authority = 0;
  double tick = 0;  ///< the tick whose pose is shown: that of the moment, less the show age
};

/// Two neighbouring views of one peer, and the position of the moment between them.
struct Moment {
  const View* before = nullptr;  ///< nullptr: this peer has no view yet
  const View* after = nullptr;
  float blend = 0;  ///< 0 at before, 1 at after
  double tick = 0;  ///< the requested tick
};

/// A recording with its scene, oracle and errors. Poses are interpolated between neighbouring
/// views, never extrapolated: after the last view, its poses stay.
class Playback {
 public:
  /// Without an oracle there are no ghosts and no errors. Parses recording.room.scene_text; throws
  /// OperatorError when that is no scene.
  Playback(Recording recording, std::optional<Oracle> oracle);
  /// Like the first constructor, with a parsed scene.
  Playback(Recording recording, Scene scene, std::optional<Oracle> oracle);
  /// For a recording that still grows and is owned by the caller. Errors are not measured at once;
  /// MeasureTick adds them.
  Playback(const Recording* growing, std::optional<Oracle> oracle);

  const Recording& recording() const { return *recording_; }
  const Scene& scene() const { return scene_; }
  /// Return the bodies before any edit.
  const std::vector<BodyShapes>& moving() const { return revisions_->first->moving; }
  const std::vector<BodyShapes>& anchored() const { return revisions_->first->anchored; }
  /// Returns the shapes after `edits` edits of the recording.
  std::shared_ptr<const DrawnRevision> RevisionAfter(int edits) const;
  /// Returns the shapes of the moment's view.
  std::shared_ptr<const DrawnRevision> RevisionOf(const Moment& moment) const;
  /// Returns scene and composition of the moment's view.
  std::shared_ptr<const SceneRevision> WorldOf(const Moment& moment) const;
  bool has_oracle() const { return oracle_.has_value(); }
  const Oracle& oracle() const { return *oracle_; }

  /// Returns the mode; nullopt for an unknown name.
  const Policy& policy() const { return PolicyOf(recording_->room); }
  int tick_hz() const { return recording_->room.tick_hz; }
  /// Returns the tick of a time; a value within rounding of a whole number becomes whole.
  double TickAt(double seconds) const;
  double first_s() const;
  double last_s() const;
  /// Returns the peers with views, ascending.
  std::vector<int> peers() const;
  /// Returns `peer` if it has views, else the lowest peer with views, else -1.
  int PeerOr(int peer) const;
  /// Returns the scene's player that a peer drives: by authority over the vehicle, else by the
  /// peer's number; -1: none.
  int PlayerOf(int peer) const;
  /// Returns a part's name; "" for a part inserted at run time.
  const std::string& PartName(PartId part) const;
  /// Returns the scene's colours by player (common/scene/player_colours.h); empty without any.
  const std::vector<std::string>& player_colours() const { return player_colours_; }
  /// Returns "server", "ann (peer 1)" or "peer 3".
  std::string PeerName(int peer) const;
  /// Returns "buffer · retrospect", "strict", "oracle".
  std::string Method() const;
  /// Returns the method, and what tells the run from others of it: "buffer · fade · seed 2".
  std::string Label() const { return Method() + (apart_.empty() ? "" : " · " + apart_); }
  /// See ApartOf; "" until it is set.
  const std::string& apart() const { return apart_; }
  void SetApart(const std::string& words) { apart_ = words; }

  Moment MomentAt(int peer, double tick) const;
  std::optional<Shown> Find(const Moment& moment, PartId id) const;
  /// Returns the oracle's pose of any part, interpolated between ticks. Views are compared with
  /// the truth of Shown::tick.
  std::optional<Pose> Truth(PartId id, double tick) const;
  /// Returns the pose of an anchored body: its start, unless it is kinematic.
  Pose Anchored(const BodyShapes& body, double tick) const;
  /// Returns the displayed pose of a part, whatever its body.
  std::optional<Pose> FindPart(const Moment& moment, PartId part) const;
  /// Returns the mean view age of a peer over the recording, ms; nullopt without an oracle or
  /// without a reliable age (view_age_ms in docs/metrics.md).
  std::optional<double> ViewAgeMs(int peer) const;

  /// Returns the RMS error of a peer's view by tick, m, against the oracle at the tick that is
  /// shown; peer -1: of all views. NaN where the oracle or the views lack the tick; empty without
  /// an oracle.
  const std::vector<double>& ErrorByTick(int peer) const;
  /// Returns the tick of the first entry of ErrorByTick.
  std::int64_t ErrorFirstTick() const { return error_first_tick_; }
  std::optional<double> ErrorAt(int peer, double tick) const;
  /// Adds the errors of a newly received tick. Ticks must ascend; skipped ones are unknown.
  void MeasureTick(std::int64_t tick);
  /// Returns nullopt without an oracle.
  const std::optional<Measures>& measures() const { return measures_; }

 private:
  void Prepare();
  void MeasureErrors();
  bool Compared(int peer, std::int64_t tick) const;
  void Keep(int peer, const Measures& measures);

  std::shared_ptr<const Recording> recording_;
  Scene scene_;
  std::string apart_;
  std::optional<Oracle> oracle_;
  /// Cache of shapes by revision, with a bounded size.
  struct KnownRevisions {
    std::size_t edits = 0;  // number of the recording's edits when `all` was made
    std::unique_ptr<RevisionHistory> all;
    std::shared_ptr<const DrawnRevision> first;
    std::map<int, std::shared_ptr<const DrawnRevision>> drawn;  // by key
  };
  /// Returns the history with all edits received so far.
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
