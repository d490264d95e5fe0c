#!/usr/bin/env bash
# The program study from outside: what it leaves, what it refuses, records that are merged.
# usage: cli_test.sh STUDY SOURCE_FOLDER
set -u
study=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../../common/testing/cli_checks.sh"

# leaves_study KIND-SCENE NUMBER_OF_CASES: the files of a study, with a row for every case.
leaves_study() {
  local folder=$work/run/results/study/$1 name
  for name in cases.csv study.json index.html; do
    [ -s "$folder/$name" ] || { echo "no $name"; return 1; }
  done
  [ "$(wc -l <"$folder/cases.csv")" -eq $(($2 + 1)) ] || { echo "not $2 cases"; return 1; }
  [ "$(find "$folder/cases" -name '*.json' | wc -l)" -eq "$2" ] || { echo "not $2 records"; return 1; }
}

# 1. The sample command lines.
samples=0
while read -r options; do
  samples=$((samples + 1))
  # shellcheck disable=SC2086  # words, as a user types them
  run "$study" $options
  check expect_code 0
  check expect_empty stderr
  check expect_text stdout "arrive" "results in results/study/"
done < <(sed -n 's#^//   study ##p' "$source_folder/study_main.cpp")
check test "$samples" -ge 4

# 2. Cases, records, figures; a second run solves nothing.
run "$study" converge heap --elements 4x4,8x8,16x16 --method newton,interior-point --lambda-r 1e-4
check expect_code 0
check leaves_study converge-heap 6
folder=$work/run/results/study/converge-heap
check grep -q '"kind": "converge"' "$folder/study.json"
check grep -q '"points": ' "$folder/study.json"
check test "$(head -n 1 "$folder/cases.csv" | cut -d , -f 1-5)" = \
  elements,method,status,iterations,factorisations
if command -v gnuplot >/dev/null; then
  for format in svg png pdf; do check test -s "$folder/errors.$format"; done
fi
cp -r "$folder" "$work/elsewhere"
stamp=$(cat "$folder"/cases/*.json | cksum)
run_again "$study" converge heap --elements 4x4,8x8,16x16 --method newton,interior-point \
  --lambda-r 1e-4
check expect_code 0
check test "$(cat "$folder"/cases/*.json | cksum)" = "$stamp"

# 3. Records made elsewhere: by the lines of --list, merged; one that is missing is told.
run "$study" converge heap --elements 4x4,8x8,16x16 --method newton,interior-point --lambda-r 1e-4 \
  --merge "$work/elsewhere"
check expect_code 0
check expect_text stdout "6 of 6 arrive"
mkdir "$work/there"
mv "$(find "$work/elsewhere/cases" -name '*.json' | head -n 1)" "$work/there"
for folders in "$work/elsewhere $work/there" "$work/there,$work/elsewhere"; do
  # shellcheck disable=SC2086  # words
  run "$study" converge heap --merge $folders --elements 4x4,8x8,16x16 \
    --method newton,interior-point --lambda-r 1e-4
  check expect_code 0
  check expect_text stdout "6 of 6 arrive"
done
run_again "$study" converge heap --elements 4x4,8x8,16x16 --method newton,interior-point \
  --lambda-r 1e-4 --merge "$work/elsewhere"
check expect_code 1
check expect_text stderr "no record"
run "$study" sweep heap --elements 4x4 --angle 0.39:0.42:4 --list
check expect_code 0
check test -z "$(ls -A "$work/run")"
check test "$(wc -l <"$work/stdout")" -eq 4
(cd "$work/run" && bash "$work/stdout" >/dev/null)
run_again "$study" sweep heap --elements 4x4 --angle 0.39:0.42:4 --merge results/study/sweep-heap
check expect_code 0
check expect_text stdout "4 of 4 arrive"

# 4. A case that does not arrive is a row with its end; one that is killed a failure of the study.
run "$study" sweep heap --elements 4x4 --angle 0.4,0.6,0.7
check expect_code 0
check expect_text stdout "no_steady_state"
check grep -q no_steady_state "$work/run/results/study/sweep-heap/cases.csv"
run "$study" sweep cylinder --around 64 --loading 0.05,0.052 --time-limit 1
check expect_code 1
check expect_text stderr "time limit"
check grep -q "time limit" "$work/run/results/study/sweep-cylinder/cases.csv"

# 5. An option that one method has no use for is left out of its cases, and no case is there twice.
run "$study" cost heap --elements 4x4 --method newton,interior-point --lambda-r 1e-4,1e-6 --list
check expect_code 0
check test "$(wc -l <"$work/stdout")" -eq 3

# 6. Wrong input, told before anything is solved or written.
check refuses "KIND: 'cots'" "did you mean cost?" -- "$study" cots heap
check refuses "SCENE: 'heep'" "did you mean heap?" -- "$study" cost heep
check refuses "--angel" "did you mean --angle?" -- "$study" sweep heap --angel 1
check refuses "--angle" "'9'" "0.001 ... 1.57" -- "$study" sweep heap --angle 0.4,9
check refuses "--angle: '0.4:0.5'" -- "$study" sweep heap --angle 0.4:0.5
check refuses "--elements" -- "$study" cost heap --elements 4x4,4
check refuses "--lambda-r: not used by --method interior-point" -- \
  "$study" sweep heap --lambda-r 1e-4,1e-5
check refuses "--quantity: 'speed'" -- "$study" sweep heap --angle 0.4,0.41 --quantity speed
check refuses "--plot: a study has no use" -- "$study" sweep heap --angle 0.4,0.41 --plot
check refuses "sweep: no option has several numbers" -- "$study" sweep heap
check refuses "ladder: it takes several values of --model" -- "$study" ladder heap
check refuses "--jobs" "'0'" -- "$study" cost heap --jobs 0
check refuses "SCENE" -- "$study" cost
check refuses "--merge: 'nowhere'" -- "$study" cost heap --elements 4x4,8x8 --merge nowhere

finish
