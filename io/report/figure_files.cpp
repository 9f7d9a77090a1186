#include "io/report/figure_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "core/error.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_tables.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

/// Last line of a picture that tread writes: a copy under another name is the user's.
std::string mark_of(const std::string& name) {
  return fmt::format("\n<!-- figure {} of a report of tread -->\n", name);
}

/// Returns true if write_figures() wrote the picture under its name.
bool is_written_here(const fs::path& picture) {
  const std::string mark = mark_of(picture.stem());
  std::ifstream file(picture, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(mark.size()), std::ios::end);
  std::string end(mark.size(), '\0');
  return file.read(end.data(), std::ssize(end)) && end == mark;
}

struct FigureFiles {
  std::string name;
  std::string svg, csv;
};

FigureFiles files_of(const Figure& figure) {
  return {figure.name, figure_svg(figure), curves_csv(figure)};
}

FigureFiles files_of(const Heatmap& map) {
  return {map.name, heatmap_svg(map), heatmap_csv(map)};
}

FigureFiles files_of(const Scatter& scatter) {
  return {scatter.name, scatter_svg(scatter), scatter_csv(scatter)};
}

FigureFiles files_of(const Drawings& drawings) {
  return {drawings.name, drawings_svg(drawings), drawings_csv(drawings)};
}

FigureFiles files_of(const PatchMovie& movie) {
  return {movie.name, movie_svg(movie), movie_csv(movie)};
}

template <class Content>
std::optional<FigureFiles> named_files(const Content& content) {
  if constexpr (requires { files_of(content); })
    if (!content.name.empty()) return files_of(content);
  return std::nullopt;
}

}  // namespace

void write_figures(const fs::path& folder, const Report& report) {
  for (const Chapter& chapter : report.chapters)
    for (const Block& block : chapter.blocks) {
      const auto files = std::visit([](const auto& content) { return named_files(content); }, block);
      if (!files) continue;
      create_folder(folder);
      write_text_file(folder / (files->name + ".svg"), files->svg + mark_of(files->name));
      write_text_file(folder / (files->name + ".csv"), files->csv);
    }
}

void write_report(const fs::path& path, const Report& report) {
  write_text_file(path, report_html(report));
  write_figures(path.parent_path() / kFigureFolder, report);
}

std::vector<std::string> figures_in(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".svg" && is_written_here(entry.path()))
      names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

void remove_figures(const fs::path& folder) {
  std::error_code ignored;
  for (const std::string& name : figures_in(folder))
    for (const char* ending : {".svg", ".csv"}) fs::remove(folder / (name + ending), ignored);
  fs::remove(folder, ignored);
}

void replace_report(const fs::path& path, const Report& report) {
  remove_figures(path.parent_path() / kFigureFolder);
  write_report(path, report);
}

}  // namespace tread
