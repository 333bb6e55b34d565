#pragma once
/// The truth a recording is measured against: where every part is after every tick, while the
/// bodies that it belongs to come and go.

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
  /// A part's pose in its body's frame, or in the world; m, rad.
  struct Place {
    int body = -1;  ///< index into the span's ids; -1: anchored, -2: not there
    float x = 0, y = 0, angle = 0;
  };
  struct Bodies {
    std::vector<PartId> ids;    ///< of the moving assemblies, ascending
    std::vector<Place> places;  ///< by part
    std::vector<PartId> roots;  ///< by part: the assembly's id; -1: not there
  };
  /// From a row on the bodies are others.
  struct RevisionSpan {
    std::size_t first_row = 0;
    int edits = 0;  ///< how many of Oracle::edits were applied
    std::shared_ptr<const Bodies> bodies;
  };

  std::int64_t first_tick = 0;
  std::vector<PartId> ids;  ///< at first, ascending
  /// [tick - first_tick][index in the ids of that time]; empty for a tick that is not known.
  std::vector<std::vector<BodyState>> ticks;
  std::vector<RevisionSpan> spans;  ///< ascending; empty: `ids` for ever, other parts unknown
  std::vector<Edit> edits;          ///< that were applied, in order, with the oracle's own ids
  /// Parts from here on came at run time and may have another id in the recording.
  PartId inserted_from = std::numeric_limits<PartId>::max();
  std::map<PartId, PartId> own_id;  ///< of parts that came, by id in the recording
  /// Bodies of two players touched (by whose they are at tick 0: Part::owner, a player's vehicle,
  /// or in whose region). nullopt: not looked for; ComputeOracle does in scenes that expect it.
  std::optional<bool> contact;

  /// State of a part, by its id in the recording: the pose of the part, the velocity of the body
  /// it is in. nullopt when the tick or the part is not known, or it has left.
  std::optional<BodyState> At(std::int64_t tick, PartId part) const;
  /// Of the moving bodies in a row of ticks, in the oracle's own numbering.
  const std::vector<PartId>& IdsOf(std::size_t row) const;
  /// Whether the parts of the body that `part` is in were the same at both ticks.
  bool SameBody(std::int64_t tick_a, std::int64_t tick_b, PartId part) const;
  /// Whether all these parts are in one body.
  bool Together(std::int64_t tick, const std::vector<PartId>& parts) const;

  /// From `row` on the bodies are those of `revision`, after `applied` edits.
  void Begin(std::size_t row, const SceneRevision& revision, int applied);
  /// Learns by their names which parts that came at run time are which in `recording`. `scene`: as
  /// it was at first.
  void Identify(const Recording& recording, const Scene& scene);

 private:
  const RevisionSpan* SpanOf(std::size_t row) const;
  PartId OwnId(PartId part) const;
};

/// How far the floor's nudge moves one body, m; at least to the next float (8e-6 m at 100 m).
constexpr float kNudge = 1e-6f;
/// The same at the resolution of the wire, whose positions are whole 1/512 m: half of that.
constexpr float kWireNudge = 1.0f / 1024;

/// How the truth is simulated.
struct OracleOptions {
  int nudged_body = -1;   ///< an index into ids: moved by `nudge` m along x at the start, at
  float nudge = kNudge;   ///< least to the next float; -1: none
  int barrier_every = 0;  ///< World::Barrier() at tick 0 and after each that this divides; 0: never
};

/// Whether a method is judged by the oracle with barriers: one that goes back and steps again has a
/// barrier at every send tick, and rebuilding the world is a rounding of its own; so has mode
/// central where clients predict all. All others are judged by the one without.
bool JudgedByBarriers(const Room& room);
/// A barrier at every send tick of the room, whatever its method.
OracleOptions WithBarriers(const Room& room);
/// With or without, as JudgedByBarriers says.
OracleOptions JudgeOf(const Room& room);

/// Simulates the recording's scene alone from tick 0 to the recording's last tick, with the inputs
/// it recorded: each in the tick it names, axes held over ticks without one, buttons acting on the
/// tick they go down; and with the edits whose cause is outside the physics, each after its tick.
/// What physics itself breaks, bonds and inserts it finds by itself. Throws OperatorError when the
/// scene does not parse or the session is too long (kOracleStatesMax).
Oracle ComputeOracle(const Recording& recording, const OracleOptions& options = {});

/// How far two oracles of a recording are apart, m: RMS of the largest displacement of a point of a
/// body, over all bodies and the ticks that both have; the bodies are those of `b`.
double OracleDistance(const Recording& recording, const Oracle& a, const Oracle& b);

/// The oracle's own sensitivity: RMS distance in m between it and itself with one body nudged, the
/// median over at most `bodies` bodies, evenly chosen. Requires an oracle without barriers. No
/// method can be expected to be better: where the floor is a metre, errors of a metre say nothing.
double ErrorFloor(const Recording& recording, const Oracle& oracle, float nudge = kNudge,
                  int bodies = 7);

/// Most ticks times bodies that ComputeOracle keeps: 24 bytes each. Where bodies change, a table of
/// all parts counts as well.
constexpr std::int64_t kOracleStatesMax = 50'000'000;

/// Why a recording made in the room `truth` is no oracle of one made in `measured`, a line for each
/// reason: another mode than oracle, another scene, another tick rate. Empty: it is one.
std::vector<std::string> OracleMismatches(const Room& truth, const std::string& truth_path,
                                          const Room& measured, const std::string& path);
/// Throws OperatorError with all that OracleMismatches finds, in one line.
void RequireOracleOf(const Room& truth, const std::string& truth_path, const Room& measured,
                     const std::string& path);

/// The displayed path of peer 0 in a recording made with --mode oracle. Throws OperatorError for a
/// recording of another mode, or without views of peer 0. `measured`: the recording that it is to
/// be compared with, if that is another one.
Oracle OracleFromRecording(const Recording& recording, const Recording* measured = nullptr);

}  // namespace seam
