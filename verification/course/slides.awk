# A page of a report: for each figure that shows files *.svg slides with at most three of them side by
# side, and its caption without what is folded in it; their names to the file `shown`.

BEGIN { RS = "<figure" }

function attribute(tag, name,    text) {
  text = tag
  if (!match(text, name "=\"[^\"]*\"")) return ""
  return substr(text, RSTART + length(name) + 2, RLENGTH - length(name) - 3)
}

function slide() {
  if (pictures == "") return
  printf "<section><h1>%s: %s</h1>\n<div>%s</div>\n<p>%s</p></section>\n", study, title, pictures, caption
  pictures = title = ""
  count = 0
}

NR > 1 {
  sub(/<\/figure>.*/, "")
  caption = ""
  if (match($0, /<figcaption[^>]*>/)) {
    caption = substr($0, RSTART + RLENGTH)
    sub(/<\/figcaption>.*/, "", caption)
    sub(/ ?Drawn by <code.*/, "", caption)
    gsub(/<[^>]*>/, "", caption)
    gsub(/[ \n]+/, " ", caption)
  }
  rest = $0
  while (match(rest, /<img [^>]*>/)) {
    tag = substr(rest, RSTART, RLENGTH)
    rest = substr(rest, RSTART + RLENGTH)
    file = attribute(tag, "src")
    if (file !~ /\.svg$/) continue
    alt = attribute(tag, "alt")
    if (title == "") { title = alt; if (!sub(/\. .*/, "", title)) title = "" }
    if (title == "") { title = file; gsub(/^.*\/|\.svg$/, "", title); gsub(/_/, " ", title) }
    pictures = pictures sprintf("<img src=\"%s%s\" alt=\"%s\">", folder, file, alt)
    print folder file > shown
    if (++count == 3) slide()
  }
  slide()
}
