#!/usr/bin/env bash
# `image` says what is wrong before it makes anything: a name, a place, room, packages that cannot be had.
source "$(dirname "$0")/stand_in.sh"

mkdir -p "$tree/image"
cp -r "$repository/image/disk" "$tree/image/"
# The machine that the image is made on is one of Debian 12, wherever this runs; so much is free as a test says.
stand_in df <<'BODY'
printf 'Avail\n%s\n' "$(cat "$STAND_IN/free")"
BODY
stand_in uname <<'BODY'
echo x86_64
BODY
echo 5000 >"$work/free"
if ! grep -q '^VERSION_ID="12"' /etc/os-release; then
  flexrf image keyboard </dev/null
  expect "exit code elsewhere" "$status" 1
  expect "message elsewhere" "$errors" "*there can be no image on this machine: *Debian 12*"
  finish
fi

refused() {  # refused PATTERN ARGUMENT...: nothing is built then
  : >"$calls"
  flexrf image "${@:2}" </dev/null
  expect "exit code of 'image ${*:2}'" "$status" 1
  expect "message of 'image ${*:2}'" "$errors" "$1"
  expect "builds of 'image ${*:2}'" "$(grep -c ^ninja "$calls")" 0
}

refused "*it takes the name of one application*./flexrf image APP*"
refused "*unknown application 'keybord', did you mean 'keyboard'?*" keybord
refused "*unexpected 'keyboard-single'*" keyboard keyboard-single
refused "*unknown option '--ouput', did you mean '--output'?*" keyboard --ouput x
refused "*--output needs the name of a file*" keyboard --output
refused "*there is no folder $work/nowhere for the image; make it first: mkdir -p $work/nowhere" keyboard --output "$work/nowhere/cell.img"
refused "*$work/bin is a folder; name a file: --output $work/bin/cell.img" keyboard --output "$work/bin"
refused "*/dev/null is not an ordinary file*./flexrf flash FILE /dev/null" keyboard --output /dev/null
refused "*--keyring needs the name of a file*" keyboard --keyring
refused "*--version needs a value*" keyboard --version
refused "*--version: 'a b' is no name of a version*" keyboard --version 'a b'
refused "*--new-keys DIR stands alone*" keyboard --new-keys "$work/keys"
refused "*--key and --certificate belong together*" keyboard --bundle --key x
refused "*--keyring is missing: which CA the PC trusts from this version on*" keyboard --bundle --key x --certificate y
refused "*a bundle is signed: --keyring needs --key and --certificate*" keyboard --bundle --keyring x
refused "*--key and --certificate sign a bundle: with --bundle*" keyboard --key x --certificate y
refused "*--boot-password-hash is for a disk*" keyboard --bundle --boot-password-hash grub.pbkdf2.sha512.10000.AB.CD
refused "*--boot-password-hash: 'secret' is no hash of a password; grub-mkpasswd-pbkdf2 makes one*" keyboard --boot-password-hash secret
mkdir -p "$tree/apps/keyboard/pc" && echo secret >"$tree/apps/keyboard/pc/boot-password"
refused "*$tree/apps/keyboard/pc/boot-password: 'secret' is no hash of a password*" keyboard
rm -r "$tree/apps/keyboard/pc"

# Keys: made once, outside of the repository, and what is signed by others is none of a PC's.
keys() { flexrf image --new-keys "$1" </dev/null; } # keys FOLDER
keys "$tree/keys"
expect "exit code of keys in the repository" "$status" 1
expect "message of keys in the repository" "$errors" "*$tree/keys is in the repository*"
expect "the folder" "$(ls -d "$tree/keys" 2>&1)" "*cannot access*"
keys "$work/keys"
expect "exit code of --new-keys" "$status" 0
expect "message of --new-keys" "$errors" "*ca.key *signer.key *--key $work/keys/signer.key --certificate $work/keys/signer.pem*"
expect "who may read the keys" "$(stat -c %a "$work"/keys/{ca,signer}.{key,pem} | tr '\n' ' ')" "600 644 600 644 "
before=$(cat "$work"/keys/*)
keys "$work/keys"
expect "exit code of keys again" "$status" 1
expect "message of keys again" "$errors" "*$work/keys has a ca.key already*"
expect "the keys of before" "$(cat "$work"/keys/*)" "$before"
keys "$work/others"
refused "*--keyring: there is no file $work/nothing that can be read" keyboard --keyring "$work/nothing"
refused "*--keyring: $work/keys/ca.key is no certificate (PEM); ./flexrf image --new-keys DIR makes one" keyboard --keyring "$work/keys/ca.key"
refused "*the certificate $work/keys/signer.pem is not that of the key $work/others/signer.key" keyboard --bundle \
  --key "$work/others/signer.key" --certificate "$work/keys/signer.pem" --keyring "$work/keys/ca.pem"
refused "*a PC with the keyring $work/others/ca.pem would not trust the certificate $work/keys/signer.pem: *" keyboard --bundle \
  --key "$work/keys/signer.key" --certificate "$work/keys/signer.pem" --keyring "$work/others/ca.pem"
refused "*the certificate $work/keys/ca.pem is not one for signing code*" keyboard --bundle \
  --key "$work/keys/ca.key" --certificate "$work/keys/ca.pem" --keyring "$work/keys/ca.pem"

# The development key is made once, kept where caches are, and said loudly.
chosen() {  # chosen: what the command takes without keys
  (
    root=$tree tool=$tree/cmake/tool cache=$work/cache
    source "$tool/words.sh"
    source "$tool/image.sh"
    choose_keys && printf '%s %s\n' "$development_key" "$image_keyring" && cat "$image_keyring"
  ) 2>"$work/chosen"
}
first=$(chosen)
expect "the development key" "$first" "yes $work/cache/development-key/ca.pem*"
expect "the development key is said" "$(<"$work/chosen")" "*WARNING: *$work/cache/development-key*anyone who has it can make an update*"
expect "the same again" "$(chosen)" "$first"
expect "nothing left of making it" "$(echo "$work"/cache/development-key*)" "$work/cache/development-key"

echo 699 >"$work/free"
refused "*there are 699 MiB left in *" keyboard
echo 1000 >"$work/free"
refused "*there are 1000 MiB left in *making an image takes up to 1500" keyboard
echo 5000 >"$work/free"

# A package that is missing is named, with what for.
grep -v -x -e mtools "$work/installed" >"$work/less" && mv "$work/less" "$work/installed"
touch "$work/no_network"
refused "*mtools *could not install: mtools*" keyboard
rm "$work/no_network"
install_all

# The packages of the image itself: neither in the lists nor to be had.
stand_in apt-get <<'BODY'
exit 100
BODY
stand_in sudo <<'BODY'
exec "$@"
BODY
output=$(bash "$tree/image/disk/fetch_packages.sh" "$work/packages" dash coreutils 2>&1)
expect "exit code without a network" $? 1
expect "message without a network" "$output" "*not all packages could be had: dash coreutils*hint: is there a network*"

# Which version it is: the last commit's time and name, and whether something was changed since.
git init -q "$work/repository" && git -C "$work/repository" config user.name x && git -C "$work/repository" config user.email x@example.com
GIT_COMMITTER_DATE='2026-11-28T00:15:00Z' git -C "$work/repository" commit -q --allow-empty -m x
version() {  # as the image says it
  (
    root=$tree tool=$tree/cmake/tool
    source "$tool/words.sh"
    source "$tool/image.sh"
    root=$work/repository
    version_text
  )
}
commit=$(git -C "$work/repository" log -1 --format=%h)
expect "version" "$(version)" "20261128T001500Z-$commit"
touch "$work/repository/changed"
expect "version with a change" "$(version)" "20261128T001500Z-$commit-dirty"

# What the tables and the role map make of the kernel's command line.
cat >"$work/descriptor" <<'BODY'
{"threads": [{"priority": 40, "role": "control"}, {"priority": 20, "role": "io"}, {"priority": 0, "role": "any"}],
 "devices": [{"drivers": [{"type": "modbus_rtu_link", "configuration": {"device": "/dev/ttyS0"}}]}]}
BODY
options() { bash "$tree/image/disk/kernel_options.sh" "$work/descriptor" "$work/machine.conf" 2>&1; }
printf 'control = 3  # one\nio = "2"\nany = 1\n' >"$work/machine.conf"
expect "CPUs of the roles" "$(options)" "* isolcpus=managed_irq,domain,2,3 nohz_full=2,3 rcu_nocbs=2,3 irqaffinity=0,1 *"
expect "a serial line of the cell's own" "$(options)" "console=tty0 quiet *"
printf 'control = 1-3\nio = 2\nrest = 0\n' >"$work/machine.conf"
expect "lists of CPUs" "$(options)" "* isolcpus=managed_irq,domain,1,2,3 * irqaffinity=0 *"
printf 'control = 1\n' >"$work/machine.conf"
expect "a role without a line" "$(options)" "*have the role 'io', and there is no line for it"$'\n'"hint: io = 1"
printf 'control = 0\nio = 1\n' >"$work/machine.conf"
expect "nothing left" "$(options)" "*nothing is left for all others"$'\n'"hint: rest = 0"
sed -i 's|/dev/ttyS0|/dev/ttyS2|' "$work/descriptor"
printf 'control = 1\nio = 1\n' >"$work/machine.conf"
expect "a serial line for the console" "$(options)" "console=tty0 console=ttyS0,115200 *"
finish
