#include "client/python/module.h"

#include "common/base/check.h"
#include "common/base/version.h"

PYBIND11_MODULE(_seam, module) {
  module.doc() = "Seam2D, as the package `seam` wraps it";
  module.attr("version") = seam::kVersion;
  pybind11::register_exception<seam::OperatorError>(module, "Error", PyExc_ValueError);
  seam::AddPlay(module);
  seam::AddLog(module);
  seam::AddNet(module);
}
