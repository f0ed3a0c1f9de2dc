// The text of run.xdmf: a time series for ParaView versions that do not read transient VTKHDF, pointing at the arrays in run.vtkhdf.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "engine/output_field.hpp"

namespace nanson {

/// What every frame refers to: the results file, by its name alone as both lie in one folder, and the sizes of the mesh.
struct XdmfMesh {
  std::string file;
  std::size_t nodes = 0;
  std::size_t tets = 0;
};

/// One time of the series. The state after a breakdown carries an Information element `breakdown` = 1.
std::string xdmf_frame(const XdmfMesh& mesh, std::span<const Field> fields, std::size_t index, double t,
                       bool breakdown);

/// The whole file around the frames.
std::string xdmf_file(std::string_view frames);

}  // namespace nanson
