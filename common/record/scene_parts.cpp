#include "common/record/scene_parts.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/base/compress.h"
#include "common/codec/validate.h"

namespace seam {

std::vector<ScenePart> CutScene(const std::string& text) {
  const Bytes frame = Compress(TextBytes(text));
  std::vector<ScenePart> all((frame.size() + kScenePartBytes - 1) / kScenePartBytes);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t begin = i * kScenePartBytes;
    const std::size_t end = std::min(frame.size(), begin + kScenePartBytes);
    all[i].part = static_cast<std::int32_t>(i);
    all[i].parts = static_cast<std::int32_t>(all.size());
    all[i].data.assign(frame.begin() + static_cast<std::ptrdiff_t>(begin),
                       frame.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return all;
}

bool SceneParts::Take(ScenePart& part) {
  if (whole_) return true;
  if (parts() != part.parts) {
    data_.assign(static_cast<std::size_t>(part.parts), {});
    have_ = 0;
  }
  Bytes& place = data_[static_cast<std::size_t>(part.part)];
  if (place.empty()) ++have_;
  place = std::move(part.data);
  if (have_ < parts()) return true;
  Bytes frame;
  for (const Bytes& data : std::exchange(data_, {})) {
    frame.insert(frame.end(), data.begin(), data.end());
  }
  have_ = 0;
  const std::optional<Bytes> text = Decompress(frame, kSceneTextBytesMax);
  if (!text) return false;
  text_.assign(text->begin(), text->end());
  whole_ = IsPrintable(text_, kSceneTextBytesMax, true);
  if (!whole_) text_.clear();
  return whole_;
}

}  // namespace seam
