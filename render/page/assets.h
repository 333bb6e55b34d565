#pragma once
/// The files of render/page/ that a page is made of, as they were when the program was built.

#include <string>

namespace seam {

std::string PageTemplate();  ///< page.html
std::string PageStyle();     ///< page.css
std::string PageScript();    ///< the .js files, each after what it uses

}  // namespace seam
