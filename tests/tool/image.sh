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
refused "*--new-signer DIR stands alone*" keyboard --new-signer "$work/keys"
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
refused "*$work/bin has no ca.key and ca.pem*" --new-signer "$work/bin"
flexrf image --new-signer "$work/keys" </dev/null
expect "exit code of --new-signer" "$status" 0
expect "message of --new-signer" "$errors" "*--key $work/keys/signer-2.key --certificate $work/keys/signer-2.pem*A key that was stolen*"
expect "who may read the new signer's key" "$(stat -c %a "$work"/keys/signer-2.{key,pem} | tr '\n' ' ')" "600 644 "
refused "*--keyring: there is no file $work/nothing that can be read" keyboard --keyring "$work/nothing"
refused "*--keyring: $work/installed is no certificate (PEM); ./flexrf image --new-keys DIR makes one" keyboard --keyring "$work/installed"
refused "*the certificate $work/keys/signer.pem is not that of the key $work/others/signer.key" keyboard --bundle \
  --key "$work/others/signer.key" --certificate "$work/keys/signer.pem" --keyring "$work/keys/ca.pem"
refused "*a PC with the keyring $work/others/ca.pem would not trust the certificate $work/keys/signer.pem: *" keyboard --bundle \
  --key "$work/keys/signer.key" --certificate "$work/keys/signer.pem" --keyring "$work/others/ca.pem"
refused "*the certificate $work/keys/ca.pem is not one for signing code*" keyboard --bundle \
  --key "$work/keys/ca.key" --certificate "$work/keys/ca.pem" --keyring "$work/keys/ca.pem"

cat "$work/keys/ca.pem" "$work/keys/ca.key" >"$work/with_key.pem"
refused "*--keyring: $work/with_key.pem has a private key in it*" keyboard --keyring "$work/with_key.pem"
{ cat "$work/keys/ca.pem" && echo '-----BEGIN X509 CRL-----'; } >"$work/with_list.pem"
refused "*--keyring: $work/with_list.pem has a list of revoked certificates, which PCs do not look at*" keyboard --keyring "$work/with_list.pem"

# Another CA: a PC that trusts the old one takes a version that trusts both, and that one takes a version that trusts the new one alone. After
# it nothing that the old one's signers have signed is taken.
cat "$work/keys/ca.pem" "$work/others/ca.pem" >"$work/both.pem"
bundle() {  # bundle NAME KEYS SIGNER KEYRING
  (
    root=$tree tool=$tree/cmake/tool
    source "$tool/words.sh"
    source "$tool/image.sh"
    image_key=$2/$3.key image_certificate=$2/$3.pem image_keyring=$4
    choose_keys
    mkdir -p "$work/packed/identity" && head -c 4096 /dev/urandom | tee "$work/packed/boot.img" >"$work/packed/root.img"
    printf '%s\n' "version=$1" built=1 >"$work/packed/identity/version"
    pack_bundle "$work/packed" flexrf-keyboard-amd64 "$work/$1.raucb"
  ) >"$work/bundled" 2>&1 || expect "packing of the bundle $1" "$(<"$work/bundled")" none
}
taken() {  # taken KEYRING BUNDLE: whether a PC with this keyring takes it
  printf '%s\n' '[system]' compatible=flexrf-keyboard-amd64 bootloader=noop '[keyring]' "path=$1" check-purpose=codesign use-bundle-signing-time=true >"$work/pc.conf"
  if rauc --conf="$work/pc.conf" info "$work/$2.raucb" >/dev/null 2>&1; then echo yes; else echo no; fi
}
if command -v rauc >/dev/null; then
  bundle both-trusted "$work/keys" signer "$work/both.pem"
  bundle new-trusted "$work/others" signer "$work/others/ca.pem"
  bundle of-the-thief "$work/keys" signer-2 "$work/keys/ca.pem"
  expect "the version that trusts both, on a PC that trusts the old CA" "$(taken "$work/keys/ca.pem" both-trusted)" yes
  expect "the version of the new CA there" "$(taken "$work/keys/ca.pem" new-trusted)" no
  for name in both-trusted new-trusted of-the-thief; do expect "$name where both are trusted" "$(taken "$work/both.pem" "$name")" yes; done
  expect "another signer of the old CA, on a PC that trusts the new one alone" "$(taken "$work/others/ca.pem" of-the-thief)" no
  expect "the version of the new CA there" "$(taken "$work/others/ca.pem" new-trusted)" yes
else
  echo "not tried: bundles, there is no rauc"
fi

# The development key is made once, kept where caches are, and said loudly.
chosen() {  # chosen [KEYRING]: what the command takes without keys
  (
    root=$tree tool=$tree/cmake/tool cache=$work/cache
    source "$tool/words.sh"
    source "$tool/image.sh"
    image_keyring=${1-}
    choose_keys && printf '%s %s\n' "$development_key" "$image_keyring" && cat "$image_keyring"
  ) 2>"$work/chosen"
}
first=$(chosen)
expect "the development key" "$first" "yes $work/cache/development-key/ca.pem*"
expect "the development key is said" "$(<"$work/chosen")" "*WARNING: *$work/cache/development-key*anyone who has it can make an update*"
expect "the same again" "$(chosen)" "$first"
cat "$work/keys/ca.pem" "$work/cache/development-key/ca.pem" >"$work/with_development.pem"
expect "a development key beside another one" "$(chosen "$work/with_development.pem")" "yes *"
expect "it is said" "$(<"$work/chosen")" "*WARNING: a development key is in the keyring*"
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

# What is in an image: Debian's packages, headers that are compiled in, the packages of the page, GRUB; in the words of SPDX 2.3.
deb() {  # deb NAME VERSION: its file
  local file=$work/deb/$1_${2/:/%3a}_amd64.deb
  mkdir -p "$work/deb" && echo "$1" >"$file" && printf '%s\n' "$file"
}
stand_in dpkg-query <<'BODY'
printf 'deb\tlibboost-dev\t1.74.0.3\tamd64\t-\t-\tSTATIC_LINK\n'
BODY
mkdir -p "$work/sbom/identity" "$tree/web-ui/panel" && echo root >"$work/sbom/root.img" && echo version=7 >"$work/sbom/identity/version"
printf '%s\n' '{"packages": {"": {"version": "1"}, "node_modules/@lit/element": {"version": "2.1.2", "license": "BSD-3-Clause"},' \
  '"node_modules/vite": {"version": "6.3.0", "dev": true}}}' >"$tree/web-ui/panel/package-lock.json"
(
  root=$tree tool=$tree/cmake/tool
  source "$tool/words.sh"
  source "$tool/image.sh"
  export SOURCE_DATE_EPOCH=1767225600
  deb libstdc++6 12.2.0-14+deb12u1 >"$work/sbom/packages"
  kernel_file=$(deb linux-image 6.1) busybox_file=$(deb busybox-static 1:6.1)
  write_sbom "$work/sbom" cell image "$work/sbom/cell.img"
) || expect "the list of what is in it" failed written
sbom() { jq -r "$1" "$work/sbom/cell.img.spdx.json"; } # sbom FILTER
expect "what the document is" "$(sbom '"\(.spdxVersion) \(.dataLicense) \(.SPDXID) \(.creationInfo.created) \(.name)"')" \
  "SPDX-2.3 CC0-1.0 SPDXRef-DOCUMENT 2026-01-01T00:00:00Z cell 7, image for an industrial PC"
expect "what is in it" "$(sbom '[.packages[].name] | sort | join(" ")')" '@lit/element FlexRF busybox-static cell libboost-dev libstdc++6 linux-image'
expect "how a package of Debian is named" "$(sbom '.packages[] | select(.name == "libstdc++6") | "\(.SPDXID) \(.externalRefs[0].referenceLocator)"')" \
  'SPDXRef-deb-libstdcplusplus6 pkg:deb/debian/libstdc%2B%2B6@12.2.0-14%2Bdeb12u1[?]arch=amd64'
expect "its checksum" "$(sbom '.packages[] | select(.name == "libstdc++6") | .checksums[0].checksumValue')" "$(echo libstdc++6 | sha256sum | head -c 64)"
expect "a version with an epoch" "$(sbom '.packages[] | select(.name == "busybox-static") | "\(.versionInfo) \(.externalRefs[0].referenceLocator)"')" \
  '1:6.1 pkg:deb/debian/busybox-static@1%3A6.1[?]arch=amd64'
expect "how a package of the page is named" "$(sbom '.packages[] | select(.name == "@lit/element") | "\(.licenseDeclared) \(.externalRefs[0].referenceLocator)"')" \
  'BSD-3-Clause pkg:npm/%40lit/element@2.1.2'
expect "relationships whose ends are not there" "$(sbom '([.packages[].SPDXID, .SPDXID]) as $known | [.relationships[] | .spdxElementId, .relatedSpdxElement] - $known | length')" 0
expect "packages without a relationship" "$(sbom '[.packages[].SPDXID] - [.relationships[].relatedSpdxElement] | length')" 0
expect "identifiers that are there twice" "$(sbom '[.packages[].SPDXID] | length - (unique | length)')" 0
expect "identifiers of another form" "$(sbom '[.packages[].SPDXID | select(test("^SPDXRef-[A-Za-z0-9.-]+$") | not)] | length')" 0

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
