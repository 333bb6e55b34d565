#pragma once
/// A font as an atlas of glyph bitmaps: DejaVu Sans by FreeType, rasterised at the start. The only
/// file pair that includes FreeType.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace seam {

/// Folder in which the package fonts-dejavu-core installs its files.
constexpr const char* kFontFolder = "/usr/share/fonts/truetype/dejavu";

/// The text styles of a page.
enum class TextStyle { kSmall, kBody, kStrong, kNumber, kTitle };
constexpr int kTextStyles = 5;

/// Position of a letter in the atlas, and its metrics.
struct Glyph {
  int atlas_x = 0, atlas_y = 0, width = 0, height = 0;  ///< px in the atlas
  int left = 0, top = 0;  ///< from the pen to the upper left corner; top is upwards
  float advance = 0;      ///< px
};

/// An immutable atlas.
class Font {
 public:
  /// Rasterises ASCII, Latin-1, a few signs, and the letters of `extra` (UTF-8) in every style,
  /// `scale` times the normal size (0.25..8). Throws OperatorError when `folder` lacks the files or
  /// they are no fonts.
  explicit Font(float scale, const std::string& extra = "",
                const std::string& folder = kFontFolder);

  /// Returns a letter's glyph, or that of "?" when the letter is not in the atlas.
  const Glyph& Find(TextStyle style, std::uint32_t codepoint) const;
  float Width(TextStyle style, const std::string& utf8) const;  ///< px
  float scale() const { return scale_; }

  int atlas_width() const { return atlas_width_; }
  int atlas_height() const { return atlas_height_; }
  const std::vector<std::uint8_t>& atlas() const { return atlas_; }  ///< coverage, rows from top

 private:
  void Pack(Glyph* glyph, const std::uint8_t* bitmap, int pitch);

  float scale_ = 1;
  int atlas_width_ = 1024;
  int atlas_height_ = 0;
  int pen_x_ = 1, pen_y_ = 1, row_height_ = 0;
  std::vector<std::uint8_t> atlas_;
  std::map<std::uint32_t, Glyph> glyphs_[kTextStyles];
};

/// Returns the codepoints of a UTF-8 text; a byte that is not UTF-8 becomes U+FFFD.
std::vector<std::uint32_t> Codepoints(const std::string& utf8);

}  // namespace seam
