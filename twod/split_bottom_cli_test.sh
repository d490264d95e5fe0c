#!/usr/bin/env bash
# The split-bottom cell's program from outside: sample runs, wrong input, what it leaves.
# usage: split_bottom_cli_test.sh PROGRAM SOURCE_FOLDER
set -u
program=$1 source_folder=$2 scene=split-bottom
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

within() {  # VALUE REFERENCE ROOM
  awk -v a="$1" -v b="$2" -v room="$3" 'BEGIN { exit !((a - b) ^ 2 <= room ^ 2) }' ||
    { echo "'$1' is not within $3 of $2"; return 1; }
}

# 1. The sample runs of the program's header, and known answers (Rc and the integral by shooting).
check_samples "$program" "$source_folder/split_bottom_main.cpp" zone
run "$program" --height 0.5 --elements 40 --plot
check expect_code 0
check within "$(result zone_radius)" 0.85408445 1e-3
check within "$(result torque_integral)" 0.11679624 2e-3
check within "$(result least_resistance_radius)" 0.85408445 1e-7
check_fails within "$(result zone_radius)" 0.76758500 1e-2
check leaves split-bottom summary.json interior_point.csv zone.csv surface.csv zone.dat zone.gp zone.png zone.svg
run_again "$program" --height 0.8 --elements 20 --method newton  # a dome: the surface turns as one
check expect_code 0
check leaves split-bottom summary.json newton.csv zone.csv surface.csv
check within "$(result turning_centre)" 1 1e-2
check expect_text stdout "zone at the surface at none"

# 2. Wrong input.
for value in 0 3 x nan; do check refuses --height "'$value'" "0.01 ... 2" -- "$program" --height $value; done
for value in 1 11 ''; do check refuses --outer-radius "'$value'" "1.01 ... 10" -- "$program" --outer-radius "$value"; done
for value in 0 -1 2; do check refuses --rate "'$value'" "1e-09 ... 1" -- "$program" --rate $value; done
for value in 1 1001 2.5; do check refuses --elements "'$value'" "2 ... 1000" -- "$program" --elements $value; done
check refuses --grading -- "$program" --grading 10 --elements 1000
check refuses "--lambda-r: not used by --method interior-point" -- "$program" --lambda-r 1e-9
check refuses "--plot: not used by --check-jacobian" -- "$program" --check-jacobian --plot
check refuses --heigth "did you mean --height?" -- "$program" --heigth 1

# 3. A solve that does not succeed says so, and leaves no older success.
run "$program" --elements 10
run_again "$program" --elements 10 --max-iterations 3
check expect_code 1
check expect_text stderr stagnated
check expect_text run/results/split-bottom/summary.json '"results": {}'
check leaves split-bottom summary.json interior_point.csv
check holds_one_run split-bottom "$program" --elements 4
finish
