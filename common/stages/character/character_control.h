#pragma once
/// Controls an active character: it stands, steps, jumps, falls, gets up and swims. Before each
/// step of the engine, reads the character's body and sets its motors' torques.
///
///   stand --drive, or pushed too far--> step --slow enough--> stand
///   stand, step --lift--> jump --> air --feet touch--> step or stand
///   anything --tilted, sunk down--> fall --lying--> rise --up--> stand
///   anything --in water--> swim --a ledge in reach--> climb --over the ledge--> fall
///   anything --player's lift fully down, a hard impact, a command--> limp --over--> fall
///   a leg or the torso gone--> limp
///
/// Balance is that of the linear inverted pendulum: its divergent component, the point x + v / w0
/// with w0 = sqrt(g / h), must be over a foot or be caught by one (Pratt and others, "Capture
/// Point: A Step toward Humanoid Push Recovery", 2006). Standing legs use virtual forces (Pratt and
/// others, "Virtual Model Control", 2001). A swinging leg goes to the foothold from which the
/// pendulum continues at the desired speed (Englsberger and others, "Three-Dimensional Bipedal
/// Walking Control Based on Divergent Component of Motion", 2015).

#include "common/scene/character.h"
#include "common/stages/character/character_gains.h"
#include "common/stages/character/character_hands.h"
#include "common/stages/character/character_limbs.h"

namespace seam {

enum class CharacterMode { kStand, kStep, kJump, kAir, kFall, kRise, kSwim, kLimp, kClimb };

/// Highest phase of any mode: CharacterMode::kRise has the most.
constexpr int kPhaseMost = 8;
/// m; x of an absent edge.
constexpr float kNoEdge = 1e6f;
/// s; step of numeric derivatives.
constexpr float kDerivativeStep = 0.01f;

/// State of a controller; numbers only, so that a world can save it.
struct CharacterMemory {
  CharacterMode mode = CharacterMode::kStand;
  float time = 0;           ///< s in this mode
  int stance = 0;           ///< kStep: the supporting side
  float step = 0;           ///< s; kStep: since lift-off of the swinging foot; kSwim: leg cycles
  b2Vec2 from{0, 0};        ///< m; kStep: lift-off point, own frame
  float to = 0;             ///< m; kStep: target of its ankle, own frame
  b2Vec2 edge{kNoEdge, 0};  ///< m; kStep: edge of the next stair
  float speed = 0;          ///< m/s; current target speed
  int phase = 0;            ///< kRise: stage of getting up
  float phase_time = 0;     ///< s in the phase; kSwim: arm cycles; kClimb: s of lying still
  float hold[2] = {};       ///< 1: the hand grips what it touches; -x: it cannot for x s
  float load[2] = {};       ///< N; load of each hand, a short moving average
  float limp = 0;           ///< s left of limpness after an impact or a command

  void Save(std::vector<float>* memory) const;
  void Load(StageMemory* memory);
};

class CharacterControl {
 public:
  CharacterControl(const Character& character, const StageWorld& world);

  void Find(b2World* world) {
    limbs_.Find(world);
    hands_.Find();
  }
  void Forget() {
    limbs_.Forget();
    hands_.Forget();
  }
  void SetInput(const Input& input);
  /// Acts before the engine's step of `h` s.
  void Act(float h);
  /// Takes an impact of `impulse` N s on one of its parts: a hard one makes it limp for a moment.
  void Struck(float impulse);
  /// Makes it limp for at least `seconds`; below 0: ends the limpness.
  void GoLimp(float seconds);
  /// Proposes grips to make or release. Called after a tick.
  void ProposeGrips(std::vector<Edit>* edits) const { hands_.Propose(memory_.hold, edits); }
  /// Updates the hands' loads. Called after a tick of `h` s.
  void UpdateHandLoads(float h);

  const CharacterMemory& memory() const { return memory_; }
  CharacterMemory* mutable_memory() { return &memory_; }

 private:
  void Choose(const CharacterSense& s, float h);
  void Enter(CharacterMode mode);

  // character_balance.cpp
  void Stand(const CharacterSense& s);
  void Bear(const CharacterSense& s, int side, float pressure_x, float lift, float torso_torque);
  void Push(const CharacterSense& s, int side, b2Vec2 pressure, float lift, float forward);
  b2Vec2 Sole(const CharacterSense& s, int side, float x) const;
  struct LegPose {
    float thigh = 0, knee = 0;  // rad; absolute, and of the joint
  };
  LegPose PoseFor(b2Vec2 way) const;
  void Reach(const CharacterSense& s, int side, b2Vec2 ankle, b2Vec2 velocity, float foot,
             float stiffness);
  float TorsoTorque(const CharacterSense& s, float lean) const;
  float Lift(const CharacterSense& s, float ground_y, float hip_height, float ground_vy,
             float stiffness, float damping) const;
  float Lift(const CharacterSense& s, float ground_y, float hip_height, float ground_vy) const {
    return Lift(s, ground_y, hip_height, ground_vy, gains_.height_stiffness, gains_.height_damping);
  }
  void Arms(float left, float right, float elbow);

  // character_step.cpp
  void StepOn(const CharacterSense& s, float h);
  float StepTime() const;
  void BeginStep(const CharacterSense& s, int stance);
  /// Target of the swinging foot: its ankle, and the ground's slope there, rad.
  struct Foothold {
    b2Vec2 ankle{0, 0};
    float slope = 0;
  };
  /// Gait on the ground ahead.
  struct StairGait {
    float speed, time, height, ahead, lean;
    bool down;
  };
  /// m beyond heel and toe that a foothold needs; below 0: length that may overhang.
  struct Rims {
    float heel, toe;
  };
  StairGait Stairs() const;
  float Ahead(float omega) const;
  b2Vec2 EdgeAhead(const CharacterSense& s, float from_x) const;
  float DesiredFoothold(const CharacterSense& s, float support_x) const;
  bool FlatAt(const CharacterSense& s, float x, const Rims& rims, Foothold* foothold) const;
  Foothold NextFoothold(const CharacterSense& s, float support_x) const;
  float StepRate(const CharacterSense& s, float support_x, float foothold_x) const;
  b2Vec2 SwingAt(float time, const Foothold& to) const;
  float LeastHeight(const CharacterSense& s, int side, const Foothold& to) const;
  void Swing(const CharacterSense& s, int side, const Foothold& to);

  // character_air.cpp
  void Jump(const CharacterSense& s);
  void Air(const CharacterSense& s);
  float LandingAhead(const CharacterSense& s) const;
  float FlightTurning(const CharacterSense& s) const;

  // character_rise.cpp
  void Fall(const CharacterSense& s);
  void Rise(const CharacterSense& s, float h);
  bool Squats(const CharacterSense& s) const;
  float SlopeBelow(const CharacterSense& s) const;
  LegPose Gathered(const CharacterSense& s, float place, float lead, float slope) const;
  void Up(const CharacterSense& s);

  // character_swim.cpp
  float ChestDepth(const CharacterSense& s) const;
  float WaterOverGround(const CharacterSense& s) const;
  void Swim(const CharacterSense& s, float h);
  void Tread(const CharacterSense& s);
  float RightingHz(const CharacterSense& s, float error) const;
  /// Angles of one leg's joints, rad.
  struct Legs {
    float hip = 0, knee = 0, ankle = 0;
  };
  float StrokeLean(float share) const;
  Legs ReadyLegs(const Legs& tread, float error, float share) const;
  Legs TreadLegs(const CharacterSense& s, float leg) const;
  Legs BeatLegs(const CharacterSense& s, float leg, float share) const;
  void PoseLegs(const Legs& tread, const Legs& beat, float share, int side);

  // character_climb.cpp
  struct Ledge {
    bool found = false;
    b2Vec2 edge{0, 0};  // m
  };
  Ledge LedgeAhead(const CharacterSense& s) const;
  void Climb(const CharacterSense& s, float h);
  void ReachWith(const CharacterSense& s, int side, b2Vec2 way);
  bool RaiseArm(const CharacterSense& s, int side, b2Vec2 tip, b2Vec2 edge);
  void PullWith(int side, b2Vec2 force);
  b2Vec2 PullTo(const CharacterSense& s, b2Vec2 tip) const;
  bool MustReachOn(int side, b2Vec2 tip, b2Vec2 shoulder) const;
  void LetGo();
  void Hang();

  /// N m: weight x height, the unit of all gains.
  float unit() const { return unit_; }
  float Omega(const CharacterSense& s, float ground_y) const;
  /// Drives a joint as a servo of `strength` units per rad; `rate` 1/s is its stiffness over its
  /// damping.
  void Pose(CharacterJoint joint, float angle, float strength, float spin, float rate);
  void Pose(CharacterJoint joint, float angle, float strength, float spin = 0) {
    Pose(joint, angle, strength, spin, gains_.servo_rate);
  }

  const Character character_;
  const StageWorld world_;
  const CharacterGains gains_;
  CharacterLimbs limbs_;
  CharacterHands hands_;
  CharacterMemory memory_;
  float drive_ = 0, lift_ = 0;  // -1..1, drive forward
  float gravity_ = 10;          // m/s^2, downwards
  float unit_ = 1;
};

}  // namespace seam
