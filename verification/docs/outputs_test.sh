#!/usr/bin/env bash
# docs/outputs.md names every file a run leaves, every column, field and result, with its unit.
# usage: outputs_test.sh PROGRAMS ROOT
set -u
programs=$1 page=$2/docs/outputs.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
checks=0 failed=0
check() {  # WHAT STATUS
  checks=$((checks + 1))
  [ "$2" -eq 0 ] || { failed=$((failed + 1)); echo "FAILED: $1"; }
}

section() {  # TEXT: of the page, from a heading with it to the next; all of it if there is no text
  awk -v text="$1" 'BEGIN { inside = text == "" } /^##/ { inside = index($0, text) > 0 } inside' "$page"
}
# missing_in SECTION...: of the names on stdin, those that stand in no `...` of these sections.
# froude_at_p_ext_3 is one of froude_at_p_ext_P.
missing_in() {
  awk 'NR == FNR { while (match($0, /`[^`]*`/)) {
                     known[substr($0, RSTART + 1, RLENGTH - 2)]; $0 = substr($0, RSTART + RLENGTH) }
                   next }
       { family = $0; sub(/_[0-9.]+$/, "_P", family) }
       !($0 in known) && !(family in known)' <(echo; for each; do section "$each"; done) /dev/stdin
}
is_told() {  # WHAT SECTION...: the names on stdin all are
  local missing
  missing=$(missing_in "${@:2}" | tr '\n' ' ')
  check "$1: not in outputs.md: $missing" "$([ -z "$missing" ]; echo $?)"
}

run() {  # FOLDER PROGRAM ARGUMENT...
  local folder=$work/$1
  "$programs/$2" "${@:3}" --output "$folder" >/dev/null 2>"$folder.complaint"
  check "$*" $?
  is_told "$1/summary.json" '`summary.json`' < <(keys_of "$folder/summary.json")
  local file
  for file in "$folder"/*.csv; do
    is_told "${file#"$work/"}" "\`${file##*/}\`" "$(results_in "${file##*/}")" < <(head -n 1 "$file" | tr ',' '\n')
  done
  for file in "$folder"/*.vtu; do
    [ -e "$file" ] || continue
    is_told "${file#"$work/"}" Fields < <(grep -o '<DataArray[^>]*Name="[^"]*"' "$file" |
      sed 's/.*Name="//; s/"//' | grep -vxE 'connectivity|offsets|types|points')
  done
  is_told "files of $1" '' < <(ls "$folder")
}
results_in() {  # FILE: the section of the results that are its columns too, else its own
  [ "$1" = sweep.csv ] && echo '### `cylinder`' || echo "\`$1\`"
}
keys_of() {  # FILE: the keys of the outermost object, as `--record` indents them
  sed -n 's/^  "\([a-z_]*\)": .*/\1/p' "$1"
}

run chute chute --elements 10
run plane bagnold --model plane --elements 4
run section heap --elements 4x5
run newton heap --elements 4x5 --method newton
run line heap --model line --elements 10
run cell split-bottom --elements 4
run space heap --model space --elements 1x4x5
run cylinder cylinder --around 16 --loading 0.02
run manufactured manufactured --elements 4

# Each result stands with its unit and its meaning.
for scene in chute bagnold heap cylinder split-bottom manufactured; do
  missing=$("$programs/$scene" --describe | awk '
    /"description":|"meaning":/ { meaning = value($0) }
    /"name":/ { name = value($0) }
    /"unit":/ { unit = value($0); print "| `" name "` | " unit " | " meaning " |" }
    function value(line) { sub(/^[^:]*: "/, "", line); sub(/",?$/, "", line); return line }' |
    while read -r row; do grep -qF -- "$row" <(section "\`$scene\`") || echo "$row"; done)
  check "$scene --describe: not in outputs.md: $missing" "$([ -z "$missing" ]; echo $?)"
done

# And a name, or a file, that is nowhere is noticed.
[ "$(printf 'yielded_share\nyielded_chair\n' | missing_in '### `heap`')" = yielded_chair ]
check "a name that is nowhere is noticed" $?
[ "$(printf 'velocity\n' | missing_in '`nowhere.csv`')" = velocity ]
check "a file that is nowhere has no columns" $?

echo "$checks checks, $failed failed"
[ $failed -eq 0 ]
