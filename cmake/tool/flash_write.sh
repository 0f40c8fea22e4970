#!/usr/bin/env bash
# flash_write.sh FILE DEVICE ask|yes: started by disk.pl, which holds the disk. Asks, writes the image, and reads it back.
# The disk's first part, without which no PC starts from it, is taken away before all else and written when the rest has been read back:
# a disk boots with all of the image on it, or it does not boot.
set -u -o pipefail
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
tool=$root/cmake/tool
file=$1 device=$2 confirm=$3
name=${device##*/}
block=4194304  # the first part, and what is written at once
end_size=1048576

# shellcheck source=cmake/tool/words.sh
source "$tool/words.sh"
# shellcheck source=cmake/tool/flash.sh
source "$tool/flash.sh"

again=$(printf ' %q' ./flexrf flash "$file" "$device")
state=whole # of the disk: whole, half or written
job=''

stop() {  # of what runs, if something does
  [[ $job ]] && kill -TERM -- "-$job" 2>/dev/null && { wait "$job"; } 2>/dev/null
}

interrupted() {
  trap '' INT TERM HUP
  stop
  if [[ -t 2 ]]; then printf '\n' >&2; fi
  case $state in
    half) say "interrupted: $device is half written, and does not boot. What was on it is lost. To write it anew:$again" ;;
    *) say "interrupted: $device is written, and was read back" ;;
  esac
  exit 130
}

failed() {  # failed MESSAGE
  say "$1"
  die "$device is half written, and does not boot"
}

mib_text() { printf '%d' $(($1 / 1048576)); }

# progress WHAT FROM: shows on standard error how far the dd has come whose messages are standard input, in a line that is written anew or,
# elsewhere than on a terminal, each ten seconds; nothing without WHAT. What dd says of errors goes to $work/said.
progress() {
  local chunk line done_bytes rate left now start shown end=''
  start=$(microseconds)
  shown=$start
  while IFS= read -r -d $'\r' chunk || end=yes; do
    while IFS= read -r line; do
      if [[ $line =~ ^([0-9]+)\ byte && $1 ]]; then
        done_bytes=$((BASH_REMATCH[1]))
        now=$(microseconds)
        rate=$((done_bytes * 1000000 / (now - start + 1)))
        done_bytes=$((done_bytes + $2))
        left='?'
        if ((rate > 0)); then printf -v left '%d:%02d' $(((image_size - done_bytes) / rate / 60)) $(((image_size - done_bytes) / rate % 60)); fi
        printf -v line '%s %d of %d MiB, %d %%, %d.%d MB/s, %s left' "$1" $((done_bytes / 1048576)) $((image_size / 1048576)) \
          $((done_bytes * 100 / image_size)) $((rate / 1000000)) $((rate / 100000 % 10)) "$left"
        if [[ -t 2 ]]; then
          printf '\r\e[K%s' "$line" >&2
        elif ((now - shown >= 10000000)); then
          say "$line"
          shown=$now
        fi
      elif [[ $line == *dd:* ]]; then
        printf '%s\n' "${line##*dd: }" >>"$work/said"
      fi
    done <<<"$chunk"
    if [[ $end ]]; then break; fi
  done
  if [[ -t 2 && $1 ]]; then printf '\r\e[K' >&2; fi
}

in_background() {  # in_background FUNCTION ARGUMENT...: so that a signal is heard at once, and not when dd ends
  local status
  : >"$work/said"
  "$@" &
  job=$!
  wait "$job"
  status=$?
  job=''
  return "$status"
}

copy() {  # copy WHAT FROM OPTION OF DD...: into the disk, past the kernel's cache, and to the end of what the disk itself keeps back
  LC_ALL=C dd of="$device" oflag=direct"${at_bytes-}" conv=notrunc,nocreat,fsync status=progress "${@:3}" 2>&1 >/dev/null | progress "$1" "$2"
}

wipe() {  # wipe FROM BYTES
  local at_bytes=,seek_bytes
  in_background copy '' 0 if=/dev/zero bs="$2" count=1 seek="$1" iflag=fullblock
}

compare() {  # compare WHAT FROM BYTES OTHER: what the disk has, read past the kernel's cache, with another file's first bytes
  LC_ALL=C dd if="$device" iflag=direct,fullblock,skip_bytes,count_bytes bs="$block" skip="$2" count="$3" status=progress 2>"$work/progress" |
    LC_ALL=C cmp -n "$3" - "$4" >"$work/compared" 2>&1 &
  progress "$1" "$2" <"$work/progress"
  wait $!
}

same() {  # same WHAT FROM BYTES FILE|ZEROS: ends with a message if the disk does not have there what was written
  local at status
  blockdev --flushbufs "$device" 2>/dev/null
  if [[ $4 == ZEROS ]]; then
    in_background compare "$1" "$2" "$3" /dev/zero
  else
    in_background compare "$1" "$2" "$3" <(tail -c +"$(($2 + 1))" "$file" 2>/dev/null)
  fi
  status=$?
  ((status)) || return 0
  if [[ $(stat -L -c '%s %Y %i' "$file") != "$was" ]]; then failed "$file was changed by somebody while it was written to the disk. Write it anew:$again"; fi
  at=$(sed -n -E 's/^.* differ: [a-z]+ ([0-9]+).*/\1/p' "$work/compared")
  if [[ $at ]]; then
    at=$(($2 + at - 1))
    say "what $device gives back is not what was written: the first difference is at byte $at, at $(mib_text "$at") MiB"
  else
    say "$device gives back less than was written: $(cat "$work/said" "$work/compared" | head -n 1)"
  fi
  failed "the disk is defective, or has less room than it says (a counterfeit), or its cable or adapter is bad. Take another one"
}

cannot_write() {
  local said
  said=$(head -n 1 "$work/said")
  [[ $said != "error reading '$file'"* ]] || failed "$file cannot be read ($said). Copy it again, or make it anew"
  failed "$device cannot be written (${said:-dd ended}). Is it unplugged, or its cable loose? Else the disk is defective: take another one"
}

write_image() {
  local rest=$((image_size - block)) behind=$((disk_size - image_size))
  if ((behind > end_size)); then behind=$end_size; fi
  state=half
  wipe 0 "$block" || cannot_write
  # There, too, others keep what makes a disk theirs: copies of tables, RAID.
  if ((behind > 0)); then wipe $((disk_size - behind)) "$behind" || cannot_write; fi
  # All of it, with what are holes in the file: the disk may have something else there.
  in_background copy written "$block" if="$file" iflag=fullblock bs="$block" skip=1 seek=1 || cannot_write
  same 'read back' "$block" "$rest" FILE
  if ((behind > 0)); then same '' $((disk_size - behind)) "$behind" ZEROS; fi
  in_background copy '' 0 if="$file" iflag=fullblock bs="$block" count=1 || cannot_write
  same '' 0 "$block" FILE
  state=written
}

# All disks of an image would have the same. Without it the PC does this at its first boot, unless it has two such disks by then.
own_identifiers() {
  sh "$root/image/disk/root/usr/lib/flexrf/own-identifiers" "$device" >"$work/said" 2>&1 ||
    say "WARNING: $device has the same identifiers as other disks of this image: start one PC with it before another such disk is plugged in there" \
      "($(tail -n 1 "$work/said"))"
}

# A desktop mounts what it finds; then the disk is in use until it is let go.
let_go() {
  local scanned=yes
  perl "$tool/disk.pl" scan "$FLEXRF_HELD" || scanned=''
  eval "exec $FLEXRF_HELD>&-"
  sync "$device" 2>/dev/null || sync
  PATH=$PATH:/usr/sbin:/sbin udevadm settle --timeout=10 2>/dev/null
  [[ $scanned ]] || say "this machine has not read the disk's new partitions; it will when the disk is plugged in again"
  look_at_disks
  if take_disk "$device" && [[ $disk_mounts ]]; then
    say "this machine has mounted it at once. Before it is unplugged: umount $disk_umount"
  else
    say "it may be unplugged"
  fi
}

PATH=$PATH:/usr/sbin:/sbin
check_image "$file"
was=$(stat -L -c '%s %Y %i' "$file")
# Nothing of it can change from now on: the disk is held.
look_at_disks
find_disk "$device" "$file"
describe "$file"
if [[ $confirm == ask ]]; then
  read -r -p "ALL THAT IS ON $name IS LOST. To write it, type its name, $name: " answer || answer=''
  [[ $answer == "$name" || $answer == "$device" ]] || die "that is not its name: nothing was written"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkfifo "$work/progress"
set -m # what runs in the background is a group, which stop() ends as a whole
trap '' TTOU # which would stop such a group where a terminal has tostop
trap interrupted INT TERM HUP
start=$(microseconds)
write_image
trap '' INT TERM HUP # there is nothing to stop any more
own_identifiers
say "$device is written and was read back, in $(since "$start"): it has what $file has"
let_go
say "next: put it into the PC and switch that on; docs/industrial-pc.md, The first boot, tells what comes"
