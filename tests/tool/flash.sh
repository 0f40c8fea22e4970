#!/usr/bin/env bash
# `flash` refuses what must not be written, asks before it writes, writes all of an image and reads it back. The disks are played: lsblk is
# a stand-in, and the disk that is written a file. At the end a real loop device is written, where there is one.
source "$(dirname "$0")/stand_in.sh"
PATH=$PATH:/usr/sbin:/sbin
for program in sfdisk jq perl script; do
  if ! command -v "$program" >/dev/null; then
    echo "not tried: there is no $program"
    finish
  fi
done
without_stand_ins=${PATH#"$work/bin:"}
of_root=image/disk/root/usr/lib/flexrf
mkdir -p "$tree/$of_root" && cp "$repository/$of_root/own-identifiers" "$tree/$of_root/"
dev=$work/dev
image=$work/cell.img
mkdir "$dev"

make_image() {  # make_image FILE NAME...: 16 MiB with partitions of these names, and something in the first and the last one
  local name table='label: gpt'
  for name in "${@:2}"; do table+=$'\n'"size=2048, name=\"$name\""; done
  truncate -s 0 "$1"
  truncate -s 16M "$1"
  sfdisk -q "$1" <<<"$table"
  head -c 300000 /dev/urandom | dd of="$1" bs=1M seek=1 conv=notrunc status=none
  head -c 300000 /dev/urandom | dd of="$1" bs=1M seek=9 conv=notrunc status=none
}
make_image "$image" bios esp boot-a boot-b root-a root-b data

# What lsblk says of the machine: the disk that may be written is sdb, the others are in use or of no use.
cat >"$work/disks.jq" <<'BODY'
def disk($name; $more): {name: $name, path: "\($dev)/\($name)", type: "disk", size: 31914983424, "log-sec": 512, ro: false, rm: true, tran: "usb",
  vendor: "SanDisk ", model: "Ultra", serial: "4C53", fstype: null, label: null, partlabel: null, mountpoints: [null]} + $more;
def part($name; $more): disk($name; {type: "part", vendor: null, model: null, serial: null, tran: null} + $more);
{blockdevices: [
  disk("sda"; {rm: false, tran: "sata", children: [part("sda1"; {mountpoints: ["/boot/efi"]}),
    part("sda2"; {children: [disk("vg-root"; {type: "lvm", mountpoints: ["/"]})]})]}),
  disk("sdb"; {size: 33554432, model: "Ul\u001b[31mtra\u202e", children: [part("sdb1"; {label: "OLD", fstype: "vfat"}), part("sdb2"; {fstype: "ext4"})]}),
  disk("sdc"; {children: [part("sdc1"; {mountpoints: ["/media/my data", "/mnt"]})]}),
  disk("sdd"; {children: [part("sdd1"; {mountpoints: ["[SWAP]"]})]}),
  disk("sde"; {children: [part("sde1"; {fstype: "LVM2_member", children: [disk("vg-data"; {type: "lvm"})]})]}),
  disk("sdf"; {children: [disk("md0"; {type: "raid1"})]}),
  disk("sdg"; {children: [disk("secret"; {type: "crypt"})]}),
  disk("sdh"; {ro: true}),
  disk("sdi"; {"log-sec": 4096}),
  disk("sdj"; {size: 16777215}),
  disk("sdk"; {size: 0}),
  disk("sdl"; {children: [part("sdl1"; {})]}),
  disk("sdm"; {}),
  disk("sdn"; {fstype: "crypto_LUKS"}),
  disk("sdo"; {children: [part("sdo1"; {fstype: "vfat"}), part("sdo2"; {fstype: "LVM2_member"}), part("sdo3"; {fstype: "linux_raid_member"})]}),
  disk("sr0"; {type: "rom"}),
  disk("zram0"; {}),
  disk("loop7"; {type: "loop", size: 33554432}),
  disk("nvme0n1"; {rm: false, tran: "nvme", vendor: null, model: "Disk", children: [part("p1"; {partlabel: "boot-a"}), part("p2"; {partlabel: "root-a"}), part("p3"; {partlabel: "data"})]})
]}
BODY
jq -n --arg dev "$dev" -f "$work/disks.jq" >"$work/disks.json"
stand_in lsblk <<'BODY'
cat "$STAND_IN/disks.json"
BODY
stand_in findmnt <<'BODY'
cat "$STAND_IN/where" 2>/dev/null
BODY
stand_in losetup <<'BODY'
cat "$STAND_IN/loops" 2>/dev/null
BODY
stand_in unsquashfs <<'BODY'
printf 'application=cell\nversion=7\n'
BODY
stand_in udevadm </dev/null
# Between writing and reading back, the disk may be changed.
stand_in blockdev <<'BODY'
[[ ! -e $STAND_IN/change ]] || . "$STAND_IN/change"
BODY
echo 0 >"$work/user"
stand_in id <<'BODY'
cat "$STAND_IN/user"
BODY
# Not every file system can be read and written past the cache, as a disk can.
real_dd=$(PATH=$without_stand_ins command -v dd)
stand_in dd <<BODY
if [[ -e \$STAND_IN/hang && " \$* " == *" skip=1 seek=1 "* ]]; then
  touch "\$STAND_IN/hangs"
  exec sleep 60
fi
arguments=()
for word; do
  word=\${word/flag=direct,/flag=}
  [[ \$word == oflag=direct ]] || arguments+=("\$word")
done
exec $real_dd "\${arguments[@]}"
BODY

disk=$dev/sdb
fresh_disk() {  # of somebody else, to its last byte
  head -c 33554432 /dev/urandom >"$disk"
  rm -f "$work/change"
}
fresh_disk
written() { stat -c '%.9Y %.9Z %s' "$disk"; } # when it was written last, to the tick of the clock
before=$(written)

refused() {  # refused PATTERN ARGUMENT...: nothing is written then
  flexrf flash "${@:2}" </dev/null
  expect "exit code of 'flash ${*:2}'" "$status" 1
  expect "message of 'flash ${*:2}'" "$errors" "$1"
  expect "the disk after 'flash ${*:2}'" "$(written)" "$before"
}

# Words.
refused "*it takes the file of an image*./flexrf flash FILE*"
refused "*unknown option '--yse', did you mean '--yes'?*" "$image" "$disk" --yse
refused "*unexpected 'more'*" "$image" "$disk" more
refused "*--yes asks nothing: it needs the disk's name*" "$image" --yes

# Files.
refused "*there is no file $work/nothing; ./flexrf image APP makes an image*" "$work/nothing" "$disk" --yes
refused "*there is no file build/image/keyboard.img; this makes it: ./flexrf image keyboard" build/image/keyboard.img "$disk" --yes
mkdir -p "$tree/build/image" && touch "$tree/build/image/keyboard.img"
refused "*there is no file keyboard; did you mean $tree/build/image/keyboard.img?" keyboard "$disk" --yes
refused "*$work is no ordinary file*" "$work" "$disk" --yes
: >"$work/empty.img"
refused "*$work/empty.img is empty*" "$work/empty.img" "$disk" --yes
head -c 100000 /dev/urandom >"$work/any.img"
refused "*$work/any.img is no image of a FlexRF disk: it has no table of partitions (GPT)*" "$work/any.img" "$disk" --yes
head -c 10000000 "$image" >"$work/cut.img"
refused "*$work/cut.img is not whole: it has 10000000 bytes of 16777216*" "$work/cut.img" "$disk" --yes
for at in 600 1100 $((16777216 - 480)); do
  cp "$image" "$work/damaged.img"
  printf X | "$real_dd" of="$work/damaged.img" bs=1 seek="$at" conv=notrunc status=none
  refused "*$work/damaged.img is damaged: its two tables of partitions are not both whole*" "$work/damaged.img" "$disk" --yes
done
make_image "$work/other.img" esp boot data
refused "*$work/other.img is no image of a FlexRF disk: it has no partition boot-a*" "$work/other.img" "$disk" --yes
printf 'hsqs and more' >"$work/bundle"
refused "*$work/bundle is a bundle*upload it at the PC's panel, Machine*" "$work/bundle" "$disk" --yes
cp "$image" "$work/cell.raucb"
refused "*$work/cell.raucb is a bundle*upload it at the PC's panel, Machine*" "$work/cell.raucb" "$disk" --yes
printf '\x1f\x8b\x08 and more' >"$work/cell.img.gz"
refused "*$work/cell.img.gz is packed: unpack it first*" "$work/cell.img.gz" "$disk" --yes

# Disks.
refused "*$dev/sda holds the system that runs here (mounted: /, /boot/efi). Take another disk" "$image" "$dev/sda" --yes
refused "*$dev/sdb1 is a partition*Its disk is $dev/sdb" "$image" "$dev/sdb1" --yes
ln -s ../dev/sdb1 "$dev/by-id-part1"
refused "*$dev/by-id-part1 is $dev/sdb1*$dev/sdb1 is a partition*" "$image" "$dev/by-id-part1" --yes
refused "*$dev/sdc is mounted (/media/my data, /mnt)*umount '/media/my data' /mnt" "$image" "$dev/sdc" --yes
refused "*$dev/sdd is in use as swap space*swapoff $dev/sdd1" "$image" "$dev/sdd" --yes
refused "*$dev/sde is in use as a part of $dev/vg-data (lvm)*vgchange*" "$image" "$dev/sde" --yes
refused "*$dev/sdf is in use as a part of $dev/md0 (raid1)*mdadm --stop $dev/md0" "$image" "$dev/sdf" --yes
refused "*$dev/sdg is in use as a part of $dev/secret (crypt)*cryptsetup close secret" "$image" "$dev/sdg" --yes
refused "*$dev/sdn holds what is closed now, *: $dev/sdn (crypto_LUKS). *wipefs --all $dev/sdn" "$image" "$dev/sdn" --yes
refused "*$dev/sdo holds what is closed now, *: $dev/sdo2 (LVM2_member), $dev/sdo3 (linux_raid_member). *wipefs --all $dev/sdo2 $dev/sdo3" "$image" "$dev/sdo" --yes
refused "*$dev/vg-data is no disk of its own*(lvm)*" "$image" "$dev/vg-data" --yes
refused "*$dev/sdh is read-only*" "$image" "$dev/sdh" --yes
refused "*$dev/sdi has sectors of 4096 bytes*" "$image" "$dev/sdi" --yes
refused "*$dev/sdj is too small: it has 16777215 bytes, and the image 16777216*" "$image" "$dev/sdj" --yes
refused "*$dev/sdk has no medium*" "$image" "$dev/sdk" --yes
refused "*$dev/sr0 is a drive for CDs*" "$image" "$dev/sr0" --yes
refused "*$dev/zram0 is no disk that a PC starts from*" "$image" "$dev/zram0" --yes
refused "*there is no $dev/sdz*" "$image" "$dev/sdz" --yes
refused "*$work/any.img is an ordinary file, and no disk*" "$image" "$work/any.img" --yes
refused "*$work is a folder, and no disk*" "$image" "$work" --yes
refused "*/dev/null is no disk*" "$image" /dev/null --yes
echo "$dev/sdl1" >"$work/where"
refused "*$dev/sdl holds the image itself, $image*" "$image" "$dev/sdl" --yes
rm "$work/where"
echo "$dev/loop7 $image" >"$work/loops"
refused "*$dev/loop7 is made of the image itself, $image*" "$image" "$dev/loop7" --yes
echo "$dev/loop7 $dev/sdm" >"$work/loops"
refused "*$dev/sdm is in use as $dev/loop7*losetup -d $dev/loop7" "$image" "$dev/sdm" --yes
rm "$work/loops"

# Nobody who could be asked.
refused "*without a terminal nobody can say that it may be*--yes*" "$image" "$disk"
refused "*disks that can be written:*1  $disk  0.0 GB*usb, removable, serial 4C53*on it: OLD (vfat), ext4*a script names it*" "$image"
expect "disks in use are not offered" "$errors" "*not offered:*$dev/sda (*$dev/sdc (* is mounted*"
expect "a terminal obeys no name of a disk" "$errors" "*SanDisk Ul ?31mtra, usb*"
expect "what is no disk is not in the list" "$errors" "${errors/zram0/}"
jq '.blockdevices |= map(select(.name == "sda"))' "$work/disks.json" >"$work/only.json"
mv "$work/disks.json" "$work/all.json" && mv "$work/only.json" "$work/disks.json"
refused "*there is no disk that can be written*" "$image"
mv "$work/all.json" "$work/disks.json"

# Root is asked for when all else is right.
echo 1000 >"$work/user"
stand_in sudo <<'BODY'
exit 7
BODY
: >"$calls"
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code of sudo" "$status" 7
expect "what sudo is given" "$(grep ^sudo "$calls")" "sudo -n $tree/flexrf flash $image $disk --yes"
expect "sudo is said" "$errors" "*writing a disk needs root: sudo $tree/flexrf flash $image $disk --yes"
: >"$calls"
refused "*$dev/sdh is read-only*" "$image" "$dev/sdh" --yes
expect "no password for what is refused" "$(grep -c ^sudo "$calls")" 0
output=$(
  # shellcheck disable=SC2034 # for who is sourced
  root=$tree tool=$tree/cmake/tool
  # shellcheck source=/dev/null
  source "$tool/words.sh"
  # shellcheck source=/dev/null
  source "$tool/flash.sh"
  # shellcheck disable=SC2123 # there is no sudo then
  PATH=$work/nowhere
  become_root "$image" "$disk" 2>&1
)
expect "exit code without sudo" $? 3
expect "message without sudo" "$output" "*there is no sudo here. As root: $tree/flexrf flash $image $disk"
echo 0 >"$work/user"

# Written: what are holes in the file, too, and nothing of somebody else's where that is looked for.
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code" "$status" 0
expect "what is written to what" "$errors" "*image  $image*cell, version 7, *disk   $disk *SanDisk*on it: OLD (vfat), ext4*"
expect "what is said" "$errors" "*less than the 2 GB*$disk is written and was read back, in *it may be unplugged*next: put it into the PC*"
has_image() { cmp -n $((15 * 1048576)) -i 1048576 "$disk" "$image"; } # but for the tables of partitions, at both ends
has_image || expect "the disk" "differs" "the image"
# The last 33 sectors are the copy of the table.
cmp -n $((1048576 - 33 * 512)) -i $((33554432 - 1048576)):0 "$disk" /dev/zero || expect "the disk's end" "not wiped" "wiped"

# Its partitions are where the image has them, and no two disks have the same identifiers.
identifiers() { sfdisk -q -J "$1" 2>/dev/null | jq -r '.partitiontable | .id, .partitions[].uuid'; } # identifiers DISK
places() { sfdisk -q -J "$1" 2>/dev/null | jq -r '.partitiontable.partitions[] | "\(.name) \(.start) \(.size) \(.type)"'; }
expect "the table of partitions" "$(places "$disk")" "$(places "$image")"
expect "the table and its copy" "$(sfdisk --verify "$disk" 2>&1 | head -n 2)" "*No errors detected*"
first_identifiers=$(identifiers "$disk")
fresh_disk
flexrf flash "$image" "$disk" --yes </dev/null
expect "identifiers that are there twice" "$({ identifiers "$image" && printf '%s\n' "$first_identifiers" && identifiers "$disk"; } | sort | uniq -d)" ''
expect "how many identifiers there are" "$(identifiers "$disk" | wc -l)" 8

stand_in sfdisk <<'BODY'
[[ $* != *--dump* ]] || { echo 'no table' >&2 && exit 1; }
exec /sbin/sfdisk "$@"
BODY
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code without identifiers of its own" "$status" 0
expect "message without identifiers of its own" "$errors" "*WARNING: $disk has the same identifiers as other disks of this image*(no table)*$disk is written*"
rm "$work/bin/sfdisk"

jq --arg disk "$disk" '(.blockdevices[] | select(.path == $disk) | .children[0].mountpoints) = ["/media/boot"]' "$work/disks.json" >"$work/mounted.json"
fresh_disk
echo "cp '$work/mounted.json' '$work/disks.json'" >"$work/change"
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code with a desktop that mounts" "$status" 0
expect "message with a desktop that mounts" "$errors" "*has mounted it at once. Before it is unplugged: umount /media/boot*"
jq -n --arg dev "$dev" -f "$work/disks.jq" >"$work/disks.json"

# Read back as something else.
first_part() { head -c 4194304 "$disk" | tr -d '\0' | wc -c; } # 0 when there is nothing that a PC would start
for at in 4194304 9500000 16777215; do
  fresh_disk
  echo "printf X | $real_dd of=$disk bs=1 seek=$at conv=notrunc status=none; rm -f $work/change" >"$work/change"
  printf Y | "$real_dd" of="$image" bs=1 seek="$at" conv=notrunc status=none
  [[ $at != 16777215 ]] || make_image "$image" bios esp boot-a boot-b root-a root-b data
  flexrf flash "$image" "$disk" --yes </dev/null
  expect "exit code of a byte changed at $at" "$status" 1
  expect "message of a byte changed at $at" "$errors" "*the first difference is at byte $at, *defective*counterfeit*does not boot"
  expect "start of a disk with a byte changed at $at" "$(first_part)" 0
done
fresh_disk
echo "truncate -s 9000000 $disk" >"$work/change"
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code of a disk that ends" "$status" 1
expect "message of a disk that ends" "$errors" "*gives back less than was written: *defective*does not boot"
fresh_disk
echo "printf X | $real_dd of=$disk bs=1 seek=33000000 conv=notrunc status=none" >"$work/change"
flexrf flash "$image" "$disk" --yes </dev/null
expect "message of an end that is not there" "$errors" "*the first difference is at byte 33000000, *"
fresh_disk
echo "touch -d 2001-01-01 $image; printf X | $real_dd of=$disk bs=1 seek=9500000 conv=notrunc status=none" >"$work/change"
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code of a file that changes" "$status" 1
expect "message of a file that changes" "$errors" "*$image was changed by somebody while it was written*"

# Interrupted, and two at once.
# QEMU holds shared locks on some bytes of a running virtual machine's disk.
fresh_disk
perl -e 'use Fcntl; open(my $d, "+<", $ARGV[0]) or die; my $l = pack("s s x![q] q q i x![q]", F_RDLCK, 0, 100, 4, 0); fcntl($d, 37, $l) or die; $| = 1; print "locked\n"; sleep 600' \
  "$disk" >"$work/locked" &
machine=$!
for ((k = 0; k < 600; ++k)); do
  [[ ! -s $work/locked ]] || break
  sleep 0.1
done
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code of a virtual machine's disk" "$status" 1
expect "message of a virtual machine's disk" "$errors" "*$disk is locked by another program, as a virtual machine that runs from it: nothing was written to it"
kill "$machine"
wait "$machine" 2>/dev/null

fresh_disk
touch "$work/hang"
"$tree/flexrf" flash "$image" "$disk" --yes </dev/null >"$work/first" 2>&1 &
first=$!
for ((k = 0; k < 600; ++k)); do
  [[ ! -e $work/hangs ]] || break
  sleep 0.1
done
rm "$work/hang"
flexrf flash "$image" "$disk" --yes </dev/null
expect "exit code of the second at once" "$status" 1
expect "message of the second at once" "$errors" "*$disk is locked by another program, as a flash that runs already: nothing was written to it"
kill -TERM "$first"
wait "$first"
expect "exit code when interrupted" $? 130
expect "message when interrupted" "$(<"$work/first")" "*interrupted: $disk is half written, and does not boot*anew: ./flexrf flash $image $disk"
expect "start of what was interrupted" "$(first_part)" 0

# At a terminal. What script shows is that of the terminal.
at_terminal() {  # at_terminal ANSWERS ARGUMENT...: sets status and output
  output=$(printf '%b' "$1" | script -q -e -c "$(printf '%q ' "$tree/flexrf" flash "${@:2}")" /dev/null 2>&1)
  status=$?
}
fresh_disk
before=$(written)
for answer in 'sdc\n' '\n' 'y\n' ''; do
  at_terminal "$answer" "$image" "$disk"
  expect "exit code of the answer '$answer'" "$status" 1
  expect "the answer '$answer'" "$output" "*ALL THAT IS ON sdb IS LOST*that is not its name: nothing was written*"
done
for answer in '\n' '99\n' '0\n' 'sdc\n' ''; do
  at_terminal "$answer" "$image"
  expect "exit code of the choice '$answer'" "$status" 1
  expect "the choice '$answer'" "$output" "*Which one?*nothing was written*"
done
touch "$dev/nvme0n1"
at_terminal '4\nsdb\n' "$image"
expect "a disk of FlexRF's" "$output" "*it is a disk of FlexRF*To keep them: docs/industrial-pc.md*ALL THAT IS ON nvme0n1 IS LOST*not its name*"
expect "the disk after all these answers" "$(written)" "$before"
for choice in 1 sdb "$disk"; do
  fresh_disk
  at_terminal "$choice\nsdb\n" "$image"
  expect "exit code of the choice $choice" "$status" 0
  expect "the choice $choice" "$output" "*ALL THAT IS ON sdb IS LOST*$disk is written and was read back*"
  has_image || expect "the disk chosen as $choice" "differs" "the image"
done

# A disk that the kernel knows.
PATH=$without_stand_ins
if ((EUID)); then
  echo "not tried: a loop device, which is root's to make"
  finish
fi
truncate -s 32M "$work/real"
if ! loop=$(losetup -f --show "$work/real" 2>&1); then
  echo "not tried: a loop device: $loop"
  finish
fi
trap 'umount "$work/mounted" 2>/dev/null; losetup -d "$loop"; rm -rf "$work"' EXIT
before=$(written)
mkdir "$work/only" && cp "$work/bin/dpkg-query" "$work/only/"
PATH=$work/only:$PATH
perl "$tree/cmake/tool/disk.pl" hold "$loop" bash -c 'touch "$0"; exec sleep 600' "$work/held" &
holder=$!
for ((k = 0; k < 600; ++k)); do
  [[ ! -e $work/held ]] || break
  sleep 0.1
done
refused "*$loop is in use by another program*nothing was written to it" "$image" "$loop" --yes
kill "$holder"
wait "$holder" 2>/dev/null
mkdir "$work/mounted"
if mke2fs -q -F "$loop" >/dev/null 2>&1 && mount "$loop" "$work/mounted" 2>/dev/null; then
  refused "*$loop is mounted ($work/mounted)*umount $work/mounted" "$image" "$loop" --yes
  umount "$work/mounted"
else
  echo "not tried: a mounted loop device, which this machine does not mount"
fi
flexrf flash "$image" "$loop" --yes </dev/null
expect "exit code of a loop device" "$status" 0
expect "message of a loop device" "$errors" "*$loop is written and was read back, in *"
cmp -n $((15 * 1048576)) -i 1048576 "$work/real" "$image" || expect "the loop device" "differs" "the image"
finish
