#!/usr/bin/env bash
# ./run pages: README and docs as pages for a browser, to be read without a network: equations are
# MathML, pictures and style lie beside them.
# usage: pages.sh ROOT [--output DIR] [--api]
set -euo pipefail
root=$1
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/pages
output=results/pages with_api=no
while [ $# -gt 0 ]; do
  case "$1" in
    --output) [ $# -ge 2 ] && [ -n "$2" ] || { echo "pages: --output: its value, a folder, is missing" >&2; exit 2; }
              output=$2; shift ;;
    --api) with_api=yes ;;
    -h | --help)
      echo "Usage: ./run pages [--output DIR] [--api]"
      echo "README and docs as pages for a browser, equations and all, to be read without a network."
      echo "  --output DIR  Folder for the pages (results/pages)"
      echo "  --api         The reference of types and functions too, by Doxygen"
      exit 0 ;;
    *) echo "pages: '$1' is none of: --output --api --help" >&2; exit 2 ;;
  esac
  shift
done
[ ! -e "$output" ] || [ -d "$output" ] || { echo "pages: --output: '$output' is no folder" >&2; exit 2; }
needed=(pandoc)
[ $with_api = no ] || needed+=(doxygen)
for tool in "${needed[@]}"; do
  command -v "$tool" >/dev/null && continue
  echo "pages: $tool is missing: sudo apt-get install $tool" >&2
  exit 1
done
mkdir -p "$output"
output=$(cd "$output" && pwd)
complaints=$(mktemp)
trap 'rm -f "$complaints"' EXIT

# An equation that pandoc cannot read stays TeX, with a warning: one is a failure.
render() {  # PAGE: its path from the root
  local up target=${1%.md}.html
  up=$(dirname "$1" | sed 's,[^/.][^/]*,..,g; s,^\.$,,; s,\(.\)$,\1/,')
  [ "$1" != README.md ] || target=index.html
  mkdir -p "$output/$(dirname "$1")"
  { printf '<nav><a href="%sindex.html">Talus</a> <a href="%sdocs/README.html">Documentation</a></nav>\n' "$up" "$up"
  } >"$output/.nav"
  pandoc --from gfm+tex_math_dollars --to html5 --mathml --standalone --lua-filter "$here/links.lua" \
    --include-before-body "$output/.nav" --css "${up}style.css" "$root/$1" --output "$output/$target" 2>&1 |
    sed "s|^|$1: |" >>"$complaints"
}

# Every link within the pages leads somewhere.
broken_links() {
  local page link
  find "$output" -name '*.html' -not -path "$output/api/*" | while read -r page; do
    grep -oE '(href|src)="[^"#:]+(#[^"]*)?"' "$page" | sed -E 's/^[a-z]+="([^"#]*).*/\1/' | sort -u |
      while read -r link; do
        [ -e "$(dirname "$page")/$link" ] || echo "${page#"$output/"}: '$link' is not there"
      done
  done
}

cd "$root"
cp "$here/style.css" "$output/"
cp LICENSE CITATION.cff "$output/"
count=0
while read -r page; do
  render "$page"
  count=$((count + 1))
done < <(find README.md docs -name '*.md' | LC_ALL=C sort)
rm -f "$output/.nav"
find docs -name '*.svg' -o -name '*.png' | while read -r picture; do cp "$picture" "$output/$picture"; done
broken_links >>"$complaints"
if [ $with_api = yes ]; then
  { cat "$here/Doxyfile"; echo "OUTPUT_DIRECTORY = \"$output\""; } | doxygen - 2>>"$complaints" >/dev/null
fi
if [ -s "$complaints" ]; then
  cat "$complaints" >&2
  echo "pages: $(wc -l <"$complaints") faults, see above" >&2
  exit 1
fi
echo "$count pages: $output/index.html"
[ $with_api = no ] || echo "types and functions: $output/api/index.html"
