#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "output/frame.hpp"
#include "output/hdf5.hpp"

/// What ParaView sees of a frame: a group of HDF5 with one dataset for each of its arrays.
///
/// The readers XDMF 2 and Xdmf3 both take whole datasets and nothing else: Xdmf3 crashes on a hyperslab and leaves out
/// what a function computes (tried with ParaView 5.11). A vector of ParaView has 3 components and a tensor 9, whatever
/// the dimension. So these datasets have that shape. Most are virtual, views of the stored values that take no room;
/// only what is not stored elsewhere is computed and written: the director, and the last component of the diagonal of
/// an order tensor.
namespace mesogen::output {

/// One array as ParaView has it.
struct ShownField {
  /// Neighbouring components: the values are columns `from`, `from` + 1, ... of a dataset.
  struct Columns {
    int to = 0;
    int from = 0;
    int width = 1;
    bool computed = false;  ///< of the dataset that is written for it, not of the stored field
  };

  std::string name;
  int components = 1;  ///< 1, 3 or 9, row by row
  NumberType type = NumberType::float64;
  FieldShape source;
  std::vector<Columns> columns;  ///< all other components are 0
};

/// In the order of the fields; in two dimensions the director behind the order tensor. A field of unknown rank is shown
/// as a scalar for each component.
std::vector<ShownField> shown_fields(const std::vector<FieldShape>& fields, int dimension);

/// Where the values of a frame lie in the same file.
struct FramePlace {
  std::function<std::string(const FieldShape&)> dataset;  ///< its path from the root
  std::size_t frames = 0;                                 ///< the dataset's first axis; 0: it has none
  std::size_t frame = 0;                                  ///< which of them
};

/// Makes the datasets in a group of `file`, named by its path from the root. `values` gives those of an order tensor as
/// they are stored, row by row.
void write_shown(const hdf5::Id& file, const std::string& group, const std::vector<ShownField>& shown,
                 std::size_t particles, int dimension, const FramePlace& place,
                 const std::function<std::vector<double>(const FieldShape&)>& values);

}  // namespace mesogen::output
