# Checks of a program from outside, for the cli_test.sh beside each program. To be sourced.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
touch "$work/file"
failures=0 checks=0

# What is asked hundreds of times is asked of the shell: a process costs as much as many a program here.
is_empty() {  # FOLDER
  local each
  for each in "$1"/* "$1"/.[!.]* "$1"/..?*; do
    [ ! -e "$each" ] && [ ! -L "$each" ] || return 1
  done
}

content_of() { content=; [ ! -f "$1" ] || IFS= read -rd '' content <"$1" || true; }  # leaves $content

is_one_line() {  # FILE
  local content
  content_of "$work/$1"
  [[ $content == *$'\n' && ${content%$'\n'} != *$'\n'* ]] || { echo "$1 is not one line"; return 1; }
}

# run PROGRAM OPTIONS...: in an empty folder; leaves $code, $work/stdout and $work/stderr.
run() {
  if [ ! -d "$work/run" ] || ! is_empty "$work/run"; then
    rm -rf "$work/run"
    mkdir "$work/run"
  fi
  run_again "$@"
}

# run_again PROGRAM OPTIONS...: in the folder of the last run.
run_again() {
  (cd "$work/run" && exec "$@") >"$work/stdout" 2>"$work/stderr"
  code=$?
}

# Every check below says on stdout what is wrong, and returns 1 if anything is.

expect_code() { [ "$code" -eq "$1" ] || { echo "exit code $code instead of $1"; return 1; }; }

expect_text() {  # FILE TEXT...
  local file=$1 text content
  shift
  content_of "$work/$file"
  for text in "$@"; do
    [[ $content == *"$text"* ]] || { echo "no '$text' in $file"; return 1; }
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

# leaves SCENE NAME...: these files and no other in the folder of its results.
leaves() {
  local folder=$work/run/results/$1 names
  shift
  names=$(ls -A "$folder" | tr '\n' ' ')
  [ "$names" = "$(printf '%s\n' "$@" | sort | tr '\n' ' ')" ] || { echo "it left: $names"; return 1; }
}

# holds_one_run SCENE PROGRAM OPTIONS...: while another process holds the folder of its results a run
# is refused and changes nothing there; --output is what to give.
holds_one_run() {
  local folder=$work/run/results/$1
  shift
  rm -rf "$work/run"
  mkdir -p "$folder"
  echo kept >"$folder/summary.json"
  run_again flock "$folder" "$@"
  expect_code 2 && expect_empty stdout && expect_text stderr --output "another run" || return 1
  [ "$(cat "$folder/summary.json")" = kept ] || { echo "summary.json was touched"; return 1; }
  run_again "$@"
  expect_code 0
}

# can_limit_memory PROGRAM: one that is sanitised reserves terabytes of addresses, whatever it needs.
can_limit_memory() {
  ! ldd "$1" | grep -q libasan || { echo "skipped: the limits of memory of $1, which is sanitised"; return 1; }
}

# waits_for_killed FOLDER: until a run that was killed has let go of it.
waits_for_killed() { [ ! -d "$1" ] || flock --timeout 20 "$1" true; }

# says_when_stdout_is_full PROGRAM OPTIONS...
says_when_stdout_is_full() {
  run "$@"  # for an empty folder and stderr
  (cd "$work/run" && exec "$@") >/dev/full 2>"$work/stderr"
  code=$?
  expect_code 1 && expect_text stderr stdout && is_one_line stderr
}

# with_gnuplot COMMANDS PROGRAM OPTIONS...: as run_again, with a shell script for gnuplot.
with_gnuplot() {
  mkdir -p "$work/gnuplot"
  printf '#!/bin/sh\n%s\n' "$1" >"$work/gnuplot/gnuplot"
  chmod +x "$work/gnuplot/gnuplot"
  shift
  PATH=$work/gnuplot:$PATH run_again "$@"
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
  expect_code 2 && expect_empty stdout && expect_text stderr "${texts[@]}" && is_one_line stderr ||
    return 1
  is_empty "$work/run" || { echo "files were left behind"; return 1; }
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
  checks=$((checks + 1))
  "$@" >"$work/message" && return
  failures=$((failures + 1))
  echo "FAILED: $*"
  cat "$work/message" "$work/stdout" "$work/stderr"
}

# check_fails CHECK...: negative control, the check must find something wrong.
check_fails() {
  checks=$((checks + 1))
  "$@" >/dev/null || return
  failures=$((failures + 1))
  echo "FAILED: passed although it should not: $*"
}

# check_samples PROGRAM SOURCE FIGURE: runs the sample command lines of the header of SOURCE, three at
# least; --plot must leave FIGURE.svg and FIGURE.png.
check_samples() {
  local program=$1 source=$2 figure=$3 scene samples=0 name options format
  scene=$(basename "$program")
  while read -r name options; do
    samples=$((samples + 1))
    # shellcheck disable=SC2086  # words, as a user types them
    check succeeds "$scene" "$program" $options
    case " $options " in *" --plot "*)
      if ! command -v gnuplot >/dev/null; then
        echo "skipped: the figures of '$name $options', gnuplot is missing"
        continue
      fi
      for format in svg png; do
        check test -s "$work/run/results/$scene/$figure.$format"
      done ;;
    esac
  done < <(sed -n "s#^//   \($scene\)\( \|\$\)#\1 #p" "$source")
  check test "$samples" -ge 3
}

# finish: the count of checks, and whether all held.
finish() {
  echo "$checks checks, $failures failed"
  [ "$failures" -eq 0 ]
}

# result KEY: that of results in the summary that the last run of $scene left.
result() {
  sed -n '/^  "results": {/,/^  }/s/^    "'"$1"'": \([^,]*\),*$/\1/p' "$work/run/results/$scene/summary.json"
}
