#!/usr/bin/env bash
# make_initramfs.sh KERNEL OUTPUT [PROGRAM...] -- [EXECUTABLE...]: the guest's root file system as an archive that its kernel
# unpacks into memory: modules and busybox from the folder KERNEL (fetch_kernel.sh), this machine's bash and ip, the PROGRAMs
# without what is for debuggers, and the libraries that all these and the EXECUTABLEs need. An EXECUTABLE itself the guest finds
# in the repository's folder, which it mounts; a PROGRAM lies there in front of the host's file, so that nothing
# waits for the host while it runs.
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
kernel=$1 output=$2
PATH=$PATH:/usr/sbin:/sbin # ip, wherever it is
shift 2
programs=()
while [[ $1 != -- ]]; do
  programs+=("$1")
  shift
done
shift
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

# What has a program of its own here does not become a busybox applet.
cp "$kernel/busybox" "$root/usr/bin/busybox"
tools=(bash ip)
for tool in "${tools[@]}"; do cp -L "$(command -v "$tool")" "$root/usr/bin/$tool"; done
ln -s bash "$root/usr/bin/sh" # busybox's own shell would prefer its applet ip, which knows no CAN
"$kernel/busybox" --list | while read -r applet; do
  [[ -e $root/usr/bin/$applet ]] || ln -s busybox "$root/usr/bin/$applet"
done

for program in "${programs[@]}"; do
  mkdir -p "$root/programs/$(dirname "$program")"
  strip -o "$root/programs/$program" "$program"
done

# Each library where its user looks for it; /lib and /lib64 are the same folders as those in /usr here, too.
for file in "${tools[@]/#/$root/usr/bin/}" "${programs[@]}" "$@"; do ldd "$file" 2>/dev/null || true; done |
  sed -n -E 's|^\s*(.* => )?(/[^ ]+) \(0x[0-9a-f]+\)$|\2|p' | sort -u | while read -r library; do
    mkdir -p "$root/$(dirname "$library")"
    cp -L "$library" "$root/$library"
  done

(cd "$root" && find . -print0 | LC_ALL=C sort -z | cpio --quiet --null -o -H newc --owner 0:0) >"$output.new"
mv "$output.new" "$output"
