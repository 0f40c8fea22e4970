#!/usr/bin/env bash
# An industrial PC's own files (image/disk): the configuration that a slot starts with, how damaged users, keys and certificates are
# replaced, that an update is marked as whole only when the disk gives back what was written, and how much room is kept. The PC's scripts run here on folders of this test.
source "$(dirname "$0")/stand_in.sh"
if ! command -v openssl >/dev/null; then
  echo "not tried: there is no openssl"
  finish
fi
pc=$work/pc
stand_in flexrf-claim <<'BODY'
exit "$(cat "$STAND_IN/users_status")"
BODY
stand_in chown </dev/null

runs() {  # runs SCRIPT: as the PC does; sets status and output
  mkdir -p "$pc/scripts"
  sed -e "s|/usr/lib/flexrf/\(flexrf-[a-z-]*\)|\1|; s|/dev/flexrf/|$pc/dev/|g; s|/usr/lib/flexrf/slots|$pc/scripts/slots|; s|/usr/lib/flexrf/|$repository/image/disk/root&|" \
    -e "s|/data|$pc/data|; s|/run/|$pc/run/|; s|/etc/|$pc/etc/|" "$repository/image/disk/root/usr/lib/flexrf/$1" >"$pc/scripts/$1"
  sed "s|/proc/cmdline|$pc/cmdline|" "$repository/image/disk/root/usr/lib/flexrf/slots" >"$pc/scripts/slots"
  output=$(cd "$pc" && sh "$pc/scripts/$1" 2>&1)
  status=$?
}

# ---- which configuration

boots() {  # boots SLOT WHY: and chooses its configuration
  echo "quiet rauc.slot=$1 flexrf.boot=$2 flexrf.trial=0000000001" >"$pc/cmdline"
  runs choose-configuration
  expect "exit code of choose-configuration" "$status" 0
}
own() { cat "$pc/data/flexrf/config-$1.xml" 2>/dev/null; } # own SLOT
saves() { echo "$2" >"$pc/data/flexrf/config-$1.xml"; }    # saves SLOT VALUE

mkdir -p "$pc"/{data/flexrf,run/flexrf,run/flexrf-notices,etc}
boots A only
saves a first
boots B trial
expect "configuration of a new version" "$(own b)" first
expect "what systemd is told" "$(<"$pc/run/flexrf/configuration")" "CONFIGURATION=*/flexrf/config-b.xml"
saves b second
cp "$pc/data/flexrf/config-b.xml" "$pc/data/flexrf/config-b.xml.previous"
boots A fallback
expect "configuration after a fallback" "$(own a)" first
boots B confirmed
expect "configuration of the version that comes back" "$(own b)" second
# The disk is written anew, the data is kept: slot A runs, where B ran last.
boots A only
expect "configuration on a disk that was written anew" "$(own a)" second
expect "the one before it" "$(cat "$pc/data/flexrf/config-a.xml.previous")" second
expect "what is said" "$output" "*the configuration is that of slot B, which ran last*"
saves a third
boots A only
expect "configuration at the next start" "$(own a)" third
# Slot B ran last, but has left no configuration: slot A keeps its own.
boots B manual
rm "$pc/data/flexrf"/config-b.xml*
boots A only
expect "configuration without another one" "$(own a)" third

# ---- users, key and certificate

flexrf=$pc/data/flexrf
echo pc >"$pc/etc/hostname"
echo 0123456789abcdef0123456789abcdef >"$pc/etc/machine-id"
notices() { cat "$pc/run/flexrf-notices/identity" 2>/dev/null; }
is_pair() { [[ $(openssl x509 -in "$flexrf/panel.crt" -noout -pubkey) == "$(openssl pkey -in "$flexrf/panel.key" -pubout)" ]] && echo pair; }
look() {  # look STATUS_OF_USERS
  rm -f "$pc/run/flexrf-notices/identity"
  echo "$1" >"$work/users_status"
  runs first-boot
  expect "exit code of first-boot" "$status" 0
  expect "key and certificate" "$(is_pair)" pair
}
look 0
expect "first boot" "$output" "*first boot: data has *Fingerprint=*"
expect "machine-id" "$(<"$pc/data/machine-id")" 0123456789abcdef0123456789abcdef
key=$(<"$flexrf/panel.key")
echo anna >"$flexrf/panel-users"
look 0
expect "second boot" "$output" ""
expect "key of the second boot" "$(<"$flexrf/panel.key")" "$key"
look 127
expect "users whom nobody could look at" "$(<"$flexrf/panel-users")" anna
look 2
expect "damaged users" "$(<"$flexrf/panel-users.damaged") $(ls "$flexrf/panel-users" 2>/dev/null)" "anna "
expect "notice of damaged users" "$(notices)" "who may log in could not be read, *: claim this PC anew *"
for damage in 'echo garbage >"$flexrf/panel.crt"' 'echo garbage >"$flexrf/panel.key"' ': >"$flexrf/panel.key"' 'rm "$flexrf/panel.crt"' \
  'openssl genpkey -algorithm EC -pkeyopt ec_paramgen_curve:P-256 -out "$flexrf/panel.key" 2>/dev/null'; do
  eval "$damage"
  look 0
  expect "notice after $damage" "$(notices)" "the panel's key or certificate was damaged, and is made anew: *Fingerprint=*"
done
look 0
expect "notice of what is whole" "$(notices)" ""
# ---- what an update wrote

stand_in flexrf-boot-choice </dev/null
stand_in blockdev <<'BODY'
[[ $1 != --getsize64 ]] || exec stat -c %s "$2"
[[ ! -e $STAND_IN/disk_changes ]] || printf X | dd of="$2" bs=1 seek=5000 conv=notrunc status=none
BODY
mkdir -p "$pc"/{dev,data/update,run/flexrf-update,bundle}
echo 'version=second' >"$pc/bundle/version"
: >"$pc/run/flexrf-update/manifest"
written=0
for part in boot root; do
  head -c 9000 /dev/urandom >"$work/$part.img"
  { cat "$work/$part.img" && head -c 5000 /dev/zero; } >"$pc/dev/$part-b" # the partition is larger
  printf "RAUC_IMAGE_%s_$written='%s'\n" CLASS "$part" SIZE 9000 DIGEST "$(sha256sum <"$work/$part.img" | head -c 64)" >>"$pc/run/flexrf-update/manifest"
  written=$((written + 1))
done
export RAUC_BUNDLE_MOUNT_POINT=$pc/bundle
echo "quiet rauc.slot=A flexrf.boot=confirmed" >"$pc/cmdline"
: >"$calls"
runs after-install
expect "exit code after an update" "$status" 0
expect "the mark" "$(grep mark-whole "$calls")" "flexrf-boot-choice mark-whole B $pc/dev/boot-b $pc/dev/root-b"
expect "the slot's version" "$(<"$pc/data/update/version-b")" version=second
rm "$pc/data/update/version-b"
touch "$work/disk_changes"
: >"$calls"
runs after-install
expect "exit code with a disk that changes" "$status" 1
expect "the mark with a disk that changes" "$(grep -c mark-whole "$calls")" 0
expect "why it was refused" "$(<"$pc/run/flexrf-update/refused")" "the disk does not give back what was written to boot-b: it is defective, *"
[[ ! -e $pc/data/update/version-b ]] || expect "a version for a slot that is not whole" there none
# ---- room for updates

PATH=$PATH:/usr/sbin:/sbin
for size in 256 4096; do # MiB
  truncate -s "${size}M" "$work/data.img"
  mke2fs -q -F -t ext4 -m 0 "$work/data.img"
  for _ in first second; do sh "$repository/image/disk/root/usr/lib/flexrf/keep-room" "$work/data.img" 2>"$work/said" || expect "keep-room of $size MiB" "$(<"$work/said")" none; done
  kept=$(dumpe2fs -h "$work/data.img" 2>/dev/null | awk -F : '$1 == "Reserved block count" { blocks = $2 } $1 == "Block size" { print blocks * $2 / 1048576 }')
  expect "MiB kept of $size" "$kept" $((size / 4 < 512 ? size / 4 : 512))
  expect "the second time" "$(<"$work/said")" ''
  rm "$work/data.img"
done
finish
