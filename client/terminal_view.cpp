#include "client/terminal_view.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/scene/planner/planner_rules.h"
#include "common/sync/method.h"

namespace seam {
namespace {

constexpr std::int64_t kFrameUs = 1000000 / 15;
constexpr int kGroundColour = 250, kGridColour = 240;
constexpr float kBricksWithin = 30000;  // m; no brick is further away
constexpr int kColumnsMax = 400, kRowsMax = 200;

/// Maps the world to dots. A braille cell is about twice as high as wide and has 2 by 4 dots, so
/// that dots are square.
struct View2 {
  Vec2 centre{0, 0};
  float dots_per_m = 1;
  int width = 0, height = 0;

  Vec2 operator()(const Vec2& world) const {
    return {static_cast<float>(width) / 2 + (world.x() - centre.x()) * dots_per_m,
            static_cast<float>(height) / 2 - (world.y() - centre.y()) * dots_per_m};
  }
};

/// Returns a part's outline in its own frame; `closed`: the last point is joined to the first.
std::vector<Vec2> OutlineOf(const Part& part, bool* closed) {
  *closed = !IsLine(part.kind);
  const auto round = [](const Vec2& centre, float radius, std::vector<Vec2>* points) {
    for (int i = 0; i < 16; ++i) {
      const float a = kPiFloat / 8 * static_cast<float>(i);
      points->push_back(centre + radius * Vec2(std::cos(a), std::sin(a)));
    }
  };
  std::vector<Vec2> points;
  if (part.kind == ShapeKind::kCircle) {
    round({0, 0}, part.radius, &points);
    points.push_back({part.radius, 0});
    points.push_back({0, 0});  // a spoke, so that rotation is visible
  } else if (part.kind == ShapeKind::kCapsule) {
    for (const Vec2& end : part.points) round(end, part.radius, &points);
  } else if (part.kind == ShapeKind::kBox) {
    const Vec2 half = part.size / 2;
    points = {{-half.x(), -half.y()}, {half.x(), -half.y()}, half, {-half.x(), half.y()}};
  } else {
    points = part.points;
  }
  return points;
}

/// A part's displayed pose and its authority; -1: anchored.
struct ShownPart {
  Vec2 position{0, 0};
  Rotation<float> rotation;
  int authority = -1;
};

bool FindShown(const World& world, const View& view, const Part& part, ShownPart* shown) {
  int body = -1;
  const auto read = [&](int of) {
    body = of;
    const auto i = static_cast<std::size_t>(of);
    return BodyState{{view.x[i], view.y[i]}, view.angle[i], {0, 0}, 0};
  };
  BodyState state;
  if (!ReadPart(world, part.id, read, &state)) return false;
  shown->position = state.position;
  shown->rotation = Rotation<float>(state.angle);
  shown->authority = body < 0 ? -1 : view.authority[static_cast<std::size_t>(body)];
  return state.position.allFinite();
}

View2 Camera2(const Client& client, const View& view, const BrailleCanvas& canvas) {
  const World& world = client.replica()->world();
  const Scene& scene = world.scene();
  View2 camera;
  camera.width = canvas.width();
  camera.height = canvas.height();
  const Vec2 size = (scene.camera.max - scene.camera.min).cwiseMax(1e-3f);
  camera.centre = (scene.camera.min + scene.camera.max) / 2;
  camera.dots_per_m = std::min(static_cast<float>(camera.width) / size.x(),
                               static_cast<float>(camera.height) / size.y());
  const PartId vehicle = client.vehicle();
  ShownPart own;
  if (vehicle < 0) return camera;
  const Part& part = scene.parts[static_cast<std::size_t>(vehicle)];
  if (!FindShown(world, view, part, &own)) return camera;
  // A third of the scene's camera, around the own vehicle.
  camera.centre = own.position + Vec2(0, 0.1f * size.y());
  camera.dots_per_m *= 3;
  return camera;
}

/// Draws the bricks of the scene, without the holes blown since.
void DrawBricks(const FeatherStore& bricks, const View2& camera, BrailleCanvas* canvas) {
  const Vec2 half = Vec2(static_cast<float>(camera.width), static_cast<float>(camera.height)) /
                    (2 * camera.dots_per_m);
  const auto units = [](float m) { return static_cast<int>(std::lround(m / kBrickUnit)); };
  const Vec2 low = (camera.centre - half).cwiseMax(-kBricksWithin).cwiseMin(kBricksWithin);
  const Vec2 high = (camera.centre + half).cwiseMax(-kBricksWithin).cwiseMin(kBricksWithin);
  for (const Brick& brick :
       bricks.InBox(units(low.x()), units(low.y()), units(high.x()), units(high.y()))) {
    const BrickKind& kind = bricks.kinds()[static_cast<std::size_t>(brick.kind)];
    const Vec2 corner = kBrickUnit * Vec2(static_cast<float>(brick.x), static_cast<float>(brick.y));
    const Vec2 size =
        kBrickUnit * Vec2(static_cast<float>(kind.width), static_cast<float>(kind.height));
    const Vec2 a = camera(corner), b = camera(corner + size);
    for (int y = static_cast<int>(b.y()); y <= static_cast<int>(a.y()); ++y) {
      for (int x = static_cast<int>(a.x()); x <= static_cast<int>(b.x()); ++x) {
        canvas->Dot(x, y, kGroundColour);
      }
    }
  }
}

/// Draws a dot at each crossing of lines of 1, 2 or 5 times a power of ten metres, so that movement
/// is seen against the background.
void DrawGrid(const View2& camera, BrailleCanvas* canvas) {
  constexpr float kLeastDots = 14;
  const float least_m = kLeastDots / camera.dots_per_m;
  const float decade = std::pow(10.0f, std::floor(std::log10(least_m)));
  float step = 10 * decade;
  for (const float factor : {5.0f, 2.0f, 1.0f}) {
    if (factor * decade >= least_m) step = factor * decade;
  }
  const Vec2 half = Vec2(static_cast<float>(camera.width), static_cast<float>(camera.height)) /
                    (2 * camera.dots_per_m);
  const Vec2 first = ((camera.centre - half) / step).array().ceil();
  const int columns = static_cast<int>(2 * half.x() / step) + 1;
  const int rows = static_cast<int>(2 * half.y() / step) + 1;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Vec2 at = camera((first + Vec2(static_cast<float>(i), static_cast<float>(j))) * step);
      canvas->Dot(static_cast<int>(at.x()), static_cast<int>(at.y()), kGridColour);
    }
  }
}

/// Draws the players' regions, the seams, where they decide about authority; the buffer zones
/// around them with fewer dots.
void DrawBorders(const Client& client, const View2& camera, BrailleCanvas* canvas) {
  const Scene& scene = client.replica()->world().scene();
  const Policy& policy = PolicyOf(client.room());
  if (!policy.PlansAuthority() || scene.planner->given) return;
  for (std::size_t p = 0; p < scene.players.size(); ++p) {
    const Player& player = scene.players[p];
    if (!player.has_region) continue;
    for (const bool zone : {false, true}) {
      if (zone && !policy.PlansFollowers()) continue;
      const Vec2 wider = Vec2(1, 1) * (zone ? scene.buffer_m : 0);
      const Vec2 a = camera(player.region_min - wider), b = camera(player.region_max + wider);
      const int colour = TerminalColour(static_cast<int>(p) + 1), every = zone ? 6 : 2;
      for (const float x : {a.x(), b.x()}) canvas->Line({x, a.y()}, {x, b.y()}, colour, every);
      for (const float y : {a.y(), b.y()}) canvas->Line({a.x(), y}, {b.x(), y}, colour, every);
    }
  }
}

}  // namespace

BrailleCanvas::BrailleCanvas(int columns, int rows)
    : columns_(std::clamp(columns, 1, kColumnsMax)),
      rows_(std::clamp(rows, 1, kRowsMax)),
      cells_(static_cast<std::size_t>(columns_ * rows_)) {}

void BrailleCanvas::Dot(int x, int y, int colour) {
  if (x < 0 || y < 0 || x >= width() || y >= height()) return;
  // Unicode's order of a cell's dots: down the left, down the right, then the lowest two.
  constexpr std::uint8_t kBits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
  Cell& cell = cells_[static_cast<std::size_t>((y / 4) * columns_ + x / 2)];
  cell.dots = static_cast<std::uint8_t>(cell.dots | kBits[y % 4][x % 2]);
  cell.colour = static_cast<std::uint8_t>(colour);
}

void BrailleCanvas::Line(Vec2 from, Vec2 to, int colour, int every) {
  // Clip to the canvas first (Liang and Barsky): lines of the ground are kilometres long.
  const Vec2 way = to - from;
  float begin = 0, end = 1;
  const float limits[2] = {static_cast<float>(width()), static_cast<float>(height())};
  for (int axis = 0; axis < 2; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const float speed = side * way[axis];
      const float room = side < 0 ? from[axis] : limits[axis] - from[axis];
      if (speed == 0 && room < 0) return;
      if (speed < 0) begin = std::max(begin, room / speed);
      if (speed > 0) end = std::min(end, room / speed);
    }
  }
  if (!(begin <= end)) return;
  const Vec2 a = from + begin * way, b = from + end * way;
  const int steps = static_cast<int>(std::ceil((b - a).cwiseAbs().maxCoeff())) + 1;
  for (int i = 0; i <= steps; i += every) {
    const Vec2 p = a + (b - a) * (static_cast<float>(i) / static_cast<float>(steps));
    Dot(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())), colour);
  }
}

std::string BrailleCanvas::Text() const {
  std::string text;
  int colour = -1;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Cell& cell = cells_[static_cast<std::size_t>(row * columns_ + column)];
      if (cell.dots == 0) {
        text += ' ';
        continue;
      }
      if (cell.colour != colour) text += "\033[38;5;" + std::to_string(cell.colour) + "m";
      colour = cell.colour;
      text += "\xe2";  // U+2800 and the dots, in UTF-8
      text += static_cast<char>(0xa0 | (cell.dots >> 6));
      text += static_cast<char>(0x80 | (cell.dots & 0x3f));
    }
    text += "\033[K\r\n";
  }
  return text + "\033[0m";
}

int TerminalColour(int peer) {
  constexpr int kColourCodes[] = {33, 208, 36, 176, 220, 117, 95, 99, 29, 181};
  return peer <= 0 ? 246 : kColourCodes[(peer - 1) % 10];
}

void DrawInTerminal(const Client& client, const FeatherStore* bricks, BrailleCanvas* canvas) {
  const World& world = client.replica()->world();
  const View view = client.replica()->MakeView();
  const View2 camera = Camera2(client, view, *canvas);
  DrawGrid(camera, canvas);
  DrawBorders(client, camera, canvas);
  if (bricks != nullptr) DrawBricks(*bricks, camera, canvas);
  for (const Part& part : world.scene().parts) {
    ShownPart shown;
    if (part.gone || !FindShown(world, view, part, &shown)) continue;
    const int colour = shown.authority < 0 ? kGroundColour : TerminalColour(shown.authority);
    bool closed = false;
    const std::vector<Vec2> points = OutlineOf(part, &closed);
    const std::size_t lines = points.size() - (closed ? 0 : 1);
    for (std::size_t i = 0; i < lines; ++i) {
      const Vec2 a = shown.position + shown.rotation(points[i]);
      const Vec2 b = shown.position + shown.rotation(points[(i + 1) % points.size()]);
      canvas->Line(camera(a), camera(b), colour);
    }
  }
}

std::optional<float> OwnSpeed(const Client& client) {
  const PartId vehicle = client.replica() != nullptr ? client.vehicle() : -1;
  if (vehicle < 0) return std::nullopt;
  const World& world = client.replica()->world();
  BodyState state;
  const auto read = [&world](int body) { return world.Read(body); };
  if (!ReadPart(world, vehicle, read, &state)) return std::nullopt;
  return state.velocity.norm();
}

namespace {

/// Cuts a line, because a wrapped one would push the picture up.
std::string CutTo(const std::string& line, int columns) {
  return line.substr(0, static_cast<std::size_t>(std::max(0, columns - 1)));
}

}  // namespace

TerminalView::TerminalView() {
  if (isatty(1) == 0) throw OperatorError("--show needs a terminal on standard output");
  std::fputs("\033[?25l\033[2J", stdout);
}

TerminalView::~TerminalView() {
  std::fputs("\033[0m\033[?25h\n", stdout);
  std::fflush(stdout);
}

void TerminalView::Show(std::int64_t now_us, const Client& client, const std::string& status,
                        const std::string& keys) {
  next_us_ = now_us + kFrameUs;
  winsize size{};
  const bool known = ioctl(1, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 1;
  const int columns = known ? size.ws_col : 80;
  BrailleCanvas canvas(columns, known ? std::max(1, size.ws_row - 2) : 22);
  if (client.replica() != nullptr) {
    const Scene& scene = client.replica()->world().scene();
    if (bricks_ == nullptr && !scene.bricks.empty()) {
      bricks_ = std::make_unique<FeatherStore>(scene.bricks);
    }
    DrawInTerminal(client, bricks_.get(), &canvas);
  }
  const std::string frame = "\033[H" + canvas.Text() + CutTo(status, columns) + "\033[K\r\n" +
                            CutTo(keys, columns) + "\033[K";
  std::fwrite(frame.data(), 1, frame.size(), stdout);
  std::fflush(stdout);
}

}  // namespace seam
