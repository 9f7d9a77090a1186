#include "io/files/history_file.hpp"

#include <fmt/format.h>

#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace tread {

namespace {

/// Rows per chunk of a dataset: 8 KiB.
constexpr std::uint64_t kChunk = 1024;

std::string dataset(const Channel& channel) {
  return "/histories/" + channel.name;
}

std::vector<Channel> checked(std::vector<Channel> channels) {
  if (channels.empty()) throw std::logic_error("histories without a channel");
  std::set<std::string> names;
  for (const Channel& channel : channels)
    if (channel.name.empty() || channel.name.find_first_of("/,\"\n") != std::string::npos ||
        !names.insert(channel.name).second)
      throw std::logic_error("history channel '" + channel.name + "' is empty, repeated or holds / , \"");
  return channels;
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& directory, std::vector<Channel> channels,
                         const Hdf5Attributes& attributes)
    : channels_(checked(std::move(channels))),
      hdf5_(Hdf5File::create(directory / "run.h5")),
      csv_(directory / "histories.csv") {
  hdf5_.set_attributes("/", attributes);
  std::string header;
  for (const Channel& channel : channels_) {
    hdf5_.make_extendible<double>(dataset(channel), kChunk);
    hdf5_.write_attribute(dataset(channel), "unit", channel.unit);
    hdf5_.write_attribute(dataset(channel), "description", channel.description);
    header += fmt::format("{}{} [{}]", header.empty() ? "" : ",", channel.name, channel.unit);
  }
  hdf5_.flush();
  csv_.append(header + '\n');
}

HistoryFile::~HistoryFile() {
  try {
    close();
  } catch (...) {  // a destructor cannot report errors
  }
}

void HistoryFile::append(std::span<const double> row) {
  if (!open_ || row.size() != channels_.size())
    throw std::logic_error("a history row needs an open file and one value per channel");
  block_.insert(block_.end(), row.begin(), row.end());
  if (block_.size() >= kBlock * channels_.size()) flush();
}

void HistoryFile::flush() {
  if (!open_ || block_.empty()) return;
  try {
    write_csv();
    write_hdf5();
  } catch (const ResourceError& error) {
    open_ = false;
    throw ResourceError(error.what() + kept());
  }
  block_.clear();
}

void HistoryFile::close() {
  flush();
  if (!std::exchange(open_, false)) return;
  try {
    hdf5_.close();
    csv_.close();
  } catch (const ResourceError& error) {
    throw ResourceError(error.what() + kept());
  }
}

void HistoryFile::write_csv() {
  const std::size_t columns = channels_.size();
  fmt::memory_buffer lines;
  for (std::size_t i = 0; i < block_.size(); ++i)
    fmt::format_to(std::back_inserter(lines), "{:.9g}{}", block_[i], (i + 1) % columns == 0 ? '\n' : ',');
  csv_.append({lines.data(), lines.size()});
  rows_written_ += static_cast<std::int64_t>(block_.size() / columns);
  last_abscissa_ = block_[block_.size() - columns];
}

void HistoryFile::write_hdf5() {
  const std::size_t columns = channels_.size();
  std::vector<double> column(block_.size() / columns);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t row = 0; row < column.size(); ++row) column[row] = block_[row * columns + c];
    hdf5_.append<double>(dataset(channels_[c]), column);
  }
  hdf5_.flush();
}

std::string HistoryFile::kept() const {
  const std::string rows = rows_written_ == 0
                               ? "no row is"
                               : fmt::format("{} rows, up to {} = {:.9g} {}, are", rows_written_,
                                             channels_[0].name, last_abscissa_, channels_[0].unit);
  return fmt::format("; {} kept in {}. Free space there or choose another folder.", rows,
                     csv_.path().string());
}

}  // namespace tread
