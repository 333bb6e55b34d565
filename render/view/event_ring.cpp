#include "render/view/event_ring.h"

namespace seam {

std::string EventText(const std::string& kind, const std::string& data) {
  return "event: " + kind + "\ndata: " + data + "\n\n";
}

void EventRing::Add(const std::string& kind, const std::string& data) {
  pieces_.push_back(std::make_shared<const std::string>(EventText(kind, data)));
  kept_ += pieces_.back()->size();
  bytes_ += static_cast<std::int64_t>(pieces_.back()->size());
  while (kept_ > kBytesMax) {
    kept_ -= pieces_.front()->size();
    pieces_.pop_front();
    ++begin_;
  }
}

void EventRing::Clear() {
  begin_ = end() + 1;
  pieces_.clear();
  kept_ = 0;
}

EventRing::Piece EventRing::At(std::uint64_t* place) const {
  if (*place == end()) return nullptr;
  return pieces_[static_cast<std::size_t>((*place)++ - begin_)];
}

}  // namespace seam
