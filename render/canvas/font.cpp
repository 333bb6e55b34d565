#include "render/canvas/font.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/check.h"

namespace seam {
namespace {

struct StyleFile {
  const char* file;
  float size_px;
};
// By TextStyle. All digits of DejaVu Sans have the same width, so changing numbers do not shift.
constexpr StyleFile kStyles[kTextStyles] = {{"DejaVuSans.ttf", 11},
                                            {"DejaVuSans.ttf", 13},
                                            {"DejaVuSans-Bold.ttf", 13},
                                            {"DejaVuSans-Bold.ttf", 17},
                                            {"DejaVuSans-Bold.ttf", 20}};

std::size_t Index(TextStyle style) { return static_cast<std::size_t>(style); }

/// FreeType's handles, freed in any case.
struct FontFaces {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  ~FontFaces() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }
};

std::set<std::uint32_t> Wanted(const std::string& extra) {
  std::set<std::uint32_t> codepoints;
  for (std::uint32_t c = 0x20; c < 0x7f; ++c) codepoints.insert(c);
  for (std::uint32_t c = 0xa0; c < 0x100; ++c) codepoints.insert(c);
  for (std::uint32_t c : Codepoints("–—…×·→←−≈≤≥µΔ±²³")) codepoints.insert(c);
  for (std::uint32_t c : Codepoints(extra)) codepoints.insert(c);
  return codepoints;
}

}  // namespace

Font::Font(float scale, const std::string& extra, const std::string& folder)
    : scale_(std::clamp(scale, 0.25f, 8.0f)) {
  atlas_width_ = scale_ > 2.5f ? 4096 : 1024;
  const std::set<std::uint32_t> wanted = Wanted(extra);
  for (int s = 0; s < kTextStyles; ++s) {
    FontFaces ft;
    const std::string path = folder + "/" + kStyles[s].file;
    if (FT_Init_FreeType(&ft.library) != 0) throw OperatorError("FreeType does not start");
    if (FT_New_Face(ft.library, path.c_str(), 0, &ft.face) != 0)
      throw OperatorError("no font at " + path +
                          ": install fonts-dejavu-core or give --fonts FOLDER");
    const float size_px = kStyles[s].size_px * scale_;
    FT_Set_Char_Size(ft.face, 0, static_cast<FT_F26Dot6>(std::lround(size_px * 64)), 72, 72);
    for (std::uint32_t codepoint : wanted) {
      const FT_UInt index = FT_Get_Char_Index(ft.face, codepoint);
      if (index == 0 && codepoint != '?') continue;
      if (FT_Load_Glyph(ft.face, index, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) continue;
      const FT_GlyphSlot slot = ft.face->glyph;
      Glyph glyph;
      glyph.width = static_cast<int>(slot->bitmap.width);
      glyph.height = static_cast<int>(slot->bitmap.rows);
      glyph.left = slot->bitmap_left;
      glyph.top = slot->bitmap_top;
      glyph.advance = static_cast<float>(slot->linearHoriAdvance) / 65536.0f;
      Pack(&glyph, slot->bitmap.buffer, slot->bitmap.pitch);
      glyphs_[s].emplace(codepoint, glyph);
    }
    if (glyphs_[s].count('?') == 0) throw OperatorError("no letters in the font " + path);
  }
}

void Font::Pack(Glyph* glyph, const std::uint8_t* bitmap, int pitch) {
  if (pen_x_ + glyph->width + 1 > atlas_width_) {
    pen_x_ = 1;
    pen_y_ += row_height_ + 1;
    row_height_ = 0;
  }
  row_height_ = std::max(row_height_, glyph->height);
  const int needed = pen_y_ + row_height_ + 1;
  if (needed > atlas_height_) {
    atlas_height_ = needed;
    atlas_.resize(static_cast<std::size_t>(atlas_width_) * static_cast<std::size_t>(needed), 0);
  }
  glyph->atlas_x = pen_x_;
  glyph->atlas_y = pen_y_;
  for (int y = 0; y < glyph->height; ++y) {
    const std::uint8_t* row = bitmap + static_cast<std::ptrdiff_t>(y) * pitch;
    const auto to = static_cast<std::ptrdiff_t>(pen_y_ + y) * atlas_width_ + pen_x_;
    std::copy(row, row + glyph->width, atlas_.begin() + to);
  }
  pen_x_ += glyph->width + 1;
}

const Glyph& Font::Find(TextStyle style, std::uint32_t codepoint) const {
  const auto& glyphs = glyphs_[Index(style)];
  const auto found = glyphs.find(codepoint);
  return found != glyphs.end() ? found->second : glyphs.at('?');
}

float Font::Width(TextStyle style, const std::string& utf8) const {
  float width = 0;
  for (std::uint32_t c : Codepoints(utf8)) width += Find(style, c).advance;
  return width;
}

std::vector<std::uint32_t> Codepoints(const std::string& utf8) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = lead < 0x80       ? 1
                               : lead >> 5 == 6  ? 2
                               : lead >> 4 == 14 ? 3
                               : lead >> 3 == 30 ? 4
                                                 : 0;
    std::uint32_t c = length == 1 ? lead : lead & (0x7fu >> length);
    bool good = length > 0 && i + length <= utf8.size();
    for (std::size_t k = 1; good && k < length; ++k) {
      const auto next = static_cast<unsigned char>(utf8[i + k]);
      good = (next & 0xc0) == 0x80;
      c = (c << 6) | (next & 0x3fu);
    }
    out.push_back(good ? c : 0xfffd);
    i += good ? length : 1;
  }
  return out;
}

}  // namespace seam
