// The table of a study: its cases by what varies, as columns, as curves, and as files.
#pragma once

#include <string>
#include <vector>

#include "common/io/table.hpp"
#include "verification/study/cases.hpp"

namespace talus::study {

/// What a study of any kind is made of.
struct Table {
  Program program;
  std::vector<Varied> varied;           ///< as asked for, options of one value included
  std::vector<std::string> quantities;  ///< of --quantity; empty: the kind's own choice
  std::vector<Row> rows = {};

  /// The options with several values.
  std::vector<Varied> axes() const;
  /// The option that makes the meshes finer.
  std::string mesh_option() const { return program.description.at("mesh_option"); }
  /// What a quantity, or error_QUANTITY, means, and its unit as an axis has it: "in d sqrt(gd)".
  std::string title_of(const std::string& quantity) const;
  std::string unit_of(const std::string& quantity) const;
};

/// Rows that differ in a few options only, and what tells them from others.
struct Curve {
  std::string label;
  std::vector<const Row*> rows;
};

/// The rows of a table by all axes but those of `without`, in the order of the rows.
std::vector<Curve> curves_of(const Table& table, const std::vector<std::string>& without);

/// The value of an option as a number: of a mesh (9x13) the product. NaN if it is none.
double as_number(const std::string& value);

/// Whether all values of an option are numbers.
bool is_numeric(const Varied& option);

/// The names of the errors that a chart shows: of the quantities asked for, or of the scene's main
/// one. Of a quantity that nothing exact is known of, and no --reference, every row gets its
/// relative error against the finest mesh, the least regularised, among the rows with the same
/// values of the options `of_problem`, and the same law if it has no yield stress; on that mesh
/// none has one.
std::vector<std::string> errors_to_show(Table& table, const std::vector<std::string>& of_problem);

/// One row a case: the options that vary, status, iterations, factorisations, times, memory, sizes,
/// every result, and the command.
io::Table cases_table(const Table& table);

/// How many cases ended how: "23 of 25 converged; 2 stagnated".
std::string count_of_ends(const std::vector<const Row*>& rows);

/// Pointers to all rows.
std::vector<const Row*> all_rows(const Table& table);

}  // namespace talus::study
