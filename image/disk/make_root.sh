#!/usr/bin/env bash
# make_root.sh OUTPUT PACKAGES KERNEL PROGRAMS APPLICATION DESCRIPTOR PC IDENTITY [ARGUMENT...]: the folder that becomes the root of
# an industrial PC. PACKAGES is a file that lists packages' files, KERNEL what take_kernel.sh made, PROGRAMS a folder with the programs
# beside the application, APPLICATION an executable, DESCRIPTOR what it says by --descriptor, PC a folder with machine.conf and
# perhaps network/*.network, IDENTITY one with the files version and keyring.pem (whose updates it takes), and the ARGUMENTs are the
# application's.
# No package's script is run, so that this needs no right of root and no folder of the machine that it runs on.
set -eu -o pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$1 packages=$2 kernel=$3 programs=$4 application=$5 descriptor=$6 pc=$7 identity=$8
shift 8
PATH=$PATH:/usr/sbin:/sbin # ldconfig

lines_of() { sed 's/ *#.*//; /^$/d' "$1"; } # lines_of FILE: without what is for people

unpack() {
  local package folder
  local -a without=()
  mapfile -t without < <(lines_of "$here/left_out.txt")
  mkdir -p "$root"/usr/{bin,sbin,lib,lib64}
  for folder in bin sbin lib lib64; do ln -s "usr/$folder" "$root/$folder"; done
  while read -r package; do
    dpkg-deb --fsys-tarfile "$package" |
      tar -x -C "$root" --no-same-owner --keep-directory-symlink --no-wildcards-match-slash --wildcards "${without[@]/#/--exclude=}"
  done <"$packages"
  # Nobody becomes somebody else here.
  find "$root" -type f -perm /6000 -exec chmod ug-s {} +
}

set_up() {
  cp -a "$kernel/lib/modules" "$root/usr/lib/"
  cp -r "$here/root/." "$root/"
  chmod 600 "$root/etc/shadow"
  : >"$root/etc/machine-id" # start/init puts this PC's in its place
  mkdir -p "$root"/{data,boot/efi,proc,sys,dev,run,tmp,var}
  ln -sfn ../proc/self/mounts "$root/etc/mtab"
  ln -sfn /run/systemd/resolve/resolv.conf "$root/etc/resolv.conf"
  ln -sfn ../lib/systemd/systemd "$root/usr/sbin/init"
  ln -sfn multi-user.target "$root/usr/lib/systemd/system/default.target"
  # A clock that stands before this version was made has stopped or lost its battery: systemd sets it to this file's time.
  touch -d "@$SOURCE_DATE_EPOCH" "$root/usr/lib/clock-epoch"
  mkdir -p "$root/etc/flexrf"
  cp "$pc/machine.conf" "$root/etc/flexrf/machine.conf"
  mkdir -p "$root/usr/lib/flexrf"
  cp "$identity/version" "$root/usr/lib/flexrf/version"
  cp "$identity/keyring.pem" "$root/etc/rauc/keyring.pem"
  sed -i "s|@application@|${application##*/}|" "$root/etc/rauc/system.conf"
  if [[ -d $pc/network ]]; then cp "$pc"/network/*.network "$root/etc/systemd/network/"; fi
}

of_tables() { jq -r -f "$here/of_tables.jq" "$descriptor" | sed -n "s/^$1 //p"; } # of_tables WORD: its values

# The files of devices that the application may open, as systemd's unit and udev's rules have them. What the kernel numbers as it
# finds it, and what a table calls by a name that stays, is allowed as a whole kind: its group in the kernel's list of drivers.
devices() {  # devices: lines GROUP_OF_THE_KERNEL|FILE KERNEL_NAME MODULE
  local class file
  for class in $(of_tables class); do
    case $class in
      gpio) echo 'char-gpiochip gpiochip* -' ;;
      camera) echo 'char-video4linux video* videodev' ;;
      input) echo 'char-input event* evdev' ;;
      watchdog) echo 'char-watchdog watchdog* -' ;;
    esac
  done
  for file in $(of_tables file); do
    case $file in
      /dev/serial/*) printf '%s\n' 'char-ttyUSB ttyUSB* usbserial' 'char-ttyACM ttyACM* cdc_acm' ;;
      /dev/ttyUSB*) echo "char-ttyUSB ${file#/dev/} usbserial" ;;
      /dev/ttyACM*) echo "char-ttyACM ${file#/dev/} cdc_acm" ;;
      /dev/tty*) echo "$file ${file#/dev/} -" ;;
    esac
  done
}

words_for_systemd() {  # words_for_systemd WORD...: as ExecStart= has them
  local word
  for word; do
    word=${word//\\/\\\\} word=${word//\"/\\\"} word=${word//%/%%} word=${word//\$/\$\$}
    printf ' "%s"' "$word"
  done
}

make_service() {  # make_service ARGUMENT...
  local name=${application##*/} program allowed kernel_name module
  local unit=$root/etc/systemd/system/flexrf.service rules=$root/etc/udev/rules.d/80-flexrf.rules
  local modules=$root/etc/modules-load.d/flexrf.conf
  mkdir -p "$root/etc"/{udev/rules.d,modules-load.d}
  for program in "$application" "$programs"/*; do strip -o "$root/usr/lib/flexrf/${program##*/}" "$program"; done
  sed -e "s|@application@|$name|" -e "s|@priority@|$(of_tables priority)|" "$here/flexrf.service" |
    awk -v arguments="$(words_for_systemd "$@" | sed 's/\\/\\\\/g')" '{ at = index($0, " @arguments@") }
      at { $0 = substr($0, 1, at - 1) arguments } { print }' >"$unit"
  echo "# The cell's devices, and what keeps processors from sleeping deeply." >"$rules"
  echo 'KERNEL=="cpu_dma_latency", GROUP="flexrf", MODE="0660"' >>"$rules"
  echo "# Kinds of devices that the cell may open: the kernel has to know them before the cell starts." >"$modules"
  while read -r allowed kernel_name module; do
    echo "DeviceAllow=$allowed rw" >>"$unit"
    echo "KERNEL==\"$kernel_name\", GROUP=\"flexrf\", MODE=\"0660\"" >>"$rules"
    [[ $module == - ]] || echo "$module" >>"$modules"
  done < <(devices | sort -u)
}

# A hung PC is reset: systemd feeds its watchdog, unless the application's tables have it.
choose_watchdog() {
  local file=$root/etc/systemd/system.conf.d/watchdog.conf
  if of_tables class | grep -q -x watchdog; then return; fi
  mkdir -p "${file%/*}"
  printf '%s\n' '[Manager]' 'RuntimeWatchdogSec=30s' 'RebootWatchdogSec=5min' >"$file"
}

choose_units() {
  local target unit
  rm -rf "$root"/usr/lib/systemd/system/*.{wants,requires}
  while read -r target unit; do
    mkdir -p "$root/etc/systemd/system/$target.wants"
    if [[ -e $root/etc/systemd/system/$unit ]]; then
      ln -s "../$unit" "$root/etc/systemd/system/$target.wants/$unit"
    elif [[ -e $root/usr/lib/systemd/system/$unit ]]; then
      ln -s "/lib/systemd/system/$unit" "$root/etc/systemd/system/$target.wants/$unit"
    else
      echo "started.txt: there is no unit $unit"
      return 1
    fi
  done < <(lines_of "$here/started.txt")
  lines_of "$here/masked.txt" | while read -r unit; do ln -s /dev/null "$root/etc/systemd/system/$unit"; done
}

libraries_missing() {  # what an executable or a library here asks for and does not find
  local needed
  # Scripts are no objects, which objdump says too.
  { find "$root" -type f \( -perm -100 -o -name '*.so*' \) -exec objdump --private-headers {} + 2>/dev/null || true; } |
    awk '$1 == "NEEDED" { print $2 }' | sort -u | while read -r needed; do
      [[ $(find "$root/usr/lib" -name "$needed" -print -quit) ]] || printf '%s\n' "$needed"
    done
}

rm -rf "$root"
umask 022
unpack
set_up
make_service "$@"
choose_watchdog
choose_units
missing=$(libraries_missing)
if [[ $missing ]]; then
  echo "packages.txt lacks the packages of these libraries: ${missing//$'\n'/ }"
  exit 1
fi
ldconfig -r "$root" -X
rm -rf "$root/var/cache"
