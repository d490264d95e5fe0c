#!/usr/bin/env bash
# The pages of a report and of a study of one's own: whole, small, and in a browser without errors,
# broken pictures or scrolling sideways. Pages that are broken on purpose are noticed. Without
# Chromium, or without gnuplot, the browser's part is skipped, by name.
# usage: pages_test.sh VERIFY STUDY SOURCE_FOLDER
set -u
verify=$1 study=$2 source_folder=$3
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../common/testing/cli_checks.sh"
# shellcheck source=verification/page_checks.sh
. "$source_folder/page_checks.sh"

run "$verify" paper/lines stability/limits ladder --output report
check expect_code 0
run_again "$study" cost heap --elements 4x4,8x8 --method newton,interior-point --output study
check expect_code 0
report=$work/run/report own=$work/run/study
check pages_are_whole "$report"
check pages_are_whole "$own"
check test "$(stat -c %s "$report/index.html")" -lt 200000
check test "$(ls "$report"/*.html | wc -l)" -eq 4
check grep -q "class=command" "$own/index.html"  # of the points
check grep -q "points of this figure" "$own/index.html"

# broken SED_EXPRESSION: a copy of the report with a front page that is broken so.
broken() {
  rm -rf "$work/broken"
  cp -r "$report" "$work/broken"
  sed -i "$1" "$work/broken/index.html"
  cmp -s "$report/index.html" "$work/broken/index.html" && echo "nothing was broken"
}
check test -z "$(broken 's#<main>#<main><a href=nowhere.html>there</a>#')"
check_fails pages_are_whole "$work/broken"
check test -z "$(broken 's#<main>#<main><a href=https://example.org>there</a>#')"
check_fails pages_are_whole "$work/broken"
check test -z "$(broken 's#<main>#<main><img src=report.css>#')"
check_fails pages_are_whole "$work/broken"
check test -z "$(broken 's#<main>#<main><h4>far down</h4>#')"
check_fails pages_are_whole "$work/broken"

for browser in chromium chromium-browser google-chrome ""; do
  command -v "$browser" >/dev/null && break
done
if [ -z "$browser" ] || ! command -v gnuplot >/dev/null; then
  echo "skipped: what a browser makes of the pages, Chromium or gnuplot is missing"
  finish || exit 1
  exit 77
fi

# faults_in FOLDER [PAGE]: what a browser finds in copies of its pages, each in frames of three
# widths.
faults_in() {
  rm -rf "$work/probe"
  cp -r "$1" "$work/probe"
  local page frames="" count=0
  for page in "$work/probe"/${2:-*.html}; do
    sed -i 's#</body>#<script src=probe.js></script></body>#' "$page"
    for width in 400 1280 1920; do
      frames+="<iframe src=\"$(basename "$page")\" width=$width height=800></iframe>"
      count=$((count + 1))
    done
  done
  cp "$source_folder/page_probe.js" "$work/probe/probe.js"
  cat >"$work/probe/all_frames.html" <<END
<!doctype html><meta charset=utf-8><body style="margin:0;width:1920px"><ol></ol><script>
addEventListener("message", (event) => {
  const line = document.createElement("li");
  line.textContent = event.data;
  document.querySelector("ol").append(line);
});
</script>$frames</body>
END
  timeout 300 "$browser" --headless --no-sandbox --disable-gpu --enable-logging=stderr --v=0 \
    --user-data-dir="$work/profile" --allow-file-access-from-files --virtual-time-budget=60000 \
    --window-size=1920,1080 --dump-dom "file://$work/probe/all_frames.html" \
    >"$work/dom" 2>"$work/console"
  grep -o 'CONSOLE.*' "$work/console"
  grep -oE '<li>[^<]*' "$work/dom" | sed 's/^<li>//' | grep -v ': sound$'
  [ "$(grep -oE '<li>' "$work/dom" | wc -l)" -eq "$count" ] || echo "not all of $count frames answered"
}
is_sound() { local faults; faults=$(faults_in "$@"); [ -z "$faults" ] || { echo "$faults"; return 1; }; }
check is_sound "$report"
check is_sound "$own"
check test -z "$(broken 's#<main>#<main><div style="width:3000px">wide</div>#')"
check_fails is_sound "$work/broken" index.html
check test -z "$(broken 's#<main>#<main><img src=report.css alt="no picture at all">#')"
check_fails is_sound "$work/broken" index.html
check test -z "$(broken 's#<main>#<main><script>console.error("wrong")</script>#')"
check_fails is_sound "$work/broken" index.html
finish
