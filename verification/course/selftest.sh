# ./course selftest [N] [--data]: for every step (or step N) that its data are whole, that each of its
# tests fails with the blank and passes with the solution, and that each usual mistake fails and is
# recognised as itself. --data: without compiling.

complaints=0
complain() { echo "  $1"; complaints=$((complaints + 1)); }

# Without a process where the shell can do it: there are sixteen steps, and ./test is to be quick.
check_data() {  # STEP
  local step=$1 source=${file_of_step[$1]} solution own rest line blank hints=0 mistakes=0
  solution=$(blocks -v mode=show -v step="$step" "$home/$source")
  own=$(own_of "$step")
  [ -f "$home/docs/course/$(field "$step" sheet)" ] || complain "no sheet $(sheet_of "$step")"
  grep -qE "\| steps? ([0-9]+, )*$step(,| \|)" "$home/$(sheet_of "$step")" 2>/dev/null || complain "its sheet does not tell of it"
  grep -q "SUITE(step_$step)" "$(test_of "$step")" || complain "its tests are in another suite"
  [ -n "$(tests_in "$step")" ] || complain "it has no tests"
  while IFS= read -r line; do
    case $line in
      "hint "*) hints=$((hints + 1)) ;;
      "mistake "*) mistakes=$((mistakes + 1)) ;;
      "- "*)
        rest=${solution//"${line#- }"/}
        [ $((${#solution} - ${#rest})) = $((${#line} - 2)) ] ||
          complain "the text of mistake $mistakes is not in the solution once" ;;
    esac
  done <"$(data_of "$step")"
  [ $hints -ge 3 ] || complain "it has fewer than three hints"
  [ $mistakes -ge 3 ] || complain "it has fewer than three mistakes"
  blank="throw std::logic_error(\"step $step is to be written"
  rest=${own//"$blank"/}
  [ $(((${#own} - ${#rest}) / ${#blank})) = "$(grep -cE "^ *// course $step: " "$home/$source")" ] ||
    complain "not each of its blocks is a blank"
}

results_of() { cut -d ' ' -f 2 "$tree/.course/build/$2/$1/cases" | sort | uniq -c | awk '{ printf "%s ", $0 }' | tr -s ' '; }

check_step_whole() {  # STEP
  local step=$1 tests mistakes number other code
  tests=$(tests_in "$step" | wc -l)
  build own "$step" || complain "the blank is not compiled"
  test_step own "$step"
  [ "$(results_of own "$step")" = " $tests failed " ] || complain "with the blank: $(results_of own "$step")"
  build solution "$step" || complain "the solution is not compiled"
  test_step solution "$step" || complain "with the solution: $(results_of solution "$step")"
  mistakes=$(mistakes_of "$step" | wc -l)
  for ((number = 1; number <= mistakes; ++number)); do
    build $number "$step" || { complain "mistake $number is not compiled"; continue; }
    test_step $number "$step" && complain "mistake $number passes"
  done
  for ((number = 1; number <= mistakes; ++number)); do
    [ "$(name_mistake $number "$step")" = "$(mistakes_of "$step" | sed -n "${number}p")" ] ||
      complain "mistake $number is taken for another"
  done
  echo "  $tests tests, $mistakes mistakes"
}

course_selftest() {
  local steps= compiles=yes step source
  while [ $# -gt 0 ]; do
    case $1 in
      --data) compiles=no ;;
      -*) fail "selftest: '$1' is none of: --data" ;;
      *) need_step "$1"; steps+=" $1" ;;
    esac
    shift
  done
  [ -n "$steps" ] || steps=$(steps_in_order)
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  course_start "$work/tree" --name selftest >/dev/null
  for source in "${files_with_blocks[@]}"; do
    blocks -v mode=list "$home/$source" >>"$work/blocks" || complain "$source: its marks are not in pairs"
  done
  for step in $(cut -d ' ' -f 1 "$work/blocks" | sort -nu); do
    is_step "$step" || complain "no data for course $step"
  done
  [ $compiles = no ] || compose_shared
  for step in $steps; do
    echo "step $step: $(title_of "$step")"
    check_data "$step"
    [ $compiles = no ] || check_step_whole "$step"
  done
  echo "$complaints complaints"
  [ $complaints = 0 ]
}
