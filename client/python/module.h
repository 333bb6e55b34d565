#pragma once
/// The parts of the Python module `seam._seam`, which the package in client/python/seam wraps.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <string>
#include <vector>

#include "common/codec/messages.h"
#include "common/measure/measure.h"
#include "common/physics/world.h"
#include "common/scene/scene.h"

namespace seam {

/// Adds the classes of logs, of worlds and sessions, and of the bus and real servers.
void AddLog(pybind11::module_& module);
void AddPlay(pybind11::module_& module);
void AddNet(pybind11::module_& module);

/// Returns an array with a copy of the values.
template <class T>
pybind11::array_t<T> ArrayOf(const std::vector<T>& values, std::vector<pybind11::ssize_t> shape) {
  pybind11::array_t<T> array(shape);
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

/// Bodies at a tick, as arrays by body.
struct Bodies {
  std::int64_t tick = 0;
  std::vector<PartId> ids;
  std::vector<std::string> names;
  std::vector<float> poses, velocities;  ///< three of each body
};
/// Returns the bodies of a view, with their names in `scene`.
Bodies BodiesOf(const Scene& scene, const View& view);
/// Returns them for Python.
pybind11::dict DictOf(const Bodies& bodies);

/// Returns an input of axes in 1/127 and a bit for each button. Throws OperatorError for others.
Input InputOf(int drive, int lift, int buttons);

/// Returns the measures by name: those of the table, and validity.
pybind11::dict MeasuresDict(const Measures& measures, const std::string& valid);

}  // namespace seam
