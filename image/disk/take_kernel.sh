#!/usr/bin/env bash
# take_kernel.sh PACKAGE OUTPUT: makes the folder OUTPUT of the package of a kernel: vmlinuz, release, and lib/modules with those modules
# of modules.txt and what they need.
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
package=$1 output=$2
PATH=$PATH:/usr/sbin:/sbin # depmod and modprobe; not only root has a use for them
work=$output.making # on the same file system, so that the folder is either complete or not there
trap 'rm -rf "$work"' EXIT
rm -rf "$work" "$output"
mkdir -p "$work"/{all,made}

dpkg-deb -x "$package" "$work/all"
kernels=("$work"/all/boot/vmlinuz-*)
release=${kernels[0]##*/vmlinuz-}
mv "${kernels[0]}" "$work/made/vmlinuz"
printf '%s\n' "$release" >"$work/made/release"

all=$work/all/lib/modules/$release
chosen=$work/made/lib/modules/$release
mkdir -p "$chosen"
depmod -b "$work/all" "$release"
sed 's/ *#.*//; /^$/d; s/ .*//' "$here/modules.txt" | while read -r module; do
  modprobe -d "$work/all" -S "$release" --show-depends "$module"
done | sed -n "s|^insmod $all/\([^ ]*\).*|\1|p" | sort -u | while read -r file; do
  mkdir -p "$chosen/$(dirname "$file")"
  mv "$all/$file" "$chosen/$file"
done
mv "$all"/modules.{builtin,builtin.modinfo,order} "$chosen/"
depmod -b "$work/made" "$release"
mv "$work/made" "$output"
