#include "output/shown_fields.hpp"

#include <algorithm>
#include <cmath>

#include "output/frame_file.hpp"

namespace mesogen::output {

namespace {

using hdf5::Id;
using Columns = ShownField::Columns;

constexpr int vector_size = 3;
constexpr int tensor_size = 9;

/// Of one row of a tensor, the first `width` columns.
Columns row_of_tensor(int row, int from, int width) { return {vector_size * row, from, width}; }

/// All components of an order tensor, those that are neighbours here and there together.
std::vector<Columns> order_tensor(int dimension) {
  std::vector<Columns> all;
  for (int row = 0; row < dimension; ++row)
    for (int column = 0; column < dimension; ++column) {
      const int to = vector_size * row + column;
      const int from = order_tensor_place(row, column, dimension);
      if (from < 0) {
        all.push_back({to, 0, 1, true});
      } else if (column > 0 && from == all.back().from + all.back().width) {
        ++all.back().width;
      } else {
        all.push_back({to, from, 1});
      }
    }
  return all;
}

std::vector<ShownField> shown(const FieldShape& field, int dimension) {
  const auto as = [&](int components, std::vector<Columns> columns) {
    return std::vector<ShownField>{{field.name, components, field.type, field, std::move(columns)}};
  };
  if (field.components == 1) return as(1, {{0, 0, 1}});
  if (field.rank == Rank::vector && field.components == dimension) return as(vector_size, {{0, 0, dimension}});
  if (field.rank == Rank::matrix && field.components == dimension * dimension) {
    std::vector<Columns> rows;
    rows.reserve(static_cast<std::size_t>(dimension));
    for (int row = 0; row < dimension; ++row) rows.push_back(row_of_tensor(row, row * dimension, dimension));
    return as(tensor_size, std::move(rows));
  }
  if (field.rank == Rank::order_tensor && field.components == component_count(Rank::order_tensor, dimension))
    return as(tensor_size, order_tensor(dimension));
  std::vector<ShownField> all;
  all.reserve(static_cast<std::size_t>(field.components));
  for (int c = 0; c < field.components; ++c)
    all.push_back({field.name + "_" + std::to_string(c), 1, field.type, field, {{0, c, 1}}});
  return all;
}

/// The director (cos theta, sin theta) of Q = q (cos 2 theta, sin 2 theta); 0 where there is no order. By half angles,
/// so that every machine makes the same numbers.
std::vector<double> directors(const std::vector<double>& order_tensor) {
  std::vector<double> result(order_tensor.size());
  for (std::size_t i = 0; i + 1 < order_tensor.size(); i += 2) {
    const double q11 = order_tensor[i];
    const double q12 = order_tensor[i + 1];
    const double order = std::sqrt(q11 * q11 + q12 * q12);
    if (!(order > 0.0)) continue;
    const double cosine = std::clamp(q11 / order, -1.0, 1.0);
    result[i] = std::sqrt(0.5 * (1.0 + cosine));
    result[i + 1] = std::copysign(std::sqrt(0.5 * (1.0 - cosine)), q12);
  }
  return result;
}

/// The last component of the diagonal, minus the sum of the others, of each particle.
std::vector<double> last_diagonal(const std::vector<double>& order_tensor, int dimension) {
  const auto stored = static_cast<std::size_t>(component_count(Rank::order_tensor, dimension));
  std::vector<double> result(order_tensor.size() / stored);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (int d = 0; d < dimension - 1; ++d)
      result[i] -= order_tensor[stored * i + static_cast<std::size_t>(order_tensor_place(d, d, dimension))];
  return result;
}

/// The columns [first, first + width) of all rows of one frame; the whole of it where rows are single numbers.
Id columns_of(const hdf5::Dimensions& sizes, bool frames, std::size_t frame, int first, int width) {
  Id space = hdf5::dataspace(sizes);
  hdf5::Dimensions start(sizes.size(), 0);
  hdf5::Dimensions count = sizes;
  if (frames) {
    start.front() = frame;
    count.front() = 1;
  }
  if (sizes.size() == (frames ? 3U : 2U)) {
    start.back() = static_cast<hsize_t>(first);
    count.back() = static_cast<hsize_t>(width);
  }
  hdf5::check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
              "select components");
  return space;
}

/// A group that a path names from the root; those on the way are made.
void make_groups(const Id& file, const std::string& path) {
  for (std::size_t end = 0; end != std::string::npos;) {
    end = path.find('/', end + 1);
    const std::string name = path.substr(0, end);
    if (!hdf5::has(file, name)) hdf5::create_group(file, name);
  }
}

hdf5::Dimensions sizes_of(std::size_t particles, int components) {
  if (components == 1) return {particles};
  return {particles, static_cast<hsize_t>(components)};
}

}  // namespace

std::vector<ShownField> shown_fields(const std::vector<FieldShape>& fields, int dimension) {
  std::vector<ShownField> all;
  for (const FieldShape& field : fields) {
    for (ShownField& one : shown(field, dimension)) all.push_back(std::move(one));
    if (has_director(field) && std::ranges::find(all, "director", &ShownField::name) == all.end())
      all.push_back({"director", vector_size, NumberType::float32, field, {{0, 0, 2, true}}});
  }
  return all;
}

void write_shown(const Id& file, const std::string& group, const std::vector<ShownField>& shown, std::size_t particles,
                 int dimension, const FramePlace& place,
                 const std::function<std::vector<double>(const FieldShape&)>& values) {
  const std::string computed = group + "/computed";
  make_groups(file, computed);
  for (const ShownField& field : shown) {
    const FieldShape shape{field.name, "1", field.components, field.type};
    const std::string name = computed + "/" + field.name;
    const bool director = field.components == vector_size;
    const int computed_components = director ? 2 : 1;
    if (std::ranges::any_of(field.columns, &Columns::computed)) {
      const std::vector<double> stored = values(field.source);
      hdf5::write(file, name, sizes_of(particles, computed_components),
                  director ? directors(stored) : last_diagonal(stored, dimension), stored_type_of(shape));
    }

    const Id list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up a view");
    hdf5::check(H5Pset_obj_track_times(list.get(), false), "set up a view");
    const hdf5::Dimensions sizes = sizes_of(particles, field.components);
    for (const Columns& columns : field.columns) {
      hdf5::Dimensions from = sizes_of(particles, columns.computed ? computed_components : field.source.components);
      const bool frames = !columns.computed && place.frames > 0;
      if (frames) from.insert(from.begin(), place.frames);
      hdf5::check(H5Pset_virtual(list.get(), columns_of(sizes, false, 0, columns.to, columns.width).get(), ".",
                                 ("/" + (columns.computed ? name : place.dataset(field.source))).c_str(),
                                 columns_of(from, frames, place.frame, columns.from, columns.width).get()),
                  "set up a view");
    }
    const Id view(H5Dcreate2(file.get(), (group + "/" + field.name).c_str(), stored_type_of(shape),
                             hdf5::dataspace(sizes).get(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
                  H5Dclose, "make a view");
  }
}

}  // namespace mesogen::output
