#!/usr/bin/env bash
# make_start.sh KERNEL BUSYBOX OUTPUT: the initial RAM disk: start/init, run by busybox (its package), and the modules of KERNEL
# (take_kernel.sh) that modules.txt has for the start, with what these need.
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=image/disk/partitions.sh
source "$here/partitions.sh"
kernel=$1 busybox=$2 output=$3
PATH=$PATH:/usr/sbin:/sbin
release=$(<"$kernel/release")
root=$output.making
trap 'rm -rf "$root" "$output.new"' EXIT
rm -rf "$root"
mkdir -p "$root"/{bin,proc,sys,dev,run,root,data,lib/modules/"$release"}
dpkg-deb --fsys-tarfile "$busybox" | tar -x -O ./bin/busybox >"$root/bin/busybox"
install -m 755 "$here/start/init" "$root/init"
ln -s bin "$root/sbin" # where the kernel looks for modprobe
chmod 755 "$root/bin/busybox"

of_start() { sed -n 's/ *#.*//; s/^\([^ ]*\) .*\<'"$1"'\>.*/\1/p' "$here/modules.txt"; }
of_start start | while read -r module; do
  modprobe -d "$kernel" -S "$release" --show-depends "$module"
done | sed -n "s|^insmod $kernel/\([^ ]*\).*|\1|p" | sort -u | while read -r file; do
  mkdir -p "$root/$(dirname "$file")"
  cp "$kernel/$file" "$root/$file"
done
cp "$kernel/lib/modules/$release"/modules.{builtin,builtin.modinfo,order} "$root/lib/modules/$release/"
depmod -b "$root" "$release"
rm -f "$root/lib/modules/$release"/*.bin # busybox reads the others
of_start always >"$root/always"
for name in root-a root-b; do identifier "$name" >"$root/image-$name"; done

find "$root" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
(cd "$root" && find . -print0 | LC_ALL=C sort -z | cpio --quiet --null --reproducible -o -H newc --owner 0:0) |
  zstd -q -19 -T0 >"$output.new"
mv "$output.new" "$output"
