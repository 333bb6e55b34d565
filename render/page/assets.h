#pragma once
/// The files of render/page/ for a review page, embedded when the program was built.

#include <string>

namespace seam {

std::string PageTemplate();  ///< page.html
std::string PageStyle();     ///< page.css
std::string PageScript();    ///< the .js files, in order of dependency

}  // namespace seam
