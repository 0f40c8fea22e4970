#!/usr/bin/env bash
# diagram.sh DOCUMENT DIAGRAM: the picture in the application's page is the one that the generator makes of its table.
set -u -o pipefail
diff -u <(awk '/^```mermaid$/ {within = 1; next} /^```$/ {within = 0} within' "$1") "$2" && exit
echo "$1: its diagram is another than the table's; put the contents of $2 there"
exit 1
