/// The rows of every kind of joint: the Jacobian is the derivative of the error.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "tests/physics/exact/rows_of_scene.h"

namespace seam {
namespace joint_rows_test {

/// Two bodies whose origins are not their centres of mass, apart in the air.
const char* kTwo = R"(
[[part]]
name = "a"
polygon = [[-0.6, -0.1], [1.0, -0.2], [0.9, 0.3]]
position = [0.2, 0.1]
angle = 0.3
[[part]]
name = "b"
polygon = [[-0.3, -0.5], [0.7, -0.2], [0.1, 0.6]]
position = [1.4, 0.8]
angle = -0.7
[[joint]]
name = "j"
a = "a"
b = "b"
)";

std::string Two(const std::string& joint) { return kTwo + joint + "\n"; }

/// Moves everything off the pose in which the joint is shut, and sets it in motion.
void Disturb(RowsOfScene* scene) {
  double by = 0.05;
  for (ExactBody& q : scene->bodies) {
    if (!q.moves()) continue;
    q.x += by;
    q.y -= 0.6 * by;
    q.Turn(1.7 * by);
    q.vx = -20 * by;
    q.vy = 31 * by;
    q.w = -60 * by;
    by = -0.7 * by;
  }
  scene->Tell();
}

double* Of(ExactBody* q, int axis) { return axis == 0 ? &q->x : axis == 1 ? &q->y : &q->a; }

/// The derivative of row `index`'s error by a body's coordinate.
double Slope(RowsOfScene* scene, int joint, std::size_t index, std::size_t body, int axis) {
  constexpr double kBy = 1e-5;
  ExactBody& q = scene->bodies[body];
  const ExactBody was = q;
  double error[2];
  for (int side = 0; side < 2; ++side) {
    *Of(&q, axis) = *Of(&q, axis) + (side == 0 ? -kBy : 2 * kBy);
    q.c = std::cos(q.a);
    q.s = std::sin(q.a);
    error[side] = scene->JointRows(joint)[index].row.error;
  }
  q = was;
  return (error[1] - error[0]) / (2 * kBy);
}

double Written(const KeptRow& kept, std::size_t body, int axis) {
  double j = 0;
  for (int e = 0; e < kept.row.ends; ++e) {
    if (kept.end[e].body == static_cast<int>(body)) j += kept.end[e].j[axis];
  }
  return j;
}

/// Expects it of all rows of the joint that have an error, and that there are `rows` of them.
void ExpectSlopes(const std::string& text, int rows, int joint = 0) {
  SCOPED_TRACE(text);
  RowsOfScene scene(text);
  Disturb(&scene);
  const std::vector<KeptRow> kept = scene.JointRows(joint);
  int with_error = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i].row.error == 0) continue;
    ++with_error;
    for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
      if (!scene.bodies[body].moves()) continue;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(Written(kept[i], body, axis), Slope(&scene, joint, i, body, axis), 1e-8)
            << "row " << i << ", body " << body << ", axis " << axis;
      }
    }
  }
  EXPECT_EQ(with_error, rows);
}

TEST(JointRows, TheJacobianIsTheDerivativeOfTheError) {
  const std::string at = "anchor = [0.9, 0.5]\n", sliding = at + "axis = [0.8, 0.6]\n";
  const std::string ends = "anchor_a = [0.5, 0.3]\nanchor_b = [1.3, 0.9]\n";
  ExpectSlopes(Two("kind = \"hinge\"\n" + at), 2);
  ExpectSlopes(Two("kind = \"hinge\"\nlimits = [-0.2, 0.1]\n" + at), 4);
  ExpectSlopes(Two("kind = \"hinge\"\nlimits = [0, 0]\n" + at), 3);
  ExpectSlopes(Two("kind = \"prismatic\"\n" + sliding), 2);
  ExpectSlopes(Two("kind = \"prismatic\"\nlimits = [-0.03, 0.03]\n" + sliding), 4);
  ExpectSlopes(Two("kind = \"wheel\"\nfrequency = 4\nlimits = [-0.03, 0.03]\n" + sliding), 4);
  ExpectSlopes(Two("kind = \"wheel\"\n" + sliding), 2);
  ExpectSlopes(Two("kind = \"weld\"\nfrequency = 5\n" + at), 3);
  ExpectSlopes(Two("kind = \"distance\"\n" + ends), 1);
  ExpectSlopes(Two("kind = \"distance\"\nfrequency = 3\n" + ends), 1);
  ExpectSlopes(Two("kind = \"distance\"\nlimits = [0.9, 1.1]\n" + ends), 2);
  ExpectSlopes(Two("kind = \"rope\"\nlength = 1\n" + ends), 1);
  ExpectSlopes(Two("kind = \"motor\"\nforce = 10\ntorque = 10\n"), 3);
  ExpectSlopes(Two("kind = \"pulley\"\nratio = 2.5\nground_a = [0, 5]\nground_b = [2, 4]\n" + ends),
               1);
}

/// Two wheels, or a rack and a pinion, on a frame that moves.
std::string GearOn(const std::string& first, const std::string& second) {
  return "[[part]]\nname = \"frame\"\npolygon = [[-2, -0.2], [2, -0.3], [1.8, 0.4]]\n"
         "[[part]]\nname = \"left\"\nbox = [0.5, 0.7]\nposition = [-1, 0.2]\n"
         "[[part]]\nname = \"right\"\nbox = [0.9, 0.3]\nposition = [1, 0.3]\n"
         "[[joint]]\nname = \"l\"\na = \"frame\"\nb = \"left\"\nanchor = [-1.1, 0.1]\n" +
         first + "\n[[joint]]\nname = \"r\"\na = \"frame\"\nb = \"right\"\nanchor = [1.1, 0.2]\n" +
         second +
         "\n[[joint]]\nname = \"g\"\nkind = \"gear\"\njoints = [\"l\", \"r\"]\nratio = -1.7\n";
}

TEST(JointRows, AGearsRowIsTheDerivativeOfItsCoordinates) {
  const std::string hinge = "kind = \"hinge\"", rack = "kind = \"prismatic\"\naxis = [0.6, 0.8]";
  ExpectSlopes(GearOn(hinge, hinge), 1, 2);
  ExpectSlopes(GearOn(rack, hinge), 1, 2);
  ExpectSlopes(GearOn(hinge, rack), 1, 2);
  ExpectSlopes(GearOn(rack, rack), 1, 2);
}

const Row* Find(const std::vector<KeptRow>& rows, RowKind kind, std::size_t* at) {
  for (*at = 0; *at < rows.size(); ++*at) {
    if (rows[*at].row.kind == kind) return &rows[*at].row;
  }
  return nullptr;
}

TEST(JointRows, AMotorsSpeedEqualsTheEnginesJointSpeed) {
  const std::string motor = "motor = {speed = 3, torque = 5}\nanchor = [0.9, 0.5]\n";
  const std::string force = "motor = {speed = 3, force = 5}\nanchor = [0.9, 0.5]\n";
  for (const std::string& text :
       {Two("kind = \"hinge\"\n" + motor), Two("kind = \"prismatic\"\n" + force),
        Two("kind = \"wheel\"\naxis = [0.8, 0.6]\nfrequency = 4\n" + motor)}) {
    SCOPED_TRACE(text);
    RowsOfScene scene(text);
    Disturb(&scene);
    b2Joint* made = scene.made(0);
    double speed = 0;
    switch (made->GetType()) {
      case e_revoluteJoint:
        speed = static_cast<double>(static_cast<b2RevoluteJoint*>(made)->GetJointSpeed());
        break;
      case e_prismaticJoint:
        speed = static_cast<double>(static_cast<b2PrismaticJoint*>(made)->GetJointSpeed());
        break;
      default:
        speed = static_cast<double>(static_cast<b2WheelJoint*>(made)->GetJointAngularSpeed());
    }
    ASSERT_GT(std::fabs(speed), 0.1);
    const std::vector<KeptRow> rows = scene.JointRows(0);
    std::size_t at = 0;
    const Row* row = Find(rows, RowKind::kMotor, &at);
    ASSERT_NE(row, nullptr);
    EXPECT_NEAR(RowsOfScene::Speed(rows[at], scene.bodies), speed, 1e-5);
    EXPECT_NEAR(row->target, 3, 1e-6);
    EXPECT_NEAR(row->hi, 5 * scene.pace.h, 1e-8) << "N s or N m s in a substep";
    EXPECT_EQ(row->lo, -row->hi);
  }
}

TEST(JointRows, ASpringIsImplicit) {
  // j v + gamma lambda = target says lambda = -h (k (e + h j v) + d j v).
  RowsOfScene scene(
      Two("kind = \"distance\"\nfrequency = 3\ndamping_ratio = 0.4\n"
          "anchor_a = [0.5, 0.3]\nanchor_b = [1.3, 0.9]\n"));
  Disturb(&scene);
  const auto& made = *static_cast<b2DistanceJoint*>(scene.made(0));
  const auto k = static_cast<double>(made.GetStiffness());
  const auto d = static_cast<double>(made.GetDamping());
  ASSERT_GT(d, 0);
  const Row row = scene.JointRows(0)[0].row;
  ASSERT_EQ(row.kind, RowKind::kSoft);
  const double h = scene.pace.h;
  for (const double speed : {-2.0, 0.0, 3.0}) {
    const double lambda = (row.target - speed) / row.gamma;
    EXPECT_NEAR(lambda, -h * (k * (row.error + h * speed) + d * speed), 1e-9) << speed;
  }
}

TEST(JointRows, AFixedBodyAddsItsSpeedToTheRightHandSide) {
  RowsOfScene scene(
      "[[part]]\nname = \"post\"\nbox = [1, 1]\nanchored = true\n"
      "[[part]]\nname = \"load\"\nbox = [1, 1]\nposition = [2, 0]\n"
      "[[joint]]\nname = \"j\"\nkind = \"hinge\"\na = \"post\"\nb = \"load\"\nanchor = [1, 0]\n");
  ExactBody& post = scene.bodies[0];
  ASSERT_FALSE(post.moves());
  post.vx = 0.5;
  post.vy = -0.25;
  post.w = 2;
  const std::vector<KeptRow> rows = scene.JointRows(0);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].row.ends, 1);
  // The point of the post at (1, 0) moves with (0.5, -0.25 + 2).
  EXPECT_NEAR(rows[0].row.fixed_speed, -0.5, 1e-12);
  EXPECT_NEAR(rows[1].row.fixed_speed, -1.75, 1e-12);
}

}  // namespace joint_rows_test
}  // namespace seam
