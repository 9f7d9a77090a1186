#include "drivers/results/growing_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "drivers/results/root_attributes.hpp"
#include "io/files/output_file.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

std::vector<Channel> channels_of(const Model& model, const MeasuredRows& measured) {
  std::vector<Channel> channels = history_channels(model);
  for (const MeasuredChannel& column : measured.channels()) channels.push_back(column.channel);
  return channels;
}

}  // namespace

GrowingFiles::GrowingFiles(const Model& model, const std::filesystem::path& directory,
                           const RunResults& results)
    : model_(&model),
      directory_(directory),
      channels_(channels_of(model, results.measured)),
      histories_(directory, channels_, root_attributes(model.scene)) {
  if (model.contact)
    patch_.emplace(directory / kPatchFile, model.contact->nodes(), root_attributes(model.scene));
  identify();
}

GrowingFiles::GrowingFiles(const Model& model, const std::filesystem::path& directory,
                           const RunResults& results, const std::string& patch)
    : model_(&model),
      directory_(directory),
      channels_(channels_of(model, results.measured)),
      histories_(directory, channels_, root_attributes(model.scene)) {
  for (std::size_t i = 0; i < results.samples.size(); ++i)
    histories_.append(row_of(results.samples[i], results.measured.row(i)));
  if (model.contact) {
    write_text_file(directory / kPatchFile, patch);
    patch_.emplace(directory / kPatchFile, model.contact->nodes(), root_attributes(model.scene),
                   results.samples.size());
  }
  identify();
}

void GrowingFiles::identify() {
  for (const char* name : {"run.h5", "histories.csv"}) identities_.emplace_back(directory_ / name);
  if (patch_) identities_.emplace_back(directory_ / kPatchFile);
}

bool GrowingFiles::in_place() const {
  return std::ranges::all_of(identities_, [](const FileIdentity& file) { return file.in_place(); });
}

std::vector<double> GrowingFiles::row_of(const Sample& sample, std::span<const double> measured) const {
  std::vector<double> row = history_row(*model_, sample);
  for (std::size_t i = 0; i < row.size(); ++i)
    if (!std::isfinite(row[i]))
      throw NumericalError(
          fmt::format("'{}' is not a finite number at t = {:.6e} s", channels_[i].name, row[0]));
  row.insert(row.end(), measured.begin(), measured.end());
  return row;
}

void GrowingFiles::append(const Sample& sample, std::span<const double> measured) {
  histories_.append(row_of(sample, measured));
  if (patch_) patch_->append(sample.time, sample.wheel_x, model_->contact->nodes());
}

std::string GrowingFiles::patch_bytes() {
  if (!patch_) return "";
  patch_->flush();
  try {
    return read_bytes(directory_ / kPatchFile, std::numeric_limits<std::size_t>::max());
  } catch (const InputError& error) {  // a file of this run
    throw ResourceError(fmt::format("{}; a run needs its folder as long as it rolls", error.what()));
  }
}

void GrowingFiles::close() {
  histories_.close();
  if (patch_) patch_->close();
  for (const FileIdentity& file : identities_) force_to_disk(file.path());
}

}  // namespace tread
