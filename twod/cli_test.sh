#!/usr/bin/env bash
# The cylinder's program from outside: sample runs, wrong input, resumption.
# usage: cli_test.sh CYLINDER SOURCE_FOLDER
set -u
cylinder=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

# run_again PROGRAM OPTIONS...: as run, in the folder of the last one.
run_again() {
  (cd "$work/run" && exec "$@") >"$work/stdout" 2>"$work/stderr"
  code=$?
}

# result KEY: that of results in the summary of the last run.
result() {
  sed -n '/^  "results": {/,/^  }/s/^    "'"$1"'": \([^,]*\),*$/\1/p' \
    "$work/run/results/cylinder/summary.json"
}

has_results() {  # KEY...
  local key
  for key in "$@"; do
    [[ "$(result "$key")" =~ ^-?[0-9] ]] || { echo "no number '$key' in results"; return 1; }
  done
}

has_file() { [ -s "$work/run/results/cylinder/$1" ] || { echo "no $1"; return 1; }; }

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

# 2. Wrong input.
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
check refuses --outflow "'foo'" open-viscous -- "$cylinder" --outflow foo
check refuses --route "'foo'" lambda-r -- "$cylinder" --route foo
check refuses --confining-pressure "'0'" 0.01 -- "$cylinder" --confining-pressure 0
check refuses --friction "'1,2'" "0.001 ... 10" -- "$cylinder" --around 16 --friction 1,2
check refuses --max-points "'1'" -- "$cylinder" --max-points 1
check refuses --output "'$work/file/below'" -- "$cylinder" --around 16 --output "$work/file/below"
check refuses --frobnicate -- "$cylinder" --frobnicate

# 3. A solve that does not succeed says so.
run "$cylinder" --around 16 --loading 0.052 --continuation natural  # beyond the yield load
check expect_code 1
check expect_text stderr step_too_small "F = 0.0501"
check expect_text run/results/cylinder/summary.json '"status": "step_too_small"'

# 4. A cylinder that was interrupted goes on from its checkpoint to the same flow.
flow=("$cylinder" --around 16 --sweep 0.03:0.045:2)
check succeeds cylinder "${flow[@]}"
drag=$(result drag) velocity=$(result mean_velocity) factorisations=$(grep factorisations \
  "$work/run/results/cylinder/summary.json")
run "${flow[@]}" --max-points 3
check expect_code 1
check expect_text stderr out_of_points
check expect_text run/results/cylinder/summary.json '"status": "out_of_points"'
check has_file checkpoint.bin
run_again "${flow[@]}" --resume --lambda-r 1e-5
check expect_code 2
check expect_text stderr --resume "other options"
run_again "${flow[@]}" --resume --max-points 5  # a second time
check expect_code 1
run_again "${flow[@]}" --resume
check expect_code 0
check expect_empty stderr
check agrees_to_1e_8 "$(result drag)" "$drag"
check agrees_to_1e_8 "$(result mean_velocity)" "$velocity"
check_fails expect_text run/results/cylinder/summary.json "$factorisations"  # fewer than at once
check_fails agrees_to_1e_8 "$(result wall_force)" "$drag"
run_again "${flow[@]}" --resume  # all is done
check expect_code 0
check agrees_to_1e_8 "$(result drag)" "$drag"
# Or just before the last loading was written down: nothing is left to follow.
LC_ALL=C sed -i '1s/"stage":"reached","sweep":\[[^]]*\]/"stage":"loading","sweep":[]/
1s/\("loadings":\)\[[^]]*\]/\1[0.045]/' "$work/run/results/cylinder/checkpoint.bin"
run_again "$cylinder" --around 16 --loading 0.045 --resume
check expect_code 0
check expect_text run/results/cylinder/summary.json '"factorisations": 0,'
check agrees_to_1e_8 "$(result drag)" "$drag"
echo broken >"$work/run/results/cylinder/checkpoint.bin"
run_again "${flow[@]}" --resume
check expect_code 2
check expect_text stderr "not a checkpoint"

# 5. Negative controls.
check_fails refuses --around -- "$cylinder" --around 16 --loading 0.01
check_fails has_results no_such_result
check_fails has_file no_such_file

finish
