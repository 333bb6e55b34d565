#include "tests/lab/report/page.h"

#include <fmt/format.h>

namespace seam {
namespace {

constexpr const char* kStyle = R"(
body { margin: 0 auto; max-width: 1240px; padding: 24px 28px 80px; background: #fff;
  color: #1c1f24; font: 15px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 27px; margin: 12px 0 4px; }
h2 { font-size: 21px; margin: 52px 0 8px; padding-top: 12px; border-top: 2px solid #1c1f24; }
h3 { font-size: 17px; margin: 34px 0 6px; }
h4 { font-size: 15px; margin: 18px 0 6px; }
p { max-width: 80ch; margin: 6px 0 12px; }
nav ul { columns: 3 260px; padding-left: 18px; margin: 8px 0; }
nav li.sub { margin-left: 16px; font-size: 14px; }
a { color: #0b5cad; }
figure { margin: 18px 0 26px; }
figure img { max-width: 100%; height: auto; border: 1px solid #e2e2dd; }
figcaption, .note { color: #4d525a; font-size: 14px; max-width: 90ch; margin-top: 4px; }
pre { background: #f5f5f2; padding: 6px 10px; font-size: 12.5px; white-space: pre-wrap;
  overflow-wrap: anywhere; margin: 4px 0 10px; }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(370px, 1fr)); gap: 16px; }
.grid figure { margin: 0; min-width: 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13.5px; font-variant-numeric: tabular-nums;
  margin: 6px 0; }
th, td { padding: 3px 11px; text-align: right; border-bottom: 1px solid #e2e2dd; }
th { vertical-align: bottom; border-bottom: 1.5px solid #1c1f24; font-weight: 600; }
th:first-child, td:first-child { text-align: left; white-space: nowrap; }
tbody tr:hover { background: #f5f5f2; }
details { margin: 4px 0 10px; } summary { cursor: pointer; color: #0b5cad; }
)";

std::string Head(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         EscapeHtml(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n";
}

std::string Shown(const std::string& file, const std::string& link, const std::string& title,
                  const std::string& below) {
  return fmt::format(
      "<figure><a href=\"{}\"><img loading=\"lazy\" src=\"{}\" alt=\"{}\"></a>"
      "<figcaption>{}</figcaption></figure>\n",
      EscapeHtml(link), EscapeHtml(file), EscapeHtml(title), below);
}

/// Each kind of item as HTML.
struct Writer {
  PictureFormat format;

  std::string operator()(const Figure& f) const {
    const std::string file = fmt::format("plots/{}.{}", f.name, Extension(format));
    return Shown(file, file, f.title,
                 fmt::format("{} <a href=\"plots/{}.gp\">gnuplot script with the data</a>"
                             "<pre>{}</pre>",
                             EscapeHtml(f.caption), f.name, EscapeHtml(f.command)));
  }
  std::string operator()(const TextTable& t) const {
    const std::string table = Html(t);
    const std::string link = fmt::format("<a href=\"tables/{}.md\">Markdown</a>", t.name);
    const std::string title = EscapeHtml(t.title);
    return fmt::format("<details{}><summary>{}</summary>{}{}</details>\n", t.open ? " open" : "",
                       title, table, link);
  }
  std::string operator()(const Thumbnail& t) const {
    return Shown(t.file, t.link, t.title,
                 "<b>" + EscapeHtml(t.title) + "</b><pre>" + EscapeHtml(t.command) + "</pre>");
  }
};

bool IsSmall(const PageItem& item) {
  const Figure* figure = std::get_if<Figure>(&item);
  return figure != nullptr ? figure->small : std::holds_alternative<Thumbnail>(item);
}

std::string Items(const std::vector<PageItem>& items, PictureFormat format) {
  std::string out;
  bool grid = false;
  for (const PageItem& item : items) {
    if (IsSmall(item) != grid) out += grid ? "</div>\n" : "<div class=\"grid\">\n";
    grid = IsSmall(item);
    out += std::visit(Writer{format}, item);
  }
  return out + (grid ? "</div>\n" : "");
}

}  // namespace

std::string HtmlPage(const std::vector<Section>& sections, PictureFormat format,
                     const std::string& data) {
  std::string out = Head("Seam2D: speed against error");
  out +=
      "<h1>Seam2D: speed against error</h1>\n<p>What each choice costs, and how wrong it is. "
      "All figures are of real runs in virtual time; under each is the command that makes it. "
      "The measures are defined in <code>docs/metrics.md</code>, the hard cases in "
      "<code>docs/hard-cases.md</code>. <a href=\"tables.md\">All tables as Markdown</a>, "
      "<a href=\"" +
      EscapeHtml(data) + "/\">all data as CSV</a>.</p>\n<nav><ul>\n";
  for (const Section& s : sections) {
    out += fmt::format("<li{}><a href=\"#{}\">{}</a></li>\n",
                       s.part_of_last ? " class=\"sub\"" : "", s.id, EscapeHtml(s.title));
  }
  out += "</ul></nav>\n";
  for (const Section& s : sections) {
    const char* const level = s.part_of_last ? "h3" : "h2";
    out += fmt::format("<{0} id=\"{1}\">{2}</{0}>\n", level, s.id, EscapeHtml(s.title));
    if (!s.intro.empty()) out += "<p>" + EscapeHtml(s.intro) + "</p>\n";
    out += Items(s.items, format);
  }
  return out + "</body>\n</html>\n";
}

std::string HtmlContactSheet(const std::string& title, const std::string& command,
                             const std::vector<std::string>& files) {
  std::string out = Head(title) + "<h1>" + EscapeHtml(title) + "</h1>\n<pre>" +
                    EscapeHtml(command) + "</pre>\n<div class=\"grid\">\n";
  for (const std::string& file : files) out += Shown(file, file, title, EscapeHtml(file));
  return out + "</div>\n</body>\n</html>\n";
}

}  // namespace seam
