// A table of text cells: written as CSV, shown on a terminal or in a report.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace talus::io {

struct Table {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// The shortest text that reads back as the same double; "nan" and "inf" as such.
std::string exact(double value);
/// The double that such a text stands for, the smallest too, at which std::stod throws; NaN if it
/// stands for none.
double number_in(const std::string& text);
/// With so many significant digits, trailing zeros dropped.
std::string rounded(double value, int digits = 4);
/// With so many decimals.
std::string fixed(double value, int decimals);

std::string to_csv(const Table& table);
/// Columns aligned with spaces, the title first.
void print(std::ostream& out, const Table& table);

}  // namespace talus::io
