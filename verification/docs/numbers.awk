# What readings.awk and compare.awk share: the numbers of a text.

# Calls found(word, value, step) for every number that stands by itself: not the 2 of Q2, 1x16x20,
# H_2 or x^2. `step` is one unit of the last digit that is printed.
function scan_numbers(text,    before, after, word, at) {
  before = ""
  while (match(text, /[-+]?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)?/)) {
    word = substr(text, RSTART, RLENGTH)
    if (RSTART > 1) before = substr(text, RSTART - 1, 1)
    after = substr(text, RSTART + RLENGTH, 2)
    text = substr(text, RSTART + RLENGTH)
    if (word ~ /^[-+]/ && before ~ /[A-Za-z0-9)_.]/) {  # a dash, not a sign
      before = substr(word, 1, 1)
      word = substr(word, 2)
      if (before == "+") before = "-"
    }
    if (before !~ /[A-Za-z0-9_.^{\\]/ && after !~ /^([A-Za-z_0-9]|\.[0-9]|-[A-Za-z])/)
      found(word, word + 0, step_of(word))
    before = substr(word, length(word), 1)
  }
}

function step_of(word,    mantissa, exponent, dot) {
  exponent = 0
  mantissa = word
  if (match(word, /[eE]/)) {
    exponent = substr(word, RSTART + 1) + 0
    mantissa = substr(word, 1, RSTART - 1)
  }
  dot = index(mantissa, ".")
  return 10 ^ (exponent - (dot ? length(mantissa) - dot : 0))
}

# Digits that mean something: 3 of 0.0120, 2 of 1.5e-7.
function digits_of(word,    mantissa) {
  mantissa = word
  sub(/[eE].*/, "", mantissa)
  gsub(/[-+.]/, "", mantissa)
  sub(/^0+/, "", mantissa)
  return length(mantissa)
}

# Mathematics and links as plain text: 2\cdot10^{-7} is 2e-7, 10^{-6} is 1e-6; what is in `...` is
# no number of the text.
function plain(text,    parts, i, count, head, tail) {
  count = split(text, parts, "`")
  text = ""
  for (i = 1; i <= count; i += 2) text = text " " parts[i]
  gsub(/\]\([^)]*\)/, "]", text)
  gsub(/\*\*Task [0-9]+\.\*\*/, "", text)
  gsub(/ ?\\cdot ?10\^/, "e", text)
  while (match(text, /(^|[^0-9.])10\^(\{-?[0-9]+\}|[0-9])/)) {
    head = substr(text, 1, RSTART + RLENGTH - 1)
    tail = substr(text, RSTART + RLENGTH)
    sub(/10\^\{?/, "1e", head)
    sub(/\}$/, "", head)
    text = head tail
  }
  while (match(text, /e\{-?[0-9]+\}/))
    text = substr(text, 1, RSTART) substr(text, RSTART + 2, RLENGTH - 3) substr(text, RSTART + RLENGTH)
  return text
}
