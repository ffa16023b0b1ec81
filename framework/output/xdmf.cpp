#include "output/xdmf.hpp"

#include <fmt/format.h>

#include <string_view>

namespace mesogen::output {

namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// The values of one frame: a hyperslab (start, stride, count) of the dataset of all frames.
std::string values(const FieldShape& field, std::size_t frame, std::size_t frames, Index particles) {
  const bool scalar = field.components == 1;
  const std::string tail = scalar ? "" : fmt::format(" {}", field.components);
  return fmt::format(R"(          <DataItem ItemType="HyperSlab" Dimensions="{particles}{tail}" Type="HyperSlab">
            <DataItem Dimensions="3 {rank}" Format="XML">{frame} 0{zero} 1 1{one} 1 {particles}{tail}</DataItem>
            <DataItem Format="HDF" NumberType="{type}" Precision="{precision}" Dimensions="{frames} {particles}{tail}">results.h5:/particles/fluid/{name}/value</DataItem>
          </DataItem>
)",
                     fmt::arg("particles", particles), fmt::arg("tail", tail), fmt::arg("rank", scalar ? 2 : 3),
                     fmt::arg("frame", frame), fmt::arg("zero", scalar ? "" : " 0"),
                     fmt::arg("one", scalar ? "" : " 1"),
                     fmt::arg("type", field.type == NumberType::int32 ? "Int" : "Float"),
                     fmt::arg("precision", field.type == NumberType::float64 ? 8 : 4), fmt::arg("frames", frames),
                     fmt::arg("name", escaped(field.name)));
}

std::string grid(const ResultsOptions& options, const ResultsContent& content, std::size_t frame) {
  std::string text = fmt::format(R"(      <Grid Name="fluid" GridType="Uniform">
        <Time Value="{:.17g}"/>
        <Topology TopologyType="Polyvertex" NumberOfElements="{}" NodesPerElement="1"/>
)",
                                 content.frames[frame].time, options.count);
  for (const FieldShape& field : content.fields) {
    const std::string data = values(field, frame, content.frames.size(), options.count);
    if (field.name == "position")
      text += fmt::format("        <Geometry GeometryType=\"{}\">\n{}        </Geometry>\n",
                          field.components == 2 ? "XY" : "XYZ", data);
    else
      text +=
          fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">\n{}        </Attribute>\n",
                      escaped(field.name), field.components == 1 ? "Scalar" : "Vector", data);
  }
  text += fmt::format(R"(        <Attribute Name="id" AttributeType="Scalar" Center="Node">
          <DataItem Format="HDF" NumberType="Int" Precision="8" Dimensions="{}">results.h5:/particles/fluid/id</DataItem>
        </Attribute>
      </Grid>
)",
                      options.count);
  return text;
}

}  // namespace

std::string xdmf_text(const ResultsOptions& options, const ResultsContent& content) {
  std::string text = R"(<?xml version="1.0"?>
<!-- In ParaView choose "XDMF Reader"; its "Xdmf3 Reader" does not read hyperslabs. -->
<Xdmf Version="3.0">
  <Domain>
    <Grid Name="run" GridType="Collection" CollectionType="Temporal">
)";
  for (std::size_t frame = 0; frame < content.frames.size(); ++frame) text += grid(options, content, frame);
  text += R"(    </Grid>
  </Domain>
</Xdmf>
)";
  return text;
}

}  // namespace mesogen::output
