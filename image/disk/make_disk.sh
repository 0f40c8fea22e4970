#!/usr/bin/env bash
# make_disk.sh OUTPUT BOOT ROOT DATA ESP: a raw image of a disk with the partitions of docs/image.md, that boots by BIOS and by UEFI.
# BOOT is a version's partition with the kernel (make_boot.sh), ROOT its squashfs, DATA the folder of what outlives updates, ESP that of
# the partition which GRUB lies on, without GRUB itself. No loop device is needed: each file system is made in a file, and put in its place.
set -eu -o pipefail
# shellcheck source=image/disk/partitions.sh
source "$(dirname "${BASH_SOURCE[0]}")/partitions.sh"
output=$1 boot=$2 root=$3 data=$4 esp=$5
PATH=$PATH:/usr/sbin:/sbin # sfdisk and the makers of file systems; not only root has a use for them
work=$(mktemp -d "$output.XXXXXX")
trap 'rm -rf "$work"' EXIT
disk=$work/disk

declare -A begins=()

partition() {
  local index begin=1 table
  table=$(printf '%s\n' 'label: gpt' "label-id: $(identifier disk)" 'unit: sectors' 'first-lba: 2048')
  for index in "${!names[@]}"; do
    begins[${names[index]}]=$begin
    table+=$(printf '\nstart=%d, size=%d, type=%s, uuid=%s, name="%s"' $((begin * 2048)) $((sizes[index] * 2048)) \
      "${types[index]}" "$(identifier "${names[index]}")" "${names[index]}")
    begin=$((begin + sizes[index]))
  done
  truncate -s $((begin + 1))M "$disk" # the second copy of the table has the last one
  sfdisk -q "$disk" <<<"$table"
}

put() { dd if="$1" of="$disk" bs=1M seek="${begins[$2]}" conv=notrunc,sparse status=none; } # put FILE PARTITION

number() {  # number VALUE BYTES: as a processor of a PC has it
  local value=$1 left
  for ((left = $2; left > 0; --left)); do
    printf '%b' "\\x$(printf '%02x' $((value & 255)))"
    value=$((value >> 8))
  done
}

patch() { dd of="$1" bs=1 seek="$2" conv=notrunc status=none; } # patch FILE OFFSET: with standard input

grub_modules=(memdisk tar part_gpt fat ext2 normal configfile test regexp loadenv probe linux boot echo sleep reboot password_pbkdf2)

# GRUB has a script in itself, which reads grub.cfg. Where that cannot be read to its end, GRUB restarts the PC, as it would otherwise give its
# shell to anybody.
make_early_script() {
  mkdir "$work/early"
  cat >"$work/early/early.cfg" <<'GRUB'
set superusers="service"
source $prefix/grub.cfg
if [ "x$is_complete" != xyes ]; then
  echo "GRUB cannot read how this PC starts (grub/grub.cfg). Restarting in 10 seconds."
  sleep 10
  reboot
fi
GRUB
  tar -C "$work/early" --owner=0 --group=0 --mtime="@$SOURCE_DATE_EPOCH" -cf "$work/early.tar" early.cfg
  echo 'normal (memdisk)/early.cfg' >"$work/start.cfg"
}

make_esp() {
  cp -r "$esp" "$work/esp"
  mkdir -p "$work/esp/EFI/BOOT"
  # Without a driver of the screen GRUB could not tell the kernel where it is, and nothing would be on it.
  grub-mkimage -O x86_64-efi -m "$work/early.tar" -p /grub -c "$work/start.cfg" -o "$work/esp/EFI/BOOT/BOOTX64.EFI" efi_gop efi_uga "${grub_modules[@]}"
  find "$work/esp" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
  # Clusters of 4 KiB: each copy of the choice has one of its own.
  truncate -s "$(mib_of esp)M" "$work/esp.fat"
  mkfs.vfat -F 16 -s 8 -n ESP -i "$(identifier esp | head -c 8)" "$work/esp.fat" >/dev/null
  (cd "$work/esp" && mcopy -i "$work/esp.fat" -s -m -Q ./* ::)
  put "$work/esp.fat" esp
}

# The first sector of the disk starts core.img, whose own first sector loads the rest of it.
make_bios() {
  local sectors core=$work/core.img first=$work/boot.img at
  grub-mkimage -O i386-pc -m "$work/early.tar" -p '(,gpt2)/grub' -c "$work/start.cfg" -o "$core" biosdisk "${grub_modules[@]}"
  sectors=$((($(stat -c %s "$core") + 511) / 512))
  ((sectors * 512 <= $(mib_of bios) * 1048576)) || { echo "GRUB's core.img does not fit into its partition" && return 1; }
  at=$((begins[bios] * 2048))
  cp /usr/lib/grub/i386-pc/boot.img "$first"
  number "$at" 8 | patch "$first" $((0x5c))
  printf '\x90\x90' | patch "$first" $((0x66)) # some BIOSes name another disk than the one that they started from
  number $((at + 1)) 8 | patch "$core" $((0x1f4))
  number $((sectors - 1)) 2 | patch "$core" $((0x1fc))
  put "$core" bios
  head -c 440 "$first" | patch "$disk" 0
}

make_data() {
  find "$data" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
  make_file_system ext4 data "$data" "$work/data" -J size=16
  put "$work/data" data
}

partition
make_early_script
make_bios
make_esp
make_data
put "$boot" boot-a
put "$root" root-a
mv "$disk" "$output"
