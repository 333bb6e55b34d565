#pragma once
/// A review page: one self-contained HTML file with all views of some recordings.

#include <string>
#include <vector>

#include "render/page/column.h"
#include "render/playback/playback.h"

namespace seam {

class PageWorlds;
struct PageEvent;

/// The parts of a page that the source of a running session keeps from one page to the next.
struct PageLive {
  PageWorlds* worlds = nullptr;                    ///< so that indices of worlds stay
  const std::vector<PageEvent>* events = nullptr;  ///< so far
};

/// One recording of a page.
struct PageRun {
  std::string name;  ///< its displayed name: "crossing-rollback"
  const Playback* playback = nullptr;
  std::string path = {};  ///< path of its log, to find messages the logger missed; "": skip that
  const PageLive* live = nullptr;  ///< the recording still grows: without losses
};

/// Returns a page's data before compression: the head's length in bytes (4 bytes, the lowest
/// first), the head (JSON, with the place of each section), the sections.
PageBytes PageData(const std::vector<PageRun>& runs);

/// Returns the page. Texts of a recording are in it as compressed JSON only, so that no name can
/// become markup.
std::string PageHtml(const std::vector<PageRun>& runs);

/// Returns a page without data, which gets them as events from the address /live of the server that
/// it came from (render/page/live.js).
std::string LivePageHtml();

}  // namespace seam
