#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/lab/report/figure.h"

namespace seam {
namespace {

constexpr int kLegendLinePx = 22, kTitlePx = 34;
constexpr int kRightPx = 24, kTopPx = 34, kBottomPx = 54;

/// In single quotes, as gnuplot reads a text in which nothing is special.
std::string Quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c == '\n' ? ' ' : c;
  }
  return out + "'";
}

std::string LineStyle(const Look& look, double width) {
  const std::string dash = look.dash == "solid" ? "1" : look.dash;
  return fmt::format("lc rgb '{}' lw {} dt {}", look.colour, width, dash);
}

std::string Points(const Look& look) {
  return fmt::format("pt {} ps {} lc rgb '{}' lw 1.5", look.point, look.size, look.colour);
}

/// "0", "0.001", "10", "2·10⁻⁵".
std::string TicText(double value) {
  if (value == 0 || (value >= 0.99e-3 && value < 0.99e5)) return fmt::format("{:g}", value);
  const int power = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  const int digit = static_cast<int>(std::round(value / std::pow(10, power)));
  std::string text = digit == 1 ? "10" : fmt::format("{}·10", digit);
  for (const char c : std::to_string(power)) {
    static const char* const kRaised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    text += c == '-' ? "⁻" : kRaised[c - '0'];
  }
  return text;
}

/// Writes one panel after the other.
class Script {
 public:
  Script(const Figure& figure, PictureFormat format) : f_(figure) {
    const int count = std::max(1, static_cast<int>(f_.panels.size()));
    columns_ = std::clamp(f_.columns, 1, count);
    rows_ = (count + columns_ - 1) / columns_;
    width_ = columns_ * f_.panel_width_px;
    for (const PlotPanel& panel : f_.panels) {
      for (const PlotCurve& curve : panel.curves) AddToLegend(curve);
    }
    for (const PlotCurve* curve : legend_) {
      legend_cell_px_ = std::max(legend_cell_px_, 66 + 8 * static_cast<int>(curve->name.size()));
    }
    const int across = std::max(1, (width_ - 14) / legend_cell_px_);
    const int entries = static_cast<int>(legend_.size());
    legend_px_ = (entries + across - 1) / across * kLegendLinePx;
    height_ = kTitlePx + legend_px_ + rows_ * f_.panel_height_px;
    Begin(format);
    for (std::size_t i = 0; i < f_.panels.size(); ++i) DrawPanel(i);
    DrawLegend(across);
    text_ += "unset multiplot\nunset output\n";
  }
  std::string text() const { return text_; }

 private:
  void AddToLegend(const PlotCurve& curve) {
    const bool known = std::any_of(legend_.begin(), legend_.end(),
                                   [&](const PlotCurve* c) { return c->name == curve.name; });
    if (!curve.name.empty() && !known) legend_.push_back(&curve);
  }

  void Begin(PictureFormat format) {
    text_ = fmt::format("# {}\n# {}\nreset\nset encoding utf8\n", f_.title, f_.command);
    text_ +=
        format == PictureFormat::kSvg
            ? fmt::format(
                  "set terminal svg size {},{} font 'Helvetica,13' noenhanced "
                  "background '#ffffff'\n",
                  width_, height_)
            : fmt::format(
                  "set terminal pngcairo size {},{} font 'sans,13' fontscale 0.75 noenhanced\n",
                  width_, height_);
    text_ += fmt::format("set output '{}.{}'\nset multiplot\n", f_.name, Extension(format));
    text_ += fmt::format("set label 1 {} at screen 0.5,{} center font ',16'\n", Quoted(f_.title),
                         1 - 17.0 / height_);
    text_ +=
        "set border 3 lc rgb '#555555'\nset tics nomirror textcolor rgb '#333333'\n"
        "set grid lc rgb '#dcdcdc' lw 1 dt 1\nunset key\n";
  }

  double X(double px) const { return px / width_; }
  double Y(double px_from_top) const { return 1 - px_from_top / height_; }

  static std::string Names(const char* axis, const Axis& a) {
    std::string list;
    for (std::size_t i = 0; i < a.names.size(); ++i) {
      list += fmt::format("{}{} {}", i == 0 ? "" : ", ", Quoted(a.names[i]), i);
    }
    return fmt::format("unset logscale {0}\nset {0}range [{1}:-1]\nset {0}tics ({2})\n", axis,
                       a.names.size(), list);
  }

  std::string AxisLines(const char* axis, const Axis& a, const PlotRange& range) const {
    std::string out = fmt::format("{1} logscale {0}\nset {0}range [{2}:{3}]\n", axis,
                                  a.log ? "set" : "unset", range.low, range.high);
    if (!a.names.empty()) return Names(axis, a);
    std::vector<double> tics = a.tics;
    if (tics.empty() && a.log) tics = LogTics(range);
    std::string list;
    for (const double tic : tics) {
      if (a.log && tic <= 0) continue;
      list += fmt::format("{}{} {}", list.empty() ? "" : ", ", Quoted(TicText(tic)), tic);
    }
    out += list.empty() ? fmt::format("set {}tics autofreq\n", axis)
                        : fmt::format("set {}tics ({})\n", axis, list);
    if (range.zero)
      out += fmt::format("set {}tics add ({} {})\n", axis, Quoted(a.at_zero), range.zero_at);
    if (range.infinity) {
      out +=
          fmt::format("set {}tics add ({} {})\n", axis, Quoted(a.at_infinity), range.infinity_at);
    }
    return out;
  }

  void DrawPanel(std::size_t index) {
    const PlotPanel& p = f_.panels[index];
    const int i = static_cast<int>(index);
    const double left = (i % columns_) * f_.panel_width_px;
    const double top = kTitlePx + legend_px_ + (i / columns_) * f_.panel_height_px;
    text_ += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\n"
        "set tmargin at screen {}\nset bmargin at screen {}\n",
        X(left + f_.left_px), X(left + f_.panel_width_px - kRightPx), Y(top + kTopPx),
        Y(top + f_.panel_height_px - kBottomPx));
    const auto [x, y] = RangesOf(p);
    text_ += AxisLines("x", p.x, x) + AxisLines("y", p.y, y);
    text_ += fmt::format("set xlabel {} offset 0,0.3\n", Quoted(p.x.label));
    // The y axis is named above it, where one reads it without turning one's head.
    text_ += fmt::format("set label 2 {} at screen {},{} left font ',13'\n", Quoted(p.y.label),
                         X(left + 14), Y(top + 16));
    text_ += Marks(p, x, y) + Data(p, x, y, i);
    std::string plots;
    for (std::size_t c = 0; c < p.curves.size(); ++c) plots += Plots(p.curves[c], i, c);
    text_ += plots.empty() ? "plot NaN\n" : "plot " + plots.substr(0, plots.size() - 2) + "\n";
    text_ += "unset label\nunset arrow\n";  // the title's too, after the first panel
  }

  /// Levels as lines without heads, notes as labels.
  std::string Marks(const PlotPanel& p, const PlotRange& x, const PlotRange& y) const {
    std::string out;
    int tag = 3;
    for (const Level& level : p.levels) {
      const double at = PlaceOn(y, level.y, p.y.log);
      out += fmt::format(
          "set arrow {0} from graph 0,first {1} to graph 1,first {1} nohead back "
          "lc rgb '#888888' lw 1.5 dt (3,3)\n"
          "set label {0} {2} at graph 0.99,first {1} right offset 0,0.45 "
          "textcolor rgb '#666666' font ',11'\n",
          tag++, at, Quoted(level.name));
    }
    for (const Level& upright : p.uprights) {
      const double at = PlaceOn(x, upright.y, p.x.log);
      out += fmt::format(
          "set arrow {0} from first {1},graph 0 to first {1},graph 1 nohead back "
          "lc rgb '#888888' lw 1.5 dt (3,3)\n"
          "set label {0} {2} at first {1},graph 0.98 left offset 0.5,0 "
          "textcolor rgb '#666666' font ',11'\n",
          tag++, at, Quoted(upright.name));
    }
    for (const Note& note : p.notes) {
      out +=
          fmt::format("set label {} {} at {},{} {} offset screen {:.5f},screen {:.5f} font ',11'\n",
                      tag++, Quoted(note.text), PlaceOn(x, note.x, p.x.log),
                      PlaceOn(y, note.y, p.y.log), note.left ? "right" : "left",
                      X(note.left ? -kBesidePx : kBesidePx), note.lift_px / height_);
    }
    return out;
  }

  std::string Data(const PlotPanel& p, const PlotRange& x, const PlotRange& y, int panel) const {
    std::string out;
    for (std::size_t c = 0; c < p.curves.size(); ++c) {
      out += fmt::format("$p{}c{} << END\n", panel, c);
      for (const PlotPoint& point : p.curves[c].points) {
        out +=
            fmt::format("{} {} {} {}\n", PlaceOn(x, point.x, p.x.log), PlaceOn(y, point.y, p.y.log),
                        PlaceOn(y, point.low, p.y.log), PlaceOn(y, point.high, p.y.log));
      }
      out += "END\n";
    }
    return out;
  }

  static std::string Plots(const PlotCurve& curve, int panel, std::size_t c) {
    if (curve.points.empty()) return "";
    const std::string data = fmt::format("$p{}c{} using 1:2", panel, c);
    const bool bars = std::any_of(curve.points.begin(), curve.points.end(),
                                  [](const PlotPoint& p) { return p.low != p.high; });
    std::string out;
    if (bars) {
      out += fmt::format("{}:3:4 with yerrorbars pt 0 ps 0 lc rgb '{}' lw 0.7, ", data,
                         curve.look.colour);
    }
    if (curve.look.width > 0) {
      out += data + " with lines " + LineStyle(curve.look, curve.look.width) + ", ";
    }
    if (curve.look.point > 0) out += data + " with points " + Points(curve.look) + ", ";
    return out;
  }

  /// Line and name of each, in rows below the title: drawn as objects of the whole picture.
  void DrawLegend(int across) {
    if (legend_.empty()) return;
    const int entries = static_cast<int>(legend_.size());
    text_ += "reset\nset encoding utf8\nunset border\nunset tics\nunset key\n";
    text_ +=
        "set lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen 1\n"
        "set bmargin at screen 0\nset xrange [0:1]\nset yrange [0:1]\n";
    std::string plots;
    for (int i = 0; i < entries; ++i) {
      const Look& look = legend_[static_cast<std::size_t>(i)]->look;
      const double left = (i % across) * legend_cell_px_ + 14;
      const double at = Y(kTitlePx + kLegendLinePx * (i / across + 0.5));
      text_ += fmt::format("set label {} at {},{} left font ',12'\n",
                           Quoted(legend_[static_cast<std::size_t>(i)]->name), X(left + 36), at);
      text_ += fmt::format("$l{} << END\n{} {}\n{} {}\nEND\n$m{} << END\n{} {}\nEND\n", i, X(left),
                           at, X(left + 30), at, i, X(left + 15), at);
      if (look.width > 0) {
        plots += fmt::format("$l{} with lines {}, ", i, LineStyle(look, look.width));
      }
      if (look.point > 0) plots += fmt::format("$m{} with points {}, ", i, Points(look));
    }
    text_ += "plot " + plots.substr(0, plots.size() - 2) + "\n";
  }

  const Figure& f_;
  std::string text_;
  std::vector<const PlotCurve*> legend_;
  int columns_ = 1, rows_ = 1, width_ = 0, height_ = 0, legend_px_ = 0, legend_cell_px_ = 90;
};

}  // namespace

const char* Extension(PictureFormat format) {
  return format == PictureFormat::kSvg ? "svg" : "png";
}

std::string GnuplotScript(const Figure& figure, PictureFormat format) {
  return Script(figure, format).text();
}

}  // namespace seam
