#include "output/samples_file.hpp"

#include "mesogen/diagnostics/error.hpp"
#include "output/results_file.hpp"
#include "output/write_file.hpp"

namespace mesogen {

void write_samples(const std::filesystem::path& file, const ResultsOptions& options,
                   const output::SampleStore& samples) {
  std::vector<std::byte> bytes;
  try {
    const hdf5::Id memory = hdf5::create_in_memory();
    output::write_structure(memory, options, {{}, {}, samples, {}}, output::Layout::packed);
    bytes = hdf5::image(memory);
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::run_failed, "cannot make " + file.string() + ": " + failure.what());
  }
  output::write_file(file, bytes, output::Owner::user);
}

}  // namespace mesogen
