/// Logs and measures in Python.

#include <algorithm>
#include <string>
#include <vector>

#include "client/python/log_arrays.h"
#include "client/python/module.h"
#include "common/record/damage.h"

namespace seam {
namespace {

namespace py = pybind11;

py::dict DictOf(const LogArrays& log, const BodyArrays& arrays) {
  const auto ticks = static_cast<py::ssize_t>(std::max<std::int64_t>(0, log.ticks()));
  const auto bodies = static_cast<py::ssize_t>(arrays.ids.size());
  std::vector<std::string> names;
  for (const PartId id : arrays.ids) names.push_back(log.NameOf(id));
  py::dict dict;
  dict["ids"] = ArrayOf(arrays.ids, {bodies});
  dict["names"] = names;
  dict["poses"] = ArrayOf(arrays.poses, {ticks, bodies, 3});
  dict["velocities"] = ArrayOf(arrays.velocities, {ticks, bodies, 3});
  dict["ages"] = ArrayOf(arrays.ages, {ticks, bodies});
  dict["authority"] = ArrayOf(arrays.authority, {ticks, bodies});
  if (!arrays.errors.empty()) dict["errors"] = ArrayOf(arrays.errors, {ticks, bodies});
  return dict;
}

py::dict InputsOf(const LogArrays& log, int player) {
  std::vector<std::int64_t> ticks;
  std::vector<std::int8_t> drive, lift;
  std::vector<std::int16_t> buttons;
  const auto found = log.recording().inputs.find(player);
  if (found != log.recording().inputs.end()) {
    for (const auto& [first, piece] : found->second) {
      for (std::size_t i = 0; i < piece.drive.size(); ++i) {
        const std::int64_t tick = first + static_cast<std::int64_t>(i);
        if (!ticks.empty() && tick <= ticks.back()) continue;  // sent again
        ticks.push_back(tick);
        drive.push_back(piece.drive[i]);
        lift.push_back(piece.lift[i]);
        buttons.push_back(piece.buttons[i]);
      }
    }
  }
  const auto count = static_cast<py::ssize_t>(ticks.size());
  py::dict dict;
  dict["tick"] = ArrayOf(ticks, {count});
  dict["drive"] = ArrayOf(drive, {count});
  dict["lift"] = ArrayOf(lift, {count});
  dict["buttons"] = ArrayOf(buttons, {count});
  return dict;
}

py::dict RoomOf(const LogArrays& log) {
  const Room& room = log.recording().room;
  std::vector<std::string> players;
  for (const Player& player : log.scene().players) players.push_back(player.name);
  std::vector<int> peers;
  for (const auto& [peer, views] : log.recording().views) peers.push_back(peer);
  py::dict dict;
  dict["scene"] = room.scene_name;
  dict["scene_text"] = room.scene_text;
  dict["mode"] = room.mode;
  dict["reconcile"] = room.reconcile;
  dict["predict"] = room.predict;
  dict["impair"] = room.impair;
  dict["seed"] = room.seed;
  dict["tick_hz"] = room.tick_hz;
  dict["players"] = players;
  dict["peers"] = peers;
  dict["first_tick"] = log.recording().first_tick;
  dict["last_tick"] = log.recording().last_tick;
  dict["missing"] = log.recording().bus_gaps;
  dict["damaged_bytes"] = log.recording().skipped_bytes;
  dict["damage"] = DamageLines(log.recording());
  return dict;
}

}  // namespace

py::dict MeasuresDict(const Measures& m, const std::string& valid) {
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
  dict["seen"] = m.seen;
  dict["error_rms_m"] = m.error_rms_m;
  dict["error_p95_m"] = m.error_p95_m;
  dict["error_max_m"] = m.error_max_m;
  dict["error_rms_rad"] = m.error_rms_rad;
  dict["shown_error_rms_m"] = m.shown_error_rms_m;
  dict["stutter_mps2"] = m.stutter_mps2;
  dict["stutter_shown_mps2"] = m.stutter_shown_mps2;
  dict["backsteps"] = m.backsteps;
  dict["rebound"] = m.rebound;
  dict["overlap_p99_m"] = m.overlap_p99_m;
  dict["penetration_m"] = m.penetration_m;
  dict["joint_drift_m"] = m.joint_drift_m;
  dict["handovers"] = m.handovers;
  dict["handover_jump_m"] = m.handover_jump_m;
  dict["inputs_late"] = m.inputs_late;
  dict["bytes_per_s"] = m.bytes_per_s;
  dict["cpu_us_per_s"] = m.cpu_us_per_s;
  return dict;
}

void AddLog(py::module_& module) {
  py::class_<LogArrays>(module, "Log")
      .def(py::init<const std::string&, const std::string&, const std::string&>(), py::arg("path"),
           py::arg("room"), py::arg("session"), py::call_guard<py::gil_scoped_release>())
      .def("room", &RoomOf)
      .def("inputs", &InputsOf, py::arg("player"))
      .def(
          "view",
          [](LogArrays& log, int peer, bool errors) {
            BodyArrays arrays;
            {
              const py::gil_scoped_release release;
              arrays = log.View(peer, errors);
            }
            return DictOf(log, arrays);
          },
          py::arg("peer"), py::arg("errors"))
      .def("oracle",
           [](LogArrays& log) {
             BodyArrays arrays;
             {
               const py::gil_scoped_release release;
               arrays = log.OracleBodies();
             }
             return DictOf(log, arrays);
           })
      .def("measure", [](LogArrays& log) {
        std::string valid;
        Measures measures;
        {
          const py::gil_scoped_release release;
          measures = log.MeasureAll(&valid);
        }
        return MeasuresDict(measures, valid);
      });
}

}  // namespace seam
