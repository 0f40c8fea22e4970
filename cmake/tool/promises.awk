# Which test checks which promise. Reads the names of files, one in a line, and prints each id that no test names, that a test
# names and nobody promises, or that is given twice, as FILE:LINE:COLUMN with a hint; ends with 1 when there was one.
# -v root: the repository.

BEGIN {
  topics["docs/stopping.md"] = "stop"
  topics["docs/executive.md"] = "exec"
  topics["docs/blackboard.md"] = "board"
  topics["docs/visual-servoing.md"] = "picker trouble"
  id = "\\[[a-z][a-z0-9-]*-[0-9]+\\]"
}

{
  file = substr($0, length(root) + 2)
  # What a document or a header of another kind writes in brackets is a quotation.
  if (file in topics)
    read_promises(topics[file], "`" id "`", "")
  else if (file ~ "^hal/.*/interface/[^/]*[.]hpp$")
    read_promises(topic_of(file), id, "//")
  else if (file ~ "(^|/)(tests|conformance)/.*[.](cpp|hpp|sh|ts)$")
    read_names()
}

END {
  for (i = 1; i <= promises; ++i)
    if (!(promised[i] in is_named))
      refuse(place[promised[i]], "no test names [" promised[i] "]",
             "write [" promised[i] "] in a comment above a test that fails when this is broken; a promise without one has no id")
  for (i = 1; i <= names; ++i)
    if (!(named[i] in place))
      refuse(named_at[i], "nobody promises [" named[i] "]",
             "promises stand in docs/stopping.md, executive.md, blackboard.md, visual-servoing.md and in the headers of hal/**/interface/")
  for (i = 1; i <= doubles; ++i)
    refuse(double_at[i], "[" double[i] "] is promised already in " place[double[i]],
           "the next number that is free is " greatest[part(double[i])] + 1)
  exit failed
}

# In the lines behind `mark`, "" for whole lines. Each has its topic, or one of some: so a copied line is found, and an id leads to
# its file.
function read_promises(topics_here, pattern, mark,    line, text, start, found, names, topic) {
  split(topics_here, names, " ")
  topic = names[1]
  for (line = 1; (getline text < $0) > 0; ++line) {
    if (mark != "") text = (start = index(text, mark)) ? substr(text, start) : ""
    while (match(text, pattern)) {
      found = substr(text, RSTART, RLENGTH)
      text = substr(text, RSTART + RLENGTH)
      gsub(/[`\[\]]/, "", found)
      if (!index(" " topics_here " ", " " part(found) " "))
        refuse(file ":" line, "[" found "] is no promise of this file", "its promises are called [" topic "-1] and so on")
      else
        promise(found, file ":" line)
    }
  }
  close($0)
}

function promise(found, where) {
  if (found in place) {
    double[++doubles] = found
    double_at[doubles] = where
    return
  }
  promised[++promises] = found
  place[found] = where
  if (number(found) > greatest[part(found)]) greatest[part(found)] = number(found)
}

# A comment of nothing but ids.
function read_names(    line, text, found) {
  for (line = 1; (getline text < $0) > 0; ++line) {
    if (text !~ "^ *(//|#)( " id ")+$") continue
    while (match(text, id)) {
      found = substr(text, RSTART + 1, RLENGTH - 2)
      text = substr(text, RSTART + RLENGTH)
      named[++names] = found
      named_at[names] = file ":" line
      is_named[found]
    }
  }
  close($0)
}

function topic_of(path) {
  sub(".*/", "", path)
  sub("[.]hpp$", "", path)
  gsub("_", "-", path)
  return path
}

function part(of) {
  sub("-[0-9]+$", "", of)
  return of
}

function number(of) {
  sub(".*-", "", of)
  return of + 0
}

function refuse(where, what, hint) {
  printf "%s:1: error: %s\n%s:1: hint: %s\n", where, what, where, hint
  failed = 1
}
