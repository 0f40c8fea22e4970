#!/usr/bin/env bash
# What an industrial PC does to its partition for data before it mounts it (image/disk), tried on files.
source "$(dirname "$0")/stand_in.sh"
PATH=$PATH:/usr/sbin:/sbin
if ! command -v e2fsck >/dev/null; then
  echo "not tried: there is no e2fsck (package e2fsprogs)"
  finish
fi
data=$work/data notice=$work/notice

repair() {  # sets status, output and what the panel shows
  output=$(sh "$repository/image/disk/root/usr/lib/flexrf/repair-data" "$data" "$notice" 2>&1)
  status=$?
  shown=$(cat "$notice" 2>/dev/null)
}

user() { debugfs -R 'cat flexrf/panel-users' "$data" 2>/dev/null; }

fresh() {  # with a user, and a superblock that has copies
  rm -rf "$data" "$notice" "$work/files"
  mkdir -p "$work/files/flexrf"
  echo anna >"$work/files/flexrf/panel-users"
  mke2fs -q -t ext4 -b 1024 -m 0 -J size=16 -d "$work/files" "$data" 200M >/dev/null 2>&1
}

garbage() { head -c "$(($2 * 1024))" /dev/urandom | dd of="$data" bs=1024 seek="$1" conv=notrunc status=none; } # garbage FROM KIB

fresh
echo "of an earlier boot" >"$notice"
repair
expect "exit code of what is whole" "$status" 0
expect "notice of what is whole" "$shown" ""
expect "user of what is whole" "$(user)" anna

debugfs -w -R 'set_super_value free_blocks_count 1' "$data" 2>/dev/null
debugfs -w -R 'set_inode_field flexrf/panel-users links_count 7' "$data" 2>/dev/null
debugfs -w -R 'set_super_value state 0' "$data" 2>/dev/null
repair
expect "exit code of small damage" "$status" 0
expect "notice of small damage" "$shown" "data was damaged, and is repaired: *"
expect "user after small damage" "$(user)" anna

fresh
garbage 1 1
repair
expect "exit code without the superblock" "$status" 0
expect "notice without the superblock" "$shown" "data was badly damaged, and is repaired *"
expect "user without the superblock" "$(user)" anna
repair
expect "notice the next time" "$shown" ""

garbage 0 150000
repair
expect "exit code without any superblock" "$status" 0
expect "notice without any superblock" "$shown" "data was damaged beyond repair, and is made anew: *"
expect "what is made anew" "$(e2fsck -f -n "$data" 2>&1)" "*data: 11/*"

# Whoever cannot look gives nothing up.
stand_in e2fsck <<'BODY'
exit 127
BODY
fresh
repair
expect "exit code without e2fsck" "$status" 1
expect "message without e2fsck" "$output" "*e2fsck has not done its work: exit code 127*"
expect "user without e2fsck" "$(user)" anna
stand_in e2fsck <<'BODY'
exit 12
BODY
repair
expect "exit code of e2fsck that could not look" "$status" 1
expect "message of e2fsck that could not look" "$output" "*data could not be checked (exit code 12 of e2fsck), and is left as it is*"
expect "user after e2fsck could not look" "$(user)" anna
# The first superblock is lost, and a copy of it is there.
garbage 1 1
repair
expect "exit code with a copy alone" "$status" 1
expect "copy" "$(dumpe2fs -o superblock=8193 -o blocksize=1024 -h "$data" 2>/dev/null)" "*0xEF53*"
rm "$data"
repair
expect "exit code without a partition" "$status" 1
expect "message without a partition" "$output" "*the partition for data cannot be read*"
finish
