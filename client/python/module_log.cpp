/// Logs and measures in Python.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/python/guarded.h"
#include "client/python/log_arrays.h"
#include "client/python/module.h"
#include "common/record/damage.h"

namespace seam {
namespace {

namespace py = pybind11;

using Log = Guarded<LogArrays>;

/// The arrays of a log, with the names of their bodies.
struct NamedArrays {
  NamedArrays(const LogArrays& log, BodyArrays of) : arrays(std::move(of)) {
    ticks = static_cast<py::ssize_t>(std::max<std::int64_t>(0, log.ticks()));
    for (const PartId id : arrays.ids) names.push_back(log.NameOf(id));
  }
  BodyArrays arrays;
  std::vector<std::string> names;
  py::ssize_t ticks = 0;
};

py::dict DictOf(const NamedArrays& named) {
  const BodyArrays& arrays = named.arrays;
  const py::ssize_t ticks = named.ticks;
  const auto bodies = static_cast<py::ssize_t>(arrays.ids.size());
  py::dict dict;
  dict["ids"] = ArrayOf(arrays.ids, {bodies});
  dict["names"] = named.names;
  dict["poses"] = ArrayOf(arrays.poses, {ticks, bodies, 3});
  dict["velocities"] = ArrayOf(arrays.velocities, {ticks, bodies, 3});
  dict["ages"] = ArrayOf(arrays.ages, {ticks, bodies});
  dict["authority"] = ArrayOf(arrays.authority, {ticks, bodies});
  if (!arrays.errors.empty()) dict["errors"] = ArrayOf(arrays.errors, {ticks, bodies});
  return dict;
}

/// A player's inputs by tick, each once.
struct InputArrays {
  std::vector<std::int64_t> ticks;
  std::vector<std::int8_t> drive, lift;
  std::vector<std::int16_t> buttons;
};

InputArrays InputsIn(const LogArrays& log, int player) {
  InputArrays all;
  const auto found = log.recording().inputs.find(player);
  if (found == log.recording().inputs.end()) return all;
  for (const auto& [first, piece] : found->second) {
    for (std::size_t i = 0; i < piece.drive.size(); ++i) {
      const std::int64_t tick = first + static_cast<std::int64_t>(i);
      if (!all.ticks.empty() && tick <= all.ticks.back()) continue;  // sent again
      all.ticks.push_back(tick);
      all.drive.push_back(piece.drive[i]);
      all.lift.push_back(piece.lift[i]);
      all.buttons.push_back(piece.buttons[i]);
    }
  }
  return all;
}

py::dict InputsOf(Log& log, int player) {
  const InputArrays all = log.Quick([player](LogArrays& l) { return InputsIn(l, player); });
  const auto count = static_cast<py::ssize_t>(all.ticks.size());
  py::dict dict;
  dict["tick"] = ArrayOf(all.ticks, {count});
  dict["drive"] = ArrayOf(all.drive, {count});
  dict["lift"] = ArrayOf(all.lift, {count});
  dict["buttons"] = ArrayOf(all.buttons, {count});
  return dict;
}

/// What a log says of its session.
struct About {
  Room room;
  std::vector<std::string> players, damage;
  std::vector<int> peers;
  std::int64_t first_tick = 0, last_tick = 0, missing = 0, damaged_bytes = 0;
};

About AboutOf(const LogArrays& log) {
  const Recording& recording = log.recording();
  About about{recording.room,         {},
              DamageLines(recording), {},
              recording.first_tick,   recording.last_tick,
              recording.bus_gaps,     recording.skipped_bytes};
  for (const Player& player : log.scene().players) about.players.push_back(player.name);
  for (const auto& [peer, views] : recording.views) about.peers.push_back(peer);
  return about;
}

py::dict RoomOf(Log& log) {
  const About about = log.Quick([](const LogArrays& l) { return AboutOf(l); });
  py::dict dict;
  dict["scene"] = about.room.scene_name;
  dict["scene_text"] = about.room.scene_text;
  dict["mode"] = about.room.mode;
  dict["reconcile"] = about.room.reconcile;
  dict["predict"] = about.room.predict;
  dict["impair"] = about.room.impair;
  dict["seed"] = about.room.seed;
  dict["tick_hz"] = about.room.tick_hz;
  dict["players"] = about.players;
  dict["peers"] = about.peers;
  dict["first_tick"] = about.first_tick;
  dict["last_tick"] = about.last_tick;
  dict["missing"] = about.missing;
  dict["damaged_bytes"] = about.damaged_bytes;
  dict["damage"] = about.damage;
  return dict;
}

}  // namespace

py::dict MeasuresDict(const Measures& m, const std::string& valid) {
  // Like the table of seam-measure: without a compared pose there is no error to give.
  const auto given = [](auto value, bool applies) {
    return applies ? std::optional(value) : std::nullopt;
  };
  const auto compared = [&](auto value) { return given(value, m.compared > 0); };
  py::dict dict;
  dict["valid"] = valid.empty();
  dict["why_not_valid"] = valid;
  dict["compared"] = m.compared;
  dict["error_others_m"] = m.error_others_m;
  dict["error_own_m"] = m.error_own_m;
  dict["error_server_m"] = m.error_server_m;
  dict["error_served_m"] = m.error_served_m;
  dict["path_error_rms_m"] = m.path_error_rms_m;
  dict["view_age_ms"] = m.view_age_ms;
  dict["response_own_ms"] = m.response_own_ms;
  dict["response_server_ms"] = m.response_server_ms;
  dict["response_other_ms"] = m.response_other_ms;
  dict["seen"] = m.compared > 0 ? m.seen : std::nullopt;
  dict["error_rms_m"] = compared(m.error_rms_m);
  dict["error_p95_m"] = compared(m.error_p95_m);
  dict["error_max_m"] = compared(m.error_max_m);
  dict["error_rms_rad"] = compared(m.error_rms_rad);
  dict["shown_error_rms_m"] = compared(m.shown_error_rms_m);
  dict["stutter_mps2"] = compared(m.stutter_mps2);
  dict["stutter_shown_mps2"] = compared(m.stutter_shown_mps2);
  dict["backsteps"] = compared(m.backsteps);
  dict["rebound"] = m.rebound;
  dict["overlap_p99_m"] = m.overlap_p99_m;
  dict["penetration_m"] = m.penetration_m;
  dict["joint_drift_m"] = m.joint_drift_m;
  dict["handovers"] = m.handovers;
  dict["handover_jump_m"] = given(m.handover_jump_m, m.handovers > 0);
  dict["inputs_late"] = m.inputs_late;
  dict["bytes_per_s"] = given(m.bytes_per_s, m.bytes_per_s > 0);
  dict["cpu_us_per_s"] = given(m.cpu_us_per_s, m.cpu_us_per_s > 0);
  return dict;
}

void AddLog(py::module_& module) {
  py::class_<Log>(module, "Log")
      .def(py::init<const std::string&, const std::string&, const std::string&>(), py::arg("path"),
           py::arg("room"), py::arg("session"), py::call_guard<py::gil_scoped_release>())
      .def("room", &RoomOf)
      .def("inputs", &InputsOf, py::arg("player"))
      .def(
          "view",
          [](Log& log, int peer, bool errors) {
            return DictOf(log.Do(
                [peer, errors](LogArrays& l) { return NamedArrays(l, l.View(peer, errors)); }));
          },
          py::arg("peer"), py::arg("errors"))
      .def("oracle",
           [](Log& log) {
             return DictOf(log.Do([](LogArrays& l) { return NamedArrays(l, l.OracleBodies()); }));
           })
      .def("measure", [](Log& log) {
        std::string valid;
        const Measures measures = log.Do([&valid](LogArrays& l) { return l.MeasureAll(&valid); });
        return MeasuresDict(measures, valid);
      });
}

}  // namespace seam
