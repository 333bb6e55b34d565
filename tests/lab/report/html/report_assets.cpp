#include "tests/lab/report/html/report_assets.h"

// As render/page/assets.cpp does it: the Makefile makes this object anew when a file changes.
#define SEAM_EMBED(name, file)                                                                     \
  asm(".pushsection .rodata\n" #name "_begin:\n.incbin \"tests/lab/report/html/" file "\"\n" #name \
      "_end:\n.popsection\n");                                                                     \
  extern const char name##_begin[] asm(#name "_begin");                                            \
  extern const char name##_end[] asm(#name "_end");

SEAM_EMBED(seam_report_style, "report.css")
SEAM_EMBED(seam_report_charts, "charts.js")
SEAM_EMBED(seam_report_answers, "answers.js")
SEAM_EMBED(seam_report_chapters, "chapters.js")

namespace seam {

std::string ReportStyle() { return {seam_report_style_begin, seam_report_style_end}; }

std::string ReportScript() {
  return std::string(seam_report_charts_begin, seam_report_charts_end) +
         std::string(seam_report_answers_begin, seam_report_answers_end) +
         std::string(seam_report_chapters_begin, seam_report_chapters_end);
}

}  // namespace seam
