#pragma once
/// A scene's joints as Box2D joints, and their motors.

#include <box2d/box2d.h>

#include "common/scene/scene.h"

namespace seam {

/// A drive that turns or moves the two sides of a joint against each other.
struct Motor {
  int index = 0;                       ///< into Scene::joints
  b2Joint* joint = nullptr;            ///< revolute, wheel, prismatic or motor
  int player = -1;                     ///< -1: turns constantly
  InputAxis axis = InputAxis::kDrive;  ///< of the player
  float speed = 0;                     ///< rad/s or m/s at full drive; motor joint: 1
  b2Vec2 offset{0, 0}, reach{0, 0};    ///< motor joint, m: b's position in a's frame; per speed
  float angle = 0, swing = 0;          ///< motor joint, rad: likewise
  float held = 0;                      ///< motor joint: its speed now

  /// Drives at `share` of full drive, -1..1. Wakes the bodies if the speed changes.
  void Drive(float share) { SetSpeed(share * speed); }
  /// Returns the current speed, rad/s or m/s; for a motor joint, the share of its reach.
  float Speed() const;
  void SetSpeed(float now);
};

/// Makes a Box2D joint. Requires one that is not rigid (IsRigid), not a gear and not kinematic.
b2Joint* MakeJoint(const Joint& joint, b2Body* a, b2Body* b, b2World* world);

/// True if the joint has a motor; then MotorOf returns it.
bool HasMotor(const Joint& joint);
Motor MotorOf(const Joint& joint, b2Joint* made, int index);

}  // namespace seam
