#!/usr/bin/env bash
# The programs from outside: sample runs, wrong input, limits of existence.
# usage: cli_test.sh CHUTE BAGNOLD SOURCE_FOLDER
set -u
chute=$1 bagnold=$2 source_folder=$3
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

# 1. The sample runs of the programs' headers.
check_samples "$chute" "$source_folder/chute_main.cpp" profile
check_samples "$bagnold" "$source_folder/bagnold_main.cpp" profile

# 2. Wrong input.
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

# 3. The limits of existence.
check has_no_steady_flow 0.571439 "$bagnold" --angle 0.6
check has_no_steady_flow 21.7729 "$chute" --pressure 20
check has_no_steady_flow 21.7729 "$chute" --pressure 20 --method interior-point
check is_at_rest bagnold "$bagnold" --angle 0.3
check is_at_rest chute "$chute" --pressure 40
check is_at_rest chute "$chute" --pressure 40 --method interior-point

# 4. A solve that does not succeed says so; so does a Jacobian check.
run "$chute" --max-iterations 1 --no-continuation
check expect_code 1
check expect_text stderr stagnated
run "$chute" --check-jacobian --tangent wrong-sign --elements 5
check expect_code 1
check expect_text stdout WRONG

# 5. Negative controls: each check notices what it is there for.
check_fails refuses --elements -- "$chute" --elements 5
check_fails refuses --nonsense -- "$chute" --elements 0
check_fails refuses no_steady_state -- "$chute" --pressure 20
check_fails succeeds chute "$chute" --elements 0
check_fails succeeds chute "$chute" --output elsewhere
check_fails has_no_steady_flow 21.7729 "$chute" --pressure 28
check_fails is_at_rest chute "$chute" --pressure 28

finish
