#!/usr/bin/env bash
# What is missing gets installed, once, and each command asks only for what it needs.
source "$(dirname "$0")/stand_in.sh"
shopt -s extglob

grep -v -x -e nodejs -e npm -e g++ -e clang-tidy -e rt-tests "$work/installed" >"$work/less" && mv "$work/less" "$work/installed"
if ((EUID != 0)); then
  stand_in sudo <<'BODY'
exec "$@"
BODY
fi
flexrf run <<<"wd"
expect "exit code" "$status" 0
expect "what is missing, and why" "$errors" "*missing:*g++ *compiler*installed 1 packages*"
expect "what run does not need" "$errors" "!(*clang-tidy*|*rt-tests*|*chromium*|*nodejs*|*npm*)"
expect "standard input" "$output" "*input: wd"
expect "calls" "$(<"$calls")" "*apt-get *update*apt-get *-y*install --no-install-recommends g++*cmake --preset release*"

: >"$calls"
flexrf run <<<"wd"
expect "exit code of the second run" "$status" 0
expect "calls of the second run" "$(<"$calls")" "dpkg-query *"$'\n'"ninja *visual-servoing"
expect "what the second run says" "$errors" "flexrf: built visual-servoing (release): *"

# Debian's npm would not work with the Node.js of another one.
touch "$work/changed_page"
stand_in npm </dev/null
flexrf run <<<"wd"
expect "what a changed page needs where there is an npm" "$errors" "flexrf: built visual-servoing (release): *"

printf 'g++\n' >"$work/installed"
touch "$work/no_network"
flexrf build </dev/null
expect "exit code without the packages" "$status" 1
expect "message without the packages" "$errors" "*E: Unable to locate package*could not install: cmake *"

# Neither root nor sudo: as somebody else, with nothing else in PATH.
: >"$work/installed"
mkdir "$work/path"
for program in bash env readlink dirname mktemp cat grep; do ln -s "$(command -v $program)" "$work/path/$program"; done
rm -f "$work/bin/sudo" "$work/bin/npm"
user=(env)
((EUID == 0)) && user=("$(command -v setpriv)" --reuid=65534 --regid=65534 --clear-groups)
chmod -R go+rwX "$work"
"${user[@]}" "$(command -v env)" PATH="$work/bin:$work/path" "$tree/flexrf" build </dev/null >"$work/output" 2>"$work/errors"
expect "exit code without root or sudo" $? 3
expect "message without root or sudo" "$(<"$work/errors")" "*needs root*no sudo*apt-get install g++ cmake *nodejs npm*"
rm "$work/changed_page"
"${user[@]}" "$(command -v env)" PATH="$work/bin:$work/path" "$tree/flexrf" build </dev/null >"$work/output" 2>"$work/errors"
expect "exit code without root or sudo, with the kept page" $? 3
expect "what the kept page does without" "$(<"$work/errors")" "!(*nodejs*|*npm*)"
finish
