# The commands of a page, one a line as EXPECTED_CODE<tab>WORDS[<tab>long]: what stands in its code as
# `./run PROGRAM ...`, alone or within text. Not those with a word in capitals to be put in, or an
# ellipsis, or that write to another program. A sentence may be about a solve that fails: codes 01.

function tell(command, code,    long) {
  if (match(command, /#.*exits with [0-9]/)) code = substr(command, RSTART + RLENGTH - 1, 1)
  long = command ~ /#.*(minutes|hour)/ ? "\tlong" : ""
  sub(/ +#.*/, "", command)
  sub(/^ *\.\/run */, "", command)
  if (command ~ /(^| )[A-Z][A-Z]*( |$|[.:=-])/ || command ~ /\.\.\.|[|<>\[]/) return
  if (!seen[command]++) print code "\t" command long
}

/\\$/ { sub(/ *\\$/, ""); carried = carried $0; next }
{ text = carried $0; carried = "" }
text ~ /^ *\.\/run / { tell(text, "0"); next }
{
  count = split(text, parts, "`")
  for (i = 2; i <= count; i += 2) if (parts[i] ~ /^\.\/run [a-z]/) tell(parts[i], "01")
}
