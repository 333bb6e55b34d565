/// AuthorityManager: chooses the mechanisms of a plan. In a large room, mechanisms asleep far from
/// everything else are left out: the server keeps them, and nobody follows them.

#include <algorithm>
#include <numeric>
#include <vector>

#include "common/scene/mechanism_ids.h"
#include "common/sync/reach/reach.h"
#include "server/authority/authority_manager.h"

namespace seam {
namespace {

/// Number of plans that see the whole room once more than half of it has to be seen: then the
/// search for sleeping mechanisms costs more than it saves.
constexpr int kSeeAll = 10;

}  // namespace

template <class Visit>
void AuthorityManager::EachBody(int m, const Visit& visit) const {
  const World& world = replica_.world();
  EachIdOf(world.composition(), m, [&](PartId id) { visit(world.BodyOfId(id)); });
}

bool AuthorityManager::MayLeaveOut(const AuthorityView& view) {
  if (see_all_ > 0) {
    --see_all_;
    return false;
  }
  const int whole = std::max(view.follow_bodies, view.server_follow);
  return view.islands && view.policy->PlansFollowers() && !view.exact && !limited_ &&
         view.rules.capacity == 0 && replica_.world().body_count() > whole;
}

void AuthorityManager::SeeAll() {
  seen_.resize(static_cast<std::size_t>(memory_.size()));
  std::iota(seen_.begin(), seen_.end(), 0);
}

/// True if the server alone has the mechanism, by plan and by record, and nobody can drive it.
bool AuthorityManager::MayBeIndexed(int m) const {
  const auto i = static_cast<std::size_t>(m);
  const Memory& memory = memory_[m];
  const AuthorityRecord& record = table().at(m);
  if (i >= plan_.size() || memory.open || memory.hand_over != HandOver::kNone) return false;
  if (record.authority != 0 || memory.last_authority != 0 || memory.contested != 0) return false;
  const PlannedAuthority& planned = plan_[i];
  return planned.authority == 0 && !planned.decided && planned.secondaries.empty() &&
         record.secondaries.empty() && replica_.world().composition().mechanisms[i].owner < 0 &&
         !replica_.drivers().Driven(m);
}

/// True if all of it sleeps and, if indexed already, has not moved since.
bool AuthorityManager::Lies(int m) {
  const World& world = replica_.world();
  const bool lay = sleeping_index_.Has(m);
  bool lies = !replica_.drivers().Driven(m);
  char& doubtful = doubtful_[m];
  doubtful = 0;
  EachBody(m, [&](int body) {
    Lay& then = at_rest_[body];
    const std::uint64_t still = world.still(body);
    if (still == 0) doubtful = 1;  // the World does not report changes of it
    if (!lies || (lay && still != 0 && still == then.still)) return;
    const BodyState now = world.Read(body);
    const bool there = lay ? now.position == then.position && now.angle == then.angle
                           : now.velocity == Vec2(0, 0) && now.spin == 0;
    lies = there && !world.awake(body);
    then.still = still;
  });
  return lies;
}

void AuthorityManager::IndexSleeping(int m) {
  const World& world = replica_.world();
  MovingBox around;
  bool first = true;
  EachBody(m, [&](int body) {
    const BodyState state = world.Read(body);
    at_rest_[body] = {world.still(body), state.position, state.angle};
    const MovingBox box = BoxOf(world, body);
    around.min = first ? box.min : around.min.cwiseMin(box.min);
    around.max = first ? box.max : around.max.cwiseMax(box.max);
    first = false;
  });
  sleeping_index_.Put(m, around);
}

/// Marks the sleeping mechanisms that may have changed since the last call.
void AuthorityManager::FindDisturbed() {
  const World& world = replica_.world();
  stirred_.clear();
  if (world.ChangedSince(index_change_, &stirred_)) {
    for (const int body : stirred_) doubtful_[world.mechanism(body)] = 1;
  } else {
    doubtful_.Reset();
  }
  index_change_ = world.last_change();
}

void AuthorityManager::SeeAwakeAndNear(const AuthorityView& view) {
  const auto count = static_cast<std::size_t>(memory_.size());
  if (sleeping_index_.size() != count) {
    sleeping_index_.Clear(count);
    at_rest_.Reset();
    doubtful_.Reset();
  }
  FindDisturbed();
  seen_.clear();
  std::vector<int> bodies, joined;
  for (const std::vector<int>& mechanisms : view.together) {
    joined.insert(joined.end(), mechanisms.begin(), mechanisms.end());
  }
  for (const int m : joined) sleeping_index_.Take(m);
  for (int m = 0; m < memory_.size(); ++m) {
    if (sleeping_index_.Has(m)) {
      if (doubtful_[m] == 0 || Lies(m)) continue;
      sleeping_index_.Take(m);
    } else if (MayBeIndexed(m) && Lies(m) && std::count(joined.begin(), joined.end(), m) == 0) {
      IndexSleeping(m);
      continue;
    }
    seen_.push_back(m);
    EachBody(m, [&](int body) { bodies.push_back(body); });
  }
  const std::vector<int> near =
      sleeping_index_.Near(BoxesOf(replica_.world(), replica_.drivers(), bodies), SightOf(view));
  const auto middle = static_cast<std::ptrdiff_t>(seen_.size());
  seen_.insert(seen_.end(), near.begin(), near.end());
  std::inplace_merge(seen_.begin(), seen_.begin() + middle, seen_.end());
  if (2 * seen_.size() > count) see_all_ = kSeeAll;
}

void AuthorityManager::LookAtBoxes(AuthorityView* view) const {
  if (SeesAll()) {
    view->boxes = BoxesOf(replica_.world(), replica_.drivers(), true);
    return;
  }
  std::vector<int> bodies;
  for (const int m : seen_) EachBody(m, [&](int body) { bodies.push_back(body); });
  std::sort(bodies.begin(), bodies.end());
  view->boxes = BoxesOf(replica_.world(), replica_.drivers(), bodies);
  for (MovingBox& box : view->boxes) box.group = PlaceOf(box.group);
}

int AuthorityManager::PlaceOf(int m) const {
  if (SeesAll()) return m;
  const auto at = std::lower_bound(seen_.begin(), seen_.end(), m);
  return at == seen_.end() || *at != m ? -1 : static_cast<int>(at - seen_.begin());
}

}  // namespace seam
