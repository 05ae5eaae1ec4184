# Prints the names in Doxygen's XML that have no description, and fails where there are any. Private names, files, pages
# and defaulted constructors need none.
/<(compounddef|memberdef|enumvalue) / {
  ++depth
  name[depth] = ""
  is_described[depth] = is_private[depth - 1] || /prot="private"/ || /kind="(file|dir|page|friend)"/
  is_private[depth] = is_private[depth - 1] || /prot="private"/
}
/<(compoundname|name)>/ && name[depth] == "" {
  name[depth] = $0
  gsub(/.*<(compoundname|name)>|<\/.*/, "", name[depth])
}
/<argsstring>.*=default</ { is_described[depth] = 1 }
/<(brief|detailed)description>/ { in_description = 1 }
/<para>/ && in_description { is_described[depth] = 1 }
/<\/(brief|detailed)description>/ { in_description = 0 }
/<\/(compounddef|memberdef|enumvalue)>/ {
  if (!is_described[depth]) {
    print "not documented: " name[depth] (depth > 1 ? " in " name[depth - 1] : "")
    found = 1
  }
  --depth
}
END { exit found }
