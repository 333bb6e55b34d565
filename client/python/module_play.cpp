/// Worlds and sessions in Python.

#include <string>
#include <vector>

#include "client/embed/local_session.h"
#include "client/embed/lone_world.h"
#include "client/python/guarded.h"
#include "client/python/module.h"
#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/measure/preconditions.h"
#include "common/measure/screen/response.h"

namespace seam {
namespace {

namespace py = pybind11;

using OneWorld = Guarded<LoneWorld>;
using OneSession = Guarded<LocalSession>;

std::vector<std::string> NamesOf(const Scene& scene, const std::vector<PartId>& ids) {
  std::vector<std::string> names;
  for (const PartId id : ids) names.push_back(scene.parts.at(static_cast<std::size_t>(id)).name);
  return names;
}

Bodies WorldBodies(const World& world) {
  Bodies bodies;
  bodies.tick = world.tick();
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState s = world.Read(body);
    bodies.ids.push_back(world.id(body));
    bodies.poses.insert(bodies.poses.end(), {s.position.x(), s.position.y(), s.angle});
    bodies.velocities.insert(bodies.velocities.end(), {s.velocity.x(), s.velocity.y(), s.spin});
  }
  bodies.names = NamesOf(world.scene(), bodies.ids);
  return bodies;
}

Bodies SessionBodies(const LocalSession& session, int peer) {
  // The server's world has every part of which a peer can show a body.
  return BodiesOf(session.server().replica().world().scene(), session.ViewOf(peer));
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
Measures MeasureSession(LocalSession& session, std::string* valid) {
  const Recording& recording = session.recording();
  if (recording.views.empty()) {
    throw OperatorError("nothing to measure: a session with keep=True, after some ticks");
  }
  const Oracle oracle = ComputeOracle(recording, JudgeOf(recording.room));
  Measures measures = Measure(recording, oracle);
  MeasureResponse(recording, oracle, &measures);
  *valid = WhyNotValid(recording, oracle, measures);
  return measures;
}

void AddWorld(py::module_& module) {
  py::class_<OneWorld>(module, "World")
      .def(py::init<const Scene&>(), py::arg("scene"))
      .def("reset", [](OneWorld& world) { world.Quick([](LoneWorld& w) { w.Reset(); }); })
      .def(
          "step",
          [](OneWorld& world, int ticks) { world.Do([ticks](LoneWorld& w) { w.Step(ticks); }); },
          py::arg("ticks"))
      .def(
          "input",
          [](OneWorld& world, int player, int drive, int lift, int buttons) {
            const Input input = InputOf(drive, lift, buttons);
            Require(world.Quick([&](LoneWorld& w) { return w.SetInput(player, input); }));
          },
          py::arg("player"), py::arg("drive"), py::arg("lift"), py::arg("buttons"))
      .def(
          "write",
          [](OneWorld& world, PartId id, const std::vector<float>& pose,
             const std::vector<float>& velocity) {
            if (pose.size() != 3 || velocity.size() != 3) {
              throw OperatorError("a pose is x, y, angle; a velocity is vx, vy, spin");
            }
            BodyState state;
            state.position = {pose[0], pose[1]};
            state.angle = pose[2];
            state.velocity = {velocity[0], velocity[1]};
            state.spin = velocity[2];
            Require(world.Quick([&](LoneWorld& w) { return w.Write(id, state); }));
          },
          py::arg("id"), py::arg("pose"), py::arg("velocity"))
      .def("save",
           [](OneWorld& world) {
             const Bytes bytes = world.Quick([](LoneWorld& w) { return w.Save(); });
             return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
           })
      .def(
          "load",
          [](OneWorld& world, const std::string& bytes) {
            Require(world.Quick([&](LoneWorld& w) { return w.Load(TextBytes(bytes)); }));
          },
          py::arg("bytes"))
      .def("state",
           [](OneWorld& world) {
             return DictOf(world.Quick([](LoneWorld& w) { return WorldBodies(w.world()); }));
           })
      .def("energy", [](OneWorld& world) {
        return world.Quick([](LoneWorld& w) { return w.world().Energy(); });
      });
}

void AddSession(py::module_& module) {
  py::class_<OneSession>(module, "Session")
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
             return std::make_unique<OneSession>(scene, config);
           }),
           py::arg("scene"), py::kw_only(), py::arg("mode"), py::arg("reconcile"),
           py::arg("predict"), py::arg("impair"), py::arg("seed"), py::arg("send_hz"),
           py::arg("drive"), py::arg("record"), py::arg("force"), py::arg("keep"))
      .def(
          "run_to",
          [](OneSession& session, std::int64_t tick) {
            session.Do([tick](LocalSession& s) { s.RunToTick(tick); });
          },
          py::arg("tick"))
      .def("tick",
           [](OneSession& session) {
             return session.Quick([](LocalSession& s) { return s.tick(); });
           })
      .def(
          "input",
          [](OneSession& session, int player, int drive, int lift, int buttons) {
            const Input input = InputOf(drive, lift, buttons);
            session.Quick([&](LocalSession& s) { s.SetInput(player, input); });
          },
          py::arg("player"), py::arg("drive"), py::arg("lift"), py::arg("buttons"))
      .def(
          "state",
          [](OneSession& session, int peer) {
            return DictOf(
                session.Quick([peer](LocalSession& s) { return SessionBodies(s, peer); }));
          },
          py::arg("peer"))
      .def("flush", [](OneSession& session) { session.Do([](LocalSession& s) { s.Flush(); }); })
      .def("measure", [](OneSession& session) {
        std::string valid;
        const Measures measures =
            session.Do([&valid](LocalSession& s) { return MeasureSession(s, &valid); });
        return MeasuresDict(measures, valid);
      });
}

}  // namespace

Bodies BodiesOf(const Scene& scene, const View& view) {
  Bodies bodies{view.tick, view.id, NamesOf(scene, view.id), {}, {}};
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    bodies.poses.insert(bodies.poses.end(), {view.x[i], view.y[i], view.angle[i]});
    bodies.velocities.insert(bodies.velocities.end(), {view.vx[i], view.vy[i], view.spin[i]});
  }
  return bodies;
}

py::dict DictOf(const Bodies& of) {
  const auto bodies = static_cast<py::ssize_t>(of.ids.size());
  py::dict dict;
  dict["tick"] = of.tick;
  dict["ids"] = ArrayOf(of.ids, {bodies});
  dict["names"] = of.names;
  dict["poses"] = ArrayOf(of.poses, {bodies, 3});
  dict["velocities"] = ArrayOf(of.velocities, {bodies, 3});
  return dict;
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
