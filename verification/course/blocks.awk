# The blocks of the course in a source: what stands between `// course 3: shape functions` and
# `// end of course 3`. A step may have several. What is printed is told by `mode`:
#
#   list     `STEP TITLE` of every block; a mark without its other half ends it with code 1
#   show     what stands in the blocks of `step`
#   blank    the file, every block a statement that throws (`sheets`: "STEP=SHEET ...")
#   compose  the first file is the solution, the second a student's: it, where all blocks but those
#            of `step` are those of the solution (no step: all)
#   mistake  the file, `from` in the blocks of `step` replaced by `to`; code 1 unless it is there once

function complain(text) { print FILENAME ":" FNR ": " text > "/dev/stderr"; failed = 1; exit 1 }
function is_begin() { return $0 ~ /^ *\/\/ course [0-9]+: / }
function is_end() { return $0 ~ /^ *\/\/ end of course [0-9]+$/ }
function number_in(text) { match(text, /course [0-9]+/); return substr(text, RSTART + 7, RLENGTH - 7) + 0 }

FNR == 1 {
  ++file
  split("", blocks_of)
  if (mode == "compose" && file == 2) print "#line 1 \"" name "\""
  if (mode == "blank")
    for (i = split(sheets, words, " "); i > 0; --i) {
      split(words[i], pair, "=")
      sheet[pair[1]] = pair[2]
    }
}

is_begin() {
  if (inside) complain("course " inside " does not end")
  inside = number_in($0)
  block = inside "/" ++blocks_of[inside]
  title = $0
  sub(/^[^:]*: /, "", title)
  pad = $0
  sub(/\/\/.*/, "", pad)
  if (mode == "list") print inside, title
  if (mode == "blank" || mode == "mistake" || (mode == "compose" && file == 2)) print
  if (mode == "blank")
    print pad "throw std::logic_error(\"step " inside " is to be written: docs/course/" sheet[inside] "\");"
  if (mode == "compose" && file == 2 && inside != step) printf "%s", solution[block]
  next
}

is_end() {
  if (number_in($0) != inside) complain("end of course " number_in($0) " without its beginning")
  if (mode == "blank" || mode == "mistake" || (mode == "compose" && file == 2)) print
  if (mode == "compose" && file == 2 && inside != step) print "#line " FNR + 1 " \"" name "\""
  if (mode == "show" && inside == step) print ""
  inside = 0
  next
}

inside {
  if (mode == "show" && inside == step) print
  if (mode == "compose" && file == 1) solution[block] = solution[block] $0 "\n"
  if (mode == "compose" && file == 2 && inside == step) print
  if (mode == "mistake") {
    if (inside == step && (at = index($0, from))) {
      ++found
      if (index(substr($0, at + 1), from)) ++found
      $0 = substr($0, 1, at - 1) to substr($0, at + length(from))
    }
    print
  }
  next
}

mode == "blank" && /^#include/ && !included { included = 1; print "#include <stdexcept>\n" }
mode == "blank" || mode == "mistake" || (mode == "compose" && file == 2) { print }

END {
  if (failed) exit 1
  if (inside) complain("course " inside " does not end")
  if (mode == "mistake" && found != 1) exit 1
}
