/// A table that spreadsheets, pandas and gnuplot read.

#include "common/measure/table.h"
#include "render/export/formats.h"
#include "render/export/json_text.h"

namespace seam {

void WriteCsvExport(const ExportSession& session, OutputFile* out) {
  out->Write("tick,time_s,view,body,x,y,angle,vx,vy,spin,error_m\n");
  ForEachView(session, [&](const View& view) {
    const double time_s = static_cast<double>(view.tick) * session.TickSeconds();
    const std::string head = std::to_string(view.tick) + ',' + JsonNumber(time_s) + ',' +
                             CsvField(session.ViewName(view.peer)) + ',';
    std::string text;
    for (const ExportRow& row : RowsOf(session, view)) {
      const std::size_t i = row.i;
      text += head + CsvField(session.of.at(row.id));
      for (const float value :
           {view.x[i], view.y[i], view.angle[i], view.vx[i], view.vy[i], view.spin[i]}) {
        text += ',' + JsonNumber(double{value});
      }
      text += ',' + (row.error_m ? JsonNumber(*row.error_m) : std::string()) + '\n';
    }
    out->Write(text);
  });
}

}  // namespace seam
