#!/usr/bin/env bash
# parts.sh PROGRAM:[LIBRARY[,LIBRARY]...]...
# Each program is linked to no libraries of others but these, besides the language's, the sanitizers' and CMocka.
set -u

everybody='ld-linux.*|libc|libm|libgcc_s|libstdc\+\+|libcmocka|lib[a-z]+san|libclang_rt.*'
failed=0
for argument in "$@"; do
  program=${argument%:*}
  wanted=${argument##*:}
  if ! headers=$(objdump --private-headers "$program"); then
    failed=1
    continue
  fi
  further=$(awk '$1 == "NEEDED" { print $2 }' <<<"$headers" |
    grep --invert-match --extended-regexp "^($everybody${wanted:+|lib(${wanted//,/|})})\.so")
  if [[ -n $further ]]; then
    echo "${program##*/} is linked to" "$further" \
      "also, which its part of the runtime is not for: see what runtime/*/CMakeLists.txt links to that part"
    failed=1
  fi
done
exit "$failed"
