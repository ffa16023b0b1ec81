#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
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

/// The dataset that a DataItem names is in results.h5, has these sizes and this precision.
void expect_dataset(const Reader& reader, const Tree& item) {
  const std::string prefix = "results.h5:";
  const std::string& text = item.data();
  ASSERT_EQ(text.rfind(prefix, 0), 0U) << text;
  const Array array = reader.array(text.substr(prefix.size()));
  EXPECT_EQ(numbers_in(item.get<std::string>("<xmlattr>.Dimensions")), array.sizes) << text;
  EXPECT_EQ(item.get<std::string>("<xmlattr>.Precision"), std::to_string(array.bytes_each)) << text;
  EXPECT_EQ(item.get<std::string>("<xmlattr>.NumberType"), array.is_integer ? "Int" : "Float") << text;
  EXPECT_EQ(item.get<std::string>("<xmlattr>.Format"), "HDF");
}

void expect_slab(const Reader& reader, const Tree& item, std::size_t frame) {
  EXPECT_EQ(item.get<std::string>("<xmlattr>.ItemType"), "HyperSlab");
  const Tree& selection = std::next(item.begin())->second;  // behind the attributes
  const Tree& dataset = std::next(item.begin(), 2)->second;
  expect_dataset(reader, dataset);
  std::vector<hsize_t> sizes = numbers_in(dataset.get<std::string>("<xmlattr>.Dimensions"));
  std::vector<hsize_t> expected(sizes.size(), 0);  // start, stride, count
  expected[0] = frame;
  expected.insert(expected.end(), sizes.size(), 1);
  expected.push_back(1);
  expected.insert(expected.end(), sizes.begin() + 1, sizes.end());
  EXPECT_EQ(numbers_in(selection.data()), expected);
  EXPECT_EQ(numbers_in(selection.get<std::string>("<xmlattr>.Dimensions")), (std::vector<hsize_t>{3, sizes.size()}));
  EXPECT_EQ(numbers_in(item.get<std::string>("<xmlattr>.Dimensions")),
            std::vector<hsize_t>(sizes.begin() + 1, sizes.end()));
}

void expect_frames(const fs::path& folder, std::size_t frames) {
  const Reader reader(folder / "results.h5");
  Tree tree;
  boost::property_tree::read_xml((folder / "results.xdmf").string(), tree,
                                 boost::property_tree::xml_parser::trim_whitespace);
  const Tree& run = tree.get_child("Xdmf.Domain.Grid");
  EXPECT_EQ(run.get<std::string>("<xmlattr>.GridType"), "Collection");
  EXPECT_EQ(run.get<std::string>("<xmlattr>.CollectionType"), "Temporal");
  ASSERT_EQ(run.count("Grid"), frames);
  std::size_t frame = 0;
  for (const auto& [name, grid] : run) {
    if (name != "Grid") continue;
    EXPECT_EQ(std::stod(grid.get<std::string>("Time.<xmlattr>.Value")), time_at(static_cast<std::int64_t>(2 * frame)));
    EXPECT_EQ(grid.get<std::string>("Topology.<xmlattr>.TopologyType"), "Polyvertex");
    EXPECT_EQ(grid.get<std::string>("Topology.<xmlattr>.NumberOfElements"), std::to_string(particles));
    EXPECT_EQ(grid.get<std::string>("Geometry.<xmlattr>.GeometryType"), "XY");
    expect_slab(reader, grid.get_child("Geometry.DataItem"), frame);
    std::vector<std::string> attributes;
    for (const auto& [kind, attribute] : grid) {
      if (kind != "Attribute") continue;
      attributes.push_back(attribute.get<std::string>("<xmlattr>.Name") + " " +
                           attribute.get<std::string>("<xmlattr>.AttributeType"));
      if (attributes.back() == "id Scalar")
        expect_dataset(reader, attribute.get_child("DataItem"));
      else
        expect_slab(reader, attribute.get_child("DataItem"), frame);
    }
    EXPECT_EQ(attributes,
              (std::vector<std::string>{"image Vector", "pressure Scalar", "velocity Vector", "id Scalar"}));
    ++frame;
  }
}

TEST(Xdmf, ShowsEachFrameOfResults) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 6);
  expect_frames(folder.path(), 4);
  writer.finish();
  expect_frames(folder.path(), 4);
}

TEST(Xdmf, EscapesNames) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  std::vector<FrameField> fields = frame_at(0);
  fields[0].name = "a<b & \"c\"";
  writer.add_frame(fields, 0, 0.0);
  Tree tree;
  boost::property_tree::read_xml((folder.path() / "results.xdmf").string(), tree);
  EXPECT_EQ(tree.get<std::string>("Xdmf.Domain.Grid.Grid.Attribute.<xmlattr>.Name"), "a<b & \"c\"");
}

}  // namespace
}  // namespace mesogen
