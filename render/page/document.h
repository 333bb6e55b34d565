#pragma once
/// A review page: one HTML file with all views of some recordings in it, that needs nothing else.

#include <string>
#include <vector>

#include "render/page/column.h"
#include "render/playback/playback.h"

namespace seam {

/// One recording of a page.
struct PageRun {
  std::string name;  ///< what to call it: "crossing-rollback"
  const Playback* playback = nullptr;
  std::string path = {};  ///< of its log, for what the logger missed; "": not looked for
};

/// What a page carries, before it is compressed: the head's length in bytes (4 bytes, the lowest
/// first), the head (JSON; it says where each section is), the sections.
PageBytes PageData(const std::vector<PageRun>& runs);

/// The page. Text of a recording stands in it as compressed JSON only, so that no name can become
/// markup.
std::string PageHtml(const std::vector<PageRun>& runs);

}  // namespace seam
