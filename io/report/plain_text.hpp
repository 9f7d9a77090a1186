#pragma once
// Tables and figures as text.

#include <cstdint>
#include <string>

#include "io/report/report.hpp"

namespace tread {

/// A report's table in columns of equal width, the title above.
std::string plain_text(const Table& table);

/// The same as a table of Markdown, without its title.
std::string markdown(const Table& table);

/// "461 656".
std::string grouped(std::int64_t number);

/// "3.1 GB", "120 kB", decimal.
std::string bytes_text(std::int64_t bytes);

}  // namespace tread
