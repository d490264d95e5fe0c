#!/usr/bin/env bash
# The program heap from outside: sample runs, wrong input, limits of existence.
# usage: cli_test.sh HEAP SOURCE_FOLDER
set -u
heap=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

# 1. The sample runs of the program's header.
check_samples "$heap" "$source_folder/heap_main.cpp" section

# 2. Wrong input.
for value in 0x5 5x0 7 7x x 7x-3 abc 1e9x2; do
  check refuses --elements "'$value'" -- "$heap" --elements "$value"
done
check refuses --angle "'2'" 1.57 -- "$heap" --angle 2
check refuses --flow-rate "'-1'" -- "$heap" --flow-rate -1
check refuses --angle --flow-rate -- "$heap" --angle 0.4 --flow-rate 10
check refuses --model "'4d'" section -- "$heap" --model 4d
check refuses --wall "'ice'" no-slip friction -- "$heap" --wall ice
check refuses --lambda-r "'0'" -- "$heap" --lambda-r 0
check refuses --frobnicate -- "$heap" --frobnicate
check refuses --output -- "$heap" --elements 3x4 --output "$work/file/below"

# 3. The limits of existence.
check has_no_steady_flow 0.571439 "$heap" --elements 3x4 --angle 0.7
check is_at_rest heap "$heap" --elements 7x10 --angle 0.3

# 4. A solve that does not succeed says so; so does a Jacobian check.
run "$heap" --elements 7x10 --max-iterations 2
check expect_code 1
check expect_text stderr stagnated
run "$heap" --elements 3x4 --method newton --check-jacobian --tangent wrong-sign
check expect_code 1
check expect_text stdout WRONG

# 5. Negative controls.
check_fails refuses --elements -- "$heap" --elements 3x4
check_fails is_at_rest heap "$heap" --elements 7x10 --angle 0.42

finish
