#!/usr/bin/env bash
# The cylinder's program from outside: sample runs, wrong input, resumption.
# usage: cli_test.sh CYLINDER SOURCE_FOLDER
set -u
cylinder=$1 source_folder=$2 scene=cylinder
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

has_results() {  # KEY...
  for key; do
    [[ "$(result "$key")" =~ ^-?[0-9] ]] || { echo "no number '$key' in results"; return 1; }
  done
}

has_row() {  # LOADING, first in its row
  grep -q "^$1," "$work/run/results/cylinder/sweep.csv" || { echo "no row '$1'"; return 1; }
}

has_file() { [ -s "$work/run/results/cylinder/$1" ] || { echo "no $1"; return 1; }; }

# reached_by WAY...: how the last run came to each of its loadings.
reached_by() {
  local ways
  ways=$(sed -n '/^  "reached": \[/,/^  \]/s/^      "by": "\(.*\)",$/\1/p' \
    "$work/run/results/cylinder/summary.json")
  [ "$ways" = "$(printf '%s\n' "$@")" ] || { echo "reached by: $ways"; return 1; }
}

# begins_like OLD NEW: NEW in the results has the lines of OLD, then others.
begins_like() {
  local new="$work/run/results/cylinder/$2"
  cmp -s "$1" <(head -n "$(wc -l <"$1")" "$new") || { echo "$2 does not begin like $1"; return 1; }
  [ "$(wc -l <"$new")" -gt "$(wc -l <"$1")" ] || { echo "$2 has nothing new"; return 1; }
  # Once, where the path along the loading starts at the end of that in λr.
  [ "$(cut -d, -f1,2 "$new" | uniq -d | wc -l)" -le 1 ] ||
    { echo "points of $2 are there twice"; return 1; }
}

# numbers FOLDER: all that a run leaves in tables and summary but its command, time and memory.
numbers() {
  cat "$1/sweep.csv" "$1/path.csv" "$1/perimeter.csv" \
    <(grep -vE '"(command|(cpu_|wall_)?seconds|peak_memory)":' "$1/summary.json")
}

same_numbers() {  # AS: the last run left the same numbers as were written to this file
  cmp -s "$1" <(numbers "$work/run/results/cylinder") || { echo "other numbers than at once"; return 1; }
}

# check_kills SECONDS...: $flow, killed at each of these moments and resumed, leaves the numbers at once.
check_kills() {
  local moment
  for moment in "$@"; do
    (cd "$work/run" && timeout -s KILL "$moment" "${flow[@]}" --resume >/dev/null 2>&1)
    waits_for_killed "$work/run/results/cylinder"
  done
  run_again "${flow[@]}" --resume
  check expect_code 0
  check same_numbers "$work/at_once"
}

# flip_bit FILE BYTE: the lowest bit of a byte, counted from 0.
flip_bit() {
  local byte
  byte=$(od -An -tu1 -j "$2" -N 1 "$1")
  # shellcheck disable=SC2059  # an octal escape
  printf "\\$(printf %o $((byte ^ 1)))" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}

agrees_to_1e_8() {  # A B
  awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > 0 && b > 0 && (a - b)^2 <= (1e-8 * b)^2) }' ||
    { echo "'$1' is not '$2'"; return 1; }
}

# 1. The sample runs of the program's header.
check_samples "$cylinder" "$source_folder/cylinder_main.cpp" drag
check has_results drag drag_traction mean_velocity min_pressure
for file in sweep.csv sweep.pvd path.csv perimeter.csv flow_0001.vtu checkpoint.bin; do
  check has_file $file
done

# Fields are drawn whole, or what --fields and --window leave of them.
run "$cylinder" --around 16 --loading 0.02 --lambda-r 1e-2 --plot --fields speed,regions,mesh --window=-1,-1.5,1,1
check expect_code 0
if command -v gnuplot >/dev/null; then
  for file in fields.dat fields.gp fields.png fields.svg; do check has_file $file; done
  check_fails has_file wake.png
  check test "$(grep -c ': boundary$' "$work/run/results/cylinder/fields.dat")" -eq 2
  check test "$(wc -c <"$work/run/results/cylinder/fields.svg")" -lt 1000000
fi

# 2. Wrong input.
check refuses "--fields: not used by a run without --plot" -- "$cylinder" --fields speed
check refuses "--fields: 'sped'" "did you mean speed?" -- "$cylinder" --plot --fields sped
for value in 0,0,1 1,0,0,1; do check refuses "--window: '$value'" -- "$cylinder" --plot --window $value; done
for value in 17 8 648 x ''; do
  check refuses --around "'$value'" "16 ... 640" -- "$cylinder" --around "$value"
done
for value in 0 x -0.05 0.08 nan; do
  check refuses --loading "'$value'" 0.07 -- "$cylinder" --loading "$value"
done
check refuses --loading --sweep -- "$cylinder" --loading 0.05 --sweep 0.04:0.05:3
for value in 0.04 0.04:0.05 0.04:0.05:3:1 x:0.05:3 0.04:0.05:1 0:0.05:3 0.04:0.05:2.5; do
  check refuses --sweep -- "$cylinder" --around 16 --sweep "$value"
done
for value in '' 0.04:0.05:3: :0.05:3 0.04::3 0.04:0.05:+3; do
  check refuses --sweep "'" -- "$cylinder" --around 16 --sweep "$value"
done
for value in 0.01,,0.02 0.01, ,0.01 ''; do
  check refuses --loading "''" 0.07 -- "$cylinder" --loading "$value"
done
check refuses --confining-pressure "''" -- "$cylinder" --confining-pressure 1,
check refuses --friction "''" -- "$cylinder" --around 16 --friction ''
check refuses --around "'0x10'" -- "$cylinder" --around 0x10
check refuses "--pressure-floor: not used by --no-pressure-regularisation" -- \
  "$cylinder" --pressure-floor 0.01 --no-pressure-regularisation
for option in "--loading 0.02" "--tolerance 1e-8" "--route loading" "--max-points 8" --plot; do
  # shellcheck disable=SC2086  # words
  check refuses "${option%% *}: not used by --check-jacobian" -- \
    "$cylinder" --around 16 --check-jacobian $option
done
check refuses --contination "did you mean --continuation?" -- "$cylinder" --contination natural
check refuses "--loading: it is given twice" -- "$cylinder" --loading 0.01 --loading 0.02
# The sample runs ask the same of the other tangent.
check succeeds cylinder "$cylinder" --around 16 --outlet 4 --tangent full --check-jacobian
check refuses --method "'interior-point'" newton -- "$cylinder" --method interior-point
check refuses --outflow "'foo'" open-viscous -- "$cylinder" --outflow foo
check refuses --route "'foo'" lambda-r -- "$cylinder" --route foo
check refuses --confining-pressure "'0'" 0.01 -- "$cylinder" --confining-pressure 0
check refuses --friction "'1,2'" "0.001 ... 10" -- "$cylinder" --around 16 --friction 1,2
check refuses --pressure-floor "'2'" -- "$cylinder" --pressure-floor 2
check refuses --max-points "'1'" -- "$cylinder" --max-points 1
check refuses --output "'$work/file/below'" -- "$cylinder" --around 16 --output "$work/file/below"
check refuses --frobnicate -- "$cylinder" --frobnicate

with_600_mb=(bash -c 'ulimit -v 600000; exec "$@"' bash)
if can_limit_memory "$cylinder"; then
  check refuses --around "'640'" GB available "would fit" -- \
    "${with_600_mb[@]}" "$cylinder" --around 640
fi
check refuses --around "'2000'" "16 ... 640" -- "$cylinder" --around 2000

# 3. A solve that does not succeed says so.
run "$cylinder" --around 16 --loading 0.052 --continuation natural  # beyond the yield load
check expect_code 1
check expect_text stderr step_too_small "F = 0.0501"
check expect_text run/results/cylinder/summary.json '"status": "step_too_small"'
check leaves cylinder summary.json path.csv sweep.pvd checkpoint.bin
check expect_text run/results/cylinder/summary.json '"results": {}'

# How near to the solution is the user's choice.
steps() { sed -n 's/^  "iterations": \(.*\),$/\1/p' "$work/run/results/cylinder/summary.json"; }
run "$cylinder" --around 16 --loading 0.02
steps=$(steps) drag=$(result drag)
run "$cylinder" --around 16 --loading 0.02 --tolerance 1e-3
check expect_code 0
check [ "$(steps)" -lt "$steps" ]
check_fails agrees_to_1e_8 "$(result drag)" "$drag"
check refuses --tolerance "'1e-2'" "1e-16 ... 0.001" -- "$cylinder" --tolerance 1e-2

# A folder holds one run and nothing older: neither what a failed run does not write nor its pictures.
run "$cylinder" --around 16 --loading 0.02 --lambda-r 1e-2 --plot
for file in .drag.png.part .flow_0002.vtu.part notes.txt; do touch "$work/run/results/cylinder/$file"; done
run_again "$cylinder" --around 16 --loading 0.05 --max-points 2 --lambda-r 1e-4 --continuation arclength
check expect_code 1
check leaves cylinder summary.json path.csv sweep.pvd checkpoint.bin notes.txt
run_again "$cylinder" --around 016 --loading 0.02 --lambda-r 1e-2
check expect_text run/results/cylinder/summary.json '"around": 16,'
check expect_text stdout "summary.json sweep.pvd path.csv sweep.csv perimeter.csv"
check leaves cylinder summary.json path.csv sweep.pvd checkpoint.bin notes.txt perimeter.csv \
  sweep.csv flow_0001.vtu
check holds_one_run cylinder "$cylinder" --around 16 --loading 0.02 --lambda-r 1e-2
check says_when_stdout_is_full "$cylinder" --around 16 --loading 0.02 --lambda-r 1e-2
with_gnuplot 'exit 1' "$cylinder" --around 16 --loading 0.02 --lambda-r 1e-2 --plot
check expect_code 0
check expect_text stdout "(no path.png: gnuplot failed)"

# 4. A cylinder that was interrupted goes on from its checkpoint to the same flow.
flow=("$cylinder" --around 16 --sweep 0.03:0.045:2 --continuation arclength)
check succeeds cylinder "${flow[@]}"
drag=$(result drag)
numbers "$work/run/results/cylinder" >"$work/at_once"
run "${flow[@]}" --max-points 3
check expect_code 1
check expect_text stderr out_of_points
check expect_text run/results/cylinder/summary.json '"status": "out_of_points"'
check has_file checkpoint.bin
cp "$work/run/results/cylinder/path.csv" "$work/begun.csv"
run_again "${flow[@]}" --resume --lambda-r 1e-5
check expect_code 2
check expect_text stderr --resume "other options" "lambda_r 1e-05, not 1e-06"
run_again "${flow[@]/16/24}" --resume
check expect_code 2
check expect_text stderr --resume "around 24, not 16"
run_again "${flow[@]}" --resume --max-points 5  # a second time
check expect_code 1
run_again "${flow[@]}" --resume
check expect_code 0
check expect_empty stderr
check same_numbers "$work/at_once"
check begins_like "$work/begun.csv" path.csv
check_fails begins_like "$work/run/results/cylinder/sweep.csv" path.csv
check_fails begins_like "$work/run/results/cylinder/path.csv" path.csv  # nothing new
check_fails same_numbers "$work/begun.csv"
check_fails agrees_to_1e_8 "$(result wall_force)" "$drag"
cp "$work/run/results/cylinder/sweep.csv" "$work/sweep.csv"
run_again "${flow[@]}" --resume  # all is done
check cmp "$work/sweep.csv" "$work/run/results/cylinder/sweep.csv"
check expect_code 0
check same_numbers "$work/at_once"
# The path may be gone on with in another way.
run "${flow[@]}" --max-points 3
check expect_code 1
run_again "${flow[@]/arclength/primal-dual}" --resume
check expect_code 0
check agrees_to_1e_8 "$(result drag)" "$drag"

# 5. Killed at any moment, it leaves a checkpoint or none, and ends with the same numbers.
for way in "primal-dual lambda-r" "natural loading" "arclength loading"; do
  read -r continuation route <<<"$way"
  flow=("$cylinder" --around 16 --sweep 0.03:0.045:2 --continuation "$continuation" --route "$route")
  check succeeds cylinder "${flow[@]}"
  numbers "$work/run/results/cylinder" >"$work/at_once"
  rm -rf "$work/run/results"
  check_kills 0.15 0.3 0.45
done
# Without a path as well: the first two loadings creep, the third does not.
flow=("$cylinder" --around 16 --loading 0.03 0.045 0.05)
check succeeds cylinder "${flow[@]}"
numbers "$work/run/results/cylinder" >"$work/at_once"
check reached_by "creep from rest" "newton from the load before" "path in λr"
rm -rf "$work/run/results"
check_kills 0.1 0.2 0.3
# What is asked for is done, creep or not; the flow is the same.
drag=$(result drag)
run "${flow[@]}" --continuation primal-dual
check reached_by "path in λr" "path in λr" "path in λr"
check agrees_to_1e_8 "$(result drag)" "$drag"
run "$cylinder" --around 16 --loading 0.03 0.045 --route loading
check reached_by "creep from rest" "path in the loading"
check_fails reached_by "creep from rest" "path in λr"
check_fails reached_by "creep from rest"
run "$cylinder" --around 16 --loading 0.01 0.02 --route loading --regularisation barker-gray
check reached_by "path in λr" "path in the loading"
run "$cylinder" --around 16 --loading 0.03 --regularisation barker-gray  # no yield stress, no creep
check reached_by "path in λr"
run "$cylinder" --around 16 --loading 0.01 --lambda-r 1e-2 --resume
check expect_code 0
check expect_text stdout "no checkpoint in results/cylinder: from the start"

# 6. A damaged checkpoint is not believed, wherever the damage is.
checkpoint=$work/run/results/cylinder/checkpoint.bin
cp "$checkpoint" "$work/whole.bin"
size=$(wc -c <"$checkpoint")
for byte in 3 20 40 100 $((size / 3)) $((size - 1)); do
  cp "$work/whole.bin" "$checkpoint"
  flip_bit "$checkpoint" "$byte"
  run_again "$cylinder" --around 16 --loading 0.01 --lambda-r 1e-2 --resume
  check expect_code 2
  check expect_text stderr --resume "remove it to start anew"
done
head -c $((size / 2)) "$work/whole.bin" >"$checkpoint"
run_again "$cylinder" --around 16 --loading 0.01 --lambda-r 1e-2 --resume
check expect_code 2
check expect_text stderr damaged
echo broken >"$checkpoint"
run_again "$cylinder" --around 16 --loading 0.01 --lambda-r 1e-2 --resume
check expect_code 2
check expect_text stderr "not a checkpoint"

# 7. An outlet that holds everything up is no flow.
run "$cylinder" --around 16 --outflow open
check expect_code 1
check expect_text stderr open-viscous

# 8. Loadings of a sweep are short decimals; one loading alone is drawn without complaint.
run "$cylinder" --around 16 --sweep 0.02:0.04:6 --lambda-r 1e-2 --plot
check expect_code 0
check expect_empty stderr
for loading in 0.02 0.024 0.028 0.032 0.036 0.04; do
  check has_row "$loading"
done
check_fails has_row 0.030
run "$cylinder" --around 16 --loading 0.03 --lambda-r 1e-2 --pressure-floor 0.01 --plot
check expect_code 0
check expect_empty stderr
check has_row 0.03
run "$cylinder" --around 16 --loading 0.03 --lambda-r 0.2  # as smooth as where paths start
check expect_code 0
run "$cylinder" --around 16 --loading 0.03 --lambda-r 1e-3 --no-pressure-regularisation
check expect_code 0

# 9. Negative controls.
check_fails refuses --around -- "$cylinder" --around 16 --loading 0.01
check_fails has_results no_such_result
check_fails has_file no_such_file

finish
