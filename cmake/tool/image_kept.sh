# Sourced by image_test.sh: what the tests of the image keep from one run to the next, below the cache (docs/image.md): PCs with their memory
# and disk, recordings of a disk's writes, and how far a campaign has come. Each is a folder NAME.KEY; the key is a checksum of everything
# that goes into it.
# shellcheck shell=bash disable=SC2154,SC2034 # shares its variables with flexrf

kept_folder=${cache:-$image_folder}/image-tests
kept_of_a_name=2 # folders of one name; older ones are removed
image_programs=(apps/pick-station/pick-station image/boot/flexrf-boot-choice image/claim/flexrf-claim image/helper/flexrf-helper image/screen/flexrf-screen)
judging_programs=(image/power_cut/flexrf-power-cut web-ui/server/access/flexrf-password image/boot/boot_choice_what_boots)
image_inputs='' # when they are known

# A line for each thing that the images of the tests depend on: programs, files and scripts of the repository, the versions of the packages in
# the image and of those that make and emulate it, the keyring. Fails if the package lists of this machine do not name a package.
find_image_inputs() {
  local release=$root/build/release names
  local -a packages
  names=$(package_names "$release/${image_programs[0]}" | sort -u)
  mapfile -t packages <<<"$names"
  (cd "$release" && sha256sum "${image_programs[@]}") || return
  (
    cd "$root" && {
      find image/disk image/guest image/boot/grub.cfg cmake/tool/image*.sh -type f -print0
      find apps/pick-station -type f \( -name config.xml -o -path '*/pc/*' \) -print0
    } | sort -z | xargs -0 sha256sum
  ) || return
  names=$(apt-get download --print-uris "${packages[@]}" busybox-static "$(kernel_package)" </dev/null 2>/dev/null) || return
  awk '{ print $2, $4 }' <<<"$names" | sort
  awk '$2 ~ /^(image|guest)/ { print $1 }' "$root/packages.txt" | sort -u | xargs dpkg-query -W 2>/dev/null
  sha256sum <"$image_keyring"
}

image_key() {  # prints the key of what is kept; call it when the programs are built and choose_keys has chosen
  printf '%s\n' "$image_inputs" | sha256sum | head -c 32
}

kept() {  # kept NAME: prints its folder if it is there and whole; one that is damaged is removed
  local folder
  folder=$kept_folder/$1.$(image_key)
  [[ -d $folder ]] || return
  # Once in a run is enough.
  if [[ ! -e $pc_shared/$1.checked ]]; then
    if ! cmp -s <(checksums_of "$folder") "$folder/checksums"; then
      say "$folder is damaged; it is removed and made again"
      rm -rf "$folder"
      return 1
    fi
    : >"$pc_shared/$1.checked"
    touch "$folder"
  fi
  printf '%s\n' "$folder"
}

# checksums_of FOLDER: of all files in it but the progress of a campaign; holes are not read
checksums_of() { tar -C "$1" -cSf - --sort=name --mtime=@0 --exclude=./checksums --exclude=./progress . | cksum; }

keep() {  # keep NAME FILE...: moves the files into a folder of that name, all of them or none
  local folder new
  folder=$kept_folder/$1.$(image_key)
  mkdir -p "$kept_folder" && new=$(mktemp -d "$kept_folder/$1.XXXXXX") || return
  if ! { mv "${@:2}" "$new/" && checksums_of "$new" >"$new/checksums" && rm -rf "$folder" && mv -T "$new" "$folder"; }; then
    rm -rf "$new"
    return 1
  fi
  : >"$pc_shared/$1.checked"
  find "$kept_folder" -mindepth 1 -maxdepth 1 -name "$1.*" -printf '%T@ %p\n' | sort -rn | sed "1,${kept_of_a_name}d; s/^[^ ]* //" |
    xargs -r -d '\n' rm -rf
}

# once NAME COMMAND...: carries out the command unless NAME is kept; lanes that need the same thing wait for the first of them
once() (
  exec 9>"$pc_shared/$1.lock"
  flock 9
  kept "$1" >/dev/null || "${@:2}" 9>&-
)
