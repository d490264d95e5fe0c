#!/usr/bin/env bash
# The program verify from outside: its parts run one by one and merged, wrong input, parts that are
# killed, a run that is killed.
# usage: cli_test.sh VERIFY SOURCE_FOLDER STUDY...    (the studies that ctest runs)
set -u
verify=$1 source_folder=$2
shift 2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

# 1. ctest runs every study of the registry, --list has a line for every part, and --help tells what
# the studies ask and how long they take.
run "$verify" --list
check expect_code 0
check expect_empty stderr
check test -z "$(ls -A "$work/run")"
check test "$(cut -d ' ' -f 2 "$work/stdout" | cut -d / -f 1 | uniq)" = "$(printf '%s\n' "$@")"
check test "$(cut -d ' ' -f 2,3- "$work/stdout" | sort | uniq -d | wc -l)" -eq 0
lines=$(wc -l <"$work/stdout")
check test "$lines" -gt $#
run "$verify" --full --list
check test "$(grep -c -- ' --full --output results/parts/' "$work/stdout")" -eq "$lines"
run "$verify" --help
for study in "$@"; do
  check grep -qP "^  $study +.*\? \([0-9.]+ (s|min), [0-9.]+ (s|min)\)$" "$work/stdout"
done
run "$verify" orders --list
check expect_text stdout orders/section
check_fails expect_text stdout jacobian

# checks FOLDER: what is checked by each part of a run and whether it holds, not the values.
checks() {
  (cd "$1" && find . -name checks.csv | sort | xargs sed 's/,[^,]*,[^,]*,[^,]*,\([a-z]*\)$/ \1/')
}
# verdicts: what a run says of the studies, not how long they took.
verdicts() { grep -Ev "CPU time|report:" "$work/stdout" | sed 's/ ([0-9.]* CPU s)//'; }

# 2. The parts of a cheap study and of another one, run by their lines and merged, are a direct run.
some=(paper/lines stability/interior-point stability/round-off)
run "$verify" "${some[@]}" --jobs 1 --output direct
check expect_code 0
direct=$(verdicts)
run_again "$verify" "${some[@]}" --list --output 'the parts'
check expect_code 0
check test "$(wc -l <"$work/stdout")" -eq 3
cp "$work/stdout" "$work/run/lines"
for task in 1 2 3; do  # as docs/studies.md gives them to Slurm
  SLURM_ARRAY_TASK_ID=$task run_again sh -c 'eval "$(sed -n ${SLURM_ARRAY_TASK_ID}p lines)"'
  check expect_code 0
done
run_again "$verify" "${some[@]}" --merge 'the parts' --output merged
check expect_code 0
check test "$(verdicts)" = "$direct"
check test -n "$(checks "$work/run/direct")"
check test "$(checks "$work/run/merged")" = "$(checks "$work/run/direct")"
body() {  # FOLDER: of a page, but for what is timed
  sed -n '/<main>/,/<h2 id=checks>/p' "$work/run/$1/$page.html" | grep -v -e ' took ' -e '<td>1x1x'
}
for page in paper stability; do
  check test -n "$(body direct)"
  check test "$(body merged)" = "$(body direct)"
done
check grep -qF "Every check holds." "$work/run/merged/index.html"
run_again "$verify" "${some[@]}" --merge 'the parts/paper-lines' 'the parts/stability-interior-point' \
  'the parts/stability-round-off' --output merged
check expect_code 0
check test "$(verdicts)" = "$direct"

# A chapter that the program mutants left joins them.
mkdir "$work/run/campaign"
cp -r "$work/run/the parts/paper-lines/paper/lines" "$work/run/campaign/mutants"
run_again "$verify" --merge 'the parts' campaign --output merged
check expect_text stdout "mutants: "
check test -s "$work/run/merged/mutants.html"
run_again "$verify" "${some[@]}" --merge 'the parts' --output merged
check test "$(verdicts)" = "$direct"
check test -z "$(grep -o mutants: "$work/stdout")"
check test ! -e "$work/run/merged/mutants.html"

# What is missing has not passed, nor has what is torn; the report is written.
run_again "$verify" paper/lines stability --merge 'the parts' --output merged
check expect_code 1
check expect_text stdout "stability/maps was not run" "report:"
check grep -qF "stability/maps was not run" "$work/run/merged/stability.html"
truncate -s 100 "$work/run/the parts/paper-lines/paper/lines/chapter.json"
run_again "$verify" "${some[@]}" --merge 'the parts' --output merged
check expect_code 1
check expect_text stdout "paper/lines did not end: it is torn" "report:"
check grep -qF "Some checks do not hold" "$work/run/merged/index.html"

# merge_refuses TEXT... -- OPTIONS...: in the folder of the last run, which stays as it is.
merge_refuses() {
  local texts=() before
  while [ "$1" != -- ]; do texts+=("$1"); shift; done
  shift
  before=$(ls -lR --full-time "$work/run")
  run_again "$verify" "$@" --output refused
  expect_code 2 && expect_empty stdout && expect_text stderr "${texts[@]}" || return 1
  [ "$(wc -l <"$work/stderr")" -eq 1 ] || { echo "stderr is not one line"; return 1; }
  [ "$(ls -lR --full-time "$work/run")" = "$before" ] || { echo "files were touched"; return 1; }
}
mkdir "$work/run/empty"
check merge_refuses "empty" "holds no part" -- --merge empty
check merge_refuses "nowhere" "is no folder" -- --merge 'the parts' nowhere
check merge_refuses "paper/lines is there twice" "'direct/paper/lines'" -- --merge direct 'the parts'
check merge_refuses "--full" -- --merge direct --full
run_again "$verify" stability/interior-point --full --output full
check expect_code 0
run_again "$verify" stability/interior-point --full --merge full --output merged
check expect_code 0
check merge_refuses "stability/interior-point was run with --full, " " without" -- \
  paper/lines stability/interior-point --merge full 'the parts/stability-round-off'

# Curves that a user gives are drawn, in the parts too that run by their lines, and merged.
given="$work/given.csv"
printf 'figure,panel,curve,x,y\n8,a,made up,0.4,1\n8,a,made up,0.5,7\n12,c,later,1,1\n' >"$given"
run "$verify" paper/lines --data "$given" --list
check test "$(grep -cF -- "--data $given" "$work/stdout")" -eq 1
cp "$work/stdout" "$work/run/lines"
run_again sh lines
check expect_code 0
check grep -qF "made up" "$work/run/results/parts/paper-lines/paper/lines/fig8.dat"
run_again "$verify" paper/lines --merge results/parts --output merged
check expect_code 0
check grep -qF "made up" "$work/run/merged/paper/lines/fig8.dat"
check grep -rqF "Points given with --data: 2." "$work/run/merged" --include="*.html"
run "$verify" orders paper --data "$given" --list
check test "$(grep -cF -- "--data" "$work/stdout")" -eq "$(grep -c ' paper/' "$work/stdout")"

# 3. Wrong input.
check refuses "'jacobain'" "did you mean jacobian?" -- "$verify" jacobain
check refuses "'nonsense'" "orders" -- "$verify" orders nonsense
check refuses "'orders/sektion'" "orders/lines" "did you mean orders/section?" -- \
  "$verify" orders/sektion
check refuses "'paper/'" "paper" -- "$verify" paper/
check refuses "--jobs: not used by --list" -- "$verify" --list --jobs 2
check refuses "--merge: not used by --list" -- "$verify" --list --merge elsewhere
check refuses "--jobs: not used by --merge" -- "$verify" --merge elsewhere --jobs 2
check refuses "--data: not used by --merge" -- "$verify" --merge elsewhere --data "$given"
check refuses "--data: not used by any of these studies, only by paper" -- \
  "$verify" orders --data "$given"
check refuses "--data: 'nowhere.csv' is no file" -- "$verify" paper --data nowhere.csv
printf 'figure,panel,curve,x,y\n8,a,made up,0.4,1\n9,a,made up,0.4,1\n' >"$given"
check refuses "--data: '$given', line 3: figure: '9' is none of: 2, 3" -- \
  "$verify" paper --data "$given" --list
check refuses "--merge: 'elsewhere'" -- "$verify" --merge elsewhere
check refuses "--merge: '' is no value" -- "$verify" --merge ''
check refuses --ful "did you mean --full?" -- "$verify" --ful
check refuses --jobs "'0'" "1 ... 64" -- "$verify" --jobs 0
check refuses "--output: '' is no value" -- "$verify" --output ''
check refuses --output "must be a folder" -- "$verify" --output "$work/file"

# Another run holds the folder: nothing is touched there.
mkdir "$work/held"
echo kept >"$work/held/index.html"
check refuses --output "another run" -- flock "$work/held" "$verify" --output "$work/held" jacobian
check expect_text held/index.html kept

run bash -c '"$0" --list >/dev/full' "$verify"
check expect_code 1
check expect_text stderr stdout

# processes: those of runs into $work/run.
processes() { grep -lsa "$work/run/[o]ut" /proc/[0-9]*/cmdline | cut -d / -f 3; }  # not grep itself
# start STUDY...: a run in the background, $main its process.
start() {
  rm -rf "$work/run"
  mkdir "$work/run"
  "$verify" "$@" --output "$work/run/out" >"$work/stdout" 2>"$work/stderr" &
  main=$!
}
comes_true() {  # TENTHS_OF_SECONDS COMMAND...
  local tries=$1
  shift
  for _ in $(seq "$tries"); do "$@" && return; sleep 0.1; done
  return 1
}
has_parts() { [ "$(processes | wc -l)" -gt "$1" ]; }
none_is_left() { [ -z "$(processes)" ]; }

# 4. No part outlives a run that is killed.
for signal in TERM KILL; do
  start stability
  check comes_true 100 has_parts 1
  kill "-$signal" "$main"
  wait "$main" 2>/dev/null
  check comes_true 50 none_is_left
  check test ! -e "$work/run/out/index.html"
  run_again "$verify" stability --merge out --output merged
  check expect_code 1
  check expect_text stdout "stability/maps did not end" "report:"
done

# 5. A part that is killed is a failed check; the report is written, beside that of the others.
start stability/maps heap --jobs 2
check comes_true 100 has_parts 1
check comes_true 100 has_parts 2
for process in $(processes); do
  [ "$process" = "$main" ] || kill -KILL "$process"
done
wait "$main"
code=$?
check expect_code 1
check expect_text stdout "in all: about" "stability/maps did not end: killed by signal 9" \
  "heap did not end: killed by signal 9" "report:"
check grep -qF "killed by signal 9" "$work/run/out/heap.html"
check grep -qF "Some checks do not hold" "$work/run/out/index.html"

finish
