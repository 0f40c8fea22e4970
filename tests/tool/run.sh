#!/usr/bin/env bash
# `run` gives the application its arguments and all of standard input, and hands its exit code back.
source "$(dirname "$0")/stand_in.sh"

printf 'wwwwddd' | "$tree/flexrf" run keyboard >"$work/output" 2>"$work/errors"
expect "exit code" $? 0
expect "standard input" "$(<"$work/output")" "arguments: "$'\n'"input: wwwwddd"
expect "how it was built" "$(<"$work/errors")" "*built keyboard (release): *"

flexrf run -- 0 'two words' --keys </dev/null
expect "arguments of the default application" "$output" "arguments: 0 two words --keys*"
expect "the default application" "$errors" "*built visual-servoing (release): *"
flexrf run keyboard-single -- 0 -- x </dev/null
expect "arguments of a named application" "$output" "arguments: 0 -- x*"
expect "target" "$(<"$calls")" "*ninja *build/release keyboard-single*"

configuration=$tree/apps/visual-servoing/config.xml
touch "$configuration"
flexrf run -- 0 x </dev/null
expect "configuration file of the application" "$output" "arguments: --config $configuration 0 x*"
flexrf run -- 0 --config mine </dev/null
expect "configuration file that was asked for" "$output" "arguments: 0 --config mine"$'\n'*
flexrf run -- 0 --config=mine </dev/null
expect "configuration file that was asked for" "$output" "arguments: 0 --config=mine"$'\n'*
flexrf run keyboard-single -- 0 </dev/null
expect "an application without one" "$output" "arguments: 0"$'\n'*
rm "$configuration"

users=$tree/apps/visual-servoing/panel-users
touch "$users"
flexrf run -- 0 x </dev/null
expect "passwords of the application" "$output" "arguments: --panel-users $users 0 x*"
flexrf run -- 0 --panel-users mine </dev/null
expect "passwords that were asked for" "$output" "arguments: 0 --panel-users mine"$'\n'*
flexrf run keyboard-single -- 0 </dev/null
expect "an application without passwords" "$output" "arguments: 0"$'\n'*
rm "$users"

for code in 0 1 2 3; do
  flexrf run keyboard -- "$code" </dev/null
  expect "exit code" "$status" "$code"
done
flexrf run keyboard -- SIGTERM </dev/null
expect "exit code of a signal" "$status" 143

cd / && "$tree/flexrf" run -- 0 </dev/null >/dev/null 2>&1
expect "exit code from another folder" $? 0
ln -s "$tree/flexrf" "$work/link" && "$work/link" run -- 0 </dev/null >/dev/null 2>&1
expect "exit code through a link" $? 0

touch "$work/broken"
flexrf run keyboard </dev/null
expect "exit code of a broken build" "$status" 1
expect "the compiler's output" "$errors" "FAILED: it*source.cpp:1: error: broken*building keyboard (release) failed*"
expect "output of a broken build" "$output" ""
finish
