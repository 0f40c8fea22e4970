#!/usr/bin/env bash
# Words that flexrf does not know, and its help.
source "$(dirname "$0")/stand_in.sh"

unknown() {  # unknown NEAREST ARGUMENT...
  local nearest=$1
  shift
  flexrf "$@" </dev/null
  expect "exit code of '$*'" "$status" 1
  expect "message of '$*'" "$errors" "*did you mean '$nearest'?*"
  expect "output of '$*'" "$output" ""
}
unknown run rnu
unknown doctor docter
unknown help hepl
unknown build help biuld
unknown keyboard run keybaord
unknown keyboard-single run keyboard_single
unknown keyboard map keybord
unknown release build --preset relase
unknown tsan test release tsna
unknown keyboard check keybord
unknown unit new unti name
unknown password pasword
unknown keyboard password keybord
unknown guest guesst

unknown_option() {  # unknown_option NEAREST ARGUMENT...: with the command's help, and nothing is run
  unknown "$@"
  expect "help of '${*:2}'" "$errors" "*./flexrf $2*"
}
unknown_option --full test --ful
unknown_option --guest test release --geust
unknown_option --preset build --prset release
unknown_option --markdown bench --markdwon
unknown_option --remove password --remov admin
unknown_option --yes flash image --yse
unknown_option --help test --hlep

flexrf test release --full </dev/null
expect "exit code of a misplaced option" "$status" 1
expect "message of a misplaced option" "$errors" "*--full comes first*"
flexrf run --keys file </dev/null
expect "exit code of a misplaced argument" "$status" 1
expect "message of a misplaced argument" "$errors" "*unknown option '--keys'*after --*"
flexrf build --preset </dev/null
expect "exit code of a preset left out" "$status" 1
flexrf guest uname </dev/null
expect "exit code of a command without --" "$status" 1
expect "message of a command without --" "$errors" "*unexpected 'uname'*after --*"
flexrf guest </dev/null
expect "exit code of a console without a terminal" "$status" 1
expect "message of a console without a terminal" "$errors" "*needs a terminal*"
expect "calls of what was not understood" "$(<"$calls")" ""

flexrf help </dev/null
expect "exit code of help" "$status" 0
commands=(run test build guest image flash check map bench doctor new password help)
for command in "${commands[@]}"; do
  expect "help lists" "$output" "*./flexrf $command *"
done
for command in "${commands[@]}"; do
  flexrf "$command" --help </dev/null
  expect "exit code of $command --help" "$status" 0
  expect "$command --help" "$output" "*./flexrf $command*"
done
flexrf run -- --help </dev/null
expect "the application's help" "$output" "*arguments: --help*"
finish
