#include "tests/lab/report/page.h"

#include <fmt/format.h>

#include "common/base/json_text.h"
#include "tests/lab/report/html/figure_json.h"
#include "tests/lab/report/html/report_assets.h"
#include "tests/lab/report/method_look.h"

namespace seam {
namespace {

std::string Head(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         EscapeHtml(title) + "</title>\n<style>" + ReportStyle() + "</style>\n</head>\n<body>\n";
}

std::string Shown(const std::string& file, const std::string& link, const std::string& title,
                  const std::string& attributes, const std::string& below) {
  return fmt::format(
      "<figure{}><a class=\"picture\" href=\"{}\"><img loading=\"lazy\" src=\"{}\" alt=\"{}\"></a>"
      "{}</figure>\n",
      attributes, EscapeHtml(link), EscapeHtml(file), EscapeHtml(title), below);
}

/// What made it, folded away.
std::string Command(const std::string& command) {
  if (command.empty()) return "";
  return "<details class=\"command\"><summary>command</summary><pre>" + EscapeHtml(command) +
         "</pre></details>";
}

std::string OfScene(const std::string& scene) {
  return scene.empty() ? "" : " data-scene=\"" + EscapeHtml(scene) + "\"";
}

std::string Data(const std::string& json) {
  return "<script type=\"application/json\">" + json + "</script>";
}

/// Each kind of item as HTML.
struct Writer {
  PictureFormat format;

  std::string operator()(const Figure& f) const {
    const std::string file = fmt::format("plots/{}.{}", f.name, Extension(format));
    return Shown(
        file, file, f.title,
        fmt::format(" data-title=\"{}\"{}", EscapeHtml(f.title), OfScene(f.scene)),
        fmt::format("<figcaption>{} <a href=\"{}\">picture</a>, <a href=\"plots/{}.gp\">gnuplot "
                    "script with the data</a></figcaption>{}{}",
                    EscapeHtml(f.caption), file, f.name, Command(f.command), Data(FigureJson(f))));
  }
  std::string operator()(const TextTable& t) const {
    const std::string table = Html(t);
    const std::string link = fmt::format("<a href=\"tables/{}.md\">Markdown</a>", t.name);
    const std::string title = EscapeHtml(t.title);
    return fmt::format("<details{}{}><summary>{}</summary>{}{}</details>\n", t.open ? " open" : "",
                       OfScene(t.scene), title, table, link);
  }
  std::string operator()(const Thumbnail& t) const {
    return Shown(
        t.file, t.link, t.title, "",
        "<figcaption><b>" + EscapeHtml(t.title) + "</b></figcaption>" + Command(t.command));
  }
  std::string operator()(const Answers& answers) const {
    return "<div class=\"answers\" hidden><form class=\"ask\">"
           "<label>latency, one way (ms)<input type=\"number\" name=\"latency\" value=\"50\" "
           "min=\"0\" max=\"1000\" step=\"5\"></label>"
           "<label>loss (%)<input type=\"number\" name=\"loss\" value=\"1\" min=\"0\" max=\"100\" "
           "step=\"1\"></label>"
           "<label>like the scene<select name=\"scene\"><option value=\"\">all of them</option>"
           "</select></label></form><output></output>" +
           Data(answers.json) + "</div>\n";
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

/// The chapters' list, and what the script's switches are about.
std::string Navigation(const std::vector<Section>& sections) {
  std::string out = "<nav><ul>\n";
  for (const Section& s : sections) {
    out += fmt::format("<li{}><a href=\"#{}\">{}</a></li>\n",
                       s.part_of_last ? " class=\"sub\"" : "", s.id, EscapeHtml(s.title));
  }
  std::string methods;
  for (const std::string& name : KnownMethods()) {
    methods += fmt::format("{}[{},{}]", methods.empty() ? "" : ",", JsonText(name),
                           JsonText(MethodLook(name).colour));
  }
  return out +
         "</ul><div class=\"controls\"><label>only the scene <select id=\"scene-filter\">"
         "<option value=\"\">all</option></select></label><label>values <select id=\"scale\">"
         "<option>as made</option><option>log</option><option>linear</option></select></label>"
         "methods</div><div class=\"methods\"></div>"
         "<script type=\"application/json\" id=\"methods-known\">[" +
         methods + "]</script></nav>\n";
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
      EscapeHtml(data) + "/\">all data as CSV</a>.</p>\n<div class=\"frame\">\n" +
      Navigation(sections) + "<main>\n";
  for (const Section& s : sections) {
    out += fmt::format("<section class=\"chapter\" id=\"{}\">\n<h2>{}</h2>\n", s.id,
                       EscapeHtml(s.title));
    if (!s.intro.empty()) out += "<p>" + EscapeHtml(s.intro) + "</p>\n";
    out += Items(s.items, format) + "</section>\n";
  }
  return out + "</main></div>\n<script>\n" + ReportScript() + "</script>\n</body>\n</html>\n";
}

std::string HtmlContactSheet(const std::string& title, const std::string& command,
                             const std::vector<std::string>& files) {
  std::string out = Head(title) + "<h1>" + EscapeHtml(title) + "</h1>\n<pre>" +
                    EscapeHtml(command) + "</pre>\n<div class=\"grid\">\n";
  for (const std::string& file : files) {
    out += Shown(file, file, title, "", "<figcaption>" + EscapeHtml(file) + "</figcaption>");
  }
  return out + "</div>\n</body>\n</html>\n";
}

}  // namespace seam
