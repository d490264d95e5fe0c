#!/usr/bin/env bash
# Pages are read back: what is right passes, and one wrong digit, one command that fails, one
# reading of nothing do not.
# usage: cli_test.sh SOURCE_FOLDER
set -u
source_folder=$1
# shellcheck source=common/testing/cli_checks.sh
. "$source_folder/../../common/testing/cli_checks.sh"
tree=$work/tree
mkdir -p "$tree/docs" "$work/programs"
printf '#!/bin/sh\n[ "$1" = --fail ] && exit 2\necho "$@"\n' >"$work/programs/tell"
printf '#!/bin/sh\nprintf "{\\n  \\"drag\\": 5.6751,\\n  \\"units\\": 1\\n}\\n" >"$3/summary.json"\necho solved\n' \
  >"$work/programs/scene"
chmod +x "$work/programs"/*

write_page() {  # the only page: a paragraph, a table, what a command prints, a solve
  cat >"$tree/README.md" <<'PAGE'
# A page

    ./run tell 1.25
    ./run tell --fail     # exits with 2
    ./run tell --thing VALUE

With `./run tell 3.5` the drag is $3.19\cdot10^{-4}$ to 12.5, 1234 times, with `--more
777` on 16x20 elements, 555 of them.

<!-- read back
tell 3.1901e-4 12.52 16x99 "(1234)" 555
-->

| load | drag | time |
|---|---|---|
| 1e-3 | -2.5% | 17 |
| 1e-4 | 0.25 | 17 |

<!-- read back but 17: seconds
tell 0.001 -2.51
tell 0.0001 0.25
-->

```
1 2.0
```

<!-- read back
tell 1 2.04
-->

A drag of 5.675.

<!-- read back
solve scene x >/dev/null
get drag
-->
PAGE
}
read_pages() { run bash "$source_folder/read_back.sh" "$tree" "$work/programs" "$@"; }

# 1. The page as it should be.
write_page
read_pages
check expect_code 0
check expect_text stdout "README.md" "0 failures"
check test "$(awk '$1 == "all" { print $2, $3, $4, $5 }' "$work/stdout")" = "5 0 11 0"

# 2. One thing wrong at a time.
for change in 's/3\.19.cdot/3.18\\cdot/' 's/-2\.5%/-2.4%/' 's/^1 2\.0$/1 2.1/' 's/1234 times/1235 times/' 's/555 of/556 of/' \
  's/5\.675\./5.676./' 's/| 1e-4 | 0.25/| 1e-4 | -0.25/' 's/tell 1 2.04/false/' 's/of 5.675/of none/' \
  's/tell 1\.25/tell --fail/' 's/--fail  *#.*/--fail/' 's/tell 3\.5`/nothing`/' 's/solve scene x/solve tell --fail; solve scene x/'; do
  write_page
  sed -i "$change" "$tree/README.md"
  read_pages
  check expect_code 1
  check expect_text stdout "1 failures"
done

# 3. A number that a wrong last digit would not give away is counted as loose.
write_page
sed -i 's/tell 1 2.04/tell 1 2.04 1.1 2.14 2.1 1.9/' "$tree/README.md"
read_pages
check expect_code 0
check test "$(awk '$1 == "all" { print $5 }' "$work/stdout")" = 1

# 4. A reading that does not end, pages and options that are not there.
write_page
sed -i '$d' "$tree/README.md"
read_pages
check expect_code 2
for wrong in "--only nowhere" "--only" "--only=" "--other"; do
  # shellcheck disable=SC2086
  read_pages $wrong
  check expect_code 2
  check test "$(wc -l <"$work/stderr")" -eq 1
done
finish
