# ./course slides [FOLDER]: every figure of a report, one a slide, in slides.html in its folder: those
# that its pages show, and those that are files *.svg only.

slides_of_pages() {
  local page folder
  find . -name '*.html' -not -name slides.html | sed 's|^\./||' | LC_ALL=C sort | while read -r page; do
    folder=
    case $page in */*) folder=${page%/*}/ ;; esac
    awk -v folder="$folder" -v study="$(basename "${folder:-$page}" .html)" -v shown="$shown" \
      -f "$tool/slides.awk" "$page"
  done
}

slides_of_files() {
  find . -name '*.svg' | sed 's|^\./||' | LC_ALL=C sort | grep -vxFf "$shown" | while read -r file; do
    name=$(basename "$file" .svg | tr '_-' '  ')
    printf '<section><h1>%s: %s</h1>\n<div><img src="%s" alt="%s"></div></section>\n' \
      "$(dirname "$file")" "$name" "$file" "$name"
  done
}

course_slides() {
  local report=${1:-$home/results/verify} slides
  [ $# -le 1 ] || fail "slides: '$2' comes after the folder '$1'"
  [ -d "$report" ] || fail "slides: '$report' is no folder: ./run makes results/verify"
  shown=$(mktemp)
  trap 'rm -f "$shown"' EXIT
  cd "$report" || exit
  slides=$(slides_of_pages; slides_of_files)
  [ -n "$slides" ] || fail "slides: '$report' holds no figures (*.svg): ./run makes them"
  {
    sed '/^SLIDES$/,$d' "$tool/slides.html"
    echo "$slides"
    sed '1,/^SLIDES$/d' "$tool/slides.html"
  } >slides.html
  echo "$(grep -c '^<section>' slides.html) slides: $PWD/slides.html"
}
