#!/usr/bin/env bash
# What programs write for ParaView, read by VTK and not by us; a file with two nodes of a cell swapped
# does not pass. Without VTK for Python the test is skipped, by name.
# usage: vtu_reader_test.sh PROGRAMS SOURCE_FOLDER
set -u
programs=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/cli_checks.sh"
for python in /usr/bin/python3 python3; do
  "$python" -c 'import vtk' 2>/dev/null && break
done
reader() { run_again "$python" "$source_folder/vtu_reader.py" "$@"; }
run true
reader
[ "$code" -eq 77 ] && { cat "$work/stdout"; exit 77; }

run "$programs/heap" --elements 4x6 --output section
check expect_code 0
run_again "$programs/heap" --model space --elements 1x4x6 --output space
check expect_code 0
run_again "$programs/cylinder" --around 16 --loading 0.03 --output cylinder
check expect_code 0
for file in section/section.vtu space/heap.vtu cylinder/flow_0001.vtu; do
  reader "$file"
  check expect_code 0
  # Two nodes of the first cell in each other's place.
  awk 'found { swap = $1; $1 = $2; $2 = swap; found = 0 } /Name="connectivity"/ { found = 1 } { print }' \
    "$work/run/$file" >"$work/run/swapped.vtu"
  reader swapped.vtu
  check test "$code" -ne 0
done
finish
