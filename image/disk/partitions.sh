# Sourced by what makes partitions: their names, sizes and kinds (docs/image.md), and file systems for them.
# shellcheck shell=bash disable=SC2034 # for who sources it

# The first one begins at 1 MiB; sizes are in MiB.
names=(bios esp boot-a boot-b root-a root-b data)
sizes=(1 32 96 96 512 512 256)
bios_type=21686148-6449-6E6F-744E-656564454649
esp_type=C12A7328-F81F-11D2-BA4B-00A0C93EC93B
boot_type=BC13C2FF-59E6-4262-A352-B275FD6F7172
root_type=4F68BCE3-E8CD-4DB1-96E7-FBCAF984B709
data_type=0FC63DAF-8483-4772-8E79-3D69D8477DE4
types=("$bios_type" "$esp_type" "$boot_type" "$boot_type" "$root_type" "$root_type" "$data_type")

mib_of() {  # mib_of PARTITION
  local k
  for k in "${!names[@]}"; do
    if [[ ${names[k]} == "$1" ]]; then printf '%d\n' "${sizes[k]}"; fi
  done
}

identifier() {  # identifier NAME: a GUID that is the same whenever the image is made
  sha256sum <<<"flexrf $1" | sed -E 's/^(.{8})(.{4}).(.{3}).(.{3})(.{12}).*/\1-\2-4\3-8\4-\5/'
}

make_file_system() {  # make_file_system KIND PARTITION FOLDER OUTPUT OPTION...
  truncate -s "$(mib_of "$2")M" "$4"
  # The time is for mke2fs, which has no other way to be told.
  E2FSPROGS_FAKE_TIME=$SOURCE_DATE_EPOCH mke2fs -q -t "$1" -L "$2" -U "$(identifier "$2")" -m 0 "${@:5}" \
    -E "root_owner=0:0,hash_seed=$(identifier "seed of $2")" -d "$3" "$4" "$(mib_of "$2")M"
}
