#!/usr/bin/env bash
# The kept page of the panel: a build takes it as long as its sources are the same, and needs npm only when they have changed.
source "$(dirname "$0")/stand_in.sh"

rm -rf "$tree/web-ui/page"
cp -r "$repository/web-ui/page" "$tree/web-ui/"
mkdir "$tree/web-ui/panel" # without what npm has left
(cd "$repository/web-ui/panel" && tar -c --exclude=node_modules --exclude=dist .) | tar -x -C "$tree/web-ui/panel"
page=$tree/web-ui/page/page.sh panel=$tree/web-ui/panel
mkdir "$work/path" # no npm
for program in bash env dirname cp rm find sort xargs sha256sum cut; do ln -s "$(command -v $program)" "$work/path/$program"; done

fits() { if PATH=$work/path bash "$page" fits; then echo yes; else echo no; fi; }
build() {  # build: sets status, errors
  PATH=$work/path bash "$page" build "$work/npm" "$work/packed" >"$work/errors" 2>&1
  status=$?
  errors=$(<"$work/errors")
}

build
expect "exit code of a build without npm" "$status" 0
expect "what is packed" "$(diff -r "$work/packed" "$tree/web-ui/page/kept" && echo the kept page)" "the kept page"

echo "// changed" >>"$panel/src/core/tests/sample.ts"
echo "changed" >>"$panel/README.md"
mkdir "$panel/node_modules" && touch "$panel/node_modules/new"
expect "after a change in tests, documents and packages, the page fits" "$(fits)" yes

for file in src/main.ts index.html public/icon.svg package-lock.json vite.config.ts ../page/embed.mjs; do
  cp "$panel/$file" "$work/before"
  echo " " >>"$panel/$file"
  expect "after a change of $file, the page fits" "$(fits)" no
  cp "$work/before" "$panel/$file"
done
touch "$panel/src/new.ts"
expect "with a new file, the page fits" "$(fits)" no
build
expect "exit code of a build that needs npm" "$status" 1
expect "what that says" "$errors" "*npm and node*not installed*./flexrf build*apt-get install nodejs npm*"
mv "$panel/src/new.ts" "$panel/src/newer.ts"
expect "with a renamed file, the page fits" "$(fits)" no
rm "$panel/src/newer.ts"
expect "with its own sources, the page fits" "$(fits)" yes
finish
