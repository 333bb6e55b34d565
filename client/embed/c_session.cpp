/// seam2d.h: a session in one process.

#include <algorithm>
#include <cstring>

#include "client/embed/c_guard.h"
#include "client/embed/local_session.h"
#include "client/embed/seam2d/seam2d.h"

struct seam2d_session {
  seam2d_session(const seam::Scene& scene, const seam::LocalSessionConfig& config)
      : local(scene, config) {}
  seam::LocalSession local;
};

namespace seam {
namespace {

void Take(const char* given, std::string* setting) {
  if (given != nullptr && given[0] != '\0') *setting = given;
}

/// Reads the options of a program that may have been compiled with a shorter struct.
LocalSessionConfig ConfigOf(const seam2d_session_options* given) {
  LocalSessionConfig config;
  if (given == nullptr) return config;
  seam2d_session_options options{};
  Demand(given->size >= offsetof(seam2d_session_options, seed) + sizeof options.seed,
         "options.size is not sizeof(seam2d_session_options)");
  std::memcpy(&options, given, std::min(given->size, sizeof options));
  Take(options.mode, &config.mode);
  Take(options.reconcile, &config.reconcile);
  Take(options.impair, &config.impair);
  Take(options.drive, &config.drive);
  Take(options.record, &config.record);
  config.seed = options.seed;
  return config;
}

void Show(const View& view, seam2d_body* bodies, int capacity) {
  const auto count = std::min(view.id.size(), static_cast<std::size_t>(capacity));
  for (std::size_t i = 0; i < count; ++i) {
    bodies[i] = {view.id[i],    1,          view.x[i],  view.y[i],
                 view.angle[i], view.vx[i], view.vy[i], view.spin[i]};
  }
}

}  // namespace
}  // namespace seam

using seam::Demand;
using seam::Guarded;

seam2d_session* seam2d_session_create(const char* scene_text, const char* name,
                                      const seam2d_session_options* options) {
  return Guarded<seam2d_session*>(nullptr, [&] {
    Demand(scene_text != nullptr && name != nullptr, "the scene's text or name is NULL");
    return new seam2d_session(seam::ParseScene(scene_text, name), seam::ConfigOf(options));
  });
}

void seam2d_session_destroy(seam2d_session* session) { delete session; }

int seam2d_session_step(seam2d_session* session, int ticks) {
  return Guarded(-1, [&] {
    Demand(session != nullptr, "the session is NULL");
    seam::DemandTicks(ticks);
    session->local.RunToTick(session->local.tick() + ticks);
    return 0;
  });
}

int seam2d_session_input(seam2d_session* session, int player, const seam2d_input* input) {
  return Guarded(-1, [&] {
    Demand(session != nullptr, "the session is NULL");
    session->local.SetInput(player, seam::InputOf(input));
    return 0;
  });
}

std::int64_t seam2d_session_tick(const seam2d_session* session) {
  return Guarded<std::int64_t>(-1, [&] {
    Demand(session != nullptr, "the session is NULL");
    return session->local.tick();
  });
}

int seam2d_session_peers(const seam2d_session* session) {
  return Guarded(-1, [&] {
    Demand(session != nullptr, "the session is NULL");
    return session->local.client_count() + 1;
  });
}

int seam2d_session_bodies(const seam2d_session* session, int peer, seam2d_body* bodies,
                          int capacity) {
  return Guarded(-1, [&] {
    Demand(session != nullptr, "the session is NULL");
    Demand(capacity >= 0 && (bodies != nullptr || capacity == 0), "no place for the bodies");
    const seam::View view = session->local.ViewOf(peer);
    seam::Show(view, bodies, capacity);
    return static_cast<int>(view.id.size());
  });
}
