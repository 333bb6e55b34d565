#pragma once
/// The oracle: ground truth for measuring a recording. Gives the state of every part after every
/// tick, also where bodies change at run time.

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/record/recording.h"
#include "common/scene/scene.h"
#include "common/topology/edit.h"

namespace seam {

struct SceneRevision;

/// Poses of every moving body after every tick.
struct Oracle {
  /// A part's pose in its body's frame, or in the world if anchored; m, rad.
  struct Place {
    int body = -1;  ///< index into the span's ids; -1: anchored, -2: removed
    float x = 0, y = 0, angle = 0;
  };
  /// The bodies between two edits.
  struct Bodies {
    std::vector<PartId> ids;    ///< moving assemblies, ascending
    std::vector<Place> places;  ///< by part
    std::vector<PartId> roots;  ///< by part: the assembly's id; -1: removed
  };
  /// Rows with the same bodies, from `first_row` to the next span.
  struct RevisionSpan {
    std::size_t first_row = 0;
    int edits = 0;  ///< number of Oracle::edits that were applied
    std::shared_ptr<const Bodies> bodies;
  };

  std::int64_t first_tick = 0;
  std::vector<PartId> ids;  ///< moving bodies at first_tick, ascending
  /// [tick - first_tick][index in the ids of that time]; empty for a tick that is not known.
  std::vector<std::vector<BodyState>> ticks;
  std::vector<RevisionSpan> spans;  ///< ascending; empty: always `ids`, other parts unknown
  std::vector<Edit> edits;          ///< applied edits, in order, with the oracle's own ids
  std::vector<std::int64_t> edit_ticks;  ///< by edit: its tick; empty if unknown
  /// First id of the parts inserted at run time. Their ids in the recording may differ.
  PartId inserted_from = std::numeric_limits<PartId>::max();
  std::map<PartId, PartId> own_id;  ///< ids of parts inserted at run time, by id in the recording
  /// True if bodies of two players touched, with ownership as at tick 0 (FindOwners). nullopt: not
  /// determined; ComputeOracle does so in scenes that expect a contact.
  std::optional<bool> contact;

  /// Returns the state of a part, by its id in the recording: the pose of the part and the velocity
  /// of its body. nullopt when the tick or the part is unknown, or the part was removed.
  std::optional<BodyState> At(std::int64_t tick, PartId part) const;
  /// Returns the state of a part at a moment, in ticks: linear between two ticks, and that of the
  /// first tick before it. nullopt where one of the ticks is unknown.
  std::optional<BodyState> AtMoment(double moment, PartId part) const;
  /// Returns the ids of the moving bodies in a row of `ticks`, in the oracle's own numbering.
  const std::vector<PartId>& IdsOf(std::size_t row) const;
  /// True if the body of `part` had the same parts at both ticks.
  bool SameBody(std::int64_t tick_a, std::int64_t tick_b, PartId part) const;
  /// True if all these parts are in one body, or if the bodies of the tick are not known.
  bool Together(std::int64_t tick, const std::vector<PartId>& parts) const;

  /// Begins a span: from `row` on the bodies are those of `revision`, after `applied` edits.
  void Begin(std::size_t row, const SceneRevision& revision, int applied);
  /// Matches the parts inserted at run time with those of `recording`, by name. `scene`: without
  /// any edit.
  void Identify(const Recording& recording, const Scene& scene);

 private:
  const RevisionSpan* SpanOf(std::size_t row) const;
  PartId OwnId(PartId part) const;
};

/// Displacement of one body for the error floor, m; at least to the next float (8e-6 m at 100 m).
constexpr float kNudge = 1e-6f;
/// Like kNudge, at the resolution of the wire: half of its quantum of 1/512 m.
constexpr float kWireNudge = 1.0f / 1024;

/// Options of the oracle's simulation.
struct OracleOptions {
  int nudged_body = -1;   ///< index into ids: this body starts displaced by `nudge` m along x, at
  float nudge = kNudge;   ///< least to the next float; -1: none
  int barrier_every = 0;  ///< World::Barrier() at tick 0 and after each that this divides; 0: never
  bool barrier_after_edits = false;  ///< another where edits have changed bodies: see Replay
};

/// True if the room's method is compared with the oracle with barriers. A method that rolls back
/// has barriers at fixed ticks, as has mode central where clients predict all, and rebuilding
/// the world changes the rounding. All other methods are compared with the oracle without barriers.
bool JudgedByBarriers(const Room& room);
/// Returns options with the barriers of the room's peers, for any method.
OracleOptions WithBarriers(const Room& room);
/// Returns the options of the oracle for the room's method, by JudgedByBarriers.
OracleOptions JudgeOf(const Room& room);

/// Returns why no oracle can be computed: "the log begins at tick 180 of its session", or a room
/// that goes on with an earlier session; its inputs and edits before are not there. "" if one can.
std::string WhyNoOracle(const Recording& recording);

/// Throws OperatorError with WhyNoOracle.
void RequireBeginning(const Recording& recording);

/// Simulates the recording's scene in one world from tick 0 to the recording's last tick, with the
/// recorded inputs: each in the tick it names, axes held over ticks without one, buttons acting on
/// the tick they go down. Applies recorded edits with an external cause, each after its tick;
/// breaks, bonds and insertions by the physics are found by the simulation itself. Throws
/// OperatorError with WhyNoOracle, when the scene does not parse, or when the session is too long
/// (kOracleStatesMax).
Oracle ComputeOracle(const Recording& recording, const OracleOptions& options = {});

/// Returns the distance of two oracles of a recording, m: RMS of the largest displacement of a
/// point of a body, over the bodies of `b` and the ticks that both have.
double OracleDistance(const Recording& recording, const Oracle& a, const Oracle& b);

/// Returns the oracle's own sensitivity, m: RMS distance between the oracle and a run with one body
/// nudged, the median over at most `bodies` bodies, evenly chosen. Requires an oracle without
/// barriers. Hardly any method is better: where the floor is a metre, errors of a metre
/// say nothing.
double ErrorFloor(const Recording& recording, const Oracle& oracle, float nudge = kNudge,
                  int bodies = 7);

/// Greatest number of ticks times bodies that ComputeOracle keeps: 24 bytes each. Where bodies
/// change, a table of all parts counts as well.
constexpr std::int64_t kOracleStatesMax = 50'000'000;

/// Returns the reasons, a line each, why a recording made in the room `truth` is no oracle for one
/// made in `measured`: another mode than oracle, another scene, another tick rate. Empty if it is.
std::vector<std::string> OracleMismatches(const Room& truth, const std::string& truth_path,
                                          const Room& measured, const std::string& path);
/// Throws OperatorError with all mismatches in one line, if OracleMismatches finds any.
void RequireOracleOf(const Room& truth, const std::string& truth_path, const Room& measured,
                     const std::string& path);

/// Makes an oracle of the views of peer 0 in a recording made with --mode oracle. Throws
/// OperatorError for a recording of another mode, or without views of peer 0. `measured`: the
/// recording to be compared with the oracle, if it is another one.
Oracle OracleFromRecording(const Recording& recording, const Recording* measured = nullptr);

}  // namespace seam
