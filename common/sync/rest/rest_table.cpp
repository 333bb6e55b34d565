#include "common/sync/rest/rest_table.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "common/base/bytes.h"

namespace seam {
namespace {

/// Fnv1a of the four bytes of a value, the lowest first. Zero bytes only multiply, so those at the
/// end do it at once: each step waits for the one before it, and a client does this for a room.
template <class T>
std::uint64_t Add(const T& value, std::uint64_t hash) {
  constexpr std::uint64_t kPrime = 0x100000001b3ULL, kPrime2 = kPrime * kPrime;
  constexpr std::uint64_t kPrime3 = kPrime2 * kPrime, kPrime4 = kPrime3 * kPrime;
  static_assert(sizeof value == 4);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  if (bits < 0x100) return (hash ^ bits) * kPrime4;
  hash = (hash ^ (bits & 0xff)) * kPrime;
  if (bits < 0x10000) return (hash ^ bits >> 8) * kPrime3;
  hash = (hash ^ (bits >> 8 & 0xff)) * kPrime;
  hash = (hash ^ (bits >> 16 & 0xff)) * kPrime;
  return (hash ^ bits >> 24) * kPrime;
}

bool SameBits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Of what is hashed.
bool Same(const RestRecord& a, const RestRecord& b) {
  return a.committed == b.committed && a.epoch == b.epoch &&
         SameBits(a.pose.position.x(), b.pose.position.x()) &&
         SameBits(a.pose.position.y(), b.pose.position.y()) && SameBits(a.pose.angle, b.pose.angle);
}

}  // namespace

void RestTable::NoteChanged(int body) { known_ = std::min(known_, body / kBlock + 1); }

void RestTable::Commit(int body, std::int32_t epoch, std::int64_t tick, const BodyState& pose) {
  RestRecord& record = records_[static_cast<std::size_t>(body)];
  RestRecord now{true, epoch, tick, pose};
  now.pose.velocity.setZero();
  now.pose.spin = 0;
  if (!record.committed) ++committed_;
  if (!Same(record, now)) NoteChanged(body);
  record = now;
}

void RestTable::End(int body) {
  RestRecord& record = records_[static_cast<std::size_t>(body)];
  if (!record.committed) return;
  record.committed = false;
  --committed_;
  NoteChanged(body);
}

void RestTable::Clear() {
  records_.assign(records_.size(), RestRecord{});
  committed_ = known_ = 0;
}

void RestTable::Remap(const std::vector<BodyOrigin>& origins) {
  std::vector<RestRecord> records;
  for (const BodyOrigin& origin : origins) {
    const bool same = origin.body >= 0 && origin.same;
    records.push_back(same ? at(origin.body) : RestRecord{});
  }
  records_ = std::move(records);
  committed_ = static_cast<int>(std::count_if(records_.begin(), records_.end(),
                                              [](const RestRecord& r) { return r.committed; }));
  known_ = 0;
}

std::uint64_t RestTable::Hash(const World& world) const {
  if (committed_ == 0) return 0;
  const int count = world.body_count();
  begins_.resize(static_cast<std::size_t>(count / kBlock + 2));
  if (known_ == 0) begins_[static_cast<std::size_t>(known_++)] = Fnv1a("", 0);
  // The last is how it ends.
  const int blocks = (count + kBlock - 1) / kBlock;
  std::uint64_t hash = begins_[static_cast<std::size_t>(known_ - 1)];
  for (int body = (known_ - 1) * kBlock; body < count; ++body) {
    if (body % kBlock == 0) begins_[static_cast<std::size_t>(body / kBlock)] = hash;
    const RestRecord& record = at(body);
    if (!record.committed) continue;
    hash = Add(world.id(body), hash);
    hash = Add(record.epoch, hash);
    hash = Add(record.pose.position.x(), hash);
    hash = Add(record.pose.position.y(), hash);
    hash = Add(record.pose.angle, hash);
  }
  begins_[static_cast<std::size_t>(blocks)] = hash;
  known_ = blocks + 1;
  return hash;
}

std::vector<Rest> RestTable::Pack(const World& world, int peer, std::vector<int> bodies) const {
  std::stable_sort(bodies.begin(), bodies.end(),
                   [this](int a, int b) { return at(a).tick < at(b).tick; });
  std::vector<Rest> out;
  for (const int body : bodies) {
    const RestRecord& record = at(body);
    if (out.empty() || out.back().tick != record.tick || out.back().id.size() >= kRestBodiesMax) {
      out.emplace_back();
      out.back().peer = peer;
      out.back().tick = record.tick;
      out.back().revision = world.topology().revision();
      out.back().composition = static_cast<std::int64_t>(world.composition().hash);
    }
    Rest& rest = out.back();
    rest.id.push_back(world.id(body));
    rest.epoch.push_back(record.epoch);
    rest.x.push_back(record.pose.position.x());
    rest.y.push_back(record.pose.position.y());
    rest.angle.push_back(record.pose.angle);
  }
  return out;
}

}  // namespace seam
