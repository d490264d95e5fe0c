# Checks of pages from outside. To be sourced after cli_checks.sh.

# pages_are_whole FOLDER: every file that a page of the folder names is there, every picture has a
# text, headings go down by one level at a time from a single first, and no address leads to the net.
pages_are_whole() {
  local page name level before faults=0
  for page in "$1"/*.html; do
    while read -r name; do
      case $name in
        '#'*) grep -qE "id=\"?${name#\#}[\" >]" "$page" ;;
        data:,) ;;
        *:*) false ;;
        *) [ -s "$1/$name" ] ;;
      esac || { echo "$page names '$name', which is not there"; faults=1; }
    done < <(grep -oE '(href|src)=("[^"]*"|[^ >]*)' "$page" | sed -E 's/^[a-z]+="?([^"]*)"?$/\1/' | sort -u)
    [ "$(grep -o '<img' "$page" | wc -l)" -eq "$(grep -oE '<img[^>]* alt="[^"]{10,}"' "$page" | wc -l)" ] ||
      { echo "$page has a picture without a text"; faults=1; }
    before=0
    for level in $(grep -oE '<h[1-6]' "$page" | tr -d '<h'); do
      [ "$level" -le $((before + 1)) ] && { [ "$level" -gt 1 ] || [ "$before" -eq 0 ]; } ||
        { echo "$page goes from heading $before to $level"; faults=1; }
      before=$level
    done
    [ "$before" -gt 0 ] || { echo "$page has no heading"; faults=1; }
  done
  return $faults
}
