#include "common/io/table.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <ostream>

namespace talus::io {

std::string exact(double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return {text, result.ptr};
}

double number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == 0 ? value : std::numeric_limits<double>::quiet_NaN();
}

std::string rounded(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string fixed(double value, int decimals) {
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string to_csv(const Table& table) {
  std::string csv;
  const auto add = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool quoted = row[i].find_first_of(",\"\n") != std::string::npos;
      csv += i == 0 ? "" : ",";
      if (!quoted) {
        csv += row[i];
        continue;
      }
      csv += '"';
      for (const char c : row[i]) csv += c == '"' ? "\"\"" : std::string(1, c);
      csv += '"';
    }
    csv += '\n';
  };
  add(table.header);
  for (const auto& row : table.rows) add(row);
  return csv;
}

void print(std::ostream& out, const Table& table) {
  // Characters, not bytes: UTF-8 continuation bytes take no column.
  const auto width_of = [](const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
  };
  std::vector<std::size_t> widths(table.header.size(), 0);
  const auto widen = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < std::min(row.size(), widths.size()); ++i)
      widths[i] = std::max(widths[i], width_of(row[i]));
  };
  widen(table.header);
  for (const auto& row : table.rows) widen(row);
  const auto show = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i)
      out << "  " << row[i] << std::string(widths[i] - std::min(widths[i], width_of(row[i])), ' ');
    out << '\n';
  };
  if (!table.title.empty()) out << table.title << '\n';
  show(table.header);
  for (const auto& row : table.rows) show(row);
}

}  // namespace talus::io
