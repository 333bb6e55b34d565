#include "common/sync/reach/kept_boxes.h"

namespace seam {

void KeptBoxes::Clear(std::size_t numbers) {
  entry_.assign(numbers, -1);
  entries_.clear();
  in_grid_ = 0;
  grid_.reset();
}

void KeptBoxes::Put(int number, const MovingBox& box) {
  entry_[static_cast<std::size_t>(number)] = static_cast<int>(entries_.size());
  entries_.push_back({number, box});
}

void KeptBoxes::Rebuild() {
  std::size_t left = 0;
  std::vector<MovingBox> boxes;
  boxes.reserve(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    int& entry = entry_[static_cast<std::size_t>(entries_[i].number)];
    if (entry != static_cast<int>(i)) continue;
    entry = static_cast<int>(left);
    boxes.push_back(entries_[i].box);
    entries_[left++] = entries_[i];
  }
  entries_.resize(left);
  in_grid_ = left;
  grid_.emplace(boxes);
}

}  // namespace seam
