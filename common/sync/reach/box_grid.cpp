#include "common/sync/reach/box_grid.h"

#include <cmath>

namespace seam {
namespace {

/// Cells per box, and the minimum of cells: more would cost more to clear than they save.
constexpr float kCellsPerBox = 16, kCellsMin = 1024;
/// Number of boxes from which the borders are computed.
constexpr std::size_t kSamples = 256;
/// Share of the boxes that may lie beyond each border, so that one distant box does not enlarge all
/// cells.
constexpr double kBeyond = 0.02;

/// Returns the range of the values without the share kBeyond at either end.
std::pair<float, float> Middle(std::vector<float> values) {
  const auto skip = static_cast<std::ptrdiff_t>(static_cast<double>(values.size()) * kBeyond);
  const auto low = values.begin() + skip, high = values.end() - 1 - skip;
  std::nth_element(values.begin(), low, values.end());
  const float least = *low;
  std::nth_element(values.begin(), high, values.end());
  return {least, *high};
}

}  // namespace

BoxGrid::BoxGrid(const std::vector<MovingBox>& boxes, const std::vector<char>* use) {
  std::vector<int> small;
  std::vector<Vec2> centres;
  small.reserve(boxes.size());
  centres.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (use != nullptr && (*use)[i] == 0) continue;
    const float half = (boxes[i].max - boxes[i].min).maxCoeff() / 2;
    if (half > kCellSide / 2) {
      large_.push_back(static_cast<int>(i));
      continue;
    }
    widest_ = std::max(widest_, half);
    small.push_back(static_cast<int>(i));
    centres.push_back((boxes[i].min + boxes[i].max) / 2);
  }
  if (small.empty()) return;
  ChooseCells(centres);
  std::vector<std::size_t> cell_of(small.size());
  start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (std::size_t k = 0; k < small.size(); ++k) {
    cell_of[k] = Cell(Column(centres[k].x()), Row(centres[k].y()));
    ++start_[cell_of[k] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<int> next(start_.begin(), start_.end() - 1);
  items_.resize(small.size());
  for (std::size_t k = 0; k < small.size(); ++k) {
    items_[static_cast<std::size_t>(next[cell_of[k]]++)] = small[k];
  }
}

void BoxGrid::ChooseCells(const std::vector<Vec2>& centres) {
  std::vector<float> xs, ys;
  const std::size_t every = 1 + centres.size() / kSamples;
  for (std::size_t i = 0; i < centres.size(); i += every) {
    xs.push_back(centres[i].x());
    ys.push_back(centres[i].y());
  }
  const auto [left, right] = Middle(std::move(xs));
  const auto [bottom, top] = Middle(std::move(ys));
  low_ = {left, bottom};
  const float most = std::max(kCellsMin, kCellsPerBox * static_cast<float>(centres.size()));
  const auto count = [this](float span) { return std::floor(span / cell_) + 1; };
  while (count(right - left) * count(top - bottom) > most) cell_ *= 2;
  columns_ = static_cast<int>(count(right - left));
  rows_ = static_cast<int>(count(top - bottom));
}

}  // namespace seam
