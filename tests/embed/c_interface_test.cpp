/// seam2d.h: no call throws or aborts because of its arguments, and each failure has a line.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "client/embed/seam2d/seam2d.h"

namespace seam {
namespace c_interface_test {

const char* const kFall = R"(
[[player]]
name = "ann"
vehicle = "crate"
[[part]]
name = "ground"
box = [40, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "crate"
box = [1, 1]
position = [0, 5]
[[part]]
name = "lid"
box = [1, 0.2]
position = [0, 5.6]
[[joint]]
name = "seal"
kind = "weld"
a = "crate"
b = "lid"
[[part]]
name = "ball"
circle = 0.5
position = [3, 5]
)";

std::string Error() { return seam2d_error(); }

TEST(CInterface, AWorldIsSteppedReadWrittenSavedAndLoaded) {
  EXPECT_EQ(seam2d_abi_version(), SEAM2D_ABI_VERSION);
  seam2d_world* world = seam2d_world_create(kFall, "fall.toml");
  ASSERT_NE(world, nullptr) << Error();
  EXPECT_EQ(seam2d_world_players(world), 1);
  EXPECT_EQ(seam2d_world_tick_seconds(world), 1.0 / 60);
  ASSERT_EQ(seam2d_world_step(world, 30), 0);
  EXPECT_EQ(seam2d_world_tick(world), 30);
  seam2d_body bodies[2];
  ASSERT_EQ(seam2d_world_bodies(world, bodies, 2), 2);
  EXPECT_EQ(seam2d_world_find(world, "lid"), bodies[0].id) << "its body is the crate's";
  EXPECT_EQ(seam2d_world_find(world, "ball"), bodies[1].id);
  EXPECT_STREQ(seam2d_world_name(world, bodies[1].id), "ball");
  // Half a second of free fall: symplectic Euler, v = g t, y = y0 - g dt^2 n (n + 1) / 2.
  EXPECT_NEAR(bodies[1].vy, -5, 1e-4);
  EXPECT_NEAR(bodies[1].y, 5 - 10.0 / 3600 * 30 * 31 / 2, 1e-4);
  const void* bytes = nullptr;
  size_t size = 0;
  ASSERT_EQ(seam2d_world_save(world, &bytes, &size), 0);
  seam2d_world* other = seam2d_world_create(kFall, "fall.toml");
  ASSERT_EQ(seam2d_world_load(other, bytes, size), 0) << Error();
  seam2d_body moved = bodies[1];
  moved.x = 10;
  moved.vx = 2;
  for (seam2d_world* each : {world, other}) {
    ASSERT_EQ(seam2d_world_write(each, &moved), 0);
    ASSERT_EQ(seam2d_world_step(each, 100), 0);
  }
  seam2d_body one[2], two[2];
  ASSERT_EQ(seam2d_world_bodies(world, one, 2), 2);
  ASSERT_EQ(seam2d_world_bodies(other, two, 2), 2);
  EXPECT_EQ(std::memcmp(one, two, sizeof one), 0);
  EXPECT_GT(one[1].x, 10);
  // Fewer places than bodies: the count says how many there are.
  one[1].id = 77;
  EXPECT_EQ(seam2d_world_bodies(world, one, 1), 2);
  EXPECT_EQ(one[1].id, 77);
  seam2d_world_destroy(world);
  seam2d_world_destroy(other);
}

TEST(CInterface, EachFailureIsOneLineAndEndsNothing) {
  EXPECT_EQ(seam2d_world_create("part = 5", "bad.toml"), nullptr);
  EXPECT_EQ(Error().rfind("bad.toml:1: ", 0), 0u) << Error();
  EXPECT_EQ(Error().find('\n'), std::string::npos);
  EXPECT_EQ(seam2d_world_create(nullptr, "x"), nullptr);
  EXPECT_EQ(seam2d_world_step(nullptr, 1), -1);
  EXPECT_EQ(Error(), "the world is NULL");
  EXPECT_EQ(seam2d_world_tick(nullptr), -1);
  EXPECT_EQ(seam2d_world_tick_seconds(nullptr), 0);
  EXPECT_EQ(seam2d_session_step(nullptr, 1), -1);
  EXPECT_EQ(Error(), "the session is NULL");
  seam2d_world_destroy(nullptr);
  seam2d_session_destroy(nullptr);
  seam2d_world* world = seam2d_world_create(kFall, "fall.toml");
  ASSERT_NE(world, nullptr);
  EXPECT_EQ(seam2d_world_step(world, -1), -1);
  EXPECT_EQ(seam2d_world_step(world, 1 << 30), -1);
  EXPECT_EQ(seam2d_world_bodies(world, nullptr, 2), -1);
  EXPECT_EQ(seam2d_world_bodies(world, nullptr, 0), 2);
  EXPECT_EQ(seam2d_world_name(world, -1), nullptr);
  EXPECT_EQ(seam2d_world_name(world, 4), nullptr);
  EXPECT_EQ(seam2d_world_find(world, "ground"), -1);
  EXPECT_EQ(Error(), "the part \"ground\" does not move");
  EXPECT_EQ(seam2d_world_find(world, "nobody"), -1);
  EXPECT_EQ(seam2d_world_load(world, "nonsense", 8), -1);
  EXPECT_EQ(seam2d_world_load(world, nullptr, 8), -1);
  EXPECT_EQ(seam2d_world_save(world, nullptr, nullptr), -1);
  EXPECT_EQ(seam2d_world_write(world, nullptr), -1);
  const seam2d_input wide{128, 0, 0}, bits{0, 0, 1 << 15}, good{-127, 127, 0x7fff};
  EXPECT_EQ(seam2d_world_input(world, 0, &wide), -1);
  EXPECT_EQ(seam2d_world_input(world, 0, &bits), -1);
  EXPECT_EQ(seam2d_world_input(world, 0, nullptr), -1);
  EXPECT_EQ(seam2d_world_input(world, 1, &good), -1);
  EXPECT_EQ(seam2d_world_input(world, 0, &good), 0);
  seam2d_body body{};
  ASSERT_GE(seam2d_world_bodies(world, &body, 1), 1);
  for (float seam2d_body::*number : {&seam2d_body::x, &seam2d_body::y, &seam2d_body::angle,
                                     &seam2d_body::vx, &seam2d_body::vy, &seam2d_body::spin}) {
    for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), -3e38f}) {
      seam2d_body wrong = body;
      wrong.*number = bad;
      EXPECT_EQ(seam2d_world_write(world, &wrong), -1);
    }
  }
  EXPECT_EQ(seam2d_world_step(world, 10), 0);
  seam2d_world_destroy(world);
}

TEST(CInterface, ErrorsAreOfTheirThread) {
  EXPECT_EQ(seam2d_world_step(nullptr, 1), -1);
  std::string elsewhere = "not asked";
  std::thread([&elsewhere] {
    elsewhere = Error();
    seam2d_session_step(nullptr, 1);
  }).join();
  EXPECT_EQ(elsewhere, "");
  EXPECT_EQ(Error(), "the world is NULL");
}

TEST(CInterface, ASessionIsDrivenAndSeenByEachPeer) {
  seam2d_session_options options{};
  EXPECT_EQ(seam2d_session_create(kFall, "fall.toml", &options), nullptr) << "without its size";
  options.size = sizeof options;
  options.mode = "nonsense";
  EXPECT_EQ(seam2d_session_create(kFall, "fall.toml", &options), nullptr);
  EXPECT_NE(Error().find("nonsense"), std::string::npos);
  options.mode = "central";
  options.seed = 3;
  seam2d_session* session = seam2d_session_create(kFall, "fall.toml", &options);
  ASSERT_NE(session, nullptr) << Error();
  EXPECT_EQ(seam2d_session_peers(session), 2);
  EXPECT_EQ(seam2d_session_bodies(session, 1, nullptr, 0), 0) << "it has not joined";
  ASSERT_EQ(seam2d_session_step(session, 120), 0) << Error();
  EXPECT_EQ(seam2d_session_tick(session), 120);
  const seam2d_input input{127, 0, 0};
  EXPECT_EQ(seam2d_session_input(session, 0, &input), 0);
  EXPECT_EQ(seam2d_session_input(session, 5, &input), -1);
  seam2d_body at_server[2], at_client[2];
  ASSERT_EQ(seam2d_session_bodies(session, 0, at_server, 2), 2);
  ASSERT_EQ(seam2d_session_bodies(session, 1, at_client, 2), 2);
  EXPECT_EQ(seam2d_session_bodies(session, 2, at_client, 2), -1);
  EXPECT_NEAR(at_server[0].y, 0.5, 0.05);
  EXPECT_NEAR(at_client[0].y, at_server[0].y, 0.05);
  seam2d_session_destroy(session);
}

}  // namespace c_interface_test
}  // namespace seam
