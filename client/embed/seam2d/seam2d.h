#pragma once
/// Seam2D for C, and for all that can call C: a world alone, and a session of server and clients in
/// one process and in virtual time.
///
/// Handles are opaque. A call that fails returns NULL or -1, and seam2d_error() says why in one
/// line; no call throws or ends the process because of its arguments. A handle is used by one
/// thread at a time; different handles by different threads at once. SI units; angles in radians.

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __GNUC__
#define SEAM2D_API __attribute__((visibility("default")))
#else
#define SEAM2D_API
#endif

/// Version of this interface; a change that breaks compiled programs raises it.
#define SEAM2D_ABI_VERSION 1
/// Returns SEAM2D_ABI_VERSION of the library; a program compares it with its header's at the start.
SEAM2D_API int seam2d_abi_version(void);
/// Returns the version of Seam2D, as "0.26.0".
SEAM2D_API const char* seam2d_version(void);
/// Returns the reason for the last failure in this thread, one line, "" if there was none. Valid
/// until the next call in this thread.
SEAM2D_API const char* seam2d_error(void);

/// A player's input for the ticks to come.
typedef struct seam2d_input {
  int32_t drive;    ///< -127..127
  int32_t lift;     ///< -127..127
  int32_t buttons;  ///< bits 0..14, of the scene's actions; a press acts on its first tick
} seam2d_input;

/// A moving body.
typedef struct seam2d_body {
  int32_t id;          ///< of its root part; the same at every peer
  int32_t awake;       ///< 1, or 0 if it sleeps; in a session 1
  float x, y, angle;   ///< m, m, rad (unwrapped): the root part's frame
  float vx, vy, spin;  ///< m/s, m/s, rad/s: the centre of mass
} seam2d_body;

/// A scene's world alone. Rules of the server (triggers, health, scripts) do not act in it.
typedef struct seam2d_world seam2d_world;

/// Creates the world of a scene file's text. `name` is for errors: "NAME:LINE: ...".
SEAM2D_API seam2d_world* seam2d_world_create(const char* scene_text, const char* name);
SEAM2D_API void seam2d_world_destroy(seam2d_world* world);
/// Advances by so many ticks, 0 to 1000000. Returns 0.
SEAM2D_API int seam2d_world_step(seam2d_world* world, int ticks);
/// Sets the input of a player (0: the scene's first), held until the next call. Returns 0.
SEAM2D_API int seam2d_world_input(seam2d_world* world, int player, const seam2d_input* input);
/// Returns the ticks since the start.
SEAM2D_API int64_t seam2d_world_tick(const seam2d_world* world);
/// Returns the seconds of a tick; 0 without a world.
SEAM2D_API double seam2d_world_tick_seconds(const seam2d_world* world);
/// Returns the number of players.
SEAM2D_API int seam2d_world_players(const seam2d_world* world);
/// Writes the first `capacity` bodies, ascending by id, and returns the number of all of them.
SEAM2D_API int seam2d_world_bodies(const seam2d_world* world, seam2d_body* bodies, int capacity);
/// Returns the name of a part, valid until the next call with this world.
SEAM2D_API const char* seam2d_world_name(const seam2d_world* world, int id);
/// Returns the id of the body that has the part of this name; -1 if none moves with it.
SEAM2D_API int seam2d_world_find(const seam2d_world* world, const char* name);
/// Sets pose and velocity of the body with this id, and wakes it. Returns 0.
SEAM2D_API int seam2d_world_write(seam2d_world* world, const seam2d_body* body);
/// Saves the state: `*bytes` points to `*size` bytes, valid until the next call with this world.
/// A world that loads them continues with the same bits. Returns 0.
SEAM2D_API int seam2d_world_save(seam2d_world* world, const void** bytes, size_t* size);
/// Continues a saved state of the same scene; refuses any other bytes. Returns 0.
SEAM2D_API int seam2d_world_load(seam2d_world* world, const void* bytes, size_t size);

/// A server and a client for each player of a scene, over a simulated network, in virtual time.
typedef struct seam2d_session seam2d_session;

/// Settings of a session; NULL or 0 stands for the default in brackets.
typedef struct seam2d_session_options {
  size_t size;            ///< sizeof(seam2d_session_options)
  const char* mode;       ///< as of seam-server --mode (buffer)
  const char* reconcile;  ///< as of seam-server --reconcile (the mode's)
  const char* impair;     ///< network between server and clients (demo)
  const char* drive;      ///< inputs, script or bot (inputs)
  const char* record;     ///< log to write (none)
  int64_t seed;           ///< 0..1000000000
} seam2d_session_options;

/// Creates a session; NULL as `options`: all defaults.
SEAM2D_API seam2d_session* seam2d_session_create(const char* scene_text, const char* name,
                                                 const seam2d_session_options* options);
/// Destroys the session; its log is whole then.
SEAM2D_API void seam2d_session_destroy(seam2d_session* session);
/// Runs until the server has done so many more ticks, 0 to 1000000. The first call lets the clients
/// join. Returns 0.
SEAM2D_API int seam2d_session_step(seam2d_session* session, int ticks);
/// Sets the input of a player, held until the next call. Returns 0.
SEAM2D_API int seam2d_session_input(seam2d_session* session, int player, const seam2d_input* input);
/// Returns the server's ticks since the start of the room.
SEAM2D_API int64_t seam2d_session_tick(const seam2d_session* session);
/// Returns the number of peers: the server, which is peer 0, and a client for each player.
SEAM2D_API int seam2d_session_peers(const seam2d_session* session);
/// Writes the first `capacity` bodies as a peer displays them now; returns the number of all.
SEAM2D_API int seam2d_session_bodies(const seam2d_session* session, int peer, seam2d_body* bodies,
                                     int capacity);

#ifdef __cplusplus
}
#endif
