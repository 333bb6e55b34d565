/// The rows of contacts: derivatives of the separation, and the terms that turn with a disc.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/exact/rows_of_scene.h"

namespace seam {
namespace contact_rows_test {

const char* kFloor = "[[part]]\nname = \"floor\"\nbox = [10, 1]\nposition = [0, -0.5]\n";

/// The first touching contact after a step of no time, read as the solver does.
ExactContact ContactOf(RowsOfScene* scene) {
  scene->world().Step(0, 1, 1);
  for (b2Contact* c = scene->world().GetContactList(); c != nullptr; c = c->GetNext()) {
    if (!c->IsTouching()) continue;
    ExactContact contact;
    contact.made = c;
    contact.a = scene->index(c->GetFixtureA()->GetBody());
    contact.b = scene->index(c->GetFixtureB()->GetBody());
    ReadContact(scene->bodies, 0, &contact);
    return contact;
  }
  return ExactContact();
}

struct PointRows {
  KeptRow normal, friction;
};

/// Rows of the contact's first point at the bodies' current poses.
PointRows RowsOf(const RowsOfScene& scene, const ExactContact& contact) {
  PointRows out;
  RowEnd ends[2 * b2_maxManifoldPoints][2];
  Row rows[2 * b2_maxManifoldPoints];
  for (int i = 0; i < 2 * contact.count; ++i) rows[i].end = ends[i];
  FillContact(contact, scene.bodies, scene.pace, rows);
  for (int i = 0; i < 2; ++i) {
    KeptRow& kept = i == 0 ? out.normal : out.friction;
    kept.row = rows[i];
    std::copy_n(ends[i], rows[i].ends, kept.end);
    kept.row.end = nullptr;
  }
  return out;
}

double Written(const KeptRow& kept, int body, int axis) {
  for (int e = 0; e < kept.row.ends; ++e) {
    if (kept.end[e].body == body) return kept.end[e].j[axis];
  }
  return 0;
}

void ExpectSlopes(RowsOfScene* scene) {
  const ExactContact contact = ContactOf(scene);
  ASSERT_GT(contact.count, 0);
  const KeptRow now = RowsOf(*scene, contact).normal;
  for (const int body : {contact.a, contact.b}) {
    ExactBody& q = scene->bodies[static_cast<std::size_t>(body)];
    const ExactBody was = q;
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kBy = 1e-5;
      double error[2];
      for (int side = 0; side < 2; ++side) {
        q = was;
        (axis == 0 ? q.x : axis == 1 ? q.y : q.a) += side == 0 ? -kBy : kBy;
        q.c = std::cos(q.a);
        q.s = std::sin(q.a);
        error[side] = RowsOf(*scene, contact).normal.row.error;
      }
      q = was;
      EXPECT_NEAR(Written(now, body, axis), (error[1] - error[0]) / (2 * kBy), 1e-8)
          << "body " << body << ", axis " << axis;
    }
  }
}

TEST(ContactRows, ABoxsNormalRowIsTheDerivativeOfTheSeparation) {
  RowsOfScene scene(std::string(kFloor) +
                    "[[part]]\nname = \"crate\"\nbox = [1, 0.6]\nposition = [0.2, 0.295]\n");
  ExpectSlopes(&scene);
}

TEST(ContactRows, ADiscsNormalRowKnowsNoTurningAndItsFrictionRowTheRadius) {
  RowsOfScene scene(std::string(kFloor) +
                    "[[part]]\nname = \"disc\"\ncircle = 0.5\nposition = [0.2, 0.495]\n");
  const ExactContact contact = ContactOf(&scene);
  ASSERT_EQ(contact.count, 1);
  const int disc = 1;
  const PointRows rows = RowsOf(scene, contact);
  EXPECT_NEAR(Written(rows.normal, disc, 2), 0, 1e-6);
  EXPECT_NEAR(std::fabs(Written(rows.friction, disc, 2)), 0.5, 0.01);
  EXPECT_NEAR(std::fabs(Written(rows.friction, disc, 0)), 1, 1e-6);
}

TEST(ContactRows, TurningADiscDoesNotMoveItsContactAndTurningABoxDoes) {
  for (const bool round : {true, false}) {
    RowsOfScene scene(std::string(kFloor) +
                      (round
                           ? "[[part]]\nname = \"disc\"\ncircle = 0.5\nposition = [0.2, 0.495]\n"
                           : "[[part]]\nname = \"disc\"\nbox = [1, 1]\nposition = [0.2, 0.495]\n"));
    const ExactContact contact = ContactOf(&scene);
    ASSERT_GT(contact.count, 0);
    const PointRows before = RowsOf(scene, contact);
    scene.bodies[1].Turn(0.3);
    const PointRows after = RowsOf(scene, contact);
    const double moved = std::fabs(after.normal.row.error - before.normal.row.error);
    if (round) {
      EXPECT_NEAR(moved, 0, 1e-12);
      EXPECT_EQ(Written(after.friction, 1, 2), Written(before.friction, 1, 2));
    } else {
      EXPECT_GT(moved, 0.05);
    }
  }
}

TEST(ContactRows, OverlapIsPushedOutSlowlyAndAGapMayClose) {
  RowsOfScene scene(std::string(kFloor) +
                    "[[part]]\nname = \"crate\"\nbox = [1, 0.6]\nposition = [0.2, 0.27]\n");
  const ExactContact contact = ContactOf(&scene);
  ASSERT_GT(contact.count, 0);
  const double h = scene.pace.h;
  Row row = RowsOf(scene, contact).normal.row;
  ASSERT_LT(row.error, -0.02);
  EXPECT_NEAR(row.target, 0.2 / (h * scene.pace.substeps) * (-row.error - 0.005), 1e-6)
      << "a fifth of what exceeds 5 mm, in a step";
  scene.bodies[1].y -= 1;
  EXPECT_EQ(RowsOf(scene, contact).normal.row.target, 2) << "at most, m/s";
  scene.bodies[1].y += 1.5;
  row = RowsOf(scene, contact).normal.row;
  ASSERT_GT(row.error, 0.1);
  EXPECT_NEAR(row.target, -row.error / h, 1e-9) << "it may come as near as it is";
  EXPECT_EQ(row.lo, 0);
}

}  // namespace contact_rows_test
}  // namespace seam
