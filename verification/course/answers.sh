# Numeric questions. To be sourced after tree.sh; docs/course/answers.txt tells each as
#
#   question 2g
#   ask    what is asked, with $NAME for a number of the student's own
#   own    NAME FIRST STEP COUNT: one of FIRST, FIRST + STEP, ..., drawn from the student's name
#   value  the script that prints the answer; `solve PROGRAM OPTION...` and then `get KEY` in it
#   within percent of the answer that are allowed
#
# The answer is computed when it is asked for, and stored nowhere.

questions() { sed -n 's/^question //p' "$home/docs/course/answers.txt"; }
line_of() {  # QUESTION KEY
  awk -v question="$1" -v key="$2" '
    $1 == "question" { inside = $2 == question }
    inside && $1 == key { sub(/^[a-z]+ +/, ""); print }' "$home/docs/course/answers.txt"
}

# own_numbers QUESTION: `NAME=VALUE` of each, from the student's name.
own_numbers() {
  local name first step count draw
  while read -r name first step count; do
    draw=$(printf '%s/%s/%s' "$(cat "$tree/.course/name")" "$1" "$name" | cksum | cut -d ' ' -f 1)
    awk -v name="$name" -v first="$first" -v step="$step" -v k=$((draw / 7 % count)) \
      'BEGIN { printf "%s=%.10g\n", name, first + k * step }'
  done < <(line_of "$1" own)
}

with_numbers() {  # TEXT NAME=VALUE...
  local text=$1 each
  for each in "${@:2}"; do text=${text//\$${each%%=*}/${each#*=}}; done
  echo "$text"
}

# What the scripts of answers call.
solve() {  # PROGRAM OPTION...
  "$@" --output "$work/solved" >"$work/log" 2>&1
}
get() {  # KEY of the last solve: of its results first
  awk -v key="\"$1\":" '
    /^  "results": \{/ { inside = 1 }
    $1 == key && (inside || other == "") { other = $2; if (inside) exit }
    END { sub(/,$/, "", other); print other }' "$work/solved/summary.json"
}

is_number() {
  [[ $1 =~ ^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{1,3})?$ ]] &&
    awk -v x="$1" 'BEGIN { x += 0; exit !(x - x == 0 && x < 1e300 && x > -1e300) }'
}

find_programs() {
  local bin
  for bin in "$tree/build/release/bin" "$home/build/release/bin"; do
    [ -x "$bin/cylinder" ] && PATH=$bin:$PATH && return
  done
  echo "course: the programs are not built: ./run build in $home first" >&2
  exit 1
}

course_answer() {
  local question=${1:-} value=${2:-} numbers expected
  [ $# -ge 1 ] && [ $# -le 2 ] || fail "answer: a question and a value: ./course answer 2g 0.123"
  [ -n "$question" ] && questions | grep -qxF -- "$question" ||
    fail "answer: '$question' is no question: $(questions | paste -sd ' ')"
  mapfile -t numbers < <(own_numbers "$question")
  if [ $# = 1 ]; then
    with_numbers "$(line_of "$question" ask)" "${numbers[@]}"
    return
  fi
  is_number "$value" || fail "answer: '$value' is no number"
  find_programs
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  expected=$(eval "$(with_numbers "$(line_of "$question" value)" "${numbers[@]}")")
  is_number "$expected" || { echo "course: the answer to $question could not be computed: $(tail -n 1 "$work/log")" >&2; exit 1; }
  if awk -v x="$value" -v y="$expected" -v percent="$(line_of "$question" within)" \
    'BEGIN { d = x - y; s = y < 0 ? -y : y; exit !((d < 0 ? -d : d) <= s * percent / 100) }'; then
    note "answer $question right"
    echo "Right."
    return
  fi
  note "answer $question wrong"
  echo "Not within $(line_of "$question" within)% of what the programs say. Your question: $(with_numbers "$(line_of "$question" ask)" "${numbers[@]}")"
  return 1
}

# A line for each step and question that was tried: name, item, done, tries, hints, solution seen.
course_score() {
  [ $# = 0 ] || fail "score: '$1' is too much: it has no options"
  local name item
  name=$(cat "$tree/.course/name")
  {
    echo "name,item,done,tries,hints,solution"
    for item in $(steps_in_order); do
      score_line "$name" "step $item" "step $item passed" "step $item " "hint $item " "solution $item\$"
    done
    for item in $(questions); do
      score_line "$name" "answer $item" "answer $item right" "answer $item " "hint of $item" "solution of $item"
    done
  } >"$tree/score.csv"
  awk -F, -v name="$name" '
    NR > 1 { ++all; done += $3 == "yes"; hints += $5; seen += $6 == "seen" }
    END { printf "%s: %d of %d done, with %d hints and %d solutions looked at first; score.csv is for the lecturer\n",
            name, done, all, hints, seen }' "$tree/score.csv"
}

score_line() {  # NAME ITEM DONE TRIES HINTS SOLUTION: patterns of the record's lines
  awk -v name="$1" -v item="$2" -v done="^[^ ]* $3" -v tries="^[^ ]* $4" -v hints="^[^ ]* $5" -v solution="^[^ ]* $6" '
    $0 ~ done { is_done = 1 }
    $0 ~ tries { ++tried }
    $0 ~ hints { ++hinted }
    $0 ~ solution { seen = 1 }
    END { printf "%s,%s,%s,%d,%d,%s\n", name, item, is_done ? "yes" : "no", tried, hinted, seen ? "seen" : "no" }' \
    "$tree/.course/record"
}

# ./course scores FILE...: a class as one table.
course_scores() {
  local file
  [ $# -gt 0 ] || fail "scores: the files are missing: ./course scores */score.csv"
  for file in "$@"; do
    [ "$(head -n 1 "$file" 2>/dev/null)" = "name,item,done,tries,hints,solution" ] ||
      fail "scores: '$file' is no score file"
  done
  awk -F, '
    FNR == 1 { next }
    !($1 in all) { order[++names] = $1 }
    { ++all[$1]; kind = $2 ~ /^step/ ? "s" : "a"
      if ($3 == "yes") ++count[$1, kind]
      hints[$1] += $5; seen[$1] += $6 == "seen" }
    END {
      printf "%-24s %6s %8s %6s %10s\n", "name", "steps", "answers", "hints", "solutions"
      for (i = 1; i <= names; ++i)
        printf "%-24s %6d %8d %6d %10d\n", order[i], count[order[i], "s"], count[order[i], "a"], hints[order[i]], seen[order[i]]
    }' "$@"
}
