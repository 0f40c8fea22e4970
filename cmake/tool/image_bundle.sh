# Sourced by image.sh: the bundle by which a PC gets another version (docs/image.md), RAUC's in the format verity.
# shellcheck shell=bash disable=SC2154 # shares its variables with flexrf

# The slots' partitions as the disk has them. What the manifest says is signed, and with it the root of the tree of checksums that the
# kernel of the PC compares each block with.
pack_bundle() {  # pack_bundle WORK COMPATIBLE OUTPUT: of boot.img, root.img and identity/version
  local work=$1 said version built
  version=$(sed -n 's/^version=//p' "$work/identity/version")
  built=$(sed -n 's/^built=//p' "$work/identity/version")
  rm -rf "$work/bundle" "$work/bundle.made"
  mkdir "$work/bundle" && ln "$work/boot.img" "$work/root.img" "$work/identity/version" "$work/bundle/" || return
  printf '%s\n' '[update]' "compatible=$2" "version=$version" "build=$built" '' '[bundle]' 'format=verity' '' \
    '[image.root]' 'filename=root.img' '' '[image.boot]' 'filename=boot.img' >"$work/bundle/manifest.raucm"
  # RAUC looks at what it has signed, as a PC does. The images are compressed already.
  printf '%s\n' '[system]' "compatible=$2" 'bootloader=noop' '[keyring]' "path=$image_keyring" 'check-purpose=codesign' \
    'use-bundle-signing-time=true' >"$work/system.conf"
  said=$(rauc --conf="$work/system.conf" --key="$image_key" --cert="$image_certificate" --keyring="$image_keyring" \
    --mksquashfs-args='-comp zstd -Xcompression-level 1 -no-progress -quiet' bundle "$work/bundle" "$work/bundle.made" 2>&1) || { say "$said" && return 1; }
  mv "$work/bundle.made" "$3"
}

make_bundle() {  # make_bundle APPLICATION OUTPUT product|test [ARGUMENT...]
  local work
  work=$(mktemp -d "$image_folder/$1.XXXXXX")
  # shellcheck disable=SC2064 # the folder of now
  trap "rm -rf '$work'" EXIT
  make_version "$work" "$1" "${@:3}"
  take_time "made the bundle" pack_bundle "$work" "flexrf-$1-amd64" "$2" || die "the bundle could not be made"
  take_time "listed what is in it, $2.spdx.json" write_sbom "$work" "$1" bundle "$2" || die "what the bundle consists of could not be listed"
  say "bundle: $(mib "$(stat -c %s "$2")"), version $(sed -n 's/^version=//p' "$work/identity/version")"
}
