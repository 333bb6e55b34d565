#pragma once
/// A figure as data: panels of curves over labelled axes, drawn by gnuplot from a script that is
/// kept beside the picture.

#include <string>
#include <vector>

namespace seam {

/// How a curve is drawn; in all figures the same for the same thing.
struct Look {
  std::string colour = "#000000";
  std::string dash = "solid";  ///< gnuplot's dashtype: solid, or (6,3)
  double width = 1.5;          ///< of the line, pt; 0: no line
  int point = 7;               ///< gnuplot's point type; 0: none
  double size = 0.6;           ///< of the points
};

/// y may be 0 on a logarithmic axis and infinite on any: it is drawn at that edge.
struct PlotPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  ///< quartiles; both y: no bar
};

struct PlotCurve {
  std::string name;  ///< "": not in the legend
  Look look;
  std::vector<PlotPoint> points;
};

/// A value that means something by itself, such as the floor: a thin line across.
struct Level {
  double y = 0;
  std::string name;  ///< written at its right end
};

/// From a point to its note, px.
constexpr double kBesidePx = 8;

struct Note {
  double x = 0, y = 0;
  std::string text;
  bool left = false;  ///< of its place; else right
  double lift_px = 0;  ///< above its place
};

struct Axis {
  std::string label;  ///< what it shows, with the unit
  bool log = false;
  std::vector<double> tics;             ///< where; none: chosen
  std::string at_infinity = "failed";   ///< what infinity is called
  std::string at_zero = "0";            ///< and zero on a logarithmic axis
  std::vector<std::string> names = {};  ///< of 0, 1, 2, ... from above, in place of numbers
};

struct PlotPanel {
  Axis x, y;
  std::vector<PlotCurve> curves;
  std::vector<Level> levels;
  std::vector<Level> uprights;  ///< the same across the other way: y is the place on x
  std::vector<Note> notes;
};

struct Figure {
  std::string name;  ///< of its files: a-z, 0-9, -
  std::string title;
  std::string caption;  ///< what is to be seen, one or two sentences
  std::string command;  ///< that makes it
  std::string scene;    ///< that it is of; "" of several
  int columns = 1;      ///< panels beside each other
  int panel_width_px = 400, panel_height_px = 300;
  int left_px = 72;    ///< of a panel, for the tics of its y axis
  bool small = false;  ///< in the page several beside each other
  std::vector<PlotPanel> panels;
};

enum class PictureFormat { kSvg, kPng };
const char* Extension(PictureFormat format);

/// Where the values of an axis lie on it.
struct PlotRange {
  double low = 0, high = 1;  ///< ends of the axis
  bool zero = false, infinity = false;
  double zero_at = 0, infinity_at = 1;  ///< where these are drawn, if there are any
};

/// Takes in all `values` with a margin; of none, 0 to 1 (or 1 to 10).
PlotRange FindRange(const std::vector<double>& values, bool log);
/// `value` or the edge it belongs to.
double PlaceOn(const PlotRange& range, double value, bool log);
/// Powers of ten; where these are few, 1, 2 and 5 of each, or more.
std::vector<double> LogTics(const PlotRange& range);

struct PlotRanges {
  PlotRange x, y;
};
/// Takes in all that a panel draws.
PlotRanges RangesOf(const PlotPanel& panel);

/// Puts each note beside its point, where it covers no point and no other note; where there is no
/// such place near, the note goes. Sizes are of the panel inside its axes. Call it when the panel
/// has its curves.
void SpreadNotes(double width_px, double height_px, PlotPanel* panel);

/// gnuplot's text for the whole figure, its data included; writes NAME.svg (or .png) beside it.
std::string GnuplotScript(const Figure& figure, PictureFormat format);

}  // namespace seam
