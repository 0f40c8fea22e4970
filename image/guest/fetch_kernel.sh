#!/usr/bin/env bash
# fetch_kernel.sh FOLDER: makes FOLDER with what the guest runs on, from packages of Debian 12 that it downloads by name and
# unpacks, so that nothing of it is installed here: vmlinuz, release (the kernel's), lib/modules (those of modules.txt and
# what they need), busybox. gpio-sim, which Debian's kernel leaves out, is built from its source.
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
target=$1
PATH=$PATH:/usr/sbin:/sbin # depmod and modprobe; not only root has a use for them
work=$target.making # on the same file system, so that the folder is either complete or not there
trap 'rm -rf "$work"' EXIT
rm -rf "$work" "$target"
mkdir -p "$work"/{debs,root,gpio-sim,made}

depends() {  # depends PACKAGE PATTERN: those of its dependencies that match
  apt-cache show --no-all-versions "$1" | sed -n 's/^Depends: //p' | tr ',' '\n' | sed 's/^ *//; s/ .*//' | grep -E "$2"
}

download() {  # what the lists here name may no longer be on the mirror: then they are renewed
  local release image
  local -a names
  image=$(depends linux-image-rt-amd64 '^linux-image-') || return
  release=${image#linux-image-}
  mapfile -t names < <(depends "linux-headers-$release" '^linux-')
  ((${#names[@]})) || return
  printf '%s\n' "$release" >"$work/made/release"
  names+=("$image" "linux-headers-$release" linux-source-6.1 busybox-static)
  (cd "$work/debs" && rm -f -- *.deb && apt-get -q download "${names[@]}" </dev/null)
}

renew_lists() {
  local -a as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || {
      echo "the package lists are old or missing, and renewing them needs root. As root: apt-get update"
      return 1
    }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get -q update </dev/null
}

download || { renew_lists && download; }
release=$(<"$work/made/release")

for package in "$work"/debs/*.deb; do
  case ${package##*/} in
    linux-source-*) source_package=$package ;;
    *) dpkg-deb -x "$package" "$work/root" ;;
  esac
done
cp "$work/root/boot/vmlinuz-$release" "$work/made/vmlinuz"
cp "$work/root/bin/busybox" "$work/made/busybox"

# Three files of the source; the archive is read to its end, or who writes it would complain.
dpkg-deb --fsys-tarfile "$source_package" | tar -x -O --wildcards '*/linux-source-*.tar.xz' |
  tar -x -J -C "$work/gpio-sim" --transform 's|.*/||' --wildcards \
    '*/drivers/gpio/gpio-sim.c' '*/drivers/gpio/gpiolib.h' '*/kernel/irq/irq_sim.c'
cd "$work/gpio-sim"
mv gpio-sim.c gpio-sim-core.c # an object may not bear its module's name
# What it calls there is not exported to modules; this does the same.
sed -i 's/handle_simple_irq(irq_to_desc(irqnum));/generic_handle_irq_safe(irqnum);/' irq_sim.c
printf 'obj-m := gpio-sim.o\ngpio-sim-y := gpio-sim-core.o irq_sim.o\n' >Kbuild
headers=$work/root/usr/src/linux-headers-$release
sed -i "s|/usr/src/|$work/root/usr/src/|" "$headers/Makefile" # they do not lie where they would be installed
make -s -C "$headers" M="$PWD" modules </dev/null
strip --strip-debug gpio-sim.ko

all=$work/root/lib/modules/$release
chosen=$work/made/lib/modules/$release
mkdir -p "$all/extra"
cp gpio-sim.ko "$all/extra/"
depmod -b "$work/root" "$release"
sed 's/ *#.*//; /^$/d; s/ .*//' "$here/modules.txt" | while read -r module; do
  modprobe -d "$work/root" -S "$release" --show-depends "$module"
done | sed -n "s|^insmod $all/\([^ ]*\).*|\1|p" | sort -u | while read -r file; do
  mkdir -p "$chosen/$(dirname "$file")"
  cp "$all/$file" "$chosen/$file"
done
cp "$all"/modules.{builtin,builtin.modinfo,order} "$chosen/"
depmod -b "$work/made" "$release"
mv "$work/made" "$target"
