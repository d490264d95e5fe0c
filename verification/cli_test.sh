#!/usr/bin/env bash
# The program verify from outside: wrong input, studies that are killed, a run that is killed.
# usage: cli_test.sh VERIFY SOURCE_FOLDER STUDY...    (the studies that ctest runs)
set -u
verify=$1 source_folder=$2
shift 2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

# 1. ctest runs every study of the registry, and each says how long it takes.
run "$verify" --list
check expect_code 0
check test "$(cut -f 1 "$work/stdout")" = "$(printf '%s\n' "$@")"
check test "$(grep -cP '^\S+\tabout [0-9.]+ (s|min), with --full [0-9.]+ (s|min)\t.*\?$' \
  "$work/stdout")" -eq $#

# 2. Wrong input.
run "$verify" orders --list
check expect_text stdout orders
check_fails expect_text stdout jacobian
check refuses "'jacobain'" "did you mean jacobian?" -- "$verify" jacobain
check refuses "'nonsense'" "orders" -- "$verify" orders nonsense
check refuses "--full: not used by --list" -- "$verify" --list --full
check refuses "--output: not used by --list" -- "$verify" --list --output elsewhere
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
# start STUDY...: a run in the background, $main its process; .
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
has_studies() { [ "$(processes | wc -l)" -gt "$1" ]; }
none_is_left() { [ -z "$(processes)" ]; }

# 3. No study outlives a run that is killed.
for signal in TERM KILL; do
  start stability
  check comes_true 100 has_studies 1
  kill "-$signal" "$main"
  wait "$main" 2>/dev/null
  check comes_true 50 none_is_left
  check test ! -e "$work/run/out/index.html"
done

# 4. A study that is killed is a failed check; the report is written, beside that of the others.
start stability heap --jobs 2
check comes_true 100 has_studies 1
check comes_true 100 has_studies 2
for process in $(processes); do
  [ "$process" = "$main" ] || kill -KILL "$process"
done
wait "$main"
code=$?
check expect_code 1
check expect_text stdout "in all: about" "study did not end: killed by signal 9" "report:"
check grep -qF "killed by signal 9" "$work/run/out/index.html"
check grep -qF "Some checks do not hold" "$work/run/out/index.html"

finish
