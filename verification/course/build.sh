# Builds and runs the tests of a step: with a student's own block, with the solution, or with one of
# the usual mistakes in it. To be sourced after steps.sh.
#
# All other blocks are those of the solution, so that a step depends on no other one. What a step
# needs from the rest of the source is compiled once for all steps.

cxx_flags="-std=c++20 -O0 -Wall -Wextra -Wno-unused-parameter -Wno-unused-variable
  -Wno-unused-but-set-variable -Wno-restrict -Wno-array-bounds -isystem /usr/include/eigen3
  -isystem /usr/include/suitesparse"

keep_if_same() {  # FILE, from stdin: its time tells ninja what is new
  [ -d "${1%/*}" ] || mkdir -p "${1%/*}"
  cat >"$1.new"
  if cmp -s "$1.new" "$1"; then rm "$1.new"; else mv "$1.new" "$1"; fi
}

# compose FOLDER SOURCE STEP: a student's file, all blocks but those of STEP as in the solution.
compose() {
  local composed
  composed=$(blocks -v mode=compose -v step="$3" -v name="$2" "$home/$2" "$tree/$2" 2>/dev/null && echo end) ||
    fail "$2: a mark '// course N: ...' or '// end of course N' is not as it was"
  printf '%s\n' "${composed%$'\n'end}" | keep_if_same "$1/$2"
}

# All files with all blocks solved, for what a step needs besides its own; before anything is built.
compose_shared() {
  local source shared=$tree/.course/build/shared
  for source in "${files_with_blocks[@]}"; do
    [ "$shared/$source" -nt "$tree/$source" ] && [ "$shared/$source" -nt "$home/$source" ] ||
      compose "$shared" "$source" 0
  done
}

# with_mistake STEP NUMBER: the solution's file with this mistake in it; fails unless its text is there once.
with_mistake() {
  blocks -v mode=mistake -v step="$1" -v from="$(mistake_part "$1" "$2" -)" -v to="$(mistake_part "$1" "$2" +)" \
    "$home/${file_of_step[$1]}"
}

object() {  # OBJECT SOURCE FOLDER...: the lines for ninja; headers are looked for in these folders
  printf 'build %s: cc %s\n  where =%s\n' "$1" "$2" "$(printf -- ' -I%s' "${@:3}")"
}

# build VARIANT STEP: what the compiler says, to stdout; its code. VARIANT is own, solution or 1, 2 ...
build() {
  local at=.course/build/$2/$1 shared=.course/build/shared source test_at objects
  cd "$tree" || exit
  case $1 in
    own) compose "$at" "${file_of_step[$2]}" "$2" ;;
    solution) keep_if_same "$at/${file_of_step[$2]}" <"$home/${file_of_step[$2]}" ;;
    *) with_mistake "$2" "$1" | keep_if_same "$at/${file_of_step[$2]}" ;;
  esac
  # Tests see the block only if it is in a header; else they are compiled once.
  case ${file_of_step[$2]} in *.hpp) test_at=$at ;; *) test_at=$shared ;; esac
  objects=$test_at/$2-test.o
  {
    printf 'rule cc\n  command = c++ %s $where -MMD -MF $out.d -c $in -o $out\n  depfile = $out.d\n' "${cxx_flags//$'\n'/ }"
    printf 'rule link\n  command = c++ $in -lboost_unit_test_framework %s -o $out\n' "$(field "$2" link)"
    object "$objects" "$(ls "verification/course/steps/$2"-*.cpp)" "$test_at" "$shared" .
    case ${file_of_step[$2]} in *.cpp)
      object "$at/block.o" "$at/${file_of_step[$2]}" "$at" "$shared" .
      objects+=" $at/block.o" ;;
    esac
    for source in $(field "$2" with); do
      objects+=" $shared/$source.o"
      [ -f "$shared/$source" ] && object "$shared/$source.o" "$shared/$source" "$shared" . ||
        object "$shared/$source.o" "$source" "$shared" .
    done
    echo "build $at/test: link $objects"
    echo "default $at/test"
  } | keep_if_same "$at/build.ninja"
  ninja -f "$at/build.ninja" 2>&1 | grep -v '^\[\|^ninja: no work' | sed "s|$at/||g"
  return "${PIPESTATUS[0]}"
}

# test_step VARIANT STEP: runs the tests; leaves log (complaints), seen (values) and cases (NAME
# passed|failed). False if one fails.
test_step() {
  local at=$tree/.course/build/$2/$1
  (cd "$at" && timeout 20 ./test --color_output=no --log_level=error --report_level=detailed \
    >out 2>report)
  local code=$?
  grep '^seen ' "$at/out" >"$at/seen"
  grep -v '^seen ' "$at/out" >"$at/log"
  awk '/^ *Test case ".*" (has|was) / {
    split($0, parts, "\""); sub(/.*\//, "", parts[2])
    print parts[2], / has passed/ ? "passed" : "failed" }' "$at/report" >"$at/cases"
  if [ $code = 124 ]; then
    echo "it did not end within 20 seconds" >"$at/log"
    tests_in "$2" | sed 's/$/ failed/' >"$at/cases"
  elif [ ! -s "$at/cases" ]; then
    { echo "it ended with code $code:"; tail -n 2 "$at/report"; } >"$at/log"
    tests_in "$2" | sed 's/$/ failed/' >"$at/cases"
  fi
  return $code
}

# values_agree only_wrong=[yes] SEEN MISTAKE SOLUTION: the values that tests saw, to nine digits:
# all of them, or those alone in which the mistake differs from the solution.
values_agree() {
  awk -v "$1" '
    function size(x) { return x < 0 ? -x : x }
    function same(x, y) {
      if (x == y) return 1
      if (x ~ /n/ || y ~ /n/) return 0
      return size(x - y) <= 1e-9 * (size(x) > size(y) ? size(x) : size(y)) + 1e-300
    }
    { sub(/^-nan/, "nan", $2); value[FILENAME, FNR] = $2; count[FILENAME] = FNR }
    END {
      if (!count[ARGV[2]] || !only_wrong && count[ARGV[1]] != count[ARGV[2]]) exit 1
      for (i = 1; i <= count[ARGV[2]]; ++i) {
        wrong = i > count[ARGV[3]] || !same(value[ARGV[2], i], value[ARGV[3], i])
        if (wrong && only_wrong) ++shared
        if ((wrong || !only_wrong) && (i > count[ARGV[1]] || !same(value[ARGV[1], i], value[ARGV[2], i]))) exit 1
      }
      exit only_wrong && !shared
    }' "${@:2}"
}

# name_mistake VARIANT STEP: `NAME: what is wrong` of the usual mistake whose tests saw the same
# values; else of the first whose wrong values are all among these. All have been run.
name_mistake() {
  local at=$tree/.course/build/$2 number mistakes option
  mapfile -t mistakes < <(mistakes_of "$2")
  for option in only_wrong= only_wrong=yes; do
    for ((number = 1; number <= ${#mistakes[@]}; ++number)); do
      values_agree $option "$at/$1/seen" "$at/$number/seen" "$at/solution/seen" || continue
      echo "${mistakes[number - 1]}"
      return
    done
  done
  return 1
}

# recognise STEP: a usual mistake in a student's own block, as name_mistake tells it.
recognise() {
  local variant
  for variant in solution $(seq "$(mistakes_of "$1" | wc -l)"); do
    build "$variant" "$1" >/dev/null
    test_step "$variant" "$1"
  done
  name_mistake own "$1"
}
