# Takes the examples out of README.md: what is to be included to headers.inc, each block of C++ as a
# function to examples.inc. A block's first line names its headers; "// FILE: #include HEADER" makes a
# file of it instead.
#     awk -v out=FOLDER -f examples.awk README.md
/^```cpp$/ { inside = 1; first = 1; next }
/^```/ {
  if (inside && body) print "}\n" > (out "/examples.inc")
  inside = 0
  next
}
!inside { next }
first {
  first = 0
  body = $0 !~ /: #include/
  if (body) {
    line = substr($0, 4)
    count = split(line, names, ", ")
    for (i = 1; i <= count; ++i) print "#include \"" names[i] "\"" > (out "/headers.inc")
    print "void example_" ++examples "() {" > (out "/examples.inc")
  } else {
    file = out "/" substr($2, 1, length($2) - 1)
    line = $0
    sub(/.*: /, "", line)
    print "#pragma once\n" line "\nusing namespace hexweft;" > file
  }
  next
}
{ print > (body ? out "/examples.inc" : file) }
END {
  print "void run_examples() {" > (out "/examples.inc")
  for (i = 1; i <= examples; ++i) print "  example_" i "();" > (out "/examples.inc")
  print "}" > (out "/examples.inc")
}
