# Sourced by flexrf: messages, and the nearest known word for one that is not known.
# shellcheck shell=bash disable=SC2154 # root and tool are flexrf's

say() { printf 'flexrf: %s\n' "$*" >&2; }

die() {
  say "$*"
  exit 1
}

edit_distance() {  # Levenshtein's distance of $1 and $2
  local a=$1 b=$2 i j cost best
  local -a above here
  for ((j = 0; j <= ${#b}; j++)); do above[j]=$j; done
  for ((i = 1; i <= ${#a}; i++)); do
    here=("$i")
    for ((j = 1; j <= ${#b}; j++)); do
      cost=1
      [[ ${a:i-1:1} == "${b:j-1:1}" ]] && cost=0
      best=$((above[j - 1] + cost))
      ((above[j] + 1 < best)) && best=$((above[j] + 1))
      ((here[j - 1] + 1 < best)) && best=$((here[j - 1] + 1))
      here[j]=$best
    done
    above=("${here[@]}")
  done
  printf '%d\n' "${above[${#b}]}"
}

nearest_word() {  # nearest_word WORD KNOWN...: the known word that is the fewest edits away, or nothing
  local word=$1 known nearest='' distance least=1000000
  shift
  for known; do
    distance=$(edit_distance "$word" "$known")
    ((distance < least)) && least=$distance nearest=$known
  done
  printf '%s\n' "$nearest"
}

known_word() {  # known_word KIND WORD KNOWN...: returns if WORD is known, else names the nearest and ends
  local kind=$1 word=$2 known nearest
  shift 2
  for known; do
    [[ $known == "$word" ]] && return
  done
  nearest=$(nearest_word "$word" "$@")
  [[ $nearest ]] || die "unknown $kind '$word'; there is none yet"
  die "unknown $kind '$word', did you mean '$nearest'? Known: $*"
}

microseconds() { printf '%s\n' "${EPOCHREALTIME//[.,]/}"; }

duration() {  # duration MICROSECONDS: as 0.4 s or 2 min 05 s
  local tenths=$(($1 / 100000))
  if ((tenths < 600)); then
    printf '%d.%d s\n' $((tenths / 10)) $((tenths % 10))
  else
    printf '%d min %02d s\n' $((tenths / 600)) $((tenths % 600 / 10))
  fi
}

since() { duration $(($(microseconds) - $1)); }  # since MICROSECONDS: the time from then to now

replace_between() {  # replace_between DOCUMENT BEGIN END: what stands between these two lines becomes what is read from standard input
  local new
  (($(grep -c -x -F -e "$2" -e "$3" "$1") == 2)) || die "$1 lacks its marks $2 and $3"
  new=$(mktemp)
  awk -v begin="$2" -v end="$3" '
    FILENAME == "-" { text = text $0 "\n"; next }
    $0 == end { replacing = 0 }
    !replacing
    $0 == begin { replacing = 1; printf "\n%s\n", text }' - "$1" >"$new"
  cat "$new" >"$1"
  rm -f "$new"
}
