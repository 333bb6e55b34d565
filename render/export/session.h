#pragma once
/// A recording as it is exported: what was chosen of it, with names, and the oracle beside it.

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
  Recording recording;  ///< only the chosen range and views
  TimeRange range;
  Scene scene;  ///< as it was at first
  std::unique_ptr<RevisionHistory> revisions;
  std::optional<Oracle> oracle;      ///< empty: there are no errors; `lacking` says why
  std::vector<ExportBody> bodies;    ///< chosen ones that are shown at any time, by id
  std::map<PartId, std::string> of;  ///< their names
  /// Called by ForEachView with ticks done and in all.
  std::function<void(std::int64_t, std::int64_t)> progress = [](std::int64_t, std::int64_t) {};
  std::vector<std::string> lacking;  ///< what the log does not have, a line each

  double TickSeconds() const { return 1.0 / recording.room.tick_hz; }
  /// server, the player's name, or "peer 7" for a spectator. Different for different peers.
  std::string ViewName(int peer) const;
  /// The name of player or seat `index` of the scene.
  std::string PlayerName(int index) const;
  /// Of a part, whether it is a body's root or not; "part 7" if the scene has none of that id.
  std::string PartName(PartId part) const;
};

/// Of a body in a view.
struct ExportRow {
  const View* view = nullptr;
  std::size_t i = 0;  ///< index in the view
  PartId id = 0;
  std::optional<double> error_m;  ///< from the oracle's position, as error_rms_m of seam-measure
};

/// Reads the log. Throws OperatorError when it cannot be read, has no room, or lacks what was
/// chosen (with the nearest name). Damage is a line of `lacking`.
ExportSession LoadExport(const ExportOptions& options);

/// The chosen rows of one view, by body.
std::vector<ExportRow> RowsOf(const ExportSession& session, const View& view);
/// The chosen views, by tick, then by peer.
void ForEachView(const ExportSession& session, const std::function<void(const View&)>& take);

}  // namespace seam
