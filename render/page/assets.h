#pragma once
/// The files of render/page/ for a review page, embedded when the program was built.

#include <string>

namespace seam {

std::string PageTemplate();  ///< page.html
std::string PageStyle();     ///< page.css
std::string PageScript();    ///< the .js files of a review page, in order of dependency
/// Returns the same with live.js and drive.js, for a page that shows a running session.
std::string LivePageScript();

}  // namespace seam
