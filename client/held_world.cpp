#include "client/held_world.h"

#include <algorithm>
#include <set>
#include <variant>

#include "common/codec/codec.h"

namespace seam {

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

void GiveHeld(const std::vector<Bytes>& held, Replica& replica) {
  std::vector<States> all;
  for (const Bytes& bytes : held) {
    const AnyMessage any = Decode(bytes);
    if (const auto* states = std::get_if<States>(&any)) all.push_back(*states);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const States& a, const States& b) { return a.tick > b.tick; });
  for (const States& states : all) replica.Place(states);
  for (const Bytes& bytes : held) {
    const AnyMessage any = Decode(bytes);
    if (const auto* rest = std::get_if<Rest>(&any)) replica.Receive(*rest);
  }
}

}  // namespace seam
