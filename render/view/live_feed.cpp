#include "render/view/live_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "common/base/json_text.h"
#include "common/codec/codec.h"
#include "render/page/document.h"
#include "render/page/gzip.h"

namespace seam {
namespace {

constexpr std::int64_t kFlushUs = 33000;
/// Poses kept for a watcher that comes: 0.1 s of work, or 1 to 20 s of the session.
constexpr std::size_t kPosesKept = 150000;
constexpr std::int64_t kKept_s = 20;
constexpr double kLiveErrorUnit_m = 1e-4;  ///< of the errors that are sent
/// After so many ms without a server a page asks for it again.
const std::string kRetry = "retry: 500\n";
constexpr std::size_t kEventsKept = 2000;
/// Worlds after which the pages begin anew: a room that breaks for hours has very many.
constexpr int kWorldsMax = 5000;

/// Removes what lies before a tick. `edits`, which make the worlds, stay.
void Forget(Recording* recording, std::int64_t before_tick) {
  for (auto& [peer, views] : recording->views)
    while (views.size() > 1 && views.begin()->first < before_tick) views.erase(views.begin());
  for (auto& [peer, strands] : recording->strands)
    strands.erase(strands.begin(), strands.lower_bound(before_tick));
  auto& impacts = recording->impacts;
  impacts.erase(std::remove_if(impacts.begin(), impacts.end(),
                               [&](const Impacts& i) { return i.tick < before_tick; }),
                impacts.end());
  for (auto& [peer, stats] : recording->stats)
    if (stats.size() > 60) stats.erase(stats.begin(), stats.end() - 30);
  recording->view_us.clear();
  recording->states.clear();
  recording->inputs.clear();
  recording->grants.clear();
  recording->events.clear();
  recording->meta.clear();
  recording->loads.clear();
  recording->first_tick = std::max(recording->first_tick, before_tick);
}

}  // namespace

LiveFeed::LiveFeed(std::string room, std::string player, double bytes_per_s)
    : room_(std::move(room)),
      player_(std::move(player)),
      bytes_per_s_(bytes_per_s),
      builder_(room_) {}

bool LiveFeed::Add(const std::string& channel, ByteView message) {
  const std::optional<std::int64_t> session = builder_.session();
  if (builder_.has_room() && channel.find(".view.") != std::string::npos) {
    const AnyMessage any = Decode(message);
    const View* const view = std::get_if<View>(&any);
    if (view != nullptr && view->session == session && IsStray(view->tick)) return false;
  }
  const bool added = builder_.Add(channel, message);
  if (builder_.session() != session) Restart();
  return added;
}

void LiveFeed::Restart() {
  playback_.reset();
  worlds_.reset();
  peers_.clear();
  motions_ = PeerFeed();
  events_.clear();
  events_sent_ = 0;
  edits_seen_ = -1;
  owners_.clear();
  stats_ticks_.clear();
  ticks_ = StrayTicks();
  impacts_tick_ = 0;
  errors_.reset();
  too_late_ = false;
  ring_.Clear();
}

void LiveFeed::HearForErrors() {
  const Recording& recording = builder_.recording();
  if (!measures_ || too_late_ || !builder_.has_scene() || recording.views.empty()) return;
  if (errors_ == nullptr) {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    for (const auto& [peer, views] : recording.views)
      if (!views.empty()) first = std::min(first, views.begin()->first);
    too_late_ = first > std::max(1, recording.room.tick_hz) / 2;
    if (too_late_) return;
    errors_ = std::make_unique<LiveErrors>(recording);
  }
  errors_->Hear(recording);
}

void LiveFeed::Prune() {
  HearForErrors();
  Recording& recording = builder_.recording();
  std::size_t bodies = 1;
  std::int64_t newest = -1;
  for (const auto& [peer, views] : recording.views) {
    if (views.empty()) continue;
    bodies += views.rbegin()->second.id.size();
    newest = std::max(newest, views.rbegin()->first);
  }
  if (newest < 0) return;
  const int hz = std::max(1, recording.room.tick_hz);
  const auto ticks = static_cast<std::int64_t>(kPosesKept / bodies);
  if (errors_ != nullptr) errors_->Forget(newest - kKept_s * hz);
  NoteSaid();
  // The oracle is a second late, and measures what is still there.
  Forget(&recording, newest - std::clamp<std::int64_t>(ticks, 2 * hz, kKept_s * hz));
}

bool LiveFeed::IsStray(std::int64_t tick) {
  if (!ticks_.IsStray(tick)) return false;
  if (!ticks_.restarted()) return true;
  builder_ = RecordingBuilder(room_);  // its room is repeated every second
  Restart();
  return true;
}

void LiveFeed::Begin() {
  playback_ = std::make_unique<Playback>(&builder_.recording(), std::nullopt);
  worlds_ = std::make_unique<PageWorlds>(*playback_);
  worlds_->TakeNewJson();
  for (auto& [peer, feed] : peers_) feed.alone = true;
  const auto& edits = builder_.recording().edits;
  edits_seen_ = edits.empty() ? -1 : edits.rbegin()->first;
  ring_.Clear();
}

void LiveFeed::Flush(std::int64_t now_us) {
  const Recording& recording = builder_.recording();
  if (now_us - flushed_us_ < kFlushUs || !builder_.has_scene() || recording.views.empty()) return;
  if (playback_ == nullptr) Begin();
  if (worlds_->count() > kWorldsMax) Begin();
  const double passed_s = static_cast<double>(now_us - flushed_us_) * 1e-6;
  credit_ = std::min(credit_ + passed_s * bytes_per_s_, bytes_per_s_ / 2);
  flushed_us_ = now_us;
  Prune();
  PageBytes frames;
  std::vector<int> order;
  for (const auto& [peer, views] : recording.views) {
    if (!views.empty()) order.push_back(peer);
  }
  const std::size_t known = peers_.size();
  const std::size_t count = order.size();
  const std::size_t first = static_cast<std::size_t>(turn_) % count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = (first + i) % count;
    PeerFeed& feed = peers_[order[at]];
    const auto& views = recording.views.at(order[at]);
    const std::int64_t newest = views.rbegin()->first;
    if (newest == feed.sent_tick) continue;
    // Base64 makes 4 bytes of 3.
    if (credit_ < 4.0 / 3 * static_cast<double>(frames.size())) {
      if (!feed.skipped) turn_ = static_cast<int>(at);
      for (std::size_t k = i; k < count; ++k) peers_[order[(first + k) % count]].skipped = true;
      break;
    }
    PutViews(order[at], newest, &frames);
  }
  if (!motions_.skipped && ticks_.newest() > motions_.sent_tick) {
    const ViewFrame frame = FrameOfMotions(ticks_.newest());
    motions_.skipped = frame.bodies.empty();  // then there are none
    if (!motions_.skipped)
      motions_.deltas.Put(frame, std::exchange(motions_.alone, false), &frames);
    motions_.sent_tick = ticks_.newest();
  }
  const std::int64_t before = ring_.bytes();
  if (worlds_->has_new()) ring_.Add("worlds", worlds_->TakeNewJson());
  if (peers_.size() != known) {
    std::vector<std::string> names;
    for (const int peer : order) {
      names.push_back(fmt::format("[{},{}]", peer, JsonText(playback_->PeerName(peer))));
    }
    ring_.Add("peers", JsonList(names));
  }
  if (!frames.empty()) ring_.Add("frames", Base64(frames));
  AddEvents();
  AddStats();
  AddErrors();
  credit_ -= static_cast<double>(ring_.bytes() - before);
}

void LiveFeed::PutViews(int peer, std::int64_t newest_tick, PageBytes* frames) {
  PeerFeed& feed = peers_[peer];
  const auto& views = builder_.recording().views.at(peer);
  // All ticks since the last flush; after a lack of bytes, or at first, only the newest.
  auto view = views.upper_bound(feed.sent_tick);
  if (feed.sent_tick < 0 || feed.skipped) view = views.find(newest_tick);
  for (; view != views.end(); ++view) {
    if (peer == 0) NoteHandOvers(view->second);
    feed.deltas.Put(FrameOf(view->second), std::exchange(feed.alone, false), frames);
  }
  feed.sent_tick = newest_tick;
  feed.skipped = false;
}

ViewFrame LiveFeed::FrameOf(const View& view) {
  ViewFrame frame;
  frame.peer = view.peer;
  frame.tick = view.tick;
  frame.world = worlds_->IndexOf(view.revision);
  frame.bodies.reserve(view.id.size());
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    frame.bodies.push_back({view.id[i],
                            {Thousandths(double{view.x[i]}), Thousandths(double{view.y[i]}),
                             Thousandths(double{view.angle[i]})},
                            3 * view.authority[i] + view.role[i]});
  }
  return frame;
}

ViewFrame LiveFeed::FrameOfMotions(std::int64_t tick) {
  ViewFrame frame;
  frame.peer = kMotionsPeer;
  frame.tick = tick;
  for (const BodyShapes& body : playback_->anchored()) {
    if (body.imposed < 0) continue;
    const Pose pose = playback_->Anchored(body, static_cast<double>(tick));
    frame.bodies.push_back(
        {body.id,
         {Thousandths(double{pose.position.x()}), Thousandths(double{pose.position.y()}),
          Thousandths(double{pose.angle})},
         0});
  }
  std::sort(frame.bodies.begin(), frame.bodies.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  return frame;
}

void LiveFeed::NoteHandOvers(const View& view) {
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    const auto [known, added] = owners_.emplace(view.id[i], view.authority[i]);
    if (added || known->second == view.authority[i]) continue;
    events_.push_back(
        HandOverEvent(*playback_, view.tick, view.id[i], known->second, view.authority[i]));
    known->second = view.authority[i];
  }
}

void LiveFeed::AddEvents() {
  const auto append = [this](const std::vector<PageEvent>& some) {
    events_.insert(events_.end(), some.begin(), some.end());
  };
  append(EditsAfter(*playback_, edits_seen_));
  const auto& edits = playback_->recording().edits;
  if (!edits.empty()) edits_seen_ = edits.rbegin()->first;
  // Impacts in windows of half a second, as in a page of a recording; a bit late, since peers lag.
  const std::int64_t window = std::max(1, playback_->tick_hz() / 2);
  if (ticks_.newest() >= impacts_tick_ + 2 * window) {
    impacts_tick_ = std::max(impacts_tick_ + window, ticks_.newest() - 2 * window);
    for (const int peer : playback_->peers()) {
      append(ImpactsBefore(*playback_, peer, static_cast<double>(impacts_tick_),
                           static_cast<double>(window)));
    }
  }
  if (events_.size() > events_sent_) {
    std::vector<std::string> some;
    for (std::size_t i = events_sent_; i < events_.size(); ++i)
      some.push_back(EventJson(events_[i]));
    ring_.Add("marks", JsonList(some));
  }
  if (events_.size() > kEventsKept) {
    events_.erase(events_.begin(), events_.end() - static_cast<std::ptrdiff_t>(kEventsKept / 2));
  }
  events_sent_ = events_.size();
}

void LiveFeed::AddStats() {
  std::vector<std::string> rows;
  for (const auto& [peer, stats] : playback_->recording().stats) {
    for (const Stats& s : stats) {
      const auto [known, added] = stats_ticks_.emplace(peer, -1);
      if (s.tick <= known->second) continue;
      known->second = s.tick;
      rows.push_back(fmt::format("[{},[{},{},{},{},{}]]", peer, s.tick, s.rtt_us, s.loss_ppm,
                                 s.bytes_in, s.bytes_out));
    }
  }
  if (!rows.empty()) ring_.Add("stats", JsonList(rows));
}

void LiveFeed::AddErrors() {
  if (errors_ == nullptr) return;
  const std::size_t known = errors_->errors().size();
  errors_->Advance(builder_.recording(), ticks_.newest());
  if (errors_->errors().size() > known) ring_.Add("errors", ErrorsJson(known));
}

std::string LiveFeed::ErrorsJson(std::size_t from) const {
  std::vector<std::string> rows;
  for (std::size_t i = from; i < errors_->errors().size(); ++i) {
    const LiveError& error = errors_->errors()[i];
    rows.push_back(fmt::format("[{},{},{}]", error.peer, error.tick,
                               std::llround(error.error_m / kLiveErrorUnit_m)));
  }
  return fmt::format(R"({{"behind":{:.1f},"rows":{}}})", errors_->behind_s(ticks_.newest()),
                     JsonList(rows));
}

std::string LiveFeed::Start() {
  Recording& recording = builder_.recording();
  recording.first_tick = recording.last_tick;
  for (const auto& [peer, views] : recording.views) {
    if (!views.empty()) recording.first_tick = std::min(recording.first_tick, views.begin()->first);
  }
  const PageLive live{worlds_.get(), &events_};
  std::vector<PageRun> runs{{recording.room.room, playback_.get(), "", &live}};
  const std::string data = Base64(Gzip(PageData(runs)));
  // The page has the worlds and peers of the ring's present end; worlds that PageData has made are
  // sent once more, which does no harm.
  for (auto& [peer, feed] : peers_) feed.alone = true;
  motions_.alone = true;
  const char* oracle = !measures_ ? "" : too_late_ ? "late" : "beside";
  const std::string start =
      kRetry + EventText("start", fmt::format(R"({{"player":{},"oracle":"{}","data":"{}"}})",
                                              JsonText(player_), oracle, data));
  return start + (control_.empty() ? "" : EventText("control", control_)) +
         (errors_ == nullptr ? "" : EventText("errors", ErrorsJson(0)));
}

EventRing::Piece LiveFeed::Next(std::uint64_t* place) {
  if (*place != 0 && ring_.Has(*place)) return ring_.At(place);
  *place = ring_.end();
  if (playback_ != nullptr) return std::make_shared<const std::string>(Start());
  const std::string room = room_.empty() ? "a session" : "room " + room_;
  return std::make_shared<const std::string>(kRetry + EventText("waiting", JsonText(room)));
}

}  // namespace seam
