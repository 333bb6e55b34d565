#pragma once
/// The rows of a scene's joints and contacts at any pose of its bodies, for tests.

#include <cmath>
#include <string>
#include <vector>

#include "common/physics/exact/contact_rows.h"
#include "common/physics/exact/joint_rows.h"
#include "common/physics/world_build.h"

namespace seam {

/// A row with its own ends.
struct KeptRow {
  Row row;
  RowEnd end[4];
};

/// A body of the list is an assembly, by its index.
class RowsOfScene {
 public:
  explicit RowsOfScene(const std::string& text)
      : scene_(ParseScene(text, "rows.toml")),
        composition_(Compose(scene_)),
        world_(ToB2(scene_.gravity)),
        built_(BuildScene(scene_, composition_, &world_)) {
    for (b2Body* body : built_.bodies) bodies.push_back(BodyOf(body));
  }

  std::vector<ExactBody> bodies;
  Pace pace{0.01, 2};

  int index(b2Body* body) const {
    for (std::size_t i = 0; i < built_.bodies.size(); ++i) {
      if (built_.bodies[i] == body) return static_cast<int>(i);
    }
    return -1;
  }
  b2World& world() { return world_; }
  b2Joint* made(int joint) const { return built_.joints[static_cast<std::size_t>(joint)]; }

  /// The bodies' states as the engine's.
  void Tell() {
    for (const ExactBody& q : bodies) {
      q.body->SetTransform(b2Vec2(0, 0), static_cast<float>(q.a));
      const b2Vec2 off = q.body->GetWorldCenter();
      q.body->SetTransform(b2Vec2(static_cast<float>(q.x), static_cast<float>(q.y)) - off,
                           static_cast<float>(q.a));
      q.body->SetLinearVelocity(b2Vec2(static_cast<float>(q.vx), static_cast<float>(q.vy)));
      q.body->SetAngularVelocity(static_cast<float>(q.w));
    }
  }

  /// Of the scene's joint of this index.
  std::vector<KeptRow> JointRows(int joint) const {
    ExactJoint read = ReadJoint(made(joint));
    b2Body* a = read.made->GetBodyA();
    b2Body* b = read.made->GetBodyB();
    const b2Vec2 at_a = read.anchor_a - a->GetLocalCenter();
    const b2Vec2 at_b = read.anchor_b - b->GetLocalCenter();
    ExactJointEnds ends{index(a),
                        index(b),
                        static_cast<double>(at_a.x),
                        static_cast<double>(at_a.y),
                        static_cast<double>(at_b.x),
                        static_cast<double>(at_b.y)};
    if (read.type == e_gearJoint) {
      auto& gear = *static_cast<b2GearJoint*>(read.made);
      ends.base_a = index(gear.GetJoint1()->GetBodyA());
      ends.base_b = index(gear.GetJoint2()->GetBodyA());
    }
    LookAt(1.0 / 60, &read);
    std::vector<KeptRow> rows(static_cast<std::size_t>(RowCount(read)));
    std::vector<Row> written(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) written[i].end = rows[i].end;
    FillJoint(read, ends, bodies, pace, written.data());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].row = written[i];
      rows[i].row.end = nullptr;  // the vector may move
    }
    return rows;
  }

  static double Speed(const KeptRow& kept, const std::vector<ExactBody>& of) {
    double speed = kept.row.fixed_speed;
    for (int e = 0; e < kept.row.ends; ++e) {
      const ExactBody& q = of[static_cast<std::size_t>(kept.end[e].body)];
      speed += kept.end[e].j[0] * q.vx + kept.end[e].j[1] * q.vy + kept.end[e].j[2] * q.w;
    }
    return speed;
  }

 private:
  static ExactBody BodyOf(b2Body* body) {
    ExactBody q;
    q.body = body;
    q.x = static_cast<double>(body->GetWorldCenter().x);
    q.y = static_cast<double>(body->GetWorldCenter().y);
    q.a = static_cast<double>(body->GetAngle());
    q.c = std::cos(q.a);
    q.s = std::sin(q.a);
    if (body->GetType() != b2_dynamicBody) return q;
    q.im = 1 / static_cast<double>(body->GetMass());
    const b2Vec2 centre = body->GetLocalCenter();
    q.inertia = static_cast<double>(body->GetInertia() - body->GetMass() * b2Dot(centre, centre));
    q.ii = 1 / q.inertia;
    return q;
  }

  Scene scene_;
  Composition composition_;
  b2World world_;
  BuiltScene built_;
};

}  // namespace seam
