# Sourced by fresh.sh: gives an npm in another root what this machine's npm knows of registries, proxies and certificates.
# shellcheck shell=bash

npm_setting() {  # npm_setting KEY: prints it; nothing without npm
  if command -v npm >/dev/null; then npm config get "$1" 2>/dev/null; fi
}

npm_texts() {  # the settings as lines KEY=VALUE; of those with the same key the last one counts
  local file name key
  for file in "$(npm_setting globalconfig)" "${npm_config_userconfig-$HOME/.npmrc}"; do
    [[ -f $file ]] && awk 1 "$file"
  done
  while read -r name; do
    key=${name#npm_config_}
    [[ $key == -* ]] || printf '%s=%s\n' "${key//_/-}" "${!name}"
  done < <(compgen -e npm_config_)
}

copy_npm_settings() {  # copy_npm_settings ROOT: into the home folder of root there, with the cache
  local home=$1/root cache certificates
  # Where things lie on this machine is no setting for the other one.
  npm_texts | grep -v -E '^ *(prefix|cache|cafile|nodedir|userconfig|globalconfig) *=' >"$home/.npmrc" || true
  certificates=$(npm_setting cafile)
  [[ -f $certificates ]] || certificates=${NODE_EXTRA_CA_CERTS-}
  if [[ -f $certificates ]]; then
    cp -L "$certificates" "$home/npm_certificates.pem"
    echo "cafile=/root/npm_certificates.pem" >>"$home/.npmrc"
  fi
  cache=$(npm_setting cache)
  if [[ -d $cache/_cacache ]]; then
    mkdir -p "$home/.npm"
    cp -a "$cache/_cacache" "$home/.npm/"
    chown -R --reference="$home" "$home/.npm"
  fi
}
