# Sourced by flexrf: makes the image of an industrial PC's disk (image/disk, docs/image.md).
# shellcheck shell=bash disable=SC2154 # shares its variables with flexrf

disk_scripts=$root/image/disk
image_folder=$root/build/image
# shellcheck source=image/disk/partitions.sh
root_mib=$(source "$disk_scripts/partitions.sh" && mib_of root-a)
image_key='' image_certificate='' image_keyring='' image_version='' image_boot_password='' # as the options say
development_key='' # yes or no, when it is known

# shellcheck source=cmake/tool/image_keys.sh
source "$tool/image_keys.sh"
# shellcheck source=cmake/tool/image_bundle.sh
source "$tool/image_bundle.sh"
# shellcheck source=cmake/tool/image_sbom.sh
source "$tool/image_sbom.sh"

image_obstacle() {  # prints why no image can be made on this machine; nothing when one can
  local release
  release=$(sed -n 's/^VERSION_ID="\{0,1\}\([0-9]*\).*/\1/p' /etc/os-release 2>/dev/null)
  if [[ $(uname -m) != x86_64 ]]; then
    printf 'it is made for amd64, of what is built for this machine\n'
  elif ! command -v dpkg-query >/dev/null || [[ $release != 12 ]]; then
    printf 'it is made of packages of Debian 12, and of an application that goes with them\n'
  fi
}

free_mib() { df -m --output=avail "$1" | tail -n 1 | tr -d ' '; } # free_mib FOLDER

check_output() {  # check_output FILE: ends with a message if no image can be written there
  local folder=${1%/*}
  [[ $1 == */* ]] || folder=.
  [[ -d $folder ]] || die "there is no folder $folder for the image; make it first: mkdir -p $folder"
  [[ ! -d $1 ]] || die "$1 is a folder; name a file: --output ${1%/}/cell.img"
  [[ ! -e $1 || -f $1 ]] || die "$1 is not an ordinary file. Make the image in a file, and write it then: ./flexrf flash FILE $1"
  [[ -w $folder && (! -e $1 || -w $1) ]] || die "$1 cannot be written: another place can be named by --output"
  # Holes take no room; file systems that have none need what the image is long.
  (($(free_mib "$folder") >= 700)) || die "there are $(free_mib "$folder") MiB left in $folder, and the image takes up to 700"
}

check_room() {  # for what the image is made of
  mkdir -p "$image_folder" || die "$image_folder cannot be made"
  (($(free_mib "$image_folder") >= 1500)) ||
    die "there are $(free_mib "$image_folder") MiB left in $image_folder, and making an image takes up to 1500"
}

package_names() {  # package_names EXECUTABLE: of the root, those of its own libraries among them
  local library
  sed 's/ *#.*//; /^$/d; s/ .*//' "$disk_scripts/packages.txt"
  ldd "$1" | sed -n -E 's|^.* => (/[^ ]+) \(0x[0-9a-f]+\)$|\1|p' | while read -r library; do
    # Where it is installed, the list of its package's files may have it without /usr, or with it.
    dpkg-query -S "$(readlink -f "$library")" "/lib/${library#*/lib/}" "/usr/lib/${library#*/lib/}" 2>/dev/null | head -n 1 | sed 's/:.*//'
  done
}

kernel_package() {  # the package of the newest real-time kernel
  apt-cache show --no-all-versions linux-image-rt-amd64 2>/dev/null | sed -n 's/^Depends: \(linux-image-[^ ,]*\).*/\1/p' | head -n 1
}

fetch() {  # fetch NAME...: prints the packages' files
  bash "$disk_scripts/fetch_packages.sh" "${cache:-$image_folder}/image-packages" "$@"
}

kernel_file='' busybox_file='' # packages that a version has beside those of its root, when they were fetched

make_image_kernel() {  # once, and anew when what it is made of has changed
  local name recipe
  name=$(kernel_package)
  [[ $name ]] || { fetch linux-image-rt-amd64 >/dev/null && name=$(kernel_package); }
  kernel_file=$(fetch "$name") || return
  recipe=$(cat "$disk_scripts"/{take_kernel.sh,modules.txt} - <<<"$kernel_file" | sha256sum)
  [[ -f $image_folder/kernel.recipe && -d $image_folder/kernel && $(<"$image_folder/kernel.recipe") == "$recipe" ]] && return
  bash "$disk_scripts/take_kernel.sh" "$kernel_file" "$image_folder/kernel" && printf '%s\n' "$recipe" >"$image_folder/kernel.recipe"
}

environment_block() {  # environment_block LINE...: as GRUB reads it
  local text
  text=$(printf '%s\n' '# GRUB Environment Block' "$@")$'\n'
  ((${#text} <= 1024)) || { say "GRUB's block of 1024 bytes is too small for: $*" && return 1; }
  printf '%s%s' "$text" "$(printf '%*s' $((1024 - ${#text})) '' | tr ' ' '#')"
}

boot_password() {  # boot_password APPLICATION: the hash for GRUB's menu, or nothing
  local file=$root/apps/$1/pc/boot-password text=$image_boot_password from=--boot-password-hash
  if [[ ! $text && -f $file ]]; then text=$(<"$file") from=$file; fi
  [[ $text ]] || return 0
  [[ $text =~ grub\.pbkdf2\.sha512\.[0-9]+\.[0-9A-Fa-f]+\.[0-9A-Fa-f]+ ]] ||
    die "$from: '${text:0:40}' is no hash of a password; grub-mkpasswd-pbkdf2 makes one, grub.pbkdf2.sha512.10000. and so on"
  printf '%s\n' "${BASH_REMATCH[0]}"
}

# What GRUB starts with, and what outlives updates.
make_folders() {  # make_folders WORK CONFIGURATION BOOT_PASSWORD_HASH
  local work=$1
  mkdir -p "$work"/{data/{flexrf,journal},esp/{grub,flexrf}} &&
    cp "$root/image/boot/grub.cfg" "$work/esp/grub/" &&
    "$root/build/release/image/boot/flexrf-boot-choice" --folder "$work/esp/flexrf" create || return
  if [[ $3 ]]; then printf 'password_pbkdf2 service %s\n' "$3" >"$work/esp/grub/password.cfg" || return; fi
  if [[ -f $2 ]]; then cp "$2" "$work/data/flexrf/config-a.xml"; fi
}

take_time() {  # take_time WHAT COMMAND...: says how long it took
  local start what=$1
  start=$(microseconds)
  shift
  "$@" || return
  say "$what: $(since "$start")"
}

version_text() {  # when the last commit was made, and which it is
  local time commit changed=''
  read -r time commit < <(git -C "$root" log -1 --format='%ct %h' 2>/dev/null)
  [[ ! $commit || ! $(git -C "$root" status --porcelain 2>/dev/null) ]] || changed=-dirty
  printf '%s%s%s\n' "$(TZ=UTC date -d "@${time:-$SOURCE_DATE_EPOCH}" +%Y%m%dT%H%M%SZ)" "${commit:+-$commit}" "$changed"
}

make_identity() {  # make_identity WORK APPLICATION DRIVERS: what version this is, and whose updates it takes
  mkdir "$1/identity" && cp "$image_keyring" "$1/identity/keyring.pem" && chmod 644 "$1/identity/keyring.pem" &&
    printf '%s\n' "application=$2" "version=${image_version:-$(version_text)}" "built=$SOURCE_DATE_EPOCH" "development_key=$development_key" \
      "drivers=$3" >"$1/identity/version"
}

make_root() {  # make_root WORK APPLICATION PC [ARGUMENT...]
  local work=$1 executable=$root/build/release/apps/$2/$2
  local -a names
  mapfile -t names < <(package_names "$executable" | sort -u)
  mkdir "$work/programs" &&
    cp "$root"/build/release/image/{boot/flexrf-boot-choice,claim/flexrf-claim,helper/flexrf-helper,screen/flexrf-screen} "$work/programs/" &&
    fetch "${names[@]}" >"$work/packages" &&
    bash "$disk_scripts/make_root.sh" "$work/root" "$work/packages" "$image_folder/kernel" "$work/programs" "$executable" \
      "$work/descriptor" "$3" "$work/identity" "${@:4}"
}

make_start() {  # once, and anew when what it is made of has changed: it takes long to pack
  local recipe
  busybox_file=$(fetch busybox-static) || return
  recipe=$(cat "$disk_scripts"/{make_start.sh,partitions.sh,modules.txt,start/init} "$image_folder/kernel.recipe" - <<<"$busybox_file $SOURCE_DATE_EPOCH" | sha256sum)
  [[ -f $image_folder/start.recipe && -f $image_folder/start.img && $(<"$image_folder/start.recipe") == "$recipe" ]] && return
  rm -f "$image_folder/start.recipe"
  bash "$disk_scripts/make_start.sh" "$image_folder/kernel" "$busybox_file" "$image_folder/start.img" && printf '%s\n' "$recipe" >"$image_folder/start.recipe"
}

# slot_block KERNEL_OPTIONS ROOT: what GRUB tells the kernel, and which root belongs to it: its size and its checksum
slot_block() { environment_block "slot_options=$1 flexrf.root=$(stat -c %s "$2"):$(sha256sum <"$2" | head -c 64)"; }

make_boot() {  # make_boot WORK KERNEL_OPTIONS: after root.img
  mkdir "$1/boot" &&
    cp "$image_folder/kernel/vmlinuz" "$1/boot/" &&
    slot_block "$2" "$1/root.img" >"$1/boot/slot.env" &&
    make_start && cp "$image_folder/start.img" "$1/boot/initrd.img" &&
    bash "$disk_scripts/make_boot.sh" "$1/boot" "$1/boot.img"
}

# What a variant for tests has besides: devices that nobody has to plug in, and a report on the console. gpio-sim, which Debian's kernel
# leaves out, is the guest's.
add_test_devices() {  # add_test_devices WORK: makes root.test of root, and lists what differs
  local release modules file
  release=$(<"$image_folder/kernel/release")
  modules=$root/build/guest/kernel/lib/modules/$release
  mkdir -p "$guest_folder"
  (flock 9 && make_kernel 9>&-) 9>"$guest_folder/.lock" || return
  [[ -d $modules ]] || { say "the guest's kernel is not the image's, $release; hint: rm -r build/guest/kernel" && return 1; }
  cp -a "$1/root" "$1/root.test" && cp -r "$disk_scripts/test/." "$1/root.test/" || return
  while read -r file; do
    [[ -e $1/root/usr/lib/modules/$release/$file ]] && continue
    mkdir -p "$1/root.test/usr/lib/modules/$release/${file%/*}"
    cp "$modules/$file" "$1/root.test/usr/lib/modules/$release/$file" || return
  done < <(PATH=$PATH:/usr/sbin:/sbin modprobe -d "$root/build/guest/kernel" -S "$release" --show-depends -a configfs gpio_sim vivid |
    sed -n "s|^insmod $modules/\\([^ ]*\\).*|\\1|p" | sort -u)
  PATH=$PATH:/usr/sbin:/sbin depmod -b "$1/root.test" "$release" || return
  say "the variant for tests differs in:"
  diff -rq --no-dereference "$1/root" "$1/root.test" | sed "s|$1/||g" >&2
  rm -rf "$1/root"
  mv "$1/root.test" "$1/root"
}

compression_of_root=() # options of mksquashfs; tests take less time for it, and more room
pack_root() {  # pack_root FOLDER OUTPUT
  mksquashfs "$1" "$2" -noappend -quiet -no-progress -all-root -no-xattrs -comp zstd "${compression_of_root[@]}" || return
  (($(stat -c %s "$2") <= root_mib * 1048576)) || { say "the root is larger than its partition of $root_mib MiB" && return 1; }
}

mib() { printf '%d MiB\n' $((($1 + 1048575) / 1048576)); } # mib BYTES

# The same inputs give the same image: the time of its files is that of the last commit, unless the environment has another.
time_of_version() { printf '%s\n' "${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct 2>/dev/null || date +%s)}"; }

# The two partitions of a version, of which disks and bundles are made.
make_version() {  # make_version WORK APPLICATION product|test [ARGUMENT...]: boot.img, root.img and identity/version in WORK
  local work=$1 application=$2 variant=$3 executable=$root/build/release/apps/$2/$2 options drivers pc=$root/apps/$2/pc
  shift 3
  umask 022
  [[ -f $pc/machine.conf ]] || pc=$disk_scripts
  SOURCE_DATE_EPOCH=$(time_of_version)
  export SOURCE_DATE_EPOCH
  [[ $development_key ]] || choose_keys # the command has done so before it built
  "$executable" --descriptor </dev/null >"$work/descriptor" || die "the application does not say what it is"
  drivers=$("$executable" "$@" --drivers </dev/null) || die "with these ARGS the application would not start on the PC"
  options=$(bash "$disk_scripts/kernel_options.sh" "$work/descriptor" "$pc/machine.conf") || exit 1
  say "drivers: ${drivers//,/, }"
  make_identity "$work" "$application" "$drivers" || die "what version this is could not be written"
  take_time "took the kernel" make_image_kernel || die "there is no kernel for the image"
  take_time "made the root" make_root "$work" "$application" "$pc" "$@" || die "the root could not be made"
  if [[ $variant == test ]]; then add_test_devices "$work" || die "the devices for tests could not be had"; fi
  take_time "packed the root" pack_root "$work/root" "$work/root.img" || die "the root could not be packed"
  say "root: $(mib "$(du -sb "$work/root" | cut -f 1)") unpacked, $(mib "$(stat -c %s "$work/root.img")") as squashfs"
  rm -rf "$work/root"
  take_time "made the start" make_boot "$work" "$options" || die "the partition with the kernel could not be made"
}

make_disk() {  # make_disk WORK APPLICATION OUTPUT: of a version
  local work=$1 hash
  hash=$(boot_password "$2") || exit 1
  make_folders "$work" "$root/apps/$2/config.xml" "$hash" || die "what GRUB reads could not be made"
  take_time "made the disk" bash "$disk_scripts/make_disk.sh" "$3" "$work/boot.img" "$work/root.img" "$work/data" "$work/esp" ||
    die "the disk could not be made"
}

make_image() {  # make_image APPLICATION OUTPUT product|test [ARGUMENT...]
  local work
  work=$(mktemp -d "$image_folder/$1.XXXXXX")
  # shellcheck disable=SC2064 # the folder of now
  trap "rm -rf '$work'" EXIT
  make_version "$work" "$1" "${@:3}"
  make_disk "$work" "$1" "$2"
  take_time "listed what is in it, $2.spdx.json" write_sbom "$work" "$1" image "$2" || die "what the image consists of could not be listed"
}
