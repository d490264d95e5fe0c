#!/usr/bin/env bash
# The heap's program from outside: sample runs, wrong input, limits of existence.
# usage: cli_test.sh HEAP SOURCE_FOLDER
set -u
heap=$1 source_folder=$2 scene=heap
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

is_below() {  # BOUND KEY...
  local bound=$1 key
  shift
  for key in "$@"; do
    awk -v a="$(result "$key")" -v b="$bound" 'BEGIN { exit !(a != "" && a >= 0 && a < b) }' ||
      { echo "$key is '$(result "$key")', not below $bound"; return 1; }
  done
}

is_close() {  # KEY VALUE: that of results in the last summary is near it, relative to 1e-5
  awk -v a="$(result "$1")" -v b="$2" 'BEGIN { exit !((a - b)^2 <= (1e-5 * b)^2) }' ||
    { echo "$1 is '$(result "$1")', not $2"; return 1; }
}

has_file() { [ -s "$work/run/results/heap/$1" ] || { echo "no $1"; return 1; }; }

# 1. The sample runs of the program's header; --plot draws the section's figure or the heap's.
sed '/--model/d' "$source_folder/heap_main.cpp" >"$work/section_samples.cpp"
sed '/^\/\/   heap/{/--model line/!d}' "$source_folder/heap_main.cpp" >"$work/line_samples.cpp"
sed '/^\/\/   heap/{/--model space/!d}' "$source_folder/heap_main.cpp" >"$work/heap_samples.cpp"
check_samples "$heap" "$work/line_samples.cpp" profile
check_samples "$heap" "$work/section_samples.cpp" section
check_samples "$heap" "$work/heap_samples.cpp" heap

# 2. The model in three dimensions tells what it found, and what would have done.
check succeeds heap "$heap" --model space --elements 1x5x6 --start rest
check expect_text stdout "hint: for the heap its cross-section" "1x5x6 elements"
check is_below 1e-12 cross_flow
check is_below 1e-10 dynamic_pressure
check_fails is_below 1e-10 flow_rate
for file in surface.csv newton.csv heap.vtu; do
  check has_file $file
done
check succeeds heap "$heap" --model space --elements 1x5x6 --flow-rate 39.71 --start section
check expect_text stdout "flow rate Q* = 39.71" "times that"
check is_below 1e-10 departure_from_section

check succeeds heap "$heap" --model 3d --elements 1x2x3  # the older spelling
check expect_text run/results/heap/summary.json '"model": "space"'
check_fails expect_text stdout " 3d"
run "$heap" --help
check expect_text stdout "[line, section, space]"
check_fails expect_text stdout " 3d"

# On a line it says what the walls are worth.
run "$heap" --model line --elements 200 --wall-friction 0.383
check expect_code 0
check expect_text stdout "The cross-section, on 18x25 elements" "off by 84%" "--model section"
check is_close exact_flow_rate 7.988980  # by the midpoint rule in √h
check test -s "$work/run/results/heap/profile.csv"
run_again "$heap" --elements 4x5
check leaves heap summary.json interior_point.csv surface.csv section.vtu
run_again "$heap" --model line --elements 10 --angle 0.36
check expect_code 0
check leaves heap summary.json interior_point.csv profile.csv
run_again "$heap" --model line --angle 0.58
check expect_code 1
check expect_text stderr no_steady_state
check leaves heap summary.json
for option in "--wall friction" "--start rest" "--grading-to-wall 2" "--outflow open" "--lambda-p 1e-4"; do
  # shellcheck disable=SC2086  # words
  check refuses "${option%% *}: not used by --model line" -- "$heap" --model line $option
done
check refuses "--flow-rate: '3'" --angle -- "$heap" --model line --flow-rate 3
check refuses "--wall-friction: not used by --model section" -- "$heap" --wall-friction 0.5
for value in 3x4 0 x; do check refuses --elements "'$value'" UP -- "$heap" --model line --elements $value; done

check succeeds heap "$heap" --method newton --elements 18x16 --start nested
check expect_text stdout "9x8 elements" "18x16 elements"

# 3. Wrong input.
for value in 0x5 5x0 7 7x x 7x-3 abc 1e9x2 1x7x10 7x10x; do
  check refuses --elements "'$value'" -- "$heap" --elements "$value"
done
for value in 7x10 1x7x 1x0x5 0x7x10 1x2x3x4 50x50x50; do
  check refuses --elements "'$value'" ALONGxACROSSxUP -- "$heap" --model space --elements "$value"
done
check refuses --angle "'2'" 1.57 -- "$heap" --angle 2
check refuses --grading-to-wall "'9'" "1 ... 8.73" -- "$heap" --elements 40x10 --grading-to-wall 9
check refuses --grading-to-surface "'9'" "1 ... 8.73" -- \
  "$heap" --model space --elements 1x4x40 --grading-to-surface 9
check refuses --flow-rate "'-1'" -- "$heap" --flow-rate -1
check refuses --angle --flow-rate -- "$heap" --angle 0.4 --flow-rate 10
check refuses --model "'4d'" section space -- "$heap" --model 4d
check refuses --wall "'ice'" no-slip friction -- "$heap" --wall ice
check refuses --lambda-r "'0'" -- "$heap" --lambda-r 0
check refuses --start "'sitting'" nested -- "$heap" --model space --start sitting
check refuses --outflow "'foo'" open-viscous -- "$heap" --model space --outflow foo
check refuses --frobnicate -- "$heap" --frobnicate
check refuses --output -- "$heap" --elements 3x4 --output "$work/file/below"
while read -r option value; do
  check refuses "$option" "'$value'" "--model space" -- "$heap" --model space --elements 1x2x3 \
    "$option" "$value"
done <<'END'
--method interior-point
--wall friction
--precision plain
--line-search energy-slope
END
check refuses --start "'section'" "--model section" "--model space" -- "$heap" --start section
# Options that the model, the method, or a check instead of a solve has no use for.
while read -r by options; do
  # shellcheck disable=SC2086  # words, as a user types them
  check refuses "${options%% *}: not used by --${by/=/ }" -- "$heap" --elements 1x2x3 $options
done <<'END'
model=section --threads 1
model=section --penalty plain
model=section --lambda-p 1e-4
model=section --outflow open
method=interior-point --start rest
method=interior-point --start nested
method=interior-point --regularisation simple
method=interior-point --lambda-r 1e-3
method=interior-point --precision plain
method=interior-point --line-search none
method=interior-point --tangent full
method=interior-point --no-continuation
check-jacobian --start rest --check-jacobian
check-jacobian --start section --check-jacobian --model space
check-jacobian --flow-rate 10 --check-jacobian
check-jacobian --tolerance 1e-8 --check-jacobian --model space
check-jacobian --max-iterations 8 --check-jacobian
check-jacobian --plot --check-jacobian
check-jacobian --output elsewhere --check-jacobian
END
check refuses "--start: not used by --method interior-point; add --method newton" -- \
  "$heap" --start nested
check refuses --angle "'23'" "radians (or 23deg)" -- "$heap" --angle 23
check refuses --outfow "did you mean --outflow?" -- "$heap" --model space --outfow open
check refuses --friction "''" -- "$heap" --elements 3x4 --friction ''
check refuses --elements "''" -- "$heap" --elements ''
check succeeds heap "$heap" --elements 07x010 --angle 23deg
check expect_text run/results/heap/summary.json '"angle": 0.4014257279' "7,"
cp "$work/run/results/heap/surface.csv" "$work/surface.csv"
radians=$(sed -n "s/.*\"angle\": \([0-9][0-9.]*\).*/\1/p" "$work/run/results/heap/summary.json" | head -n 1)
check succeeds heap "$heap" --elements 7x10 --angle "$radians"
check cmp "$work/surface.csv" "$work/run/results/heap/surface.csv"

# A folder holds one run and nothing older.
run "$heap" --elements 7x10 --plot
run_again "$heap" --elements 7x10 --max-iterations 2 --plot
check expect_code 1
check leaves heap summary.json interior_point.csv
check expect_text run/results/heap/summary.json '"results": {}' stagnated
run "$heap" --model space --elements 1x3x4 --plot
! command -v gnuplot >/dev/null || check has_file heap_fields.png
with_gnuplot 'exit 1' "$heap" --elements 7x10 --plot
check expect_code 0
check expect_text stdout "(no section.png: gnuplot failed)"
check leaves heap summary.json surface.csv interior_point.csv section.vtu section.dat section.gp
run_again "$heap" --model space --elements 1x3x4 --max-iterations 2
check leaves heap summary.json newton.csv
check expect_text run/results/heap/summary.json '"results": {}' stagnated
check holds_one_run heap "$heap" --elements 7x10
check says_when_stdout_is_full "$heap" --elements 7x10

# What does not fit into memory is refused before it begins, with the size that would; that one fits.
with_1_gb=(bash -c 'ulimit -v 1200000; exec "$@"' bash)
fitting() {  # the size that the last run said would fit
  sed -n "s/.*available; \([0-9x]*\) would fit$/\1/p" "$work/stderr"
}
if can_limit_memory "$heap"; then
  check refuses --elements "'900x1100'" GB available "would fit" -- \
    "${with_1_gb[@]}" "$heap" --elements 900x1100
  size=$(fitting)
  run "${with_1_gb[@]}" "$heap" --elements "${size:-none}" --max-iterations 1
  check expect_code 1
  check expect_text stderr stagnated
  check refuses --elements "'46x46x46'" GB available "would fit" -- \
    "${with_1_gb[@]}" "$heap" --model space --elements 46x46x46
fi
check refuses --elements "'100000x100000'" -- "$heap" --elements 100000x100000

# 4. The limits of existence.
check has_no_steady_flow 0.571439 "$heap" --elements 3x4 --angle 0.7
check has_no_steady_flow 0.571439 "$heap" --model space --elements 1x3x4 --angle 0.7
check is_at_rest heap "$heap" --elements 7x10 --angle 0.3

# 5. A solve that does not succeed says so; so does a Jacobian check.
run "$heap" --elements 7x10 --max-iterations 2
check expect_code 1
check expect_text stderr stagnated
run "$heap" --model space --elements 1x3x4 --max-iterations 2
check expect_code 1
check expect_text stderr stagnated "--start section"
for model in section space; do
  [ $model = space ] && elements=1x2x2 || elements=3x4
  run "$heap" --model $model --elements $elements --method newton --check-jacobian \
    --tangent wrong-sign --lambda-r 1e-4
  check expect_code 1
  check expect_text stdout WRONG
done

# 6. An angle is found for every flow rate that one carries; for others the end is named.
check succeeds heap "$heap" --elements 7x10 --flow-rate 5000
check is_close flow_rate 5000
check succeeds heap "$heap" --elements 7x10 --friction 0.383,0.015,0.279 --flow-rate 10
check is_close flow_rate 10
check succeeds heap "$heap" --model space --elements 1x3x4 --flow-rate 40 --tolerance 1e-7
check is_close flow_rate 40
check_fails is_close flow_rate 41
run "$heap" --elements 4x5 --flow-rate 1e6
check expect_code 1
check expect_text stderr no_steady_state "the largest found is" "lower --flow-rate"
check expect_text run/results/heap/summary.json '"status": "no_steady_state"'
run "$heap" --elements 4x5 --flow-rate 40 --max-iterations 2
check expect_code 1
check expect_text stderr stagnated
check expect_text run/results/heap/summary.json '"status": "stagnated"'

# 7. Negative controls.
check_fails refuses --elements -- "$heap" --elements 3x4
check_fails refuses --elements -- "$heap" --model space --elements 1x3x4
check_fails is_at_rest heap "$heap" --elements 7x10 --angle 0.42
check_fails has_file no_such_file

finish
