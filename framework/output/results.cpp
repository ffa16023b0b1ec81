#include "output/results.hpp"

#include <algorithm>
#include <chrono>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "output/frame_file.hpp"
#include "output/results_file.hpp"
#include "output/run_folder.hpp"
#include "output/write_file.hpp"
#include "output/xdmf.hpp"
#include "plugin/crash.hpp"

namespace mesogen {

namespace {

std::vector<output::FieldShape> shapes_of(const std::vector<FrameField>& fields) {
  std::vector<output::FieldShape> shapes;
  for (const FrameField& field : fields) shapes.push_back(output::shape_of(field));
  std::ranges::sort(shapes, {}, &output::FieldShape::name);
  if (std::ranges::find(shapes, "position", &output::FieldShape::name) == shapes.end())
    throw std::logic_error("a frame must hold the position");
  return shapes;
}

void check_rows(const std::vector<FrameField>& fields, Index count) {
  for (const FrameField& field : fields)
    if (field.components < 1 ||
        field.values.size() != static_cast<std::size_t>(count) * static_cast<std::size_t>(field.components))
      throw std::logic_error("a frame's field " + field.name + " must have one row a particle");
}

void write_views_of(const ResultsOptions& options, const output::ResultsContent& content) {
  std::vector<std::byte> bytes;
  try {
    const hdf5::Id memory = hdf5::create_in_memory();
    output::write_structure(memory, options, content, output::Layout::views);
    bytes = hdf5::image(memory);
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::run_failed, "cannot make results.h5: " + std::string(failure.what()));
  }
  output::write_file(options.folder / "results.h5", std::span<const std::byte>(bytes));
  output::write_file(options.folder / "results.xdmf", output::xdmf_text(options, content, output::Layout::views));
}

/// Its last frame, and then the views of all. What it works on is its own: meanwhile samples come in, and the writer of
/// results may move.
void write_last_frame(TakenFrame frame, const ResultsOptions options, const output::ResultsContent content) {
  tell_of_crashes_in_this_thread();
  frame.fill(frame.fields);
  check_rows(frame.fields, options.count);
  const std::string name = output::frame_name(content.frames.size() - 1);
  output::write_frame(options.folder / name, frame.fields, content.frames.back(), options.dimension);
  frame = {};  // its memory
  write_views_of(options, content);
}

void make_frame_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directory(folder / "frames", error);
  if (error) throw output::system_error(ExitCode::run_failed, "make the folder", folder / "frames", error.value());
  output::sync_folder(folder);
}

}  // namespace

ResultsWriter::ResultsWriter(Options options) : options_(std::move(options)) {}

ResultsWriter ResultsWriter::silent() { return ResultsWriter(Options{}); }

ResultsWriter ResultsWriter::create(Options options) { return resume(std::move(options), -1); }

ResultsWriter ResultsWriter::resume(Options options, std::int64_t last_step, const EndRecords& forgotten) {
  ResultsWriter writer(std::move(options));
  const std::filesystem::path& folder = writer.options_.folder;
  if (last_step >= 0) {
    output::StoredResults stored = output::read_results(writer.options_, "continue");
    const std::int64_t last_frame = forgotten.frame ? last_step - 1 : last_step;
    std::erase_if(stored.content.frames, [&](const output::FrameStamp& frame) { return frame.step > last_frame; });
    if (stored.content.frames.empty()) stored.content.fields.clear();
    stored.content.samples.drop_after(last_step);
    for (const std::string& observer : forgotten.observers) stored.content.samples.drop_after(last_step - 1, observer);
    writer.content_ = std::move(stored.content);
    if (stored.layout == output::Layout::packed) {
      output::remove_frames(folder, 0);
      make_frame_folder(folder);
      output::unpack(writer.options_, writer.content_);
    } else {
      make_frame_folder(folder);
      output::check_frames(writer.options_, writer.content_.frames);
    }
  } else {
    make_frame_folder(folder);
  }
  // Only when results.h5 no longer speaks of them are later frames removed.
  writer.write_views();
  output::remove_frames(folder, writer.content_.frames.size());
  make_frame_folder(folder);
  return writer;
}

void ResultsWriter::declare_observable(const std::string& observer, const Quantity& quantity) {
  content_.samples.declare(observer, quantity);
  changed_ = true;
}

void ResultsWriter::add_sample(const std::string& observer, const Sample& sample, std::int64_t step, double time) {
  if (content_.samples.add(observer, sample, step, time)) changed_ = true;
}

void ResultsWriter::add_frame(std::vector<FrameField> fields, std::int64_t step, double time) {
  add_frame({std::move(fields), [](std::vector<FrameField>&) {}}, step, time);
}

void ResultsWriter::add_frame(TakenFrame frame, std::int64_t step, double time) {
  wait();
  if (finished_) throw std::logic_error("the results are finished");
  if (step == last_frame_step()) return;
  if (step < last_frame_step()) throw std::logic_error("frames must come in the order of steps");
  std::vector<output::FieldShape> shapes = shapes_of(frame.fields);
  if (!content_.frames.empty() && shapes != content_.fields)
    throw Error(ExitCode::bad_case, "the frames already in " + options_.folder.string() +
                                        " hold other fields; keep output.fields as it was, or start a new run");
  output::ResultsContent with_frame = content_;
  with_frame.fields = shapes;
  with_frame.frames.push_back({step, time});
  writing_ = std::async(std::launch::async, write_last_frame, std::move(frame), options_, std::move(with_frame));
  content_.fields = std::move(shapes);
  content_.frames.push_back({step, time});
  changed_ = false;
}

void ResultsWriter::wait() {
  if (!writing_.valid()) return;
  try {
    writing_.get();
  } catch (...) {
    content_.frames.pop_back();
    if (content_.frames.empty()) content_.fields.clear();
    changed_ = true;
    throw;
  }
}

void ResultsWriter::check() {
  if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) wait();
}

void ResultsWriter::flush() {
  wait();
  if (changed_ && !finished_ && writes()) write_views();
}

void ResultsWriter::write_views() {
  write_views_of(options_, content_);
  changed_ = false;
}

void ResultsWriter::finish(std::optional<RunCost> cost) {
  wait();
  if (finished_ || !writes()) return;
  content_.cost = cost;
  output::pack(options_, content_);
  output::write_file(options_.folder / "results.xdmf", output::xdmf_text(options_, content_, output::Layout::packed));
  finished_ = true;
  output::remove_frames(options_.folder, 0);
}

std::int64_t ResultsWriter::last_sample_step(const std::string& observer) const {
  const auto found = content_.samples.observers().find(observer);
  return found == content_.samples.observers().end() || found->second.steps.empty() ? -1 : found->second.steps.back();
}

}  // namespace mesogen
