#include "client/held_world.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <variant>

#include "common/codec/codec.h"

namespace seam {
namespace {

/// Of a message about bodies; -1: it is none.
std::int64_t TickOf(const AnyMessage& any) {
  if (const auto* states = std::get_if<States>(&any)) return states->tick;
  const auto* rest = std::get_if<Rest>(&any);
  return rest != nullptr ? rest->tick : -1;
}

}  // namespace

bool CoversWorld(const std::vector<Bytes>& held, const World& world, std::int64_t from) {
  const auto composition = static_cast<std::int64_t>(world.composition().hash);
  std::set<int> heard;
  const auto note = [&](const auto& message) {
    if (message.composition == composition) heard.insert(message.id.begin(), message.id.end());
  };
  for (const Bytes& bytes : held) {
    const AnyMessage any = Decode(bytes);
    const auto* states = std::get_if<States>(&any);
    if (states != nullptr && states->tick >= from) note(*states);
    if (const auto* rest = std::get_if<Rest>(&any)) note(*rest);
  }
  for (int body = 0; body < world.body_count(); ++body) {
    if (heard.count(world.id(body)) == 0) return false;
  }
  return true;
}

std::int64_t TickOfWorld(const std::vector<Bytes>& held, const World& world, std::int64_t oldest,
                         std::int64_t now) {
  const auto composition = static_cast<std::int64_t>(world.composition().hash);
  struct Heard {
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), newest = -1;
    bool rests = false;  // by the newest
  };
  std::map<int, Heard> heard;
  const auto note = [&](const auto& message, bool rests) {
    if (message.composition != composition || message.tick > now) return;
    for (const std::int32_t id : message.id) {
      Heard& of = heard[id];
      of.first = std::min(of.first, message.tick);
      if (message.tick < of.newest) continue;
      of.newest = message.tick;
      of.rests = rests;
    }
  };
  for (const Bytes& bytes : held) {
    const AnyMessage any = Decode(bytes);
    if (const auto* states = std::get_if<States>(&any)) note(*states, false);
    if (const auto* rest = std::get_if<Rest>(&any)) note(*rest, true);
  }
  std::int64_t tick = now, least = oldest;
  for (const auto& [id, of] : heard) {
    if (!of.rests) tick = std::min(tick, of.newest);
    least = std::max(least, of.first);
  }
  return std::min(now, std::max(tick, least));
}

/// Of what is not after its tick the newest first: what a body was before, whether it moved or lay,
/// is no news of it then. What lay after a tick lies so in that tick, too.
void GiveHeld(const std::vector<Bytes>& held, Replica& replica) {
  std::vector<AnyMessage> all;
  for (const Bytes& bytes : held) all.push_back(Decode(bytes));
  std::stable_sort(all.begin(), all.end(), [](const AnyMessage& a, const AnyMessage& b) {
    const auto order = [](const AnyMessage& any) {
      return 2 * TickOf(any) + (std::holds_alternative<Rest>(any) ? 1 : 0);
    };
    return order(a) < order(b);
  });
  const auto later = std::find_if(
      all.begin(), all.end(), [&](const AnyMessage& any) { return TickOf(any) > replica.tick(); });
  const auto place = [&](const AnyMessage& any) {
    if (const auto* states = std::get_if<States>(&any)) replica.Place(*states);
    if (const auto* rest = std::get_if<Rest>(&any)) replica.Receive(*rest);
  };
  std::for_each(std::make_reverse_iterator(later), all.rend(), place);
  std::for_each(later, all.end(), place);
  std::for_each(later, all.end(), [&](const AnyMessage& any) {
    if (const auto* states = std::get_if<States>(&any)) replica.Receive(*states);
  });
}

}  // namespace seam
