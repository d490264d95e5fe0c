# The commands of a page, one a line as EXPECTED_CODE<tab>WORDS: what stands in its code as
# `./run PROGRAM ...`, alone or within text. Not those with a word in capitals to be put in, or an
# ellipsis, or that write to another program.

function tell(command,    code) {
  code = 0
  if (match(command, /#.*exits with [0-9]/)) code = substr(command, RSTART + RLENGTH - 1, 1)
  sub(/ +#.*/, "", command)
  sub(/^ *\.\/run */, "", command)
  if (command ~ /(^| )[A-Z][A-Z]*( |$|[.:=-])/ || command ~ /\.\.\.|[|<>\[]/) return
  if (!seen[command]++) print code "\t" command
}

/\\$/ { sub(/ *\\$/, ""); carried = carried $0; next }
{ text = carried $0; carried = "" }
text ~ /^ *\.\/run / { tell(text); next }
{
  count = split(text, parts, "`")
  for (i = 2; i <= count; i += 2) if (parts[i] ~ /^\.\/run [a-z]/) tell(parts[i])
}
