#!/usr/bin/env bash
# The last step of the action: checks the files that the lines of FILES name, with the words of
# OPTIONS. GitHub turns what it prints into annotations.
set -euo pipefail
shopt -s globstar nullglob

read -r -d '' -a options <<< "$OPTIONS" || true

# Each line is a pattern, whose blanks are a part of it.
IFS=$'\n'
# shellcheck disable=SC2206
files=($FILES)
if [ ${#files[@]} -eq 0 ]; then
    echo "::error title=Burnish::no file has a name like ${FILES//$'\n'/ or }"
    exit 1
fi
echo "Checking ${#files[@]} files."
exec python -m burnish check --format github "${options[@]}" -- "${files[@]}"
