#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/blast_push.h"
#include "common/physics/world_couplings.h"
#include "common/scene/mass.h"
#include "common/stages/bonds/bond_net.h"
#include "common/stages/contact_force.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// A body that contains glue.
struct Glued {
  int assembly = 0;  // index into Composition::assemblies
  BondNet net;
  std::vector<double> mass;   // kg, by node
  std::vector<Vector2d> arm;  // m, by node, from the centre of mass, in the root's frame
  double reach = 0;           // m: largest distance of a part's centre from the centre of mass
  double whole = 0;           // kg
  std::vector<int> joints;    // joints of the engine with an end at it: indices into joints
  // Of the current tick:
  std::vector<PartPush> felt;    // contacts' impulses
  std::vector<Vector2d> pushed;  // N s, by node
  double pushes = 0;             // N s, sum of all magnitudes
  double spin = 0;               // rad/s, before the tick
};

Glued GluedOf(const Scene& scene, const Assembly& assembly, int index, BondNet net) {
  Glued glued;
  glued.assembly = index;
  glued.net = std::move(net);
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  const MassProperties all = AssemblyProperties(scene, assembly);
  glued.whole = all.mass;
  const auto nodes = static_cast<std::size_t>(glued.net.nodes);
  glued.mass.assign(nodes, 0.0);
  glued.arm.assign(nodes, Vector2d(0, 0));
  glued.pushed.assign(nodes, Vector2d(0, 0));
  for (std::size_t i = 0; i < glued.net.parts.size(); ++i) {
    const Part& part = scene.parts[static_cast<std::size_t>(glued.net.parts[i])];
    const auto node = static_cast<std::size_t>(glued.net.node_of[i]);
    const MassProperties own = PartProperties(part);
    const Vector2d arm = ToRootFrame(part, root, own.centre) - all.centre;
    glued.mass[node] += own.mass;
    glued.arm[node] += own.mass * arm;
    glued.reach = std::max(glued.reach, arm.norm());
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    if (glued.mass[n] > 0) glued.arm[n] /= glued.mass[n];
  }
  return glued;
}

class GlueStage : public Stage {
 public:
  explicit GlueStage(const StageWorld& world) : w_(world) {}

  void Rebuilt(b2World* world) override { b2_ = world; }
  void Emptied() override { b2_ = nullptr; }
  void BeforeTick() override;
  void AfterTick() override;
  void ProposeEdits(std::vector<Edit>* edits) override;
  void Edited(const Edit& edit) override;
  void Save(std::vector<float>* memory) const override;
  void Load(StageMemory* memory) override;
  bool listens() const override { return true; }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

 private:
  void Look();
  void Forget();
  b2Body* BodyOf(const Glued& glued) const {
    return w_.built.bodies[static_cast<std::size_t>(glued.assembly)];
  }
  /// True also for what a kinematic joint moves: its own acceleration strains nothing.
  bool IsAnchored(const Glued& glued) const {
    return w_.composition.assemblies[static_cast<std::size_t>(glued.assembly)].anchored;
  }
  Glued* GluedWith(PartId part);
  void AddJoints(Glued* glued);
  void Strain(Glued* glued);
  void FeelBlasts();
  void Feel(const BlastHit& hit);

  const StageWorld w_;
  bool stale_ = true;  // the glue has changed since the last Look
  std::vector<Glued> glued_;
  std::vector<int> glued_of_;  // by assembly; -1: none
  b2World* b2_ = nullptr;
  std::vector<BlastEdit> blasts_;  // blasts that have pushed the bodies since the last tick
  std::vector<int> breaking_;      // joints overloaded in the last tick
};

void GlueStage::Look() {
  if (!stale_) return;
  stale_ = false;
  glued_.clear();
  glued_of_.assign(w_.composition.assemblies.size(), -1);
  std::vector<std::vector<int>> within(w_.composition.assemblies.size());
  for (std::size_t j = 0; j < w_.scene.joints.size(); ++j) {
    const Joint& joint = w_.scene.joints[j];
    if (joint.gone) continue;
    const int a = w_.composition.assembly_of_part[static_cast<std::size_t>(joint.a)];
    const int b = w_.composition.assembly_of_part[static_cast<std::size_t>(joint.b)];
    if (a == b) within[static_cast<std::size_t>(a)].push_back(static_cast<int>(j));
  }
  for (std::size_t a = 0; a < w_.composition.assemblies.size(); ++a) {
    const Assembly& assembly = w_.composition.assemblies[a];
    if (within[a].empty()) continue;
    BondNet net = NetOf(w_.scene, assembly, within[a]);
    if (net.bonds.empty()) continue;
    glued_of_[a] = static_cast<int>(glued_.size());
    glued_.push_back(GluedOf(w_.scene, assembly, static_cast<int>(a), std::move(net)));
  }
  for (std::size_t j = 0; j < w_.scene.joints.size(); ++j) {
    const Joint& joint = w_.scene.joints[j];
    if (joint.gone || joint.kind == JointKind::kGlue) continue;
    for (const PartId end : {joint.a, joint.b}) {
      Glued* glued = GluedWith(end);
      if (glued != nullptr) glued->joints.push_back(static_cast<int>(j));
    }
  }
}

void GlueStage::Forget() {
  for (Glued& glued : glued_) {
    std::fill(glued.pushed.begin(), glued.pushed.end(), Vector2d(0, 0));
    glued.felt.clear();
    glued.pushes = 0;
  }
}

Glued* GlueStage::GluedWith(PartId part) {
  const auto p = static_cast<std::size_t>(part);
  if (p >= w_.composition.assembly_of_part.size()) return nullptr;
  const int assembly = w_.composition.assembly_of_part[p];
  const int index = assembly < 0 ? -1 : glued_of_[static_cast<std::size_t>(assembly)];
  return index < 0 ? nullptr : &glued_[static_cast<std::size_t>(index)];
}

void GlueStage::BeforeTick() {
  breaking_.clear();
  Look();
  Forget();
  for (Glued& glued : glued_) {
    glued.spin = static_cast<double>(BodyOf(glued)->GetAngularVelocity());
  }
  FeelBlasts();
}

void GlueStage::Edited(const Edit& edit) {
  stale_ = true;
  const BlastEdit* blast = edit.As<BlastEdit>();
  const bool pushes = blast != nullptr && blast->impulse > 0 && w_.topology.Validate(edit).ok();
  if (pushes) blasts_.push_back(*blast);
}

/// Recomputes the blasts' impulses on the glue from the poses, which are still those of the blast.
void GlueStage::FeelBlasts() {
  for (const BlastEdit& blast : blasts_) {
    if (glued_.empty()) break;
    for (const BlastHit& hit : HitsOf(*b2_, w_.scene, w_.topology.BricksLeft(), blast)) Feel(hit);
  }
  blasts_.clear();
}

void GlueStage::Feel(const BlastHit& hit) {
  const auto part = static_cast<PartId>(PartOf(hit.fixture));
  Glued* glued = GluedWith(part);
  if (glued == nullptr) return;
  b2Body* body = hit.fixture->GetBody();
  const Vector2d impulse = FromB2(hit.impulse).cast<double>();
  glued->felt.push_back({part, body->GetLocalPoint(hit.point), impulse});
  glued->pushes += impulse.norm();
  if (body->GetType() != b2_dynamicBody) return;
  // The body's spin already includes the blast: restore the spin before it.
  const Vector2d arm = FromB2(hit.point - body->GetWorldCenter()).cast<double>();
  const float inertia =
      body->GetInertia() - body->GetMass() * body->GetLocalCenter().LengthSquared();
  if (inertia > 0) glued->spin -= Cross(arm, impulse) / static_cast<double>(inertia);
}

void GlueStage::Save(std::vector<float>* memory) const {
  memory->push_back(static_cast<float>(blasts_.size()));
  for (const BlastEdit& blast : blasts_) {
    memory->insert(memory->end(),
                   {blast.centre.x(), blast.centre.y(), blast.radius, blast.impulse});
  }
}

void GlueStage::Load(StageMemory* memory) {
  blasts_.assign(memory->NextCount(4), {});
  for (BlastEdit& blast : blasts_) {
    blast.centre.x() = memory->Next();
    blast.centre.y() = memory->Next();
    blast.radius = memory->Next();
    blast.impulse = memory->Next();
  }
}

void GlueStage::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
  EachContactPush(contact, *impulse, [this](const PartPush& push) {
    Glued* glued = GluedWith(push.fixture);
    if (glued == nullptr) return;
    glued->felt.push_back(push);
    glued->pushes += push.impulse.norm();
  });
}

void GlueStage::AddJoints(Glued* glued) {
  const float hz = static_cast<float>(w_.scene.solver.tick_hz * w_.scene.solver.substeps);
  const double tick_s = 1.0 / w_.scene.solver.tick_hz;
  for (const int j : glued->joints) {
    b2Joint* held = w_.built.joints[static_cast<std::size_t>(j)];
    if (held == nullptr) continue;
    // The last substep stands for all substeps.
    const JointForces forces = ForcesOf(held, hz);
    const Vector2d on_a = tick_s * FromB2(forces.on_a).cast<double>();
    const Vector2d on_b = tick_s * FromB2(forces.on_b).cast<double>();
    const Joint& joint = w_.scene.joints[static_cast<std::size_t>(j)];
    const int a = glued->net.NodeOf(joint.a), b = glued->net.NodeOf(joint.b);
    if (a >= 0) glued->pushed[static_cast<std::size_t>(a)] += on_a;
    if (b >= 0) glued->pushed[static_cast<std::size_t>(b)] += on_b;
    glued->pushes += std::max(on_a.norm(), on_b.norm());
  }
}

void GlueStage::Strain(Glued* glued) {
  b2Body* body = BodyOf(*glued);
  const bool anchored = IsAnchored(*glued);
  const double hz = w_.scene.solver.tick_hz;
  const double spin = static_cast<double>(body->GetAngularVelocity());
  const double turning = anchored ? 0 : (spin - glued->spin) * hz;
  const Vector2d gravity = w_.scene.gravity.cast<double>();
  // No bond bears more than half of the sum of all forces, inertial forces included.
  const double inner =
      anchored ? gravity.norm() : (std::fabs(turning) + spin * spin) * glued->reach / 2;
  if (glued->pushes * hz + inner * glued->whole <= glued->net.weakest) return;
  PartFinder parts(w_);
  for (const PartPush& push : glued->felt) {
    const int node = glued->net.NodeOf(parts.At(push.fixture, push.point));
    glued->pushed[static_cast<std::size_t>(node)] += push.impulse;
  }
  Vector2d sum(0, 0);
  for (const Vector2d& pushed : glued->pushed) sum += hz * pushed;
  const Rotation<double> rotation(static_cast<double>(body->GetAngle()));
  std::vector<Vector2d> forces;
  for (std::size_t n = 0; n < glued->pushed.size(); ++n) {
    Vector2d force = hz * glued->pushed[n];
    if (anchored) {
      force += glued->mass[n] * gravity;
    } else {
      // Subtract mass times acceleration; a common acceleration cancels.
      const Vector2d arm = rotation(glued->arm[n]);
      force -= glued->mass[n] / glued->whole * sum;
      force -= glued->mass[n] * (turning * Vector2d(-arm.y(), arm.x()) - spin * spin * arm);
    }
    forces.push_back(force);
  }
  const std::vector<double> loads = BondLoads(glued->net, forces);
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const BondNet::Bond& bond = glued->net.bonds[b];
    if (loads[b] > bond.strength) breaking_.push_back(bond.joint);
  }
}

void GlueStage::AfterTick() {
  for (Glued& glued : glued_) {
    const b2Body* body = BodyOf(glued);
    const bool moves = body->GetType() == b2_dynamicBody;
    const bool displayed = body->GetType() == b2_kinematicBody && !IsAnchored(glued);
    if (IsAside(*body) || displayed || (moves && !body->IsAwake())) continue;
    AddJoints(&glued);
    Strain(&glued);
  }
  std::sort(breaking_.begin(), breaking_.end());
}

void GlueStage::ProposeEdits(std::vector<Edit>* edits) {
  for (const int joint : breaking_) {
    if (w_.scene.joints[static_cast<std::size_t>(joint)].gone) continue;
    edits->emplace_back(BreakEdit{joint});
  }
}

}  // namespace

bool IsBreakableGlue(const Joint& joint) {
  return joint.kind == JointKind::kGlue && joint.strength > 0;
}

std::unique_ptr<Stage> MakeGlueStage(const StageWorld& world) {
  return std::make_unique<GlueStage>(world);
}

}  // namespace seam
