/// Worlds and sessions in Python.

#include <string>
#include <vector>

#include "client/embed/local_session.h"
#include "client/embed/lone_world.h"
#include "client/python/module.h"
#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/measure/preconditions.h"
#include "common/measure/screen/response.h"

namespace seam {
namespace {

namespace py = pybind11;

/// Returns the states of bodies as arrays, with their names.
py::dict StateDict(const Scene& scene, std::int64_t tick, const std::vector<PartId>& ids,
                   const std::vector<float>& poses, const std::vector<float>& velocities) {
  std::vector<std::string> names;
  for (const PartId id : ids) names.push_back(scene.parts.at(static_cast<std::size_t>(id)).name);
  const auto bodies = static_cast<py::ssize_t>(ids.size());
  py::dict dict;
  dict["tick"] = tick;
  dict["ids"] = ArrayOf(ids, {bodies});
  dict["names"] = names;
  dict["poses"] = ArrayOf(poses, {bodies, 3});
  dict["velocities"] = ArrayOf(velocities, {bodies, 3});
  return dict;
}

py::dict WorldState(const LoneWorld& alone) {
  const World& world = alone.world();
  std::vector<PartId> ids;
  std::vector<float> poses, velocities;
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState s = world.Read(body);
    ids.push_back(world.id(body));
    poses.insert(poses.end(), {s.position.x(), s.position.y(), s.angle});
    velocities.insert(velocities.end(), {s.velocity.x(), s.velocity.y(), s.spin});
  }
  return StateDict(world.scene(), world.tick(), ids, poses, velocities);
}

py::dict SessionState(const LocalSession& session, int peer) {
  // The server's world has every part of which a peer can show a body.
  return ViewDict(session.server().replica().world().scene(), session.ViewOf(peer));
}

std::vector<std::string> PlayersOf(const Scene& scene) {
  std::vector<std::string> names;
  for (const Player& player : scene.players) names.push_back(player.name);
  return names;
}

void Require(const Status& status) {
  if (!status.ok()) throw OperatorError(status.why());
}

/// Returns the measures of all that a session has recorded.
py::dict MeasureSession(LocalSession& session) {
  Measures measures;
  std::string valid;
  {
    const py::gil_scoped_release release;
    const Recording& recording = session.recording();
    if (recording.views.empty()) {
      throw OperatorError("nothing to measure: a session with keep=True, after some ticks");
    }
    const Oracle oracle = ComputeOracle(recording, JudgeOf(recording.room));
    measures = Measure(recording, oracle);
    MeasureResponse(recording, oracle, &measures);
    valid = WhyNotValid(recording, oracle, measures);
  }
  return MeasuresDict(measures, valid);
}

void AddWorld(py::module_& module) {
  py::class_<LoneWorld>(module, "World")
      .def(py::init<const Scene&>(), py::arg("scene"))
      .def("reset", &LoneWorld::Reset)
      .def("step", &LoneWorld::Step, py::arg("ticks"), py::call_guard<py::gil_scoped_release>())
      .def(
          "input",
          [](LoneWorld& world, int player, int drive, int lift, int buttons) {
            Require(world.SetInput(player, InputOf(drive, lift, buttons)));
          },
          py::arg("player"), py::arg("drive"), py::arg("lift"), py::arg("buttons"))
      .def(
          "write",
          [](LoneWorld& world, PartId id, const std::vector<float>& pose,
             const std::vector<float>& velocity) {
            if (pose.size() != 3 || velocity.size() != 3) {
              throw OperatorError("a pose is x, y, angle; a velocity is vx, vy, spin");
            }
            BodyState state;
            state.position = {pose[0], pose[1]};
            state.angle = pose[2];
            state.velocity = {velocity[0], velocity[1]};
            state.spin = velocity[2];
            Require(world.Write(id, state));
          },
          py::arg("id"), py::arg("pose"), py::arg("velocity"))
      .def("save",
           [](LoneWorld& world) {
             const Bytes bytes = world.Save();
             return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
           })
      .def(
          "load",
          [](LoneWorld& world, const std::string& bytes) { Require(world.Load(TextBytes(bytes))); },
          py::arg("bytes"))
      .def("state", &WorldState)
      .def("energy", [](const LoneWorld& world) { return world.world().Energy(); });
}

void AddSession(py::module_& module) {
  py::class_<LocalSession>(module, "Session")
      .def(py::init([](const Scene& scene, const std::string& mode, const std::string& reconcile,
                       const std::string& predict, const std::string& impair, std::int64_t seed,
                       int send_hz, const std::string& drive, const std::string& record, bool force,
                       bool keep) {
             LocalSessionConfig config;
             config.mode = mode;
             config.reconcile = reconcile;
             config.predict = predict;
             config.impair = impair;
             config.seed = seed;
             config.send_hz = send_hz;
             config.drive = drive;
             config.record = record;
             config.force = force;
             config.keep = keep;
             return std::make_unique<LocalSession>(scene, config);
           }),
           py::arg("scene"), py::kw_only(), py::arg("mode"), py::arg("reconcile"),
           py::arg("predict"), py::arg("impair"), py::arg("seed"), py::arg("send_hz"),
           py::arg("drive"), py::arg("record"), py::arg("force"), py::arg("keep"))
      .def("run_to", &LocalSession::RunToTick, py::arg("tick"),
           py::call_guard<py::gil_scoped_release>())
      .def("tick", &LocalSession::tick)
      .def(
          "input",
          [](LocalSession& session, int player, int drive, int lift, int buttons) {
            session.SetInput(player, InputOf(drive, lift, buttons));
          },
          py::arg("player"), py::arg("drive"), py::arg("lift"), py::arg("buttons"))
      .def("state", &SessionState, py::arg("peer"))
      .def("flush", &LocalSession::Flush)
      .def("measure", &MeasureSession);
}

}  // namespace

py::dict ViewDict(const Scene& scene, const View& view) {
  std::vector<float> poses, velocities;
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    poses.insert(poses.end(), {view.x[i], view.y[i], view.angle[i]});
    velocities.insert(velocities.end(), {view.vx[i], view.vy[i], view.spin[i]});
  }
  return StateDict(scene, view.tick, view.id, poses, velocities);
}

Input InputOf(int drive, int lift, int buttons) {
  const auto axis = [](int value) { return value >= -127 && value <= 127; };
  if (!axis(drive) || !axis(lift)) throw OperatorError("drive and lift are from -1 to 1");
  if (buttons < 0 || buttons > 0x7fff) throw OperatorError("buttons are numbers from 0 to 14");
  return {static_cast<std::int8_t>(drive), static_cast<std::int8_t>(lift),
          static_cast<std::int16_t>(buttons)};
}

void AddPlay(py::module_& module) {
  py::class_<Scene>(module, "Scene")
      .def_readonly("name", &Scene::name)
      .def_readonly("title", &Scene::title)
      .def_readonly("duration_s", &Scene::duration_s)
      .def_property_readonly("tick_hz", [](const Scene& scene) { return scene.solver.tick_hz; })
      .def_property_readonly("players", &PlayersOf);
  module.def("parse_scene", &ParseScene, py::arg("text"), py::arg("name"));
  module.def(
      "load_scene", [](const std::string& word) { return LoadScene(FindScene(word)); },
      py::arg("word"));
  AddWorld(module);
  AddSession(module);
}

}  // namespace seam
