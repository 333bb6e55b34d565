#pragma once
/// The exported part of a recording, with names and the oracle.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/measure/oracle.h"
#include "common/measure/revisions.h"
#include "common/record/recording.h"
#include "render/export/options.h"

namespace seam {

struct ExportBody {
  PartId id = 0;
  std::string name;
};

struct ExportSession {
  Recording recording;  ///< only the selected range and views
  TimeRange range;
  Scene scene;  ///< without any edit
  std::unique_ptr<RevisionHistory> revisions;
  std::optional<Oracle> oracle;      ///< empty: there are no errors; `lacking` says why
  std::vector<ExportBody> bodies;    ///< selected bodies that are shown at any time, by id
  std::map<PartId, std::string> of;  ///< names of `bodies`
  /// Called by ForEachView with the number of finished ticks and of all ticks.
  std::function<void(std::int64_t, std::int64_t)> progress = [](std::int64_t, std::int64_t) {};
  bool damaged = false;              ///< see IsDamaged; `lacking` says where
  std::vector<std::string> lacking;  ///< missing contents of the log, a line each

  double TickSeconds() const { return 1.0 / recording.room.tick_hz; }
  /// Returns "server", the player's name, or "peer 7" for a spectator; unique for each peer.
  std::string ViewName(int peer) const;
  /// Returns the name of player `index` of the scene, or of a seat, numbered after the players.
  std::string PlayerName(int index) const;
  /// Returns the name of a part, root or not; "part 7" if the scene has none of that id.
  std::string PartName(PartId part) const;
};

/// One body in one view.
struct ExportRow {
  const View* view = nullptr;
  std::size_t i = 0;  ///< index in the view
  PartId id = 0;
  std::optional<double> error_m;  ///< from the oracle's position, as error_rms_m of seam-measure
};

/// Reads the log. Throws OperatorError when it cannot be read, has no room, or lacks a selected
/// body or view (with the nearest name). Damage is a line of `lacking`.
ExportSession LoadExport(const ExportOptions& options);

/// Returns the selected rows of one view, by body.
std::vector<ExportRow> RowsOf(const ExportSession& session, const View& view);
/// Visits the selected views, by tick, then by peer.
void ForEachView(const ExportSession& session, const std::function<void(const View&)>& take);

}  // namespace seam
