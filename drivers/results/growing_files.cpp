#include "drivers/results/growing_files.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "drivers/results/root_attributes.hpp"
#include "io/files/output_file.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

const std::vector<double>& checked(const std::vector<double>& row, const std::vector<Channel>& channels) {
  for (std::size_t i = 0; i < row.size(); ++i)
    if (!std::isfinite(row[i]))
      throw NumericalError(
          fmt::format("'{}' is not a finite number at t = {:.6e} s", channels[i].name, row[0]));
  return row;
}

}  // namespace

GrowingFiles::GrowingFiles(const Model& model, const std::filesystem::path& directory)
    : model_(&model),
      directory_(directory),
      channels_(history_channels(model)),
      histories_(directory, channels_, root_attributes(model.scene)) {
  if (model.contact)
    patch_.emplace(directory / kPatchFile, model.contact->nodes(), root_attributes(model.scene));
}

GrowingFiles::GrowingFiles(const Model& model, const std::filesystem::path& directory,
                           const std::vector<Sample>& samples, const std::string& patch)
    : model_(&model),
      directory_(directory),
      channels_(history_channels(model)),
      histories_(directory, channels_, root_attributes(model.scene)) {
  for (const Sample& sample : samples) histories_.append(history_row(model, sample));
  if (!model.contact) return;
  write_text_file(directory / kPatchFile, patch);
  patch_.emplace(directory / kPatchFile, model.contact->nodes(), root_attributes(model.scene),
                 samples.size());
}

void GrowingFiles::append(const Sample& sample) {
  histories_.append(checked(history_row(*model_, sample), channels_));
  if (patch_) patch_->append(sample.time, sample.wheel_x, model_->contact->nodes());
}

std::string GrowingFiles::patch_bytes() {
  if (!patch_) return "";
  patch_->flush();
  return read_bytes(directory_ / kPatchFile, std::numeric_limits<std::size_t>::max());
}

void GrowingFiles::close() {
  histories_.close();
  if (patch_) patch_->close();
}

}  // namespace tread
