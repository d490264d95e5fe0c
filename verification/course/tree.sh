# A student's tree, and what one does there. To be sourced after build.sh.
#
# .course/ in it holds: home (the tree with the solutions), name, record (a line for all that was
# done, only ever added to) and build/.

note() { echo "$(date -u +%Y-%m-%dT%H:%M:%S) $*" >>"$tree/.course/record"; }
noted() { grep -c "^[^ ]* $*\$" "$tree/.course/record"; }  # TEXT: how often
is_done() { [ "$(noted "step $1 passed")" -gt 0 ]; }

course_start() {
  local name= dir= source
  while [ $# -gt 0 ]; do
    case $1 in
      --name) [ $# -ge 2 ] && [ -n "$2" ] || fail "start: --name: its value is missing"; name=$2; shift ;;
      -*) fail "start: '$1' is none of: --name" ;;
      *) [ -z "$dir" ] || fail "start: '$1' comes after the folder '$dir'"; dir=$1 ;;
    esac
    shift
  done
  [ -n "$dir" ] || fail "start: the folder is missing: ./course start DIR"
  [ ! -e "$dir" ] || fail "start: '$dir' is there already"
  name=${name:-$(id -un)}
  [[ $name != *[$',"\n']* ]] || fail "start: --name: '$name' may not hold commas, quotes or line ends"
  mkdir -p "$dir" || exit 2
  tree=$(cd "$dir" && pwd)
  case $tree/ in "$home"/*) rmdir "$tree"; fail "start: '$dir' lies within the source of Talus: choose a folder outside" ;; esac
  (cd "$home" && tar -c --exclude=./build --exclude=./results --exclude=./.git --exclude=./.course \
    --exclude=./docs/course/solutions .) | tar -x -C "$tree" || exit 1
  mkdir "$tree/.course"
  echo "$home" >"$tree/.course/home"
  echo "$name" >"$tree/.course/name"
  touch "$tree/.course/record"
  local step sheets=
  for step in $(steps_in_order); do sheets+=" $step=$(field "$step" sheet)"; done
  for source in "${files_with_blocks[@]}"; do
    blocks -v mode=blank -v sheets="$sheets" "$home/$source" >"$tree/$source" || exit 1
  done
  echo "$name's tree is in $tree: $(steps_in_order | wc -l) steps are to be written."
  echo "Go there, read docs/course/README.md, and begin with: ./course check 1"
}

progress() {
  local step count=0 all=0 bar=
  for step in $(steps_in_order); do
    all=$((all + 1))
    if is_done "$step"; then count=$((count + 1)) bar+='#'; else bar+=.; fi
  done
  echo "[$bar] $count of $all steps"
}

first_complaint() {  # LOG TEST: `0.4 != 2.5   in: fitted_order(...) == 2.5`
  sed -n "s|^[^ ]*: [a-z ]*: in \"[^\"]*/$2\": ||p" "$1" | head -n 1 |
    sed 's/^check \(.*\) has failed \[\([^]]*\)\].*/\2   in: \1/; s/seen(\(.*\)) \(==\|[<>]\)/\1 \2/; s/^/          /'
}

# check_step STEP: true if its tests pass.
check_step() {
  local step=$1 at=$tree/.course/build/$1/own name result complaint compiler code=0
  echo "Step $step: $(title_of "$step") ($(sheet_of "$step"))"
  if is_blank "$step"; then
    name=${file_of_step[$step]}
    echo "  to be written: $name, line $(grep -n "^ *// course $step: " "$tree/$name" | cut -d: -f1 | paste -sd,)"
    return 1
  fi
  [ ! -t 2 ] || [ -x "$at/test" ] || echo "  building it for the first time ..." >&2
  compiler=$(build own "$step") || code=$?
  [ $code != 2 ] || exit 2
  [ -z "$compiler" ] || head -n 30 <<<"$compiler"
  if [ $code != 0 ]; then
    echo "  the compiler does not take it"
    note "step $step failed"
    return 1
  fi
  test_step own "$step" || code=1
  while read -r name result; do
    printf '  %s  %s\n' "$result" "${name//_/ }"
    [ "$result" = passed ] || first_complaint "$at/log" "$name"
  done <"$at/cases"
  if [ $code = 0 ]; then
    is_done "$step" || note "step $step passed"
    return
  fi
  note "step $step failed"
  grep -h '^it ' "$at/log" | sed 's/^/  /'
  echo "  ./course hint $step says more"
  return 1
}

course_check() {
  local step= watch=no each steps code=0
  while [ $# -gt 0 ]; do
    case $1 in
      --watch) watch=yes ;;
      -*) fail "check: '$1' is none of: --watch" ;;
      *) need_step "$1"; step=$1 ;;
    esac
    shift
  done
  while :; do
    code=0
    steps=$step
    if [ -z "$step" ]; then
      for each in $(steps_in_order); do is_blank "$each" || steps+=" $each"; done
      [ -n "$steps" ] || steps=1
    fi
    touch "$tree/.course/looked"
    compose_shared
    for each in $steps; do check_step "$each" || code=1; done
    progress
    [ $watch = yes ] || return $code
    echo "(waiting until a file is saved; Ctrl-C ends)"
    until [ -n "$(cd "$tree" && find "${files_with_blocks[@]}" -newer .course/looked | head -n 1)" ]; do sleep 0.5; done
  done
}

course_hint() {
  [ $# -eq 1 ] || fail "hint: the step is missing: ./course hint N"
  need_step "$1"
  local step=$1 level found
  compose_shared
  if ! is_blank "$step" && build own "$step" >/dev/null; then
    if test_step own "$step"; then
      echo "Step $step passes its tests."
      return
    fi
    echo "Comparing with the usual mistakes ..." >&2
    if found=$(recognise "$step"); then
      note "hint $step ${found%%:*}"
      echo "It looks as if ${found#*: }."
      return
    fi
  fi
  level=$(($(grep -c "^[^ ]* hint $step [0-9]" "$tree/.course/record") + 1))
  found=$(field "$step" hint | sed -n "${level}p")
  [ -n "$found" ] || { echo "There are no more hints: ./course solution $step"; return; }
  note "hint $step $level"
  echo "Hint $level of $(field "$step" hint | wc -l): $found"
}

course_solution() {
  [ $# -eq 1 ] || fail "solution: the step is missing: ./course solution N"
  need_step "$1"
  is_done "$1" || note "solution $1"
  solution_of "$1"
}
