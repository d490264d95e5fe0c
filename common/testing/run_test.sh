#!/usr/bin/env bash
# The script ./run from outside, without building anything: CMake and the programs are stand-ins.
# usage: run_test.sh PROJECT_FOLDER
set -u
project=$1
# shellcheck source=common/testing/cli_checks.sh
. "$project/common/testing/cli_checks.sh"

# A tree that holds `run`, built programs that say their name, words and end with 7, and tools that
# write down what they are asked.
tree="$work/a tree"
mkdir -p "$tree/build/release/bin" "$tree/build/release/CMakeFiles" "$tree/build/asan" "$work/tools"
cp "$project/run" "$tree"
for program in chute bagnold heap cylinder split-bottom manufactured study verify fuzz mutants; do
  printf '#!/bin/sh\necho %s "$@"\nexit 7\n' $program >"$tree/build/release/bin/$program"
done
printf '#!/bin/sh\n[ -e build/release/CMakeCache.txt ] && echo with cache >>%q || echo without >>%q
[ ! -e %q ]\n' "$work/configured" "$work/configured" "$work/broken" >"$work/tools/cmake"
printf '#!/bin/sh\nprintf installed\n' >"$work/tools/dpkg-query"
chmod +x "$work/tools"/* "$tree/build/release/bin"/*
PATH=$work/tools:$PATH

configured_in() {  # FOLDER: as a build of the tree there leaves it
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$1" >"$tree/build/release/CMakeCache.txt"
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$1" >"$tree/build/asan/CMakeCache.txt"
  mkdir -p "$tree/build/release/CMakeFiles"
  rm -f "$work/configured"
}

is_configured() {  # with cache|without, by the first call of CMake
  [ "$(head -n 1 "$work/configured")" = "$1" ] || { echo "CMake found: $(cat "$work/configured")"; return 1; }
}

# 1. A program's words and its exit code go through.
configured_in "$tree"
for program in chute bagnold heap cylinder split-bottom manufactured study verify fuzz mutants; do
  run "$tree/run" $program --elements '1 2' ''
  check expect_code 7
  check expect_text stdout "$program --elements 1 2"
  check expect_empty stderr
done
mkdir -p "$tree/verification/docs"
printf 'echo docs "$@"\nexit 7\n' >"$tree/verification/docs/read_back.sh"
run "$tree/run" docs --only '1 2'
check expect_code 7
check expect_text stdout "docs $tree $tree/build/release/bin --only 1 2"
check is_configured "with cache"
check_fails is_configured without

# 2. A tree that was moved or copied is configured anew, whatever the preset; a link to it is not.
for elsewhere in /no/such/folder "$project"; do
  configured_in "$elsewhere"
  run "$tree/run" chute
  check expect_code 7
  check expect_text stderr "configured in '$elsewhere'"
  check is_configured without
  check test ! -e "$tree/build/release/CMakeFiles" -a ! -e "$tree/build/asan/CMakeCache.txt"
  check test -x "$tree/build/release/bin/chute"
done
configured_in "$tree"
ln -s "$tree" "$work/link"
run "$work/link/run" chute
check expect_code 7
check is_configured "with cache"

# 3. What CMake complains about is shown.
touch "$work/broken"
run "$tree/run" build
check expect_code 1
rm "$work/broken"
run "$tree/run" build
check expect_code 0
check expect_empty stdout

# 4. Wrong words.
check refuses "'chtue'" "did you mean chute?" "(see ./run --help)" -- "$tree/run" chtue
check refuses "'verfiy'" "did you mean verify?" -- "$tree/run" verfiy --full
check refuses "'plot'" "chute bagnold heap cylinder split-bottom manufactured study verify fuzz mutants docs pages build" -- "$tree/run" plot
check_fails refuses "did you mean" -- "$tree/run" plot
check refuses "''" -- "$tree/run" ''
check refuses "'--fast'" -- "$tree/run" build --fast
run "$tree/run" --help
check expect_code 0
check expect_text stdout chute bagnold heap cylinder split-bottom manufactured study verify fuzz mutants "./run build"

finish
