#!/usr/bin/env bash
# The program verify from outside: what it lists, and wrong input. No study is run.
# usage: cli_test.sh VERIFY SOURCE_FOLDER
set -u
verify=$1 source_folder=$2
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"

run "$verify" --list
check expect_code 0
check expect_text stdout jacobian orders paper cost stability heap ladder cylinder
run "$verify" orders --list
check expect_text stdout orders
check_fails expect_text stdout jacobian

check refuses "'jacobain'" "did you mean jacobian?" -- "$verify" jacobain
check refuses "'nonsense'" "orders" -- "$verify" orders nonsense
check refuses "--full: not used by --list" -- "$verify" --list --full
check refuses "--output: not used by --list" -- "$verify" --list --output elsewhere
check refuses --ful "did you mean --full?" -- "$verify" --ful
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

finish
