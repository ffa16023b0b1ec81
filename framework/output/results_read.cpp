#include "mesogen/diagnostics/error.hpp"
#include "output/attributes.hpp"
#include "output/frame_file.hpp"
#include "output/results.hpp"
#include "output/results_file.hpp"

namespace mesogen::output {

namespace {

using hdf5::Id;

std::vector<FrameStamp> stamps(const Id& element) {
  const auto steps = hdf5::read<std::int64_t>(hdf5::open_dataset(element, "step"), "step");
  const auto times = hdf5::read<double>(element, "time", steps.size());
  std::vector<FrameStamp> result;
  for (std::size_t i = 0; i < steps.size(); ++i) result.push_back({steps[i], times[i]});
  return result;
}

void read_fields(const Id& fluid, const ResultsOptions& options, StoredResults& stored) {
  for (const std::string& name : hdf5::names(fluid)) {
    if (name == "box" || name == "id") continue;
    const Id element = hdf5::open_group(fluid, name);
    const Id value = hdf5::open_dataset(element, "value");
    FieldShape field{name, read_unit(value), 1, NumberType::float64, read_rank(value)};
    const hdf5::Dimensions sizes = hdf5::dimensions_of(value);
    if (sizes.size() == 3) field.components = static_cast<int>(sizes[2]);
    const Id type(H5Dget_type(value.get()), H5Tclose, "read " + name);
    if (H5Tget_class(type.get()) == H5T_INTEGER)
      field.type = NumberType::int32;
    else if (H5Tget_size(type.get()) == sizeof(float))
      field.type = NumberType::float32;
    if (stored.content.fields.empty()) stored.content.frames = stamps(element);
    if (sizes != value_dimensions(field, stored.content.frames.size(), static_cast<std::size_t>(options.count)))
      throw hdf5::Failure("particles/fluid/" + name + " has another shape than this run's");
    const Id list(H5Dget_create_plist(value.get()), H5Pclose, "read " + name);
    stored.layout = H5Pget_layout(list.get()) == H5D_VIRTUAL ? Layout::views : Layout::packed;
    stored.content.fields.push_back(field);
  }
}

QuantitySeries read_quantity(const Id& element, const std::string& name, std::size_t samples) {
  QuantitySeries series;
  const Id value = hdf5::open_dataset(element, "value");
  const hdf5::Dimensions sizes = hdf5::dimensions_of(value);
  if ((sizes.size() != 1 && sizes.size() != 3) || sizes.front() != samples)
    throw hdf5::Failure(name + " does not fit its times");
  series.quantity.name = name;
  series.quantity.unit(read_unit(value));
  series.quantity.doc(hdf5::read_text_attribute(value, "description"));
  series.quantity.columns = sizes.size() == 3 ? sizes[2] : 0;
  series.quantity.varying = hdf5::has(element, "count");
  const std::size_t most = sizes.size() == 3 ? sizes[1] : 1;
  series.rows.assign(samples, most);
  if (series.quantity.varying) {
    const auto count = hdf5::read<std::int64_t>(element, "count", samples);
    series.rows.assign(count.begin(), count.end());
  }
  const auto padded = hdf5::read<double>(value, name);
  for (std::size_t sample = 0; sample < samples; ++sample) {
    if (series.rows[sample] > most) throw hdf5::Failure(name + " counts more rows than it has");
    const auto from = padded.begin() + static_cast<std::ptrdiff_t>(sample * most * series.columns());
    series.values.insert(series.values.end(), from,
                         from + static_cast<std::ptrdiff_t>(series.rows[sample] * series.columns()));
  }
  return series;
}

void read_samples(const Id& observables, SampleStore& samples) {
  for (const std::string& name : hdf5::names(observables)) {
    const Id observer = hdf5::open_group(observables, name);
    ObserverSeries series;
    for (const std::string& quantity : hdf5::names(observer)) {
      const Id element = hdf5::open_group(observer, quantity);
      series.steps = hdf5::read<std::int64_t>(hdf5::open_dataset(element, "step"), "step");
      series.times = hdf5::read<double>(element, "time", series.steps.size());
      series.quantities[quantity] = read_quantity(element, quantity, series.steps.size());
    }
    samples.restore(name, std::move(series));
  }
}

}  // namespace

StoredResults read_results(const ResultsOptions& options, const std::string& purpose) {
  const std::filesystem::path path = options.folder / "results.h5";
  try {
    const Id file = hdf5::open_file(path);
    StoredResults stored;
    read_fields(hdf5::open_group(file, "particles/fluid"), options, stored);
    read_samples(hdf5::open_group(file, "observables"), stored.content.samples);
    return stored;
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::bad_case, "cannot " + purpose + " " + path.string() + ": " + failure.what());
  }
}

void check_frames(const ResultsOptions& options, const std::vector<FrameStamp>& frames) {
  for (std::size_t number = 0; number < frames.size(); ++number) {
    const std::filesystem::path path = options.folder / frame_name(number);
    try {
      if (read_stamp(hdf5::open_file(path)) != frames[number]) throw hdf5::Failure("it is of another step");
    } catch (const hdf5::Failure& failure) {
      throw Error(ExitCode::bad_case, "cannot continue with the frame " + path.string() + ": " + failure.what());
    }
  }
}

}  // namespace mesogen::output

namespace mesogen {

bool ResultsWriter::are_finished(const std::filesystem::path& folder) {
  try {
    const hdf5::Id file = hdf5::open_file(folder / "results.h5");
    return hdf5::has(hdf5::open_group(file, "parameters"), "cost");
  } catch (const hdf5::Failure&) {
    return false;
  }
}

}  // namespace mesogen
