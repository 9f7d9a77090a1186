#pragma once
// Tables and figures as text.

#include <cstdint>
#include <string>

#include "io/report/report.hpp"

namespace tread {

/// Text of a report's table in columns of equal width, with the title above.
std::string plain_text(const Table& table);

/// The table in Markdown, without its title.
std::string markdown(const Table& table);

/// Number with grouped digits: "461 656".
std::string grouped(std::int64_t number);

/// Size in decimal units: "3.1 GB", "120 kB".
std::string bytes_text(std::int64_t bytes);

}  // namespace tread
