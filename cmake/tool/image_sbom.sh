# Sourced by image.sh: what an image or a bundle consists of, in the format SPDX 2.3 (JSON), beside it as FILE.spdx.json. The person
# responsible for a PC looks there for a package in which a vulnerability was found.
# shellcheck shell=bash disable=SC2154 # shares its variables with flexrf

# Libraries of which only headers exist, or are used: their code is in the executables.
header_libraries=(libboost-dev libeigen3-dev nlohmann-json3-dev)

# Lines for sbom.jq: kind, name, version, architecture, SHA-256, license, and how what is described has it; a dash for what is not known.
debian_packages() {  # of the files of packages that standard input names, as apt-get calls them: NAME_VERSION_ARCHITECTURE.deb
  local sum file name version architecture
  local -a files
  mapfile -t files
  sha256sum "${files[@]}" | while read -r sum file; do
    IFS=_ read -r name version architecture <<<"${file##*/}"
    printf 'deb\t%s\t%s\t%s\t%s\t-\tCONTAINS\n' "$name" "${version//%3a/:}" "${architecture%.deb}" "$sum"
  done
}

installed_packages() {  # installed_packages RELATION NAME...: of this machine, whose content gets into the image
  dpkg-query -W -f "deb\t\${Package}\t\${Version}\t\${Architecture}\t-\t-\t$1\n" "${@:2}"
}

page_packages() {  # of the panel's page, which is in the application's executable
  jq -r '.packages | to_entries[] | select(.key != "" and .value.dev != true) |
    ["npm", (.key | sub("^.*node_modules/"; "")), .value.version, "-", "-", (.value.license // "-"), "STATIC_LINK"] | @tsv' \
    "$root/web-ui/panel/package-lock.json"
}

write_sbom() {  # write_sbom WORK APPLICATION image|bundle FILE: of a version
  local work=$1
  {
    printf 'own\tFlexRF\t%s\t-\t-\tApache-2.0\tCONTAINS\n' "$(version_text)"
    { cat "$work/packages" && printf '%s\n' "$kernel_file" "$busybox_file"; } | sort -u | debian_packages &&
      installed_packages STATIC_LINK "${header_libraries[@]}" && page_packages || return
    # An update leaves GRUB as it is.
    [[ $3 != image ]] || installed_packages CONTAINS grub-pc-bin grub-efi-amd64-bin
  } >"$work/sbom.rows" && jq -n -R --arg application "$2" --arg version "$(sed -n 's/^version=//p' "$work/identity/version")" --arg kind "$3" \
    --arg sum "$(sha256sum <"$work/root.img" | head -c 64)" --arg created "$(TZ=UTC date -d "@$SOURCE_DATE_EPOCH" +%Y-%m-%dT%H:%M:%SZ)" \
    -f "$tool/image_sbom.jq" "$work/sbom.rows" >"$4.spdx.json"
}
