#!/usr/bin/env bash
# The program mutants from outside: the list, and what it refuses.
# usage: cli_test.sh MUTANTS SOURCE_FOLDER
set -u
mutants=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../../common/testing/cli_checks.sh"
tree=$source_folder/../..

run "$mutants" --tree "$tree" --list
check expect_code 0
check test "$(wc -l <"$work/stdout")" -ge 200
run "$mutants" --tree "$tree" --list --only '^law/'
check expect_code 0
check test "$(grep -vc '^law/' "$work/stdout")" -eq 0
for wrong in "--only nothing_is_called_so" "--only (" "--catalogue $work --list" "--jobs 0"; do
  # shellcheck disable=SC2086
  run "$mutants" --tree "$tree" $wrong
  check expect_code 2
  check test "$(wc -l <"$work/stderr")" -eq 1
  check test -z "$(ls -A "$work/run")"
done
# A mutant that is no longer of the code.
mkdir "$work/catalogue"
printf '== common/rheology/friction_law.cpp\nstale: a line of long ago\n- long_ago();\n' \
  >"$work/catalogue/old.txt"
run "$mutants" --tree "$tree" --catalogue "$work/catalogue" --copy "$work/copy"
check expect_code 2
check expect_text stderr old/stale "stands 0 times"
# No copy over what is no copy, such as a tree of sources.
run "$mutants" --tree "$tree" --copy "$work/catalogue"
check expect_code 2
check expect_text stderr "--copy" "holds something else"
check test "$(ls "$work/catalogue")" = old.txt
finish
