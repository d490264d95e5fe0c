#!/usr/bin/env bash
# A regularisation that lacks a member is told so by the compiler, in one line that names it.
# usage: incomplete_law_test.sh COMPILER SOURCE_FOLDER
set -u
compiler=$1 source_folder=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

law() {
  cat <<'CODE'
#include "common/rheology/regularisation.hpp"
using namespace talus::rheology;
struct Mine {
  static constexpr std::string_view name = "mine";
  static constexpr std::string_view equation = "(0)";
  static constexpr bool has_yield_stress = true;
  static double friction(const FrictionLaw&, double) { return 0; }
  static double inertial_number(const FrictionLaw&, double) { return 0; }
  static double inertial_number_integral(const FrictionLaw&, double) { return 0; }
  static double kink(const FrictionLaw&) { return 0; }
  static double well_posedness(const FrictionLaw&, double) { return 0; }
  static Viscosity evaluate(const FrictionLaw&, double, double, double) { return {}; }
};
Registry<Simple, Mine> all;
CODE
}

# errors: what the compiler says of the law on stdin, as this project is compiled.
errors() {
  cat >"$work/law.cpp"
  "$compiler" -std=c++20 -fsyntax-only -Wfatal-errors -I "$source_folder" "$work/law.cpp" 2>&1 |
    grep 'error:'
}

[ -z "$(law | errors)" ] || { echo "FAILED: a whole law is refused"; failures=1; }
for member in name equation has_yield_stress friction inertial_number inertial_number_integral kink \
  well_posedness evaluate; do
  message=$(law | sed -E "/ $member( =|\()/d" | errors)
  told=$member
  case $member in friction | inertial* | kink | well_posedness) told=YieldStressLimit ;; esac
  if [ "$(wc -l <<<"$message")" -ne 1 ] || ! grep -q "a regularisation needs.*$told" <<<"$message"; then
    echo "FAILED: without $member the compiler says: $message"
    failures=1
  fi
done
exit $failures
