#!/usr/bin/env bash
# Manufactured flows from outside: sample runs, errors that fall as they should, wrong input.
# usage: manufactured_cli_test.sh MANUFACTURED SOURCE_FOLDER
set -u
manufactured=$1 source_folder=$2 scene=manufactured
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

has_order() {  # ORDER COARSE FINE: log2 of their ratio, to 0.25
  awk -v order="$1" -v a="$2" -v b="$3" \
    'BEGIN { exit !(a > 0 && b > 0 && (log(a / b) / log(2) - order)^2 <= 0.25^2) }' ||
    { echo "'$2' and '$3' are not of order $1"; return 1; }
}

# 1. The sample runs of the program's header.
check_samples "$manufactured" "$source_folder/manufactured_main.cpp" fields

# 2. Orders 3, 2 and 2, under any law, in the plane and in space.
while read -r n options; do
  declare -A coarse=()
  # shellcheck disable=SC2086  # words, as a user types them
  check succeeds manufactured "$manufactured" --elements "$n" $options
  for key in error_velocity_l2 error_velocity_h1 error_pressure_l2; do coarse[$key]=$(result $key); done
  # shellcheck disable=SC2086
  check succeeds manufactured "$manufactured" --elements $((2 * n)) $options
  check has_order 3 "${coarse[error_velocity_l2]}" "$(result error_velocity_l2)"
  check has_order 2 "${coarse[error_velocity_h1]}" "$(result error_velocity_h1)"
  check has_order 2 "${coarse[error_pressure_l2]}" "$(result error_pressure_l2)"
  check_fails has_order 2 "${coarse[error_velocity_l2]}" "$(result error_velocity_l2)"
done <<'END'
10 --mesh stretched
10 --mesh sector --flow turning --regularisation papanastasiou --no-inertia
4 --model space --mesh distorted --flow turning
END
check expect_text run/results/manufactured/summary.json '"scene": "manufactured"' \
  '"model": "space"' '"mesh": "distorted"' '"lambda_r": 0.5' '"inertia": true' divergence \
  '"condensed_unknowns"' '"status": "converged"'
check leaves manufactured summary.json newton.csv
# A plain penalty of some size takes the order of the pressure away: the flow solves another problem.
check succeeds manufactured "$manufactured" --elements 8 --penalty plain --lambda-p 1e-3
coarse=$(result error_pressure_l2)
check succeeds manufactured "$manufactured" --elements 16 --penalty plain --lambda-p 1e-3
check_fails has_order 2 "$coarse" "$(result error_pressure_l2)"

# 3. Any number of threads gives the same digits.
check succeeds manufactured "$manufactured" --model space --elements 3 --threads 1
one=$(result error_pressure_l2)
check succeeds manufactured "$manufactured" --model space --elements 3 --threads 3
check test "$one" = "$(result error_pressure_l2)"

# 4. Wrong input.
while read -r option value; do
  check refuses "$option" "'$value'" -- "$manufactured" "$option" "$value"
done <<'END'
--model line
--flow still
--mesh hexagons
--elements 0
--elements 2001
--elements 2.5
--regularisation foo
--lambda-r 0
--lambda-p 2
--penalty none
--friction 1,2
--method interior-point
--tangent flat
--tolerance 0.1
--threads 0
END
check refuses "--mesh: 'sector'" "--model space" uniform -- \
  "$manufactured" --model space --mesh sector
for option in "--tolerance 1e-8" "--max-iterations 5" "--output elsewhere"; do
  # shellcheck disable=SC2086
  check refuses "${option%% *}: not used by --check-jacobian" -- \
    "$manufactured" --elements 2 --check-jacobian $option
done
check refuses --frobnicate -- "$manufactured" --frobnicate
if can_limit_memory "$manufactured"; then
  check refuses --elements "'400'" GB available "would fit" -- \
    bash -c 'ulimit -v 1200000; exec "$@"' bash "$manufactured" --model space --elements 400
fi

# 5. A solve that does not succeed says so; so does a Jacobian check.
run "$manufactured" --elements 4 --max-iterations 1
check expect_code 1
check expect_text stderr stagnated "--check-jacobian"
check expect_text run/results/manufactured/summary.json '"results": {}' stagnated
check leaves manufactured summary.json newton.csv
for model in plane space; do
  check succeeds manufactured "$manufactured" --model $model --elements 1 --check-jacobian
  for tangent in wrong-sign frozen; do
    run "$manufactured" --model $model --elements 1 --check-jacobian --tangent $tangent
    check expect_code 1
    check expect_text stdout WRONG
  done
done

check refuses "--plot: not used by --model space" -- "$manufactured" --model space --plot

# 6. A folder holds one run.
check holds_one_run manufactured "$manufactured" --elements 3
check says_when_stdout_is_full "$manufactured" --elements 3
check_fails refuses --elements -- "$manufactured" --elements 3

finish
