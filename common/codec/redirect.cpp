#include "common/codec/redirect.h"

#include "common/base/names.h"
#include "common/codec/validate.h"

namespace seam {

bool Valid(const Redirect& m) {
  return m.utime > -kTimeMaxUs && m.utime < kTimeMaxUs && !m.address.empty() &&
         IsPrintable(m.address, kLabelBytesMax) && IsName(m.room) && m.epoch >= 1;
}

}  // namespace seam
