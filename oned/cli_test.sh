#!/usr/bin/env bash
# The programs from outside: sample runs, wrong input, limits of existence.
# usage: cli_test.sh CHUTE BAGNOLD SOURCE_FOLDER
set -u
chute=$1 bagnold=$2 source_folder=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
touch "$work/file"
failures=0 checks=0

# run PROGRAM OPTIONS...: in an empty folder; leaves $code, $work/stdout and $work/stderr.
run() {
  rm -rf "$work/run"
  mkdir "$work/run"
  (cd "$work/run" && exec "$@") >"$work/stdout" 2>"$work/stderr"
  code=$?
}

# Every check below says on stdout what is wrong, and returns 1 if anything is.

expect_code() { [ "$code" -eq "$1" ] || { echo "exit code $code instead of $1"; return 1; }; }

expect_text() {  # FILE TEXT...
  local file=$1 text
  shift
  for text in "$@"; do
    grep -qF -e "$text" "$work/$file" || { echo "no '$text' in $file"; return 1; }
  done
}

expect_empty() { [ ! -s "$work/$1" ] || { echo "$1 is not empty"; return 1; }; }

expect_summary() {  # of the program named
  local summary=$work/run/results/$1/summary.json key
  [ -f "$summary" ] || { echo "no summary.json"; return 1; }
  if [ "$(head -n 1 "$summary")" != "{" ] || [ "$(tail -n 1 "$summary")" != "}" ]; then
    echo "summary.json is not one JSON object"
    return 1
  fi
  for key in scene model parameters status seconds results; do
    grep -q "^  \"$key\": " "$summary" || { echo "no key '$key' in summary.json"; return 1; }
  done
}

# succeeds SCENE PROGRAM OPTIONS...: exit 0, results written, nothing on stderr.
succeeds() {
  local scene=$1
  shift
  run "$@"
  expect_code 0 && expect_empty stderr || return 1
  case " $* " in
    *" --check-jacobian "*) expect_text stdout "The tangent is the derivative" ;;
    *) expect_summary "$scene" ;;
  esac
}

# refuses TEXT... -- PROGRAM OPTIONS...: exit 2, one line on stderr with every TEXT, no other trace.
refuses() {
  local texts=()
  while [ "$1" != -- ]; do texts+=("$1"); shift; done
  shift
  run "$@"
  expect_code 2 && expect_empty stdout && expect_text stderr "${texts[@]}" || return 1
  [ "$(wc -l <"$work/stderr")" -eq 1 ] || { echo "stderr is not one line"; return 1; }
  [ -z "$(ls -A "$work/run")" ] || { echo "files were left behind"; return 1; }
}

# has_no_steady_flow LIMIT PROGRAM OPTIONS...: exit 1, the end and the limit on stderr.
has_no_steady_flow() {
  local limit=$1
  shift
  run "$@"
  expect_code 1 && expect_empty stdout && expect_text stderr no_steady_state "$limit"
}

# is_at_rest SCENE PROGRAM OPTIONS...: exit 0 and says so.
is_at_rest() { succeeds "$@" && expect_text stdout "at rest"; }

# check CHECK...: counts it, and reports its failure.
check() {
  local message
  checks=$((checks + 1))
  message=$("$@") && return
  failures=$((failures + 1))
  printf 'FAILED: %s: %s\n' "$*" "$message"
  cat "$work/stdout" "$work/stderr"
}

# check_fails CHECK...: negative control, the check must find something wrong.
check_fails() {
  checks=$((checks + 1))
  "$@" >/dev/null || return
  failures=$((failures + 1))
  echo "FAILED: passed although it should not: $*"
}

# 1. The sample runs of the programs' headers.
for scene in chute bagnold; do
  samples=0
  while read -r name options; do
    samples=$((samples + 1))
    # shellcheck disable=SC2086  # words, as a user types them
    check succeeds "$scene" "${!name}" $options
    case " $options " in *" --plot "*)
      if ! command -v gnuplot >/dev/null; then
        echo "skipped: the figures of '$name $options', gnuplot is missing"
        continue
      fi
      for figure in svg png; do
        check test -s "$work/run/results/$scene/profile.$figure"
      done ;;
    esac
  done < <(sed -n "s#^//   \($scene\)\( \|\$\)#\1 #p" "$source_folder/${scene}_main.cpp")
  check test "$samples" -ge 3
done

# 2. Wrong input.
for program in "$chute" "$bagnold"; do
  for value in 0 -3 abc 1e9 2.5 ''; do
    check refuses --elements "'$value'" "1 ... 100000" -- "$program" --elements "$value"
  done
  check refuses --elements missing -- "$program" --elements
  check refuses --lambda-r "'0'" 1e-15 -- "$program" --lambda-r 0
  check refuses --lambda-r "'nan'" 1e-15 -- "$program" --lambda-r nan
  check refuses --grading "'0.5'" "1 ... 10" -- "$program" --grading 0.5
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

echo "$checks checks, $failures failed"
[ "$failures" -eq 0 ]
