#!/usr/bin/env bash
# make_boot.sh FOLDER OUTPUT: a version's partition that GRUB reads, of the folder with its kernel. It is the same in either slot.
set -eu -o pipefail
# shellcheck source=image/disk/partitions.sh
source "$(dirname "${BASH_SOURCE[0]}")/partitions.sh"
PATH=$PATH:/usr/sbin:/sbin # mke2fs
find "$1" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
make_file_system ext2 boot-a "$1" "$2"
