#include "common/topology/feather_blast.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "common/base/check.h"
#include "common/scene/bricks.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

using Eigen::Vector2d;

constexpr double kUnit = static_cast<double>(kBrickUnit);

Vector2d MiddleOf(const BrickField& field, int x, int y, int columns, int rows) {
  return Vector2d(2 * x + columns * field.width, 2 * y + rows * field.height) * (kUnit / 2);
}

/// Returns the velocity, m/s, that the blast gives at a position: outwards.
Vector2d SpeedAt(const Blast& blast, const Vector2d& place) {
  const Vector2d out = place - blast.centre.cast<double>();
  const double distance = std::sqrt(out.x() * out.x() + out.y() * out.y());
  const double radius = static_cast<double>(blast.radius);
  if (distance >= radius) return {0, 0};
  const double speed = static_cast<double>(blast.speed) * (1 - distance / radius);
  if (distance < 1e-6) return {0, speed};
  return out * (speed / distance);
}

bool Before(const Brick& a, const Brick& b) {
  return std::tie(a.kind, a.y, a.x) < std::tie(b.kind, b.y, b.x);
}

/// Returns all bricks that the blast would free, sorted by kind, then y, then x.
std::vector<Brick> FreeableBricks(const FeatureList<BrickField>& fields, const FeatherStore& left,
                                  const Blast& blast) {
  if (blast.speed <= 0) return {};
  const auto unit = [](float metres) {
    return static_cast<int>(std::floor(static_cast<double>(metres) / kUnit));
  };
  const Vec2 low = blast.centre.array() - blast.radius, high = blast.centre.array() + blast.radius;
  std::vector<Brick> loose =
      left.InBox(unit(low.x()) - 1, unit(low.y()) - 1, unit(high.x()) + 2, unit(high.y()) + 2);
  const auto stays = [&](const Brick& b) {
    const BrickField& field = fields[static_cast<std::size_t>(b.kind)];
    const double strength = static_cast<double>(field.strength);
    const Vector2d speed = SpeedAt(blast, MiddleOf(field, b.x, b.y, 1, 1));
    return speed.squaredNorm() <= std::max(1e-6, strength * strength);
  };
  loose.erase(std::remove_if(loose.begin(), loose.end(), stays), loose.end());
  std::sort(loose.begin(), loose.end(), Before);
  loose.erase(std::unique(loose.begin(), loose.end()), loose.end());
  return loose;
}

/// Neighbouring bricks that fly together.
struct Piece {
  Brick first;  ///< lower left
  int columns = 1, rows = 1;
  double distance = 0;  ///< m, from its middle to the blast's centre
};

/// Groups bricks two by two where possible, else two side by side, else two stacked, else single.
std::vector<Piece> Pieces(const FeatureList<BrickField>& fields, const std::vector<Brick>& loose,
                          const Blast& blast) {
  std::vector<bool> used(loose.size(), false);
  const auto find = [&](const Brick& b) {
    const auto at = std::lower_bound(loose.begin(), loose.end(), b, Before);
    const bool there =
        at != loose.end() && *at == b && !used[static_cast<std::size_t>(at - loose.begin())];
    return there ? static_cast<int>(at - loose.begin()) : -1;
  };
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < loose.size(); ++i) {
    if (used[i]) continue;
    const Brick& b = loose[i];
    const BrickField& field = fields[static_cast<std::size_t>(b.kind)];
    const int right = find({b.x + field.width, b.y, b.kind});
    const int above = find({b.x, b.y + field.height, b.kind});
    const int both = find({b.x + field.width, b.y + field.height, b.kind});
    Piece piece{b, right >= 0 ? 2 : 1, 1, 0};
    std::vector<int> members = {static_cast<int>(i), right};
    if (right >= 0 && above >= 0 && both >= 0) {
      piece.rows = 2;
      members.insert(members.end(), {above, both});
    } else if (right < 0 && above >= 0) {
      piece.rows = 2;
      members.push_back(above);
    }
    for (const int m : members) {
      if (m >= 0) used[static_cast<std::size_t>(m)] = true;
    }
    const Vector2d out =
        MiddleOf(field, b.x, b.y, piece.columns, piece.rows) - blast.centre.cast<double>();
    piece.distance = std::sqrt(out.x() * out.x() + out.y() * out.y());
    pieces.push_back(piece);
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& p, const Piece& q) { return p.distance < q.distance; });
  if (pieces.size() > kBlastPiecesMax) pieces.resize(kBlastPiecesMax);
  return pieces;
}

}  // namespace

Part FreedPart(const BrickField& field, const Brick& first, int columns, int rows) {
  BrickField whole = field;
  whole.width *= columns;
  whole.height *= rows;
  Part part = BrickPart(whole, first.x, first.y);
  const Vec2 size = part.size.array() - 2 * kFreedGap;
  part.material.density *= part.size.prod() / size.prod();
  part.size = size;
  part.anchored = false;
  part.name = field.name + "@" + std::to_string(first.x) + "," + std::to_string(first.y) + "+" +
              std::to_string(columns) + "x" + std::to_string(rows);
  part.line = field.line;
  return part;
}

Freed BlastBricks(const FeatureList<BrickField>& fields, const FeatherStore& left,
                  const Blast& blast) {
  Freed freed;
  const std::vector<Brick> loose = FreeableBricks(fields, left, blast);
  for (const Piece& piece : Pieces(fields, loose, blast)) {
    const BrickField& field = fields[static_cast<std::size_t>(piece.first.kind)];
    Part part = FreedPart(field, piece.first, piece.columns, piece.rows);
    Vector2d velocity = SpeedAt(blast, part.position.cast<double>());
    const double most = static_cast<double>(kSpeedMax), speed = velocity.norm();
    if (speed > most) velocity *= most / speed;
    part.velocity = velocity.cast<float>();
    freed.parts.push_back(part);
    for (int row = 0; row < piece.rows; ++row) {
      for (int column = 0; column < piece.columns; ++column) {
        freed.bricks.push_back({piece.first.x + column * field.width,
                                piece.first.y + row * field.height, piece.first.kind});
      }
    }
  }
  return freed;
}

std::vector<Brick> FreedBricks(const FeatureList<BrickField>& fields,
                               const std::vector<Part>& parts) {
  std::vector<Brick> freed;
  for (const Part& part : parts) {
    const std::size_t at = part.name.find('@');
    if (at == std::string::npos) continue;
    int x = 0, y = 0, columns = 0, rows = 0;
    const int read = std::sscanf(part.name.c_str() + at, "@%d,%d+%dx%d", &x, &y, &columns, &rows);
    SEAM_ASSERT(read == 4);
    for (std::size_t kind = 0; kind < fields.size(); ++kind) {
      if (part.name.compare(0, at, fields[kind].name) != 0) continue;
      for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
          freed.push_back({x + column * fields[kind].width, y + row * fields[kind].height,
                           static_cast<int>(kind)});
        }
      }
    }
  }
  return freed;
}

bool Possible(const Blast& blast) {
  return blast.centre.cwiseAbs().maxCoeff() <= kBlastPlaceMax && blast.centre.allFinite() &&
         blast.radius > 0 && blast.radius <= kBlastRadiusMax && blast.speed >= 0 &&
         blast.speed <= kSpeedMax && blast.impulse >= 0 && blast.impulse <= kBlastImpulseMax;
}

}  // namespace seam
