#!/usr/bin/env bash
# Chute and inclined plane from outside: sample runs, models, wrong input, limits of existence.
# usage: unidirectional_cli_test.sh CHUTE BAGNOLD SOURCE_FOLDER
set -u
chute=$1 bagnold=$2 source_folder=$3
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

# 1. The sample runs of the programs' headers.
check_samples "$chute" "$source_folder/chute_main.cpp" profile
check_samples "$bagnold" "$source_folder/bagnold_main.cpp" profile

is_within() {  # BOUND A B: |A - B| <= BOUND |B|
  awk -v bound="$1" -v a="$2" -v b="$3" \
    'BEGIN { exit !(a != "" && b != "" && (a - b)^2 <= (bound * b)^2) }' ||
    { echo "'$2' and '$3' are further apart than $1"; return 1; }
}

# 2. The richer models find the flow of the line, and say what they are.
measured="max_velocity error_l2 error_nodal_max error_shear_rate_l2 error_shear_rate_max error_stress_max"
for scene in chute bagnold; do
  program=${!scene}
  check succeeds $scene "$program" --elements 8 --lambda-r 1e-4
  check expect_text run/results/$scene/summary.json '"model": "line"' '"unknowns": 17'
  check_fails expect_text run/results/$scene/summary.json cross_flow condensed_unknowns
  declare -A on_a_line=()
  for key in $measured; do on_a_line[$key]=$(result $key); done
  for model in plane space; do
    check succeeds $scene "$program" --elements 8 --lambda-r 1e-4 --model $model
    check expect_text run/results/$scene/summary.json "\"model\": \"$model\"" condensed_unknowns \
      '"penalty": "iterated"'
    check expect_text stdout "a line gives the same flow" "--model line"
    for key in $measured; do check is_within 1e-7 "$(result $key)" "${on_a_line[$key]}"; done
    for key in cross_flow dynamic_pressure change_along; do
      check is_within 1e-9 "$(awk -v x="$(result $key)" 'BEGIN { print 1 + x }')" 1
    done
    check leaves $scene summary.json profile.csv newton.csv
  done
  # As the paper solves it.
  check succeeds $scene "$program" --model space --elements 5 --lambda-r 1e-6 --penalty plain \
    --lambda-p 1e-6 --precision plain --no-continuation --max-iterations 60
  check expect_text run/results/$scene/summary.json '"penalty": "plain"' '"precision": "plain"'
done
check_fails is_within 1e-7 "$(scene=bagnold && result error_l2)" "${on_a_line[error_l2]}"

# 3. Wrong input.
for program in "$chute" "$bagnold"; do
  for value in 0 -3 abc 1e9 2.5 ''; do
    check refuses --elements "'$value'" "1 ... 100000" -- "$program" --elements "$value"
  done
  check refuses --elements missing -- "$program" --elements
  check refuses --lambda-r "'0'" 1e-15 -- "$program" --lambda-r 0
  check refuses --lambda-r "'nan'" 1e-15 -- "$program" --lambda-r nan
  check refuses --grading "'0.5'" "1 ... 10" -- "$program" --grading 0.5
  check refuses --grading "'10'" "1 ... 7.00" -- "$program" --elements 100 --grading 10
  check refuses --regularisation "'foo'" papanastasiou -- "$program" --regularisation foo
  check refuses --model "'sectn'" "line, plane, space" -- "$program" --model sectn
  check refuses --method "'foo'" interior-point -- "$program" --method foo
  check refuses --friction "'1,2'" "0.001 ... 10" -- "$program" --friction 1,2
  check refuses --friction "'x'" "0.001 ... 10" -- "$program" --friction 1,2,x
  check refuses --friction "'99'" "0.001 ... 10" -- "$program" --friction 1,99,1
  check refuses --output "'$work/file/below'" -- "$program" --output "$work/file/below"
  check refuses --frobnicate -- "$program" --frobnicate
  check refuses surplus -- "$program" surplus
done
check refuses --angle "'2'" 1.57 -- "$bagnold" --angle 2
check refuses --align -- "$bagnold" --align
check refuses --pressure "'-1'" -- "$chute" --pressure -1
check refuses --align "'2'" 0.99 -- "$chute" --align 2
check refuses --align -- "$chute" --align --pressure 40
check refuses --elements "'1'" -- "$chute" --align --elements 1
for program in "$chute" "$bagnold"; do
  for model in plane space; do
    check refuses "--method: 'interior-point'" "--model $model" "only newton" -- \
      "$program" --model $model --method interior-point
    check refuses "--line-search: not used by --model $model" -- \
      "$program" --model $model --line-search none
    check refuses "--tolerance: not used by --check-jacobian" -- \
      "$program" --model $model --elements 2 --check-jacobian --tolerance 1e-8
  done
  while read -r option value; do
    check refuses "$option: not used by --model line; add --model plane" -- "$program" $option $value
  done <<'END'
--penalty plain
--lambda-p 1e-6
--threads 2
END
  check refuses --lambda-p "'0'" 1e-14 -- "$program" --model plane --lambda-p 0
done
for program in "$chute" "$bagnold"; do
  # Options that the method, or a check instead of a solve, has no use for.
  while read -r option value; do
    # shellcheck disable=SC2086  # no word where there is no value
    check refuses "$option: not used by --method interior-point; add --method newton" -- \
      "$program" --method interior-point $option $value
  done <<'END'
--regularisation simple
--lambda-r 1e-3
--precision plain
--line-search none
--tangent frozen
--no-continuation
END
  while read -r option value; do
    # shellcheck disable=SC2086
    check refuses "$option: not used by --check-jacobian" -- \
      "$program" --elements 3 --check-jacobian $option $value
  done <<'END'
--tolerance 1e-8
--max-iterations 5
--precision plain
--line-search none
--no-continuation
--output elsewhere
--plot
END
  # Words that are nearly right, too many or too few.
  check refuses --regularization "did you mean --regularisation?" -- "$program" --regularization x
  check refuses --lambda_r "did you mean --lambda-r?" -- "$program" --lambda_r 1e-3
  check refuses "'newtn'" "did you mean newton?" -- "$program" --method newtn
  check refuses "'20' '40' belong to no option" -- "$program" --elements 10 20 40
  check refuses "--plot: it is given twice" -- "$program" --plot --plot
  check refuses "--output: its value is missing" -- "$program" --output --plot
  check refuses "--output: '' is no value" -- "$program" --output ''
  check refuses "--output" "must be a folder" -- "$program" --output "$work/file"
  for value in '' 0.383,0.26,0.279, ,0.26,0.279 0.383,,0.279; do
    check refuses --friction "''" -- "$program" --friction "$value"
  done
  for value in 0x10 +10 ' 10' 1_000 1,000 10.0 1e1; do
    check refuses --elements "'$value'" "1 ... 100000" -- "$program" --elements "$value"
  done
  for value in +1 0x1p-3 ' 1' 1e-400; do
    check refuses --lambda-r "'$value'" 1e-15 -- "$program" --lambda-r "$value"
  done
done
check refuses --angle "'23'" "radians (or 23deg)" -- "$bagnold" --angle 23
check refuses --align "''" -- "$chute" --align ''

# 4. Numbers are decimal, angles in degrees where they say so.
for value in 0100 100; do
  check succeeds chute "$chute" --elements $value
  check expect_text run/results/chute/summary.json '"elements": 100,'
done
check succeeds bagnold "$bagnold" --angle 23deg --elements 08
check expect_text run/results/bagnold/summary.json '"angle": 0.40142572795869' '"elements": 8,'
check_fails expect_text run/results/bagnold/summary.json '"angle": 0.4,'

# A velocity among the smallest doubles is drawn like any other.
check succeeds chute "$chute" --elements 10 --plot --regularisation barker-gray --friction 1.0922,3.7419,2.88287
# The richer models have fields, the line has none.
for model in plane space; do
  check succeeds bagnold "$bagnold" --model $model --elements 4 --plot
  ! command -v gnuplot >/dev/null || check test -s "$work/run/results/bagnold/fields.png"
done
check refuses "--fields: not used by --model line" -- "$bagnold" --plot --fields speed
check refuses "--window: not used by a run without --plot" -- \
  "$bagnold" --model plane --window 0,0,1,1

# 5. A folder holds one run and nothing older.
pictures="profile.dat profile.gp profile.png profile.svg"
run "$chute" --elements 5 --plot
touch "$work/run/results/chute/notes.txt" "$work/run/results/chute/.profile.png.part"
# shellcheck disable=SC2086
! command -v gnuplot >/dev/null ||
  check leaves chute summary.json profile.csv newton.csv notes.txt $pictures .profile.png.part
run_again "$chute" --elements 0
check test -e "$work/run/results/chute/.profile.png.part"  # bad input removes nothing
run_again "$chute" --elements 5 --method interior-point
check leaves chute summary.json profile.csv interior_point.csv notes.txt
for failing in "--max-iterations 1 --no-continuation" "--pressure 20"; do
  # shellcheck disable=SC2086
  run_again "$chute" --elements 5 --plot $failing
  check expect_code 1
  check_fails expect_text run/results/chute/summary.json max_velocity
  check_fails expect_text stdout velocity
done
check leaves chute summary.json notes.txt
check holds_one_run chute "$chute" --elements 5
check_fails leaves chute summary.json profile.csv
rm "$work/run/results/chute/profile.csv"
mkdir -p "$work/run/results/chute/profile.csv/in the way"
run_again "$chute" --elements 5
check expect_code 2
check expect_text stderr --output profile.csv
check leaves chute newton.csv profile.csv
check says_when_stdout_is_full "$chute" --elements 5
check says_when_stdout_is_full "$chute" --help
check_fails says_when_stdout_is_full "$chute" --elements 0
run bash -c '"$0" --elements 5 >&-' "$chute"  # closed
check expect_code 1

# 6. What became of gnuplot is told; an older picture does not stand in.
run "$chute" --elements 5 --plot
with_gnuplot 'echo no terminal >&2; exit 1' "$chute" --elements 5 --plot
check expect_code 0
check expect_text stdout "(no profile.png: gnuplot failed: no terminal)"
check leaves chute summary.json profile.csv newton.csv profile.dat profile.gp
if command -v gnuplot >/dev/null; then
  # Ctrl-C while a picture is drawn.
  with_gnuplot 'echo half; kill -INT $PPID; sleep 9' "$chute" --elements 5 --plot
  check test "$code" -gt 128
  check leaves chute newton.csv profile.csv profile.dat profile.gp
  run_again "$chute" --elements 5
  check leaves chute summary.json profile.csv newton.csv
fi

# 7. The limits of existence.
check has_no_steady_flow 0.571439 "$bagnold" --angle 0.6
check has_no_steady_flow 21.7729 "$chute" --pressure 20
check has_no_steady_flow 21.7729 "$chute" --pressure 20 --method interior-point
for model in plane space; do
  check has_no_steady_flow 0.571439 "$bagnold" --angle 0.6 --model $model
  check has_no_steady_flow 21.7729 "$chute" --pressure 20 --model $model
  check is_at_rest bagnold "$bagnold" --angle 0.3 --model $model --elements 5
  check is_at_rest chute "$chute" --pressure 40 --model $model --elements 5
done
check is_at_rest bagnold "$bagnold" --angle 0.3
check is_at_rest chute "$chute" --pressure 40
check is_at_rest chute "$chute" --pressure 40 --method interior-point

# 8. A solve that does not succeed says so; so does a Jacobian check.
run "$chute" --max-iterations 1 --no-continuation
check expect_code 1
check expect_text stderr stagnated
for model in plane space; do
  run "$chute" --model $model --elements 5 --max-iterations 1 --no-continuation
  check expect_code 1
  check expect_text stderr stagnated "--model line"
  check expect_text run/results/chute/summary.json '"results": {}' "\"model\": \"$model\""
  check leaves chute summary.json newton.csv
  for tangent in wrong-sign frozen; do
    run "$chute" --model $model --check-jacobian --tangent $tangent --elements 2
    check expect_code 1
    check expect_text stdout WRONG "is NOT the derivative"
  done
done
if can_limit_memory "$chute"; then
  check refuses --elements "'100000'" GB available "would fit" -- \
    bash -c 'ulimit -v 1200000; exec "$@"' bash "$chute" --model space --elements 100000
fi
# What is left then is of one problem, and no result.
run "$chute" --tangent frozen --elements 10 --max-iterations 60
check expect_code 1
check expect_text stdout "the last state is of lambda_r = 0.01"
check expect_text run/results/chute/summary.json '"results": {}' '"lambda_r": 0.01,' \
  '"status": "stagnated"'
check_fails expect_text run/results/chute/summary.json '"results": {"'
# A loose tolerance is one of the answer, or refused.
check refuses --tolerance "'0.01'" "1e-16 ... 0.001" -- "$chute" --tolerance 0.01
check succeeds chute "$chute" --tolerance 1e-3 --elements 40 --lambda-r 1e-8
check expect_text stdout "largest velocity 1.23"
for tangent in wrong-sign frozen; do
  run "$chute" --check-jacobian --tangent $tangent --elements 5
  check expect_code 1
  check expect_text stdout WRONG "is NOT the derivative"
done
check succeeds chute "$chute" --check-jacobian
check succeeds chute "$chute" --check-jacobian --tangent primal-dual --pressure 20 --lambda-r 1e-10
check succeeds bagnold "$bagnold" --check-jacobian --grading 2

# 9. Negative controls: each check notices what it is there for.
check_fails refuses --elements -- "$chute" --elements 5
check_fails refuses --nonsense -- "$chute" --elements 0
check_fails refuses no_steady_state -- "$chute" --pressure 20
check_fails succeeds chute "$chute" --elements 0
check_fails succeeds chute "$chute" --output elsewhere
check_fails has_no_steady_flow 21.7729 "$chute" --pressure 28
check_fails is_at_rest chute "$chute" --pressure 28

finish
