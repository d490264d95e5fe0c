# Are the numbers of a reading (first file: line, number, step) in the output (second file), in this
# order? Prints `wrong LINE NUMBER` for the first that is not,
# and `read COUNT LOOSE`: of how many one would not notice if their last digit were another.

function found(word, value, step) { output[++outputs] = value }

function is_rounded(value, printed, step,    distance) {
  distance = value - printed
  if (distance < 0) distance = -distance
  return distance <= step * 0.500001
}

# The first number, from 1, that is not found; 0 if all are. Number `changed` is taken to be `other`.
function first_missing(changed, other,    i, at, printed) {
  at = 0
  for (i = 1; i <= numbers; ++i) {
    printed = i == changed ? other : value[i]
    do ++at
    while (at <= outputs && !is_rounded(output[at], printed, step[i]))
    if (at > outputs) return i
  }
  return 0
}

FILENAME == ARGV[1] {
  line[++numbers] = $1; word[numbers] = $2; value[numbers] = $2 + 0; step[numbers] = $3
  next
}
{ scan_numbers($0) }
END {
  missing = first_missing(0, 0)
  if (missing) print "wrong", line[missing], word[missing]
  loose = 0
  if (!missing)
    for (i = 1; i <= numbers; ++i)
      if (!first_missing(i, value[i] + step[i]) || !first_missing(i, value[i] - step[i])) ++loose
  print "read", numbers + 0, loose
}
