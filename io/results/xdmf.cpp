// The elements of XDMF that the readers of ParaView 5.11 and 5.13 all understand.
#include "io/results/xdmf.hpp"

#include <fmt/format.h>

namespace nanson {
namespace {

std::string data_item(std::string_view dimensions, std::string_view number, int bytes, std::string_view file,
                      std::string_view path) {
  return fmt::format(R"(<DataItem Dimensions="{}" NumberType="{}" Precision="{}" Format="HDF">{}:{}</DataItem>)",
                     dimensions, number, bytes, file, path);
}

std::string attribute(std::string_view name, std::string_view type, std::string_view centre, const std::string& item) {
  return fmt::format(R"(<Attribute Name="{}" AttributeType="{}" Center="{}">{}</Attribute>)", name, type, centre, item)
         + "\n";
}

std::string_view attribute_type(int components) {
  return components == 1 ? "Scalar" : components == 3 ? "Vector" : components == 9 ? "Tensor" : "Matrix";
}

}  // namespace

std::string xdmf_frame(const XdmfMesh& mesh, std::span<const Field> fields, std::size_t index, double t,
                       bool breakdown) {
  std::string text = fmt::format(R"(<Grid Name="frame {}" GridType="Uniform"><Time Value="{}"/>)", index, t) + "\n";
  if (breakdown) text += "<Information Name=\"breakdown\" Value=\"1\"/>\n";
  text += fmt::format(R"(<Topology TopologyType="Tetrahedron" NumberOfElements="{}">)", mesh.tets);
  text += data_item(fmt::format("{} 4", mesh.tets), "Int", 8, mesh.file, "/VTKHDF/Connectivity") + "</Topology>\n";
  text += R"(<Geometry GeometryType="XYZ">)"
          + data_item(fmt::format("{} 3", mesh.nodes), "Float", 8, mesh.file, "/VTKHDF/Points") + "</Geometry>\n";
  text += attribute("region", "Scalar", "Cell",
                    data_item(fmt::format("{}", mesh.tets), "Int", 4, mesh.file, "/VTKHDF/CellData/region"));
  for (const auto& field : fields) {
    const auto dimensions = field.components == 1 ? fmt::format("{}", mesh.nodes)
                                                  : fmt::format("{} {}", mesh.nodes, field.components);
    const auto path = fmt::format("/frames/{:06}/{}", index, field.name);
    text += attribute(field.name, attribute_type(field.components), "Node",
                      data_item(dimensions, "Float", 4, mesh.file, path));
  }
  return text + "</Grid>\n";
}

std::string xdmf_file(std::string_view frames) {
  return fmt::format(R"(<?xml version="1.0"?>
<Xdmf Version="3.0"><Domain><Grid Name="run" GridType="Collection" CollectionType="Temporal">
{}</Grid></Domain></Xdmf>
)",
                     frames);
}

}  // namespace nanson
