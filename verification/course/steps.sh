# What is known of the steps: their data beside this file, their blocks in the source. To be sourced;
# $tool is this folder, $home the tree with the solutions, $tree a student's.

fail() { echo "course: $1" >&2; exit 2; }

steps_in_order() { ls "$tool/steps"/*.txt | sed 's|.*/\([0-9]*\)-.*|\1|' | sort -n; }
data_of() { echo "$tool/steps/$1"-*.txt; }  # STEP
test_of() { echo "$tool/steps/$1"-*.cpp; }
tests_in() { sed -n 's/^BOOST_AUTO_TEST_CASE(\(.*\)) {.*/\1/p' "$(test_of "$1")"; }
is_step() { [[ $1 =~ ^[1-9][0-9]?$ ]] && [ -f "$(data_of "$1")" ]; }
need_step() {
  is_step "$1" || fail "'$1' is no step: 1 ... $(steps_in_order | tail -n 1)"
}
field() { sed -n "s/^$2 //p" "$(data_of "$1")"; }  # STEP KEY: sheet, link, with, hint
blocks() { awk -f "$tool/blocks.awk" "$@"; }

# The files with blocks, from the root, and which step is where: read once.
find_blocks() {
  local source step
  declare -gA file_of_step=()
  files_with_blocks=()
  while IFS=: read -r source step; do
    [[ " ${files_with_blocks[*]} " == *" $source "* ]] || files_with_blocks+=("$source")
    [ -z "${file_of_step[$step]:-}" ] || fail "the blocks of step $step are in two files"
    file_of_step[$step]=$source
  done < <(cd "$home" && grep -rE --include='*.?pp' '^ *// course [0-9]+: ' common verification |
    sed 's|^\([^:]*\): *// course \([0-9]*\):.*|\1:\2|' | LC_ALL=C sort -u)
}
title_of() {  # STEP
  blocks -v mode=list "$home/${file_of_step[$1]}" | sed -n "s/^$1 //p" | head -n 1
}
sheet_of() { echo "docs/course/$(field "$1" sheet)"; }
solution_of() {  # STEP
  echo "// ${file_of_step[$1]}"
  blocks -v mode=show -v step="$1" "$home/${file_of_step[$1]}"
}
own_of() {  # STEP: what stands in the student's blocks
  blocks -v mode=show -v step="$1" "$tree/${file_of_step[$1]}" 2>/dev/null
}
is_blank() { own_of "$1" | grep -q "^ *throw std::logic_error(\"step $1 is to be written"; }

# The usual mistakes as `NAME: what is wrong`.
mistakes_of() { field "$1" mistake; }
mistake_part() {  # STEP NUMBER [-+]: the text of the solution, or what stands there instead
  awk -v wanted="$2" -v sign="$3" '
    /^mistake / { ++number }
    number == wanted && substr($0, 1, 1) == sign { print substr($0, 3) }' "$(data_of "$1")"
}
