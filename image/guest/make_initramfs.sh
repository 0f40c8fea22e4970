#!/usr/bin/env bash
# make_initramfs.sh KERNEL OUTPUT TOOL... -- LIBRARY...: packs the guest's root file system as an archive that its kernel unpacks into
# memory: modules and busybox from the folder KERNEL (fetch_kernel.sh), and this machine's TOOLs with the LIBRARYs that they load. Nothing
# that a build makes is in it: a saved guest outlives builds.
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
kernel=$1 output=$2
shift 2
root=$output.making
trap 'rm -rf "$root" "$output.new"' EXIT
rm -rf "$root"
mkdir -p "$root"/{usr/{bin,sbin,lib,lib64},proc,sys,dev,run,tmp,etc/flexrf,root}
for folder in bin sbin lib lib64; do ln -s "usr/$folder" "$root/$folder"; done

cp -a "$kernel/lib/modules" "$root/usr/lib/"
cp "$here/init" "$root/init"
cp "$here/devices.sh" "$here/modules.txt" "$root/etc/flexrf/"
printf 'root:x:0:0:root:/root:/bin/bash\n' >"$root/etc/passwd"
printf 'root:x:0:\n' >"$root/etc/group"
printf '127.0.0.1 localhost guest\n' >"$root/etc/hosts"

# A tool has precedence over the busybox applet of its name.
cp "$kernel/busybox" "$root/usr/bin/busybox"
while [[ $1 != -- ]]; do
  cp -L "$1" "$root/usr/bin/${1##*/}"
  shift
done
shift
ln -s bash "$root/usr/bin/sh" # busybox's own shell would prefer its applet ip, which knows no CAN
"$kernel/busybox" --list | while read -r applet; do
  [[ -e $root/usr/bin/$applet ]] || ln -s busybox "$root/usr/bin/$applet"
done

# Each library lies where the program that loads it looks; /lib and /lib64 are links to the folders in /usr here, too.
for library; do
  mkdir -p "$root/$(dirname "$library")"
  cp -L "$library" "$root/$library"
done

(cd "$root" && find . -print0 | LC_ALL=C sort -z | cpio --quiet --null -o -H newc --owner 0:0) >"$output.new"
mv "$output.new" "$output"
