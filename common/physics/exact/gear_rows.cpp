#include "common/physics/exact/gear_rows.h"

#include <algorithm>

namespace seam {
namespace {

GearSides::Side ReadSide(b2Joint* joint) {
  GearSides::Side side;
  if (joint->GetType() == e_prismaticJoint) {
    const auto& slide = *static_cast<b2PrismaticJoint*>(joint);
    side.slides = true;
    side.base = slide.GetLocalAnchorA();
    side.arm = slide.GetLocalAnchorB();
    side.axis = slide.GetLocalAxisA();
  } else {
    const auto& hinge = *static_cast<b2RevoluteJoint*>(joint);
    side.reference = static_cast<double>(hinge.GetReferenceAngle());
  }
  return side;
}

/// Adds to the row's end for this body, or makes one.
void Add(int place, const ExactBody& body, double jx, double jy, double jw, Row* row) {
  if (!body.moves()) {
    row->fixed_speed += jx * body.vx + jy * body.vy + jw * body.w;
    return;
  }
  for (int e = 0; e < row->ends; ++e) {
    RowEnd& end = row->end[e];
    if (end.body != place) continue;
    end.j[0] += jx;
    end.j[1] += jy;
    end.j[2] += jw;
    return;
  }
  row->End(place, jx, jy, jw);
}

/// Arm from the centre of mass to a point of the body, in the world, m. In double precision,
/// because single precision would limit the accuracy of a rack.
struct Arm {
  double x, y;
};

Arm FromCentre(const ExactBody& q, const b2Vec2& local) {
  const b2Vec2 arm = local - q.body->GetLocalCenter();
  const auto x = static_cast<double>(arm.x), y = static_cast<double>(arm.y);
  return {q.c * x - q.s * y, q.s * x + q.c * y};
}

/// Adds one joint's share of the row; returns its coordinate.
double AddSide(const GearSides::Side& side, int base, int moved,
               const std::vector<ExactBody>& bodies, double ratio, Row* row) {
  const ExactBody& c = bodies[static_cast<std::size_t>(base)];
  const ExactBody& a = bodies[static_cast<std::size_t>(moved)];
  if (!side.slides) {
    Add(moved, a, 0, 0, ratio, row);
    Add(base, c, 0, 0, -ratio, row);
    return a.a - c.a - side.reference;
  }
  const auto lx = static_cast<double>(side.axis.x), ly = static_cast<double>(side.axis.y);
  const double ux = c.c * lx - c.s * ly, uy = c.s * lx + c.c * ly;
  const Arm from = FromCentre(c, side.base), to = FromCentre(a, side.arm);
  const double wx = a.x + to.x - c.x, wy = a.y + to.y - c.y;
  Add(moved, a, ratio * ux, ratio * uy, ratio * (to.x * uy - to.y * ux), row);
  Add(base, c, -ratio * ux, -ratio * uy, -ratio * (wx * uy - wy * ux), row);
  return ux * (wx - from.x) + uy * (wy - from.y);
}

}  // namespace

GearSides ReadGear(b2GearJoint* gear) {
  GearSides sides;
  sides.first = ReadSide(gear->GetJoint1());
  sides.second = ReadSide(gear->GetJoint2());
  sides.ratio = static_cast<double>(gear->GetRatio());
  return sides;
}

void FillGear(const ExactJoint& joint, const ExactJointEnds& ends,
              const std::vector<ExactBody>& bodies, double h, Row* row) {
  row->kind = RowKind::kHard;
  row->ends = 0;
  row->fixed_speed = 0;
  row->tense_a = row->tense_b = -1;
  row->gamma = 0;
  const GearSides& gear = joint.gear;
  row->error = AddSide(gear.first, ends.base_a, ends.a, bodies, 1, row);
  row->error += gear.ratio * AddSide(gear.second, ends.base_b, ends.b, bodies, gear.ratio, row);
  row->lo = -kUnbounded;
  row->hi = kUnbounded;
  row->target = HardTarget(row->error, h);
}

}  // namespace seam
