// Drives the scene `rover` over LCM until its pose is that of a parked rover.
//   lcm-gen --cpp --cpp-hpath . lcmtypes/*.lcm
//   c++ -I. docs/examples/rover.cpp -llcm -o rover
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <utility>

#include "seam/drive_t.hpp"
#include "seam/message_t.hpp"
#include "seam/pose_t.hpp"

struct Driver {
  lcm::LCM lcm;
  bool gate = false, parked = false;

  void OnPose(const lcm::ReceiveBuffer*, const std::string&, const seam::pose_t* pose) {
    if (pose->name == "gate") gate = true;  // no pose of it comes any more once it has gone
    if (pose->name != "rover") return;
    const double to_gate = -1.5 - pose->x, to_bay = 10 - pose->x;
    const double way = std::exchange(gate, false) ? to_gate - 0.5 : to_bay;
    seam::drive_t drive{0, std::clamp(0.4 * way - 0.2 * pose->vx, -1.0, 1.0), 0, 0};
    lcm.publish("ROVER.DRIVE", &drive);
    seam::message_t sensor{0, "gate", 1, {std::abs(to_gate)}, ""};
    lcm.publish("ROVER.SENSOR", &sensor);
    parked = std::abs(to_bay) < 0.5 && std::abs(pose->vx) < 0.02;
  }
};

int main() {
  Driver driver;
  driver.lcm.subscribe("ROVER.POSE", &Driver::OnPose, &driver);
  while (!driver.parked && driver.lcm.handle() == 0) {
  }
  std::puts("parked");
}
