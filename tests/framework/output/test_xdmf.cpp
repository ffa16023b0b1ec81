#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <map>
#include <set>
#include <sstream>

#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;
using Tree = boost::property_tree::ptree;

std::vector<hsize_t> numbers_in(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<hsize_t>(in), {}};
}

/// What a DataItem names; it has these sizes and this precision. Both readers of ParaView open whole datasets alone: no
/// hyperslab, no function.
Array dataset(const fs::path& folder, const Tree& item) {
  EXPECT_EQ(item.get<std::string>("<xmlattr>.Format"), "HDF");
  EXPECT_EQ(item.get_optional<std::string>("<xmlattr>.ItemType"), boost::none);
  EXPECT_EQ(item.get_optional<std::string>("<xmlattr>.Function"), boost::none);
  const std::string& text = item.data();
  const std::size_t colon = text.find(":/");
  EXPECT_NE(colon, std::string::npos) << text;
  const Array array = Reader(folder / text.substr(0, colon)).array(text.substr(colon + 1));
  EXPECT_EQ(numbers_in(item.get<std::string>("<xmlattr>.Dimensions")), array.sizes) << text;
  EXPECT_EQ(item.get<std::string>("<xmlattr>.Precision"), std::to_string(array.bytes_each)) << text;
  EXPECT_EQ(item.get<std::string>("<xmlattr>.NumberType"), array.is_integer ? "Int" : "Float") << text;
  return array;
}

Tree xdmf_of(const fs::path& folder) {
  Tree tree;
  boost::property_tree::read_xml((folder / "results.xdmf").string(), tree,
                                 boost::property_tree::xml_parser::trim_whitespace);
  return tree;
}

/// The grids of the temporal collection of this name.
std::vector<Tree> series(const Tree& tree, const std::string& name) {
  std::vector<Tree> grids;
  for (const auto& [kind, collection] : tree.get_child("Xdmf.Domain")) {
    if (kind != "Grid" || collection.get<std::string>("<xmlattr>.Name") != name) continue;
    EXPECT_EQ(collection.get<std::string>("<xmlattr>.GridType"), "Collection");
    EXPECT_EQ(collection.get<std::string>("<xmlattr>.CollectionType"), "Temporal");
    for (const auto& [inner, grid] : collection)
      if (inner == "Grid") grids.push_back(grid);
  }
  return grids;
}

/// Attributes by "name type", and where the points are.
std::map<std::string, Array> arrays_of(const fs::path& folder, const Tree& grid) {
  std::map<std::string, Array> arrays;
  for (const auto& [kind, attribute] : grid)
    if (kind == "Attribute")
      arrays[attribute.get<std::string>("<xmlattr>.Name") + " " +
             attribute.get<std::string>("<xmlattr>.AttributeType")] = dataset(folder, attribute.get_child("DataItem"));
  EXPECT_EQ(grid.get<std::string>("Geometry.<xmlattr>.GeometryType"), "XYZ");
  arrays["points"] = dataset(folder, grid.get_child("Geometry.DataItem"));
  return arrays;
}

double single(double value) { return static_cast<double>(static_cast<float>(value)); }

/// A frame with one field of each rank.
std::vector<FrameField> frame_of_each_rank(std::int64_t step) {
  const auto n = static_cast<std::size_t>(particles);
  std::vector<FrameField> fields = frame_at(step);
  fields.push_back({"order_tensor", "1", 2, {}, NumberType::float32, Rank::order_tensor});
  fields.push_back({"velocity_gradient", "1/s", 4, {}, NumberType::float64, Rank::matrix});
  fields.push_back({"order_tensor_gradient", "1/m", 4, {}, NumberType::float64, {}});
  for (std::size_t f = fields.size() - 3; f < fields.size(); ++f)
    for (std::size_t i = 0; i < n * static_cast<std::size_t>(fields[f].components); ++i)
      fields[f].values.push_back(value_at(step, i) * static_cast<double>(f));
  return fields;
}

void expect_frames(const fs::path& folder, std::size_t frames) {
  const std::vector<Tree> fluid = series(xdmf_of(folder), "fluid");
  ASSERT_EQ(fluid.size(), frames);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const auto step = static_cast<std::int64_t>(2 * frame);
    const Tree& grid = fluid[frame];
    EXPECT_EQ(std::stod(grid.get<std::string>("Time.<xmlattr>.Value")), time_at(step));
    EXPECT_EQ(grid.get<std::string>("Topology.<xmlattr>.TopologyType"), "Polyvertex");
    EXPECT_EQ(grid.get<std::string>("Topology.<xmlattr>.NumberOfElements"), std::to_string(particles));
    EXPECT_EQ(dataset(folder, grid.get_child("Topology.DataItem")).values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
    std::map<std::string, Array> arrays = arrays_of(folder, grid);
    const std::vector<FrameField> fields = frame_of_each_rank(step);
    const auto stored = [&](const std::string& name, std::size_t i) {
      const auto field = std::ranges::find(fields, name, &FrameField::name);
      return field->type == NumberType::float32 ? single(field->values[i]) : field->values[i];
    };
    ASSERT_EQ(arrays.size(), 12U);
    for (std::size_t i = 0; i < static_cast<std::size_t>(particles); ++i) {
      for (const auto& [name, shown] :
           {std::pair{"velocity", "velocity Vector"}, {"position", "points"}, {"image", "image Vector"}}) {
        EXPECT_EQ(arrays[shown].values[3 * i], stored(name, 2 * i));
        EXPECT_EQ(arrays[shown].values[3 * i + 1], stored(name, 2 * i + 1));
        EXPECT_EQ(arrays[shown].values[3 * i + 2], 0.0);
      }
      const double q11 = stored("order_tensor", 2 * i);
      const double q12 = stored("order_tensor", 2 * i + 1);
      const std::vector<double>& tensor = arrays["order_tensor Tensor"].values;
      EXPECT_EQ(std::vector<double>(tensor.begin() + static_cast<std::ptrdiff_t>(9 * i),
                                    tensor.begin() + static_cast<std::ptrdiff_t>(9 * i + 9)),
                (std::vector<double>{q11, q12, 0, q12, -q11, 0, 0, 0, 0}));
      const double angle = 0.5 * std::atan2(q12, q11);
      const std::vector<double>& director = arrays["director Vector"].values;
      EXPECT_NEAR(director[3 * i], std::cos(angle), 1e-7);
      EXPECT_NEAR(director[3 * i + 1], std::sin(angle), 1e-7);
      EXPECT_EQ(director[3 * i + 2], 0.0);
      const std::vector<double>& gradient = arrays["velocity_gradient Tensor"].values;
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
          EXPECT_EQ(gradient[9 * i + 3 * row + column],
                    row < 2 && column < 2 ? stored("velocity_gradient", 4 * i + 2 * row + column) : 0.0);
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_EQ(arrays["order_tensor_gradient_" + std::to_string(c) + " Scalar"].values[i],
                  stored("order_tensor_gradient", 4 * i + c));
      EXPECT_EQ(arrays["pressure Scalar"].values[i], stored("pressure", i));
      EXPECT_EQ(arrays["id Scalar"].values[i], static_cast<double>(i));
    }
  }
}

TEST(Xdmf, ShowsEachFrameAsWholeDatasetsOfVectorsAndTensors) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  for (std::int64_t step = 0; step < 8; step += 2) writer.add_frame(frame_of_each_rank(step), step, time_at(step));
  writer.flush();
  expect_frames(folder.path(), 4);
  writer.finish();
  expect_frames(folder.path(), 4);
  ResultsWriter resumed = ResultsWriter::resume(options_in(folder.path()), 4);
  expect_frames(folder.path(), 3);
  resumed.add_frame(frame_of_each_rank(6), 6, time_at(6));
  resumed.finish();
  expect_frames(folder.path(), 4);
}

/// What only ParaView reads is virtual, but for the director and one number of the order tensor.
TEST(Xdmf, TakesLittleRoom) {
  const auto size = [](int frames) {
    constexpr Index many = 20000;
    const TemporaryFolder folder;
    ResultsOptions options = options_in(folder.path());
    options.count = many;
    ResultsWriter writer = ResultsWriter::create(options);
    for (int frame = 0; frame < frames; ++frame) {
      std::vector<FrameField> fields = frame_at(frame, many);
      fields.push_back(
          {"order_tensor", "1", 2, std::vector<double>(2 * many, 0.5), NumberType::float32, Rank::order_tensor});
      writer.add_frame(fields, frame, frame);
    }
    writer.finish();
    return static_cast<double>(fs::file_size(folder.path() / "results.h5")) / static_cast<double>(many);
  };
  const double fields = 8 + 16 + 8 + 8 + 8;  // velocity, position, image, pressure, order tensor
  const double shown = 8 + 4;                // director, Q22
  EXPECT_NEAR(size(3) - size(2), fields + shown, 1.0) << "bytes for each particle of a frame";
}

TEST(Xdmf, ShowsTheEdgesOfTheBoxAtEachTime) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 2);
  const std::vector<Tree> boxes = series(xdmf_of(folder.path()), "box");
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_EQ(std::stod(boxes[1].get<std::string>("Time.<xmlattr>.Value")), time_at(2));
  EXPECT_EQ(boxes[1].get<std::string>("Topology.<xmlattr>.TopologyType"), "Polyline");
  EXPECT_EQ(boxes[1].get<std::string>("Topology.<xmlattr>.NodesPerElement"), "2");
  EXPECT_EQ(boxes[1].get<std::string>("Topology.<xmlattr>.NumberOfElements"), "4");
  const auto lines = numbers_in(boxes[1].get<std::string>("Topology.DataItem"));
  const auto points = numbers_in(boxes[1].get<std::string>("Geometry.DataItem"));
  ASSERT_EQ(points.size(), 12U);
  std::set<std::set<std::vector<hsize_t>>> edges;
  const auto point = [&](hsize_t n) {
    return std::vector<hsize_t>(points.begin() + static_cast<std::ptrdiff_t>(3 * n),
                                points.begin() + static_cast<std::ptrdiff_t>(3 * n + 3));
  };
  for (std::size_t line = 0; line < lines.size(); line += 2) edges.insert({point(lines[line]), point(lines[line + 1])});
  EXPECT_EQ(edges,
            (std::set<std::set<std::vector<hsize_t>>>{
                {{0, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {0, 3, 0}}, {{2, 0, 0}, {2, 3, 0}}, {{0, 3, 0}, {2, 3, 0}}}));
}

TEST(Xdmf, EscapesNames) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  std::vector<FrameField> fields = frame_at(0);
  fields[0].name = "a<b & \"c\"";
  writer.add_frame(fields, 0, 0.0);
  writer.flush();
  Tree tree;
  boost::property_tree::read_xml((folder.path() / "results.xdmf").string(), tree);
  EXPECT_EQ(tree.get<std::string>("Xdmf.Domain.Grid.Grid.Attribute.<xmlattr>.Name"), "a<b & \"c\"");
}

}  // namespace
}  // namespace mesogen
