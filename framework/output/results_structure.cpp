#include <pwd.h>
#include <unistd.h>

#include <limits>

#include "output/attributes.hpp"
#include "output/frame_file.hpp"
#include "output/results_file.hpp"
#include "output/run_record_file.hpp"

namespace mesogen::output {

namespace {

using hdf5::Id;

/// H5MD asks for somebody's real name: where the system does not know it, that of the account.
std::string author() {
  const passwd* const user = ::getpwuid(::geteuid());
  if (user == nullptr || user->pw_name == nullptr) return "unknown";
  const std::string full = user->pw_gecos == nullptr ? "" : user->pw_gecos;
  const std::string real_name = full.substr(0, full.find(','));  // behind it: office, telephone
  return real_name.empty() ? user->pw_name : real_name;
}

void write_header(const Id& file, const ResultsOptions& options, const std::optional<RunCost>& cost) {
  const Id h5md = hdf5::create_group(file, "h5md");
  hdf5::write_attribute(h5md, "version", std::vector<std::int64_t>{1, 1});
  hdf5::write_attribute(hdf5::create_group(h5md, "author"), "name", author());
  const Id creator = hdf5::create_group(h5md, "creator");
  hdf5::write_attribute(creator, "name", std::string("Mesogen"));
  hdf5::write_attribute(creator, "version", options.version);
  const Id units = hdf5::create_group(hdf5::create_group(h5md, "modules"), "units");
  hdf5::write_attribute(units, "version", std::vector<std::int64_t>{1, 0});
  hdf5::write_attribute(units, "system", std::string("SI"));

  const Id parameters = hdf5::create_group(file, "parameters");
  hdf5::write_text(parameters, "case", options.case_text);
  hdf5::write_text(parameters, "version", options.version);
  hdf5::write_text(parameters, "build", options.build);
  hdf5::write(parameters, "seed", {}, std::vector<std::int64_t>{options.seed});
  if (options.origin) write_origin(parameters, *options.origin);
  if (cost) write_cost(parameters, *cost);
}

void write_box(const Id& fluid, const ResultsOptions& options) {
  const Id box = hdf5::create_group(fluid, "box");
  hdf5::write_attribute(box, "dimension", static_cast<std::int64_t>(options.dimension));
  std::vector<std::string> boundary;
  std::vector<double> edges;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(options.dimension); ++axis) {
    boundary.emplace_back(options.periodic.at(axis) ? "periodic" : "none");
    edges.push_back(options.box.at(axis));
  }
  hdf5::write_attribute(box, "boundary", boundary);
  write_unit(hdf5::write(box, "edges", {edges.size()}, edges), options.length_unit);
}

/// The datasets `step` and `time` of an H5MD element.
void write_times(const Id& element, const std::vector<std::int64_t>& steps, const std::vector<double>& times,
                 const std::string& unit) {
  hdf5::write(element, "step", {steps.size()}, steps);
  write_unit(hdf5::write(element, "time", {times.size()}, times), unit);
}

/// H5MD lets elements share one `step` and one `time` by hard links.
void link_times(const Id& first, const Id& element) {
  for (const char* name : {"step", "time"})
    hdf5::check(H5Lcreate_hard(first.get(), name, element.get(), name, H5P_DEFAULT, H5P_DEFAULT), "link the times");
}

void write_observer(const Id& observables, const std::string& name, const ObserverSeries& series,
                    const std::string& time_unit) {
  const Id observer = hdf5::create_group(observables, name);
  const Id* first = nullptr;
  std::vector<Id> elements;
  elements.reserve(series.quantities.size());
  for (const auto& [quantity_name, quantity] : series.quantities) {
    const Id& element = elements.emplace_back(hdf5::create_group(observer, quantity_name));
    if (first == nullptr)
      write_times(element, series.steps, series.times, time_unit);
    else
      link_times(*first, element);
    if (first == nullptr) first = &element;

    hdf5::Dimensions sizes{series.steps.size()};
    if (quantity.quantity.columns > 0) {
      sizes.push_back(quantity.most_rows());
      sizes.push_back(quantity.columns());
    }
    const Id value = hdf5::write(element, "value", sizes, quantity.padded());
    write_unit(value, quantity.quantity.unit_text);
    hdf5::write_attribute(value, "description", quantity.quantity.doc_text);
    if (quantity.quantity.varying)
      hdf5::write(element, "count", {quantity.rows.size()},
                  std::vector<std::int64_t>(quantity.rows.begin(), quantity.rows.end()));
  }
}

/// A dataset whose frames are those of other files, named relative to results.h5.
Id create_view(const Id& element, const FieldShape& field, const hdf5::Dimensions& sizes) {
  const Id list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up a view");
  hdf5::check(H5Pset_obj_track_times(list.get(), false), "set up a view");
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  if (field.type != NumberType::int32)
    hdf5::check(H5Pset_fill_value(list.get(), H5T_NATIVE_DOUBLE, &missing), "set up a view");
  const Id source = hdf5::dataspace({sizes.begin() + 1, sizes.end()});
  for (std::size_t frame = 0; frame < sizes.front(); ++frame)
    hdf5::check(H5Pset_virtual(list.get(), hdf5::slice(sizes, frame).get(), frame_name(frame).c_str(),
                               field.name.c_str(), source.get()),
                "set up a view");
  return {H5Dcreate2(element.get(), "value", stored_type_of(field), hdf5::dataspace(sizes).get(), H5P_DEFAULT,
                     list.get(), H5P_DEFAULT),
          H5Dclose, "make a view"};
}

void write_fields(const Id& fluid, const ResultsOptions& options, const ResultsContent& content, Layout layout) {
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  for (const FrameStamp& frame : content.frames) {
    steps.push_back(frame.step);
    times.push_back(frame.time);
  }
  std::vector<Id> elements;
  elements.reserve(content.fields.size());
  for (const FieldShape& field : content.fields) {
    const Id& element = elements.emplace_back(hdf5::create_group(fluid, field.name));
    if (elements.size() == 1)
      write_times(element, steps, times, options.time_unit);
    else
      link_times(elements.front(), element);
    const hdf5::Dimensions sizes =
        value_dimensions(field, content.frames.size(), static_cast<std::size_t>(options.count));
    const Id value = layout == Layout::views ? create_view(element, field, sizes)
                                             : hdf5::create_dataset(element, "value", stored_type_of(field), sizes);
    write_unit(value, field.unit);
    write_rank(value, field.rank);
  }
}

}  // namespace

std::string value_name(const FieldShape& field) { return "particles/fluid/" + field.name + "/value"; }

hdf5::Dimensions value_dimensions(const FieldShape& field, std::size_t frames, std::size_t particles) {
  hdf5::Dimensions sizes{frames};
  for (const std::uint64_t size : frame_dimensions(field, particles)) sizes.push_back(size);
  return sizes;
}

void write_structure(const hdf5::Id& file, const ResultsOptions& options, const ResultsContent& content,
                     Layout layout) {
  write_header(file, options, content.cost);
  const Id fluid = hdf5::create_group(hdf5::create_group(file, "particles"), "fluid");
  write_box(fluid, options);
  std::vector<std::int64_t> id(static_cast<std::size_t>(options.count));
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<std::int64_t>(i);
  hdf5::write(fluid, "id", {id.size()}, id);
  write_fields(fluid, options, content, layout);
  const Id observables = hdf5::create_group(file, "observables");
  for (const auto& [name, series] : content.samples.observers())
    write_observer(observables, name, series, options.time_unit);
}

}  // namespace mesogen::output
