# Sourced by flash.sh: whether a file is the image of a FlexRF disk, and all of it.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

image_size='' image_text='' # of the image that was checked: bytes, and what is in it

number_at() { od -A n -t u8 -j "$2" -N 8 "$1" 2>/dev/null | tr -d ' '; }           # number_at FILE OFFSET
bytes_at() { od -A n -t x1 -j "$2" -N "$3" "$1" 2>/dev/null | tr -d ' \n'; }       # bytes_at FILE OFFSET BYTES: in hexadecimal
efi_part=4546492050415254                                                          # what a GPT begins with

no_such_image() {  # no_such_image FILE: says which file may be meant
  local name=${1##*/}
  name=${name%.img}
  if [[ -f $root/build/image/$name.img ]]; then
    die "there is no file $1; did you mean $root/build/image/$name.img?"
  elif [[ $'\n'$(applications)$'\n' == *$'\n'"$name"$'\n'* ]]; then
    die "there is no file $1; this makes it: ./flexrf image $name"
  fi
  die "there is no file $1; ./flexrf image APP makes an image, build/image/APP.img"
}

other_kind() {  # other_kind FILE: prints what it is in place of an image
  case $(bytes_at "$1" 0 6) in
    68737173*) echo "is a bundle, by which a PC that runs gets another version: upload it at the PC's panel, Machine. A new disk is written from an image, which ./flexrf image APP makes" ;;
    1f8b* | fd377a585a00 | 28b52ffd* | 425a68* | 504b0304*) echo "is packed: unpack it first, and write what comes out" ;;
    514649fb*) echo "is a disk of QEMU's: qemu-img convert -O raw makes a raw image of it" ;;
    *) echo "is no image of a FlexRF disk: it has no table of partitions (GPT). ./flexrf image APP makes an image" ;;
  esac
}

check_file() {  # check_file FILE: ends with a message unless it may be an image
  if [[ -b $1 ]]; then die "$1 is a disk: the image's file comes first, and then the disk: ./flexrf flash FILE DEVICE"; fi
  [[ -e $1 ]] || no_such_image "$1"
  [[ -f $1 ]] || die "$1 is no ordinary file; ./flexrf image APP makes an image, build/image/APP.img"
  [[ -r $1 ]] || die "$1 cannot be read by $(id -un): chmod a+r makes it readable"
  [[ -s $1 ]] || die "$1 is empty; make it anew: ./flexrf image APP"
  [[ $1 != *.raucb ]] ||
    die "$1 is a bundle, by which a PC that runs gets another version: upload it at the PC's panel, Machine. A new disk is written from an image, which ./flexrf image APP makes"
}

partition_names() { PATH=$PATH:/usr/sbin:/sbin LC_ALL=C sfdisk -J "$1" 2>/dev/null | jq -r '.partitiontable.partitions[]?.name // empty'; } # FILE

check_image() {  # check_image FILE: ends with a message unless it is one; sets image_size and image_text
  local last needed said names name first
  image_size=$(stat -L -c %s "$1")
  [[ $(bytes_at "$1" 512 8) == "$efi_part" ]] || die "$1 $(other_kind "$1")"
  # The table says where its copy is, in the disk's last sector. A file that is cut off does not have it.
  last=$(number_at "$1" 544)
  [[ $last =~ ^[0-9]{1,12}$ ]] || die "$1 is damaged: its table of partitions has no end. Copy it again, or make it anew"
  needed=$(((last + 1) * 512))
  ((image_size >= needed)) ||
    die "$1 is not whole: it has $image_size bytes of $needed. Copy it again, or make it anew: ./flexrf image APP"
  ((image_size % 512 == 0)) || die "$1 is damaged: $image_size bytes are no whole sectors. Copy it again, or make it anew"
  said=$(PATH=$PATH:/usr/sbin:/sbin LC_ALL=C sfdisk -J "$1" 2>&1 >/dev/null)
  if [[ $(bytes_at "$1" $((last * 512)) 8) != "$efi_part" || $said == *corrupt* ]]; then
    die "$1 is damaged: its two tables of partitions are not both whole. Copy it again, or make it anew: ./flexrf image APP"
  fi
  names=$(partition_names "$1")
  for name in boot-a root-a data; do
    [[ $'\n'$names$'\n' == *$'\n'"$name"$'\n'* ]] || die "$1 is no image of a FlexRF disk: it has no partition $name. ./flexrf image APP makes an image"
  done
  first=$(PATH=$PATH:/usr/sbin:/sbin sfdisk -q -J "$1" 2>/dev/null | jq -r '.partitiontable.partitions[] | select(.name == "root-a") | .start')
  said=$(unsquashfs -o $((first * 512)) -cat "$1" usr/lib/flexrf/version 2>/dev/null | tr -cd '[:graph:]\n')
  image_text=$(sed -n 's/^application=//p' <<<"$said")
  name=$(sed -n 's/^version=//p' <<<"$said")
  image_text=${image_text:-no version in it}${name:+, version $name}
}
