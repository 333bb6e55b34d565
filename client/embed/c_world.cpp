/// seam2d.h: a world alone.

#include <algorithm>

#include "client/embed/c_guard.h"
#include "client/embed/lone_world.h"
#include "client/embed/seam2d/seam2d.h"

struct seam2d_world {
  explicit seam2d_world(const seam::Scene& scene) : alone(scene) {}
  seam::LoneWorld alone;
  seam::Bytes saved;
};

namespace seam {
namespace {

const World& WorldOf(const seam2d_world* world) {
  Demand(world != nullptr, "the world is NULL");
  return world->alone.world();
}

seam2d_body BodyOf(const World& world, int body) {
  const BodyState state = world.Read(body);
  return {world.id(body), world.awake(body) ? 1 : 0, state.position.x(), state.position.y(),
          state.angle,    state.velocity.x(),        state.velocity.y(), state.spin};
}

/// Returns the moving body that has this part; -1 if there is none.
int BodyWith(const World& world, PartId part) {
  const Composition& all = world.composition();
  const int assembly = all.assembly_of_part[static_cast<std::size_t>(part)];
  if (assembly < 0) return -1;
  const PartId id = all.assemblies[static_cast<std::size_t>(assembly)].id;
  return world.BodyOfId(id) < 0 ? -1 : id;
}

}  // namespace
}  // namespace seam

using seam::Demand;
using seam::Guarded;
using seam::WorldOf;

seam2d_world* seam2d_world_create(const char* scene_text, const char* name) {
  return Guarded<seam2d_world*>(nullptr, [&] {
    Demand(scene_text != nullptr && name != nullptr, "the scene's text or name is NULL");
    return new seam2d_world(seam::ParseScene(scene_text, name));
  });
}

void seam2d_world_destroy(seam2d_world* world) { delete world; }

int seam2d_world_step(seam2d_world* world, int ticks) {
  return Guarded(-1, [&] {
    WorldOf(world);
    seam::DemandTicks(ticks);
    world->alone.Step(ticks);
    return 0;
  });
}

int seam2d_world_input(seam2d_world* world, int player, const seam2d_input* input) {
  return Guarded(-1, [&] {
    WorldOf(world);
    Demand(world->alone.SetInput(player, seam::InputOf(input)));
    return 0;
  });
}

std::int64_t seam2d_world_tick(const seam2d_world* world) {
  return Guarded<std::int64_t>(-1, [&] { return WorldOf(world).tick(); });
}

double seam2d_world_tick_seconds(const seam2d_world* world) {
  return Guarded(0.0, [&] { return 1.0 / WorldOf(world).scene().solver.tick_hz; });
}

int seam2d_world_players(const seam2d_world* world) {
  return Guarded(-1, [&] {
    WorldOf(world);
    return world->alone.player_count();
  });
}

int seam2d_world_bodies(const seam2d_world* world, seam2d_body* bodies, int capacity) {
  return Guarded(-1, [&] {
    const seam::World& from = WorldOf(world);
    Demand(capacity >= 0 && (bodies != nullptr || capacity == 0), "no place for the bodies");
    for (int i = 0; i < std::min(capacity, from.body_count()); ++i)
      bodies[i] = seam::BodyOf(from, i);
    return from.body_count();
  });
}

const char* seam2d_world_name(const seam2d_world* world, int id) {
  return Guarded<const char*>(nullptr, [&] {
    const auto& parts = WorldOf(world).scene().parts;
    Demand(id >= 0 && static_cast<std::size_t>(id) < parts.size(), "there is no part of this id");
    return parts[static_cast<std::size_t>(id)].name.c_str();
  });
}

int seam2d_world_find(const seam2d_world* world, const char* name) {
  return Guarded(-1, [&] {
    Demand(name != nullptr, "the name is NULL");
    const seam::World& in = WorldOf(world);
    for (const seam::Part& part : in.scene().parts) {
      if (part.gone || part.name != name) continue;
      const int id = seam::BodyWith(in, part.id);
      if (id < 0) throw seam::OperatorError("the part \"" + part.name + "\" does not move");
      return id;
    }
    throw seam::OperatorError(std::string("there is no part \"") + name + "\"");
  });
}

int seam2d_world_write(seam2d_world* world, const seam2d_body* body) {
  return Guarded(-1, [&] {
    WorldOf(world);
    Demand(body != nullptr, "the body is NULL");
    seam::BodyState state;
    state.position = {body->x, body->y};
    state.angle = body->angle;
    state.velocity = {body->vx, body->vy};
    state.spin = body->spin;
    Demand(world->alone.Write(body->id, state));
    return 0;
  });
}

int seam2d_world_save(seam2d_world* world, const void** bytes, size_t* size) {
  return Guarded(-1, [&] {
    WorldOf(world);
    Demand(bytes != nullptr && size != nullptr, "no place for the saved bytes");
    world->saved = world->alone.Save();
    *bytes = world->saved.data();
    *size = world->saved.size();
    return 0;
  });
}

int seam2d_world_load(seam2d_world* world, const void* bytes, size_t size) {
  return Guarded(-1, [&] {
    WorldOf(world);
    Demand(bytes != nullptr, "the saved bytes are NULL");
    Demand(world->alone.Load({static_cast<const std::uint8_t*>(bytes), size}));
    return 0;
  });
}
