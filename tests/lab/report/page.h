#pragma once
/// The report as data: sections of figures, tables and pictures, and the HTML page of it, which
/// needs no network. Its script shows a chapter at a time and draws the figures; without it all
/// stands below each other, with pictures.

#include <string>
#include <variant>
#include <vector>

#include "tests/lab/report/figure.h"
#include "tests/lab/report/text_table.h"

namespace seam {

/// A rendering that is there already: shown small, opens large.
struct Thumbnail {
  std::string file;  ///< shown, relative to the page
  std::string link;  ///< opened
  std::string title;
  std::string command;  ///< that made it; may be several lines
};

/// Asks for a latency and a loss and says what to use; see html/answers.h.
struct Answers {
  std::string json;
};

using PageItem = std::variant<Figure, TextTable, Thumbnail, Answers>;

struct Section {
  std::string id;  ///< of its anchor
  std::string title;
  std::string intro;  ///< one paragraph; may be empty
  std::vector<PageItem> items;
  bool part_of_last = false;  ///< a subsection
};

/// The whole document; pictures are expected in plots/, tables in tables/. `data`: the folder of
/// the CSV files, relative to the page.
std::string HtmlPage(const std::vector<Section>& sections, PictureFormat format,
                     const std::string& data);

/// A page of pictures in a row, such as the frames of a comparison; `files` relative to it.
std::string HtmlContactSheet(const std::string& title, const std::string& command,
                             const std::vector<std::string>& files);

}  // namespace seam
