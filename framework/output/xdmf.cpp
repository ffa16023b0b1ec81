#include "output/xdmf.hpp"

#include <fmt/format.h>

#include <string_view>

#include "output/frame_file.hpp"
#include "output/shown_fields.hpp"

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

std::string dataset(std::string_view path, std::string_view type, int precision, Index rows, int columns) {
  return fmt::format(R"(<DataItem Format="HDF" NumberType="{}" Precision="{}" Dimensions="{}{}">{}</DataItem>)", type,
                     precision, rows, columns == 1 ? "" : fmt::format(" {}", columns), escaped(path));
}

std::string attribute(std::string_view name, int components, std::string_view data) {
  const char* const kind = components == 1 ? "Scalar" : components == 3 ? "Vector" : "Tensor";
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                     escaped(name), kind, data);
}

/// Where the frame's group lies: file:/group
std::string place(std::size_t frame, Layout layout) {
  return layout == Layout::packed ? "results.h5:/" + packed_shown_group(frame) : frame_name(frame) + ":/" + shown_group;
}

/// The particles of one frame. Xdmf3 makes cells only of points that the topology lists: the ids, which count them.
std::string fluid(const ResultsOptions& options, const ResultsContent& content, std::size_t frame, Layout layout) {
  const std::string id = dataset("results.h5:/particles/fluid/id", "Int", 8, options.count, 1);
  std::string text = fmt::format(R"(      <Grid Name="fluid" GridType="Uniform">
        <Time Value="{:.17g}"/>
        <Topology TopologyType="Polyvertex" NumberOfElements="{}" NodesPerElement="1">{}</Topology>
)",
                                 content.frames[frame].time, options.count, id);
  for (const ShownField& field : shown_fields(content.fields, options.dimension)) {
    const std::string data =
        dataset(place(frame, layout) + "/" + field.name, field.type == NumberType::int32 ? "Int" : "Float",
                field.type == NumberType::float64 ? 8 : 4, options.count, field.components);
    text += field.name == "position" ? fmt::format("        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n", data)
                                     : attribute(field.name, field.components, data);
  }
  return text + attribute("id", 1, id) + "      </Grid>\n";
}

/// The edges of the box: lines between corners that differ along one axis. Bit d of a corner's number: is it at the far
/// end of axis d?
std::string box(const ResultsOptions& options, double time) {
  const unsigned corners = 1U << static_cast<unsigned>(options.dimension);
  std::string points;
  std::string lines;
  int count = 0;
  for (unsigned corner = 0; corner < corners; ++corner) {
    for (unsigned axis = 0; axis < 3; ++axis)
      points += fmt::format("{} ", (corner >> axis & 1U) != 0 ? options.box.at(axis) : 0.0);
    for (unsigned axis = 0; axis < static_cast<unsigned>(options.dimension); ++axis) {
      if ((corner >> axis & 1U) != 0) continue;
      lines += fmt::format("{} {} ", corner, corner | 1U << axis);
      ++count;
    }
  }
  return fmt::format(R"(      <Grid Name="box" GridType="Uniform">
        <Time Value="{:.17g}"/>
        <Topology TopologyType="Polyline" NumberOfElements="{}" NodesPerElement="2">
          <DataItem Format="XML" NumberType="Int" Dimensions="{} 2">{}</DataItem>
        </Topology>
        <Geometry GeometryType="XYZ"><DataItem Format="XML" NumberType="Float" Precision="8" Dimensions="{} 3">{}</DataItem></Geometry>
      </Grid>
)",
                     time, count, count, lines, corners, points);
}

}  // namespace

std::string xdmf_text(const ResultsOptions& options, const ResultsContent& content, Layout layout) {
  std::string fluids;
  std::string boxes;
  for (std::size_t frame = 0; frame < content.frames.size(); ++frame) {
    fluids += fluid(options, content, frame, layout);
    boxes += box(options, content.frames[frame].time);
  }
  constexpr const char* series =
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n";
  return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n" + fmt::format(series, "fluid", fluids) +
         fmt::format(series, "box", boxes) + "  </Domain>\n</Xdmf>\n";
}

}  // namespace mesogen::output
