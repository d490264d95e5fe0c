#!/usr/bin/env bash
# The course from outside: its data, a student's tree, a blank, a solution and a usual mistake of the cheapest step,
# answers, scores, slides. `./course selftest` compiles all steps.
# usage: cli_test.sh PROJECT_FOLDER
set -u
project=$1
# shellcheck source=common/testing/cli_checks.sh
. "$project/common/testing/cli_checks.sh"
course=$project/course
tree=$work/tree
steps=$(ls "$project/verification/course/steps"/*.txt | wc -l)

# 1. Every step has sheet, tests, hints and mistakes whose text is in its solution once; a broken set is noticed.
run "$course" selftest --data
check expect_code 0
check expect_text stdout "step $steps: " "0 complaints"
mkdir "$work/broken"
cp -r "$project/course" "$project/common" "$project/verification" "$project/docs" "$work/broken"
broken=$work/broken/verification/course/steps
sed -i 's/^- law.mu_s \/ std::sqrt(square)/- law.mu_s \/ sqrt(square)/' "$broken"/3-*.txt
sed -i '0,/^hint /{/^hint /d}' "$broken"/2-*.txt
sed -i 's/^sheet .*/sheet 99-nothing.md/' "$broken"/1-*.txt
run "$work/broken/course" selftest --data 1 2 3
check expect_code 1
check expect_text stdout "the text of mistake 1 is not in the solution once" "fewer than three hints" "no sheet" "4 complaints"
sed -i 's|// end of course 5|// end|' "$work/broken/common/rheology/pressure_regularisation.hpp"
run "$work/broken/course" start "$work/never"
check expect_code 1

# 2. A student's tree: blanks, nothing of the solutions.
run "$course" start "$tree" --name "Ada L"
check expect_code 0
check expect_text stdout "$steps steps"
check test "$(grep -rl 'throw std::logic_error("step ' "$tree/common" "$tree/verification/harness" | wc -l)" = \
  "$(cd "$project" && grep -rlE --include='*.?pp' '^ *// course [0-9]+: ' common verification | wc -l)"
check test ! -e "$tree/docs/course/solutions"
check_fails grep -q "delta_mu \* inertial_number / (I0" "$tree/common/rheology/friction_law.cpp"

# 3. A blank fails its tests, a mistake is named, the solution passes; other steps do not matter.
law=$tree/common/rheology/friction_law.cpp
write_step_1() { sed -i '/course 1: /,/end of course 1/{/\/\/.*course/!d}' "$law"; sed -i "/course 1: /a $1" "$law"; }
run "$tree/course" check 1
check expect_code 1
check expect_text stdout "to be written: common/rheology/friction_law.cpp" "0 of $steps steps"
write_step_1 'return mu_s + mu_2() * (inertial_number / (inertial_number + I0)); // mine'
run "$tree/course" check
check expect_code 1
check expect_text stdout "passed  at rest friction is static" "failed  half of the rise"
run "$tree/course" hint 1
check expect_code 0
check expect_text stdout "the rise is delta_mu"
write_step_1 'return mu_s + ;'
run "$tree/course" check 1
check expect_code 1
check expect_text stdout "common/rheology/friction_law.cpp:22" "the compiler does not take it"
write_step_1 'return std::isinf(inertial_number) ? mu_2() : mu_s + delta_mu / (1 + I0 / inertial_number);'
run "$tree/course" check 1
check expect_code 0
check expect_text stdout "1 of $steps steps"
run "$tree/course" hint 2
check expect_text stdout "Hint 1 of 3"
run "$tree/course" hint 2
check expect_text stdout "Hint 2 of 3"
run "$tree/course" solution 2
check expect_text stdout "excess / margin"
sed -i 's|// end of course 2|// end|' "$law"
check refuses "friction_law.cpp" "is not as it was" -- "$tree/course" check 1

# 4. Answers, from a stand-in for the programs: own numbers, a tolerance, no garbage.
mkdir -p "$tree/build/release/bin"
printf '#!/bin/sh\nprintf "{\\n  \\"results\\": {\\n    \\"max_velocity\\": 0.5\\n  }\\n}\\n" >"$(for last; do :; done; mkdir -p "$last"; echo "$last")/summary.json"\n' \
  >"$tree/build/release/bin/chute"
cp "$tree/build/release/bin/chute" "$tree/build/release/bin/cylinder"
chmod +x "$tree/build/release/bin"/*
run "$tree/course" answer 2g
check expect_text stdout "lambda_r = 0.00"
check_fails expect_text stdout '$'
first=$(cat "$work/stdout")
echo "Someone else" >"$tree/.course/name"
run "$tree/course" answer 2g
check test "$(cat "$work/stdout")" != "$first"
for value in 0.5 0.504 +5e-1; do
  run "$tree/course" answer 2g $value
  check expect_code 0
done
for value in 0.51 -0.5 0; do
  run "$tree/course" answer 2g $value
  check expect_code 1
  check_fails expect_text stdout 0.5
done
for value in nan inf 1e999 0x1 abc '' 1,5 '0.5;echo'; do
  check refuses "is no number" -- "$tree/course" answer 2g "$value"
done
check refuses "is no question" -- "$tree/course" answer 77z 1

# 5. Scores.
run "$tree/course" score
check expect_code 0
check expect_text stdout "2 of "
check grep -qx "Someone else,step 1,yes,3,1,no" "$tree/score.csv"
check grep -qx "Someone else,step 2,no,0,2,seen" "$tree/score.csv"
check grep -qx "Someone else,answer 2g,yes,6,0,no" "$tree/score.csv"
run "$course" scores "$tree/score.csv"
check expect_code 0
check expect_text stdout "Someone else"
check refuses "is no score file" -- "$course" scores "$project/run"

# 6. Slides of whatever figures there are.
mkdir -p "$work/report/orders"
echo '<svg xmlns="http://www.w3.org/2000/svg"/>' >"$work/report/orders/all.svg"
echo '<figure><a href="all.svg"><img src="all.svg" alt="Orders of all. They fall."></a><figcaption>What is <b>seen</b></figcaption></figure>' >"$work/report/orders/index.html"
run "$course" slides "$work/report"
check expect_code 0
check grep -q "Orders of all" "$work/report/slides.html"
check grep -q "What is seen" "$work/report/slides.html"

# 7. Wrong input.
check refuses "'chekc'" "check" -- "$course" chekc
check refuses "no student's tree" -- "$course" check 1
check refuses "is there already" -- "$course" start "$work"
check refuses "outside" -- "$course" start "$project/docs/mine"
check refuses "'--nam'" -- "$course" start "$work/new" --nam x
check refuses "commas" -- "$course" start "$work/new" --name 'a,b'
check refuses "'17'" "1 ... $steps" -- "$tree/course" check 17
check refuses "'x'" -- "$tree/course" hint x
check refuses "the step is missing" -- "$tree/course" solution
check refuses "is no folder" -- "$course" slides "$work/nothing"
check refuses "holds no figures" -- "$course" slides "$project/common/io"
finish
