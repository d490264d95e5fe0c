#!/usr/bin/env bash
# The heap's program from outside: sample runs, wrong input, limits of existence.
# usage: cli_test.sh HEAP SOURCE_FOLDER
set -u
heap=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

# result KEY: that of results in the last summary.
result() {
  sed -n '/^  "results": {/,/^  }/s/^    "'"$1"'": \([^,]*\),*$/\1/p' \
    "$work/run/results/heap/summary.json"
}

is_below() {  # BOUND KEY...
  local bound=$1 key
  shift
  for key in "$@"; do
    awk -v a="$(result "$key")" -v b="$bound" 'BEGIN { exit !(a != "" && a >= 0 && a < b) }' ||
      { echo "$key is '$(result "$key")', not below $bound"; return 1; }
  done
}

has_file() { [ -s "$work/run/results/heap/$1" ] || { echo "no $1"; return 1; }; }

# 1. The sample runs of the program's header; --plot draws the section's figure or the heap's.
sed '/--model 3d/d' "$source_folder/heap_main.cpp" >"$work/section_samples.cpp"
sed '/^\/\/   heap --elements/d' "$source_folder/heap_main.cpp" >"$work/heap_samples.cpp"
check_samples "$heap" "$work/section_samples.cpp" section
check_samples "$heap" "$work/heap_samples.cpp" heap

# 2. The model in three dimensions tells what it found, and what would have done.
check succeeds heap "$heap" --model 3d --elements 1x5x6 --start rest
check expect_text stdout "hint: for the heap its cross-section" "1x5x6 elements"
check is_below 1e-12 cross_flow
check is_below 1e-10 dynamic_pressure
check_fails is_below 1e-10 flow_rate
for file in surface.csv newton.csv heap.vtu; do
  check has_file $file
done
check succeeds heap "$heap" --model 3d --elements 1x5x6 --flow-rate 39.71 --start section
check expect_text stdout "flow rate Q* = 39.71" "times that"
check is_below 1e-10 departure_from_section

check succeeds heap "$heap" --method newton --elements 18x16 --start nested
check expect_text stdout "9x8 elements" "18x16 elements"

# 3. Wrong input.
for value in 0x5 5x0 7 7x x 7x-3 abc 1e9x2 1x7x10 7x10x; do
  check refuses --elements "'$value'" -- "$heap" --elements "$value"
done
for value in 7x10 1x7x 1x0x5 0x7x10 1x2x3x4 50x50x50; do
  check refuses --elements "'$value'" ALONGxACROSSxUP -- "$heap" --model 3d --elements "$value"
done
check refuses --angle "'2'" 1.57 -- "$heap" --angle 2
check refuses --grading-to-wall "'9'" "1 ... 8.73" -- "$heap" --elements 40x10 --grading-to-wall 9
check refuses --grading-to-surface "'9'" "1 ... 8.73" -- \
  "$heap" --model 3d --elements 1x4x40 --grading-to-surface 9
check refuses --flow-rate "'-1'" -- "$heap" --flow-rate -1
check refuses --angle --flow-rate -- "$heap" --angle 0.4 --flow-rate 10
check refuses --model "'4d'" section 3d -- "$heap" --model 4d
check refuses --wall "'ice'" no-slip friction -- "$heap" --wall ice
check refuses --lambda-r "'0'" -- "$heap" --lambda-r 0
check refuses --start "'sitting'" nested -- "$heap" --model 3d --start sitting
check refuses --outflow "'foo'" open-viscous -- "$heap" --model 3d --outflow foo
check refuses --frobnicate -- "$heap" --frobnicate
check refuses --output -- "$heap" --elements 3x4 --output "$work/file/below"
while read -r option value; do
  check refuses "$option" "'$value'" "--model 3d" -- "$heap" --model 3d --elements 1x2x3 \
    "$option" "$value"
done <<'END'
--method interior-point
--wall friction
--precision plain
--line-search energy-slope
--tangent frozen
END
check refuses --no-continuation "--model 3d" -- "$heap" --model 3d --no-continuation
check refuses --start "'rest'" "--model section" -- "$heap" --start rest
check refuses --start "'section'" "--model section" -- "$heap" --method newton --start section
check refuses --outflow "'open'" "--model section" -- "$heap" --outflow open

# 4. The limits of existence.
check has_no_steady_flow 0.571439 "$heap" --elements 3x4 --angle 0.7
check has_no_steady_flow 0.571439 "$heap" --model 3d --elements 1x3x4 --angle 0.7
check is_at_rest heap "$heap" --elements 7x10 --angle 0.3

# 5. A solve that does not succeed says so; so does a Jacobian check.
run "$heap" --elements 7x10 --max-iterations 2
check expect_code 1
check expect_text stderr stagnated
run "$heap" --model 3d --elements 1x3x4 --max-iterations 2
check expect_code 1
check expect_text stderr stagnated "--start section"
for model in section 3d; do
  [ $model = 3d ] && elements=1x2x2 || elements=3x4
  run "$heap" --model $model --elements $elements --method newton --check-jacobian \
    --tangent wrong-sign --lambda-r 1e-4
  check expect_code 1
  check expect_text stdout WRONG
done

# 6. Negative controls.
check_fails refuses --elements -- "$heap" --elements 3x4
check_fails refuses --elements -- "$heap" --model 3d --elements 1x3x4
check_fails is_at_rest heap "$heap" --elements 7x10 --angle 0.42
check_fails has_file no_such_file

finish
