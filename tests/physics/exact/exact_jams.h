#pragma once
/// Random jams for tests: crates that overlap deeply, some of them jointed to each other, between
/// walls or on a wagon with rails. Most are clamped from more sides than they can give way to.

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {

/// What a jam lies in.
enum class JamPlace { kPit, kWagon };

class JamMaker {
 public:
  explicit JamMaker(unsigned seed) : random_(seed) {}

  /// Scene text. `press` (scene text) comes after it.
  std::string Text(JamPlace place, const std::string& press = "") {
    half_ = Between(0.6, 1.5);
    std::string text = "[[part]]\nname = \"ground\"\nchain = [[-200, 0], [200, 0]]\n";
    text += place == JamPlace::kPit ? Pit() : Wagon();
    const int count = 3 + Number(10);
    std::vector<std::array<double, 2>> at;
    for (int i = 0; i < count; ++i) text += Crate(i, &at);
    const int joints = place == JamPlace::kPit ? 1 + Number(count - 1) : Number(count);
    for (int i = 0; i < joints; ++i) text += Hinge(i, at);
    return text + press;
  }

 private:
  double Between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 5) / 134217728.0;
  }
  int Number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  static std::string Box(const std::string& name, double w, double h, double x, double y,
                         const std::string& rest) {
    return PartText(name, "box = [" + FloatDigits(w) + ", " + FloatDigits(h) + "]\nposition = [" +
                              FloatDigits(x) + ", " + FloatDigits(y) + "]\n" + rest);
  }

  std::string Pit() {
    bottom_ = 0;
    return Box("left", 0.4, 3, -half_ - 0.2, 1.5, "anchored = true\n") +
           Box("right", 0.4, 3, half_ + 0.2, 1.5, "anchored = true\n");
  }

  std::string Wagon() {
    bottom_ = 1.2;
    std::string text = Box("cart", 2 * half_ + 0.4, 0.4, 0, 1,
                           "friction = 0.9\ndensity = " + FloatDigits(Between(1, 10)));
    for (const double side : {-1.0, 1.0}) {
      const std::string n = side < 0 ? "0" : "1";
      const double rail = side * (half_ + 0.1), axle = 0.7 * side * half_;
      text += Box("rail-" + n, 0.2, 1, rail, 1.7, "density = 2\n");
      text += "[[joint]]\nname = \"w" + n + "\"\nkind = \"weld\"\na = \"cart\"\nb = \"rail-" + n +
              "\"\nanchor = [" + FloatDigits(rail) + ", 1.2]\n";
      text += PartText("wheel-" + n, "circle = 0.4\nfriction = 0.9\ndensity = 4\nposition = [" +
                                         FloatDigits(axle) + ", 0.4]");
      text += HingeText("axle-" + n, "cart", "wheel-" + n, axle, 0.4);
    }
    return text;
  }

  std::string Crate(int i, std::vector<std::array<double, 2>>* at) {
    const double w = Between(0.2, 0.9), h = Between(0.2, 0.9);
    const double x = Between(-half_ + 0.4 * w, half_ - 0.4 * w);
    const double y = bottom_ + Between(0.4 * h, 1.4);
    at->push_back({x, y});
    std::string rest = "density = " + FloatDigits(std::pow(10, Between(-1, 1.5)));
    rest += "\nfriction = " + FloatDigits(Between(0, 1));
    rest +=
        "\nvelocity = [" + FloatDigits(Between(-3, 3)) + ", " + FloatDigits(Between(-3, 3)) + "]\n";
    if (Number(3) == 0) rest += "angle = " + FloatDigits(Between(-0.5, 0.5)) + "\n";
    if (Number(4) == 0) rest += "restitution = 0.5\n";
    return Box("c" + std::to_string(i), w, h, x, y, rest);
  }

  std::string Hinge(int i, const std::vector<std::array<double, 2>>& at) {
    const auto count = static_cast<int>(at.size());
    const int a = Number(count), b = Number(count);
    if (a == b) return "";
    const auto &p = at[static_cast<std::size_t>(a)], &q = at[static_cast<std::size_t>(b)];
    std::string rest = Number(3) == 0 ? "limits = [-0.2, 0.3]\n" : "";
    if (Number(3) == 0) rest += "collide = true\n";
    return HingeText("h" + std::to_string(i), "c" + std::to_string(a), "c" + std::to_string(b),
                     (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, rest);
  }

  std::mt19937 random_;
  double half_ = 1;    // m, width of the room
  double bottom_ = 0;  // m
};

}  // namespace seam
