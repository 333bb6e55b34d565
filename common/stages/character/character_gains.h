#pragma once
/// The numbers of the balance controllers, for a body of 1.8 m under 10 m/s^2. Torques and
/// stiffnesses are shares of weight x height (`unit`), so that they fit every size and density.

namespace seam {

/// 1/s: servos go towards their angle with at most this times what is missing. Faster ones ring
/// with what the foot touches, slower ones come late for the step.
constexpr float kServoRate = 25, kHipRate = 12;
/// Shares of unit per rad of the servos.
constexpr float kSwingStiffness = 0.6f, kAnkleStiffness = 0.12f, kArmStiffness = 0.12f,
                kNeckStiffness = 0.06f;
/// Of the torso upright, per rad and per rad/s.
constexpr float kTorsoStiffness = 0.45f, kTorsoDamping = 0.075f;
/// Of the weight, what is above the hips; m of its middle above them.
constexpr float kUpperShare = 0.52f, kUpperHeight = 0.40f;
/// Of the height of the hip, 1/s^2 and 1/s: a spring of 1.6 Hz.
constexpr float kHeightStiffness = 150, kHeightDamping = 20;
/// Vertical force, shares of the weight: legs neither pull nor jump while they balance.
constexpr float kLiftMin = 0.2f, kLiftMax = 3.0f;
/// Horizontal force per vertical: below what feet hold (friction 0.5 on 0.8).
constexpr float kGrip = 0.7f;
/// Of the hip above the ground while standing and while stepping, shares of its height with
/// straight legs. Bent knees can also push.
constexpr float kStandHeight = 0.97f, kStepHeight = 0.93f;
/// Of that height, less per m/s: longer steps need bent knees.
constexpr float kCrouch = 0.04f;
/// Standing: how strongly the point of pressure is beyond the capture point.
constexpr float kCaptureGain = 1.5f;
/// m; the rim of the sole that pressure stays away from.
constexpr float kSoleRim = 0.02f;
/// m of the capture point beyond the soles' ends at which it takes a step.
constexpr float kCaptureMargin = -0.02f;

/// s of a step.
constexpr float kStepTime = 0.30f;
/// m of the foot over the ground in its middle, and over a stair.
constexpr float kClearance = 0.09f, kStairClearance = 0.08f;
/// Shares of a step: when the foot is up, when it goes on onto a stair, when it is where it lands.
constexpr float kLifted = 0.4f, kStairLifted = 0.4f, kStairWait = 0, kArrive = 1.0f;
/// m/s by which a foot that finds no ground goes on down.
constexpr float kSearch = 0.5f;
/// m/s at full drive; m/s^2 by which the proposed follows.
constexpr float kRunSpeedMax = 3.0f, kSpeedBack = 1.2f, kSpeedRate = 2.5f;
/// rad of the torso's lean forward per m/s.
constexpr float kLean = 0.04f;
/// Steepest way from foot to foot that the hip follows, as rise over run.
constexpr float kSlopeMax = 0.7f;
/// m beside the wished foothold, where it looks for a flat one; the first is taken if none is.
constexpr float kAside[] = {0, 0.08f, -0.08f, 0.16f, -0.16f, 0.24f};
/// m of the furthest foothold before or behind the hip.
constexpr float kReachMax = 0.60f, kReachBack = 0.45f;

/// rad of the torso beyond which it falls; the hip's height, share of straight, below which.
constexpr float kTiltMax = 1.1f, kSunk = 0.45f;
/// Jumping: the hip's height before it, share of straight, and s for that; force, in weights;
/// m of the pressure behind the centre of mass at full drive; s of the whole, and of the flight in
/// which a touch is still the ground it left.
constexpr float kJumpCrouch = 0.72f, kJumpCrouchMax = 0.4f, kJumpLift = 3, kJumpForward = 0.1f,
                kJumpMax = 0.8f, kAirMin = 0.1f;
/// 1/s, of turning while it pushes; of the hip's height, where the legs are straight.
constexpr float kJumpStill = 100, kJumpStretched = 1.0f;
/// s without ground after which it is in the air.
constexpr float kLostGround = 0.15f;
/// Of the legs in the air: soft, or the torso turns the other way; less so before they land.
constexpr float kAirStiffness = 0.05f, kLandStiffness = 0.4f;
/// Where they land: before the hips, times the capture point's distance; each from the middle, hip
/// heights.
constexpr float kAirAhead = 0.8f, kAirApart = 0.05f;
/// m of the centre of mass behind and before the ankle within which a run becomes a jump.
constexpr float kJumpBehind = 0.02f, kJumpBefore = 0.2f;
/// s on the ground between jumps.
constexpr float kJumpRest = 0.2f;
/// Falling: share of unit per rad of its servos, soft; s after which it begins to get up, when it
/// lies still and at the latest.
constexpr float kFallStiffness = 0.03f, kFallMin = 0.4f, kFallMax = 2.0f;
/// Getting up: of hips and knees; s for the last part, from a squat; of the hip's height, where it
/// stands again.
constexpr float kRiseStiffness = 0.4f, kUpMax = 2.0f, kRisen = 0.85f;

/// Swimming: m of the chest under water from which, and to which, for 1.8 m.
constexpr float kSwimFrom = 0.05f, kSwimTo = -0.25f;
/// Turns of an arm per s, beats of the legs per turn; the shoulder overhead and at the hip, rad,
/// and the elbow while it comes back.
constexpr float kStrokeHz = 0.8f, kKicks = 2, kStrokeFrom = 2.7f, kStrokeTo = 0.0f, kFolded = 2.3f;
/// Of all its servos; rad of the legs' beat; rad of the torso's lean at full drive; legs per torso.
constexpr float kStrokeStiffness = 0.2f, kKick = 0.35f, kSwimLean = 1.0f, kSwimSteer = 0.8f;

}  // namespace seam
