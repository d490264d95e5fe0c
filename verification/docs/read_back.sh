#!/usr/bin/env bash
# ./run docs: runs every command of README and docs, and reads every number back that a comment
# `<!-- read back ... -->` in a page says how to make (readings.awk tells how one is written).
# usage: read_back.sh ROOT PROGRAMS [--only TEXT] [--full] [--list]
set -u
root=$1 programs=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
only= asks_for_pages=no list=no full=no
while [ $# -gt 0 ]; do
  case "$1" in
    --only) [ $# -ge 2 ] || { echo "docs: --only: its value is missing" >&2; exit 2; }
            only=$2 asks_for_pages=yes; shift ;;
    --list) list=yes ;;
    --full) full=yes ;;
    -h | --help)
      echo "Usage: ./run docs [--only TEXT] [--full] [--list]"
      echo "Runs the commands of README and docs, and compares the numbers beside them with what they print."
      echo "  --only TEXT  Pages whose paths contain this text"
      echo "  --full       Those too that their pages call long"
      echo "  --list       Only list the pages, their numbers, readings and commands"
      exit 0 ;;
    *) echo "docs: '$1' is none of: --only --full --list --help" >&2; exit 2 ;;
  esac
  shift
done
mapfile -t pages < <(cd "$root" && find README.md docs -name '*.md' | LC_ALL=C sort | grep -F -- "$only")
[ -n "$only" ] || [ $asks_for_pages = no ] || pages=()
[ ${#pages[@]} -gt 0 ] || { echo "docs: --only: '$only' is in no path of README.md and docs/" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
PATH=$programs:$PATH
export work root here PATH

# What scripts of readings can call. The folder they run in is that of their page.

note_refusal() {  # CODE COMMAND OUTPUT: a solve may fail (1), a command line may not be wrong
  [ "$1" -le 1 ] || echo "'$2' exits with $1: $(tail -n 1 "$3")" >>"$work/refused"
}
solve() {  # PROGRAM ARGUMENT...: once for all readings; what it printed is printed, `get` and `columns` read its files
  solved=$work/solved/$(printf '%s\n' "$@" | cksum | tr ' ' _)
  if [ ! -d "$solved" ]; then
    mkdir -p "$solved"
    "$@" --output "$solved" >"$solved.out" 2>&1
    note_refusal $? "$*" "$solved.out"
  fi
  cat "$solved.out"
}
get() {  # KEY...: numbers of the last solve's summary.json, of its results first
  local key
  for key; do
    awk -v key="\"$key\":" '
      /^  "results": \{/ { in_results = 1 }
      /^  \}/ { in_results = 0 }
      $1 == key && (in_results || (/^  "/ && other == "")) { other = $2; if (in_results) exit }
      END { sub(/,$/, "", other); print other }' "$solved/summary.json"
  done
}
columns() {  # FILE NAME...: these columns of a table of the last solve
  awk -F, -v names="${*:2}" '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; count = split(names, name, " "); next }
    { for (i = 1; i <= count; ++i) printf "%s ", $at[name[i]]; print "" }' "$solved/$1"
}
part() {  # STUDY/PART [--full]: made once; its tables and checks are the files of folder $tables
  local folder=$work/parts/${1//\//_}${2:-}
  [ -d "$folder" ] || { mkdir -p "$folder"; verify "$@" --output "$folder" >"$folder.out" 2>&1
                         note_refusal $? "verify $*" "$folder.out"; }
  tables=$folder/$1/
}
held() {  # STUDY/PART TEXT: how many checks that have this text in them hold; none if one does not
  part "$1" >/dev/null
  find "$tables" -name checks.csv -exec cat {} + | grep -v '^check,against' |
    grep -F -- "$2" |
    awk '/,yes$/ { ++held } !/,yes$/ { ++failed } END { print failed ? "not" : held + 0 }'
}
task() {  # SHEET N: what the code of its task N prints; the tasks before it come first
  local tasks=$work/tasks/$1
  if [ ! -d "$tasks" ]; then
    mkdir -p "$tasks"
    awk -v folder="$tasks" '
      /^## / && started { started = 0; task = "end" }
      /^## Run/ { started = 1 }
      started && /^[0-9]+\. / { task = $1 + 0 }
      started && !in_code && /`cylinder [^`]*`/ {  # a command within a line
        split($0, parts, "`"); print parts[2] > (folder "/" task ".sh") }
      /^ *```/ { in_code = !in_code; next }
      in_code && !started && task == "" && !/run build|^PATH=/ { print > (folder "/0.sh") }
      in_code && started { print > (folder "/" task ".sh") }' "$root/docs/course/$1"
    (
      cd "$tasks" || exit
      touch 0.sh
      {
        cat 0.sh
        for script in $(ls [1-9]*.sh | sort -n); do
          echo "{"; cat "$script"; echo "} >${script%.sh}.out 2>&1"
        done
      } >all
      bash all
    )
  fi
  cat "$tasks/$2.out"
}
export -f note_refusal solve get columns part held task

failures=0
tell_failure() { echo "  $1"; failures=$((failures + 1)); }

read_back() {  # PAGE READING: adds to read, loose
  local page=$1 at=$work/page/$2 line printed
  line=$(cat "$at.line")
  rm -f "$work/refused"
  (cd "$work/page" && bash "$at.script") >"$at.out" 2>"$at.err" </dev/null
  [ ! -f "$work/refused" ] || tell_failure "$page:$line: $(head -n 1 "$work/refused")"
  printed=$(awk -f "$here/numbers.awk" -f "$here/compare.awk" "$at.numbers" "$at.out")
  case "$printed" in
    wrong*) set -- $printed
            tell_failure "$page:$2: $3 is not what its commands print (comment of line $line)"
            return ;;
  esac
  set -- ${printed##*read }
  [ "$1" -gt 0 ] || tell_failure "$page:$line: this reads no number back"
  read=$((read + $1)) loose=$((loose + $2))
}

try_command() {  # PAGE EXPECTED_CODES WORDS
  local code
  (cd "$work/commands" && eval "$3") >"$work/command.out" 2>&1 </dev/null
  code=$?
  [[ $2 == *$code* ]] ||
    tell_failure "$1: './run $3' exits with $code: $(tail -n 1 "$work/command.out")"
}

numbers_of() {  # PAGE: its readings go to $work/page
  rm -rf "$work/page" "$work/commands"
  mkdir -p "$work/page" "$work/commands"
  awk -f "$here/numbers.awk" -f "$here/readings.awk" -v folder="$work/page" "$root/$1" || exit 2
}

# Those that say so, and what is no more than a build or takes hours.
is_for_another_day() {  # COMMAND, as commands.awk tells it
  local code words long
  IFS=$'\t' read -r code words long <<<"$1"
  [[ $long == long && $full == no ]] ||
    [[ $words == build* || $words == mutants* || $words == verify*--full* || $words == docs* ]]
}

row='%-44s %8s %9s %9s %6s %9s\n'
printf "$row" page numbers "left out" "read back" loose commands
all_numbers=0 all_left=0 all_read=0 all_loose=0
for page in "${pages[@]}"; do
  numbers_of "$page"
  readings=$(cat "$work/page/readings") total=$(cat "$work/page/total") left=$(cat "$work/page/left") read=0 loose=0
  mapfile -t commands < <(awk -f "$here/commands.awk" "$root/$page")
  tried=0
  for command in "${commands[@]}"; do
    IFS=$'\t' read -r code words _ <<<"$command"
    { [ -z "$words" ] || is_for_another_day "$command"; } && continue
    tried=$((tried + 1))
    if [ $list = yes ]; then echo "    $words"; else try_command "$page" "$code" "$words"; fi
  done
  for ((reading = 1; reading <= readings; ++reading)); do
    [ -f "$work/page/$reading.long" ] && [ $full = no ] && continue
    if [ $list = yes ]; then
      read=$((read + $(wc -l <"$work/page/$reading.numbers")))
    else
      read_back "$page" $reading
    fi
  done
  printf "$row" "$page" "$total" "$left" $read $loose $tried
  all_numbers=$((all_numbers + total)) all_left=$((all_left + left)) all_read=$((all_read + read)) all_loose=$((all_loose + loose))
done
printf "$row" all $all_numbers $all_left $all_read $all_loose ""
[ $list = yes ] && exit 0
echo "numbers: of three digits and more, outside of output; left out: without a reading, or named in it as"
echo "not compared; read back: all that were compared; loose: another last digit would not be noticed"
echo "$failures failures"
[ $failures -eq 0 ]
