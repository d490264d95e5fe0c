# Reads a page and writes to `folder`, for each reading K of it: K.line (where it is), K.script
# (what makes its numbers) and K.numbers (a line each: line of the page, number as printed, step). A
# reading is a comment behind a paragraph, a table or a block of output:
#
#     <!-- read back [all] [long] [but NUMBER ...: why]
#     SCRIPT
#     -->
#
# In a paragraph numbers of three digits and more count, with `all` each of them; those behind `but` are
# not compared. A long one is read with --full. To `folder`/total goes the count of numbers of three
# digits and more on the page, output and code apart, to `folder`/left that of those in no reading.

function found(word, value, step) {
  if (counting) total += digits_of(word) >= 3
  else if (word in is_apart) return
  else if (every || digits_of(word) >= 3) {
    covered += kind != "output" && digits_of(word) >= 3
    print current, word, step > (folder "/" readings ".numbers")
  }
}

function forget() { lines = 0; kind = ""; is_open = 0 }

# What is quoted may go on in the next line.
function with_quotes_closed(text) {
  if (is_open) text = "`" text
  is_open = gsub(/`/, "`", text) % 2
  return text
}

function keep(text) { block[++lines] = text; place[lines] = FNR }

function begin_reading(options,    i, apart, words, count) {
  ++readings
  print FNR > (folder "/" readings ".line")
  printf "" > (folder "/" readings ".numbers")
  printf "" > (folder "/" readings ".script")
  if (options ~ /(^| )long( |$)/) print > (folder "/" readings ".long")
  apart = ""
  if (match(options, /but [^:]*/)) apart = substr(options, RSTART + 4, RLENGTH - 4)
  split("", is_apart)
  count = split(apart, words, " ")
  for (i = 1; i <= count; ++i) is_apart[words[i]] = 1
  every = kind != "text" || options ~ /(^| )all( |$)/
  is_open = 0
  for (i = 1; i <= lines; ++i) {
    if (kind == "table" && i <= 2) continue
    current = place[i]
    scan_numbers(kind == "output" ? block[i] : plain(with_quotes_closed(block[i])))
  }
}

/^<!-- read back/ && !in_code {
  begin_reading(substr($0, 15))
  in_script = 1
  next
}
in_script && /^-->/ { in_script = 0; forget(); next }
in_script { print > (folder "/" readings ".script"); next }
/^ *<!--/ { next }
/^ *```/ {
  in_code = !in_code
  if (in_code) { forget(); kind = "output" }
  next
}
in_code { keep($0); next }
/^ *$/ { ended = 1; next }
{
  new_kind = /^ *\|/ ? "table" : "text"
  if (ended || new_kind != kind) forget()
  ended = 0
  kind = new_kind
  keep($0)
  counting = 1
  if (!/^    [^ ]/ && !/^ *\|[-| ]*$/) scan_numbers(plain(with_quotes_closed($0)))
  counting = 0
}
END {
  if (in_script) { print FILENAME ": a reading that does not end" > "/dev/stderr"; exit 2 }
  print total + 0 > (folder "/total")
  print total - covered > (folder "/left")
  print readings + 0 > (folder "/readings")
}
