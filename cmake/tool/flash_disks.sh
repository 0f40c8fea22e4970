# Sourced by flash.sh: which disks there are, what they are, and why one may not be written.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

disks='' # what lsblk says of all

gigabytes() { printf '%d.%d GB\n' $((($1 + 50000000) / 1000000000)) $((($1 + 50000000) / 100000000 % 10)); } # gigabytes BYTES

look_at_disks() {
  disks=$(LC_ALL=C lsblk -J -b --tree \
    -o NAME,PATH,TYPE,SIZE,LOG-SEC,RO,RM,TRAN,VENDOR,MODEL,SERIAL,FSTYPE,LABEL,PARTLABEL,MOUNTPOINTS) ||
    die "lsblk does not say which disks there are; it has to be that of util-linux 2.37 or newer"
}

# take_disk PATH: sets what is known of it, disk_*; fails if lsblk does not list it. What devices say of themselves has then no control
# characters, which a terminal would obey, and none that are invisible or turn the direction of a text, which a person would misread.
take_disk() {
  local fields
  fields=$(jq -r --arg path "$1" '
    def all: recurse(.children[]?);
    def text: if . == null then "" else tostring | gsub("[[:cntrl:]\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]"; " ") | gsub("^ +| +$"; "") end;
    def yes: text | . == "true" or . == "1";
    def list(f): [f | select(. != "")] | join(", ");
    def mounts: .mountpoints[]? | select(. != null and . != "[SWAP]");
    def contents: ((.partlabel // .label // "") | text) as $name | (.fstype | text) as $kind |
      if $name == "" then $kind elif $kind == "" then $name else "\($name) (\($kind))" end;
    [.blockdevices[] | . as $top | all | . + {top: $top.path}] | map(select(.path == $path)) | first // empty | . as $disk |
    [all] as $all | [$all[] | select(.type != "part" and .path != $disk.path)] as $holders |
    [
      .type, .top, .size, (.["log-sec"] // 512), (.ro | yes),
      list((list(.vendor, .model | text | select(startswith("0x") | not)) | gsub(", "; " ")), (.tran | text),
        (if .rm | yes then "removable" else "not removable" end), (.serial | text | if . == "" then "" else "serial " + . end)),
      (if .children then list(.children[] | contents) as $names |
          if $names == "" then "partitions: \(.children | length)" else $names end
        else contents end),
      ([$all[].partlabel] | contains(["boot-a", "root-a", "data"])),
      ([$all[] | mounts] | any(IN("/", "/usr", "/var", "/boot", "/boot/efi", "/efi"))),
      ([$all[] | mounts | text] | unique | join(", ")),
      ([$all[] | mounts] | unique | map(if test("^[A-Za-z0-9/._-]+$") then . else @sh end) | join(" ")),
      ([$all[] | select(.mountpoints | index("[SWAP]")) | .path] | unique | join(" ")),
      ($holders | map("\(.path) (\(.type))") | unique | join(", ")), ($holders[0] // {} | .type, .path),
      ([$all[] | select(.children | not) | select((.fstype | text) | test("^(crypto_LUKS|LVM2_member|.*_raid_member|zfs_member|bcache)$"))] |
        unique_by(.path) | (map("\(.path) (\(.fstype))") | join(", ")), (map(.path) | join(" ")))
    ] | map(text) | join("\u001f")' <<<"$disks") || return
  [[ $fields ]] || return 1
  disk_path=$1
  IFS=$'\x1f' read -r disk_type disk_top disk_size disk_sector disk_read_only disk_text disk_contents disk_is_ours disk_is_system \
    disk_mounts disk_umount disk_swaps disk_holders disk_holder_type disk_holder disk_members disk_member_paths <<<"$fields"
}

holds_file() {  # holds_file FILE: whether it lies on the disk that was taken
  local source
  source=$(findmnt -n -v -o SOURCE -T "$1" 2>/dev/null)
  [[ $source ]] && jq -e --arg path "$disk_path" --arg source "$source" \
    'def all: recurse(.children[]?); [.blockdevices[] | all | select(.path == $path) | all.path] | index($source) != null' <<<"$disks" >/dev/null
}

loops() { PATH=$PATH:/usr/sbin:/sbin losetup -l -n -O NAME,BACK-FILE 2>/dev/null; } # a line for each: the device, and what it is made of

loop_of() {  # loop_of FILE: the loop device that is made of a file or disk
  local name file
  while read -r name file; do
    [[ $file -ef $1 || $file == "$1" ]] && printf '%s\n' "$name" && return
  done < <(loops)
  return 1
}

how_to_release() {  # what frees the disk that was taken of its holder
  case $disk_holder_type in
    crypt) printf 'cryptsetup close %s\n' "${disk_holder##*/}" ;;
    raid* | md*) printf 'mdadm --stop %s\n' "$disk_holder" ;;
    lvm) printf 'vgchange --activate n, with the name of its volume group\n' ;;
    *) printf 'dmsetup remove %s\n' "${disk_holder##*/}" ;;
  esac
}

# disk_obstacle FILE: prints why the disk that was taken may not be written with this image, and what to do; nothing if it may.
disk_obstacle() {
  local loop
  case $disk_type in
    disk | loop) ;;
    part) echo "is a partition, and an image is for a whole disk. Its disk is $disk_top" && return ;;
    rom) echo "is a drive for CDs, from which no cell runs. Take another disk" && return ;;
    *) echo "is no disk of its own, but one that this machine makes of others ($disk_type). Take one of those: ./flexrf flash FILE lists them" && return ;;
  esac
  case ${disk_path##*/} in
    zram* | ram[0-9]* | mtdblock* | mmcblk*boot* | mmcblk*rpmb) echo "is no disk that a PC starts from. Take another one" && return ;;
  esac
  if ((disk_size == 0)); then
    echo "has no medium. Put the card in, or plug the disk in again"
  elif [[ $disk_is_system == true ]]; then
    echo "holds the system that runs here (mounted: $disk_mounts). Take another disk"
  elif holds_file "$1"; then
    echo "holds the image itself, $1. Take another disk, or put the image on another one"
  elif [[ $disk_type == loop && $(loop_of "$1") == "$disk_path" ]]; then
    echo "is made of the image itself, $1. Take another disk"
  elif [[ $disk_mounts ]]; then
    echo "is mounted ($disk_mounts). If all that is on it may be lost: umount $disk_umount"
  elif [[ $disk_swaps ]]; then
    echo "is in use as swap space. If all that is on it may be lost: swapoff $disk_swaps"
  elif [[ $disk_holders ]]; then
    echo "is in use as a part of $disk_holders. If all that is on it may be lost: $(how_to_release)"
  elif [[ $disk_members ]]; then
    echo "holds what is closed now, and belongs to other disks or needs a password: $disk_members. If all that is on it may be lost: wipefs --all $disk_member_paths"
  elif loop=$(loop_of "$disk_path"); then
    echo "is in use as $loop. If all that is on it may be lost: losetup -d $loop"
  elif [[ $disk_read_only == true ]]; then
    echo "is read-only. Slide its lock, if it is a card; else take another disk"
  elif ((disk_sector != 512)); then
    echo "has sectors of $disk_sector bytes, and PCs would not find the image's partitions there: they are for 512. Take another disk, or format it for 512 if it can"
  elif ((disk_size < image_size)); then
    echo "is too small: it has $disk_size bytes, and the image $image_size. Take a disk of 2 GB or more"
  fi
}

list_disks() {  # list_disks FILE: says which may be written, and why others may not; sets offered
  local path obstacle refused=''
  offered=()
  while read -r path; do
    take_disk "$path" || continue
    obstacle=$(disk_obstacle "$1")
    if [[ $obstacle ]]; then
      refused+="  $path ($disk_text, $(gigabytes "$disk_size")) $obstacle"$'\n'
      continue
    fi
    offered+=("$path")
    if ((${#offered[@]} == 1)); then say "disks that can be written:"; fi
    printf '  %d  %s  %s\n     %s\n' ${#offered[@]} "$path" "$(gigabytes "$disk_size")" "$disk_text" >&2
    printf '     on it: %s\n' "${disk_contents:-nothing that is known}" >&2
  done < <(jq -r '.blockdevices[] | select(.type == "disk" and (.size | tonumber) > 0) | .path' <<<"$disks" | grep -v -E '/(zram|ram|mtdblock)[0-9]|/mmcblk.*boot')
  if [[ $refused ]]; then
    say "not offered:"
    printf '%s' "$refused" >&2
  fi
}

no_disk() {  # no_disk NAME PATH: ends with why it is none
  [[ -e $2 ]] || die "there is no $1; ./flexrf flash FILE lists the disks"
  [[ ! -d $2 ]] || die "$1 is a folder, and no disk; ./flexrf flash FILE lists the disks"
  [[ ! -f $2 ]] || die "$1 is an ordinary file, and no disk; ./flexrf flash FILE lists the disks"
  if [[ -c $2 ]]; then
    [[ $2 =~ /nvme[0-9]+$ ]] && die "$1 is a controller; its disk is called ${2}n1"
    die "$1 is no disk; ./flexrf flash FILE lists the disks"
  fi
  die "$1 has no medium, or is none that can be written; ./flexrf flash FILE lists the disks"
}

find_disk() {  # find_disk NAME FILE: takes it, or ends with why it may not be written; NAME may be sdb, or a link to it
  local name=$1 path obstacle
  [[ $name == */* || -e $name || ! -e /dev/$name ]] || name=/dev/$name
  path=$(readlink -f "$name") || path=$name
  if [[ $path != "$1" ]]; then say "$1 is $path"; fi
  take_disk "$path" || no_disk "$1" "$path"
  obstacle=$(disk_obstacle "$2")
  [[ ! $obstacle ]] || die "$path $obstacle"
}

describe() {  # describe FILE: the image, and the disk that was taken
  cat >&2 <<TEXT
  image  $1
         $image_text, $(gigabytes "$image_size")
  disk   $disk_path  $(gigabytes "$disk_size")
         $disk_text
         on it: ${disk_contents:-nothing that is known}
TEXT
  if [[ $disk_is_ours == true ]]; then
    say "it is a disk of FlexRF: the users and the configuration of its PC are lost. To keep them: docs/industrial-pc.md, Writing the image anew"
  fi
  if ((disk_size < 2000000000)); then
    say "it has less than the 2 GB that a PC should have: there is less room for data, and updates need some"
  fi
}
