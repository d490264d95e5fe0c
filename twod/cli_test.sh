#!/usr/bin/env bash
# The cylinder's program from outside: sample runs, wrong input, resumption.
# usage: cli_test.sh CYLINDER SOURCE_FOLDER
set -u
cylinder=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

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

has_row() {  # LOADING, first in its row
  grep -q "^$1," "$work/run/results/cylinder/sweep.csv" || { echo "no row '$1'"; return 1; }
}

has_file() { [ -s "$work/run/results/cylinder/$1" ] || { echo "no $1"; return 1; }; }

# begins_like OLD NEW: NEW in the results has the lines of OLD, then others.
begins_like() {
  local new="$work/run/results/cylinder/$2"
  cmp -s "$1" <(head -n "$(wc -l <"$1")" "$new") || { echo "$2 does not begin like $1"; return 1; }
  [ "$(wc -l <"$new")" -gt "$(wc -l <"$1")" ] || { echo "$2 has nothing new"; return 1; }
  # Once, where the path along the loading starts at the end of that in λr.
  [ "$(cut -d, -f1,2 "$new" | uniq -d | wc -l)" -le 1 ] ||
    { echo "points of $2 are there twice"; return 1; }
}

few_factorisations() {  # no path, only Newton at a solution
  local count
  count=$(sed -n 's/^  "factorisations": \([0-9]*\),$/\1/p' "$work/run/results/cylinder/summary.json")
  [ "${count:-99}" -le 4 ] || { echo "'$count' factorisations"; return 1; }
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
check refuses --contination "did you mean --continuation?" -- "$cylinder" --contination natural
check refuses "--loading: it is given twice" -- "$cylinder" --loading 0.01 --loading 0.02
check refuses --outflow "'foo'" open-viscous -- "$cylinder" --outflow foo
check refuses --route "'foo'" lambda-r -- "$cylinder" --route foo
check refuses --confining-pressure "'0'" 0.01 -- "$cylinder" --confining-pressure 0
check refuses --friction "'1,2'" "0.001 ... 10" -- "$cylinder" --around 16 --friction 1,2
check refuses --pressure-floor "'2'" -- "$cylinder" --pressure-floor 2
check refuses --max-points "'1'" -- "$cylinder" --max-points 1
check refuses --output "'$work/file/below'" -- "$cylinder" --around 16 --output "$work/file/below"
check refuses --frobnicate -- "$cylinder" --frobnicate

with_600_mb=(bash -c 'ulimit -v 600000; exec "$@"' bash)
check refuses --around "'640'" GB available "would fit" -- \
  "${with_600_mb[@]}" "$cylinder" --around 640
check refuses --around "'2000'" "16 ... 640" -- "$cylinder" --around 2000

# 3. A solve that does not succeed says so.
run "$cylinder" --around 16 --loading 0.052 --continuation natural  # beyond the yield load
check expect_code 1
check expect_text stderr step_too_small "F = 0.0501"
check expect_text run/results/cylinder/summary.json '"status": "step_too_small"'
check leaves cylinder summary.json path.csv sweep.pvd checkpoint.bin
check expect_text run/results/cylinder/summary.json '"results": {}'

# A folder holds one run and nothing older: neither what a failed run does not write nor its pictures.
run "$cylinder" --around 16 --loading 0.02 --lambda-r 1e-2 --plot
for file in .drag.png.part .flow_0002.vtu.part notes.txt; do touch "$work/run/results/cylinder/$file"; done
run_again "$cylinder" --around 16 --loading 0.03 --max-points 2 --lambda-r 1e-4 --continuation arclength
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
drag=$(result drag) velocity=$(result mean_velocity) factorisations=$(grep factorisations \
  "$work/run/results/cylinder/summary.json")
run "${flow[@]}" --max-points 3
check expect_code 1
check expect_text stderr out_of_points
check expect_text run/results/cylinder/summary.json '"status": "out_of_points"'
check has_file checkpoint.bin
cp "$work/run/results/cylinder/path.csv" "$work/begun.csv"
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
check begins_like "$work/begun.csv" path.csv
check_fails begins_like "$work/run/results/cylinder/sweep.csv" path.csv
check_fails begins_like "$work/run/results/cylinder/path.csv" path.csv  # nothing new
check_fails expect_text run/results/cylinder/summary.json "$factorisations"  # fewer than at once
check_fails few_factorisations
check_fails agrees_to_1e_8 "$(result wall_force)" "$drag"
cp "$work/run/results/cylinder/sweep.csv" "$work/sweep.csv"
run_again "${flow[@]}" --resume  # all is done
check cmp "$work/sweep.csv" "$work/run/results/cylinder/sweep.csv"
check expect_code 0
check agrees_to_1e_8 "$(result drag)" "$drag"
# The path may be gone on with in another way.
run "${flow[@]}" --max-points 3
check expect_code 1
run_again "${flow[@]/arclength/primal-dual}" --resume
check expect_code 0
check agrees_to_1e_8 "$(result drag)" "$drag"
# Or just before the last loading was written down: nothing is left to follow.
LC_ALL=C sed -i '1s/"stage":"reached","sweep":\[[^]]*\]/"stage":"loading","sweep":[]/
1s/\("loadings":\)\[[^]]*\]/\1[0.045]/' "$work/run/results/cylinder/checkpoint.bin"
run_again "$cylinder" --around 16 --loading 0.045 --continuation arclength --resume
check expect_code 0
check few_factorisations
check agrees_to_1e_8 "$(result drag)" "$drag"
echo broken >"$work/run/results/cylinder/checkpoint.bin"
run_again "${flow[@]}" --resume
check expect_code 2
check expect_text stderr "not a checkpoint"

# 6. Loadings of a sweep are short decimals; one loading alone is drawn without complaint.
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

# 7. Negative controls.
check_fails refuses --around -- "$cylinder" --around 16 --loading 0.01
check_fails has_results no_such_result
check_fails has_file no_such_file

finish
