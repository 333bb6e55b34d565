#include "render/page/column.h"

#include <cstddef>

namespace seam {

void PutUnsigned(PageBytes* out, std::uint64_t value) {
  while (value >= 0x80) {
    out->push_back(static_cast<std::uint8_t>((value & 0x7f) | 0x80));
    value >>= 7;
  }
  out->push_back(static_cast<std::uint8_t>(value));
}

void PutSigned(PageBytes* out, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  PutUnsigned(out, (bits << 1) ^ (value < 0 ? ~std::uint64_t{0} : 0));
}

void PutSecondDifferences(PageBytes* out, const std::vector<std::int64_t>& values) {
  std::int64_t last = 0, step = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    PutSigned(out, values[i] - last - step);
    step = i == 0 ? 0 : values[i] - last;
    last = values[i];
  }
}

void PutFirstDifferences(PageBytes* out, const std::vector<std::int64_t>& values) {
  std::int64_t last = 0;
  for (const std::int64_t value : values) {
    PutSigned(out, value - last);
    last = value;
  }
}

void PutRuns(PageBytes* out, const std::vector<std::int64_t>& values) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 0 || values[i] != values[i - 1]) begins.push_back(i);
  }
  PutUnsigned(out, begins.size());
  for (std::size_t k = 0; k < begins.size(); ++k) {
    const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : values.size();
    PutUnsigned(out, end - begins[k]);
    PutSigned(out, values[begins[k]]);
  }
}

}  // namespace seam
