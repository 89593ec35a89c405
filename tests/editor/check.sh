#!/bin/sh
# check.sh - what do editors show in case files? Nightly, not in ctest: it needs node, npm and the network.
#
#     tests/editor/check.sh [BULLA]          BULLA: the program, build/bin/bulla if not given
#
# Installs the YAML language server, which VS Code, neovim and helix all use, into a temporary folder (or takes the one
# in YAML_LANGUAGE_SERVER) and asks it for completions, hovers and errors with the schema of the program, plugins in
# BULLA_MODULE_PATH included. Exit: 0 all answers are right, 1 not all are, 77 skipped, with the reason. ASK_SHOW=1
# shows every answer.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
bulla=${1:-$here/../../build/bin/bulla}
version=1.25.0

skip() {
    echo "skipped: $*"
    exit 77
}

[ -x "$bulla" ] || { echo "error: no program at $bulla"; exit 2; }
command -v node >/dev/null 2>&1 || skip "node is not installed"
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
trap 'exit 130' INT TERM
server=${YAML_LANGUAGE_SERVER:-$place/node_modules/yaml-language-server/bin/yaml-language-server}
if [ -z "${YAML_LANGUAGE_SERVER:-}" ]; then
    command -v npm >/dev/null 2>&1 || skip "npm is not installed"
    npm install --loglevel=error --no-audit --no-fund --prefix "$place" "yaml-language-server@$version" >"$place/npm.log" 2>&1 ||
        skip "npm cannot install yaml-language-server $version: $(head -n 1 "$place/npm.log")"
fi
"$bulla" schema >"$place/case.schema.json"
node "$here/ask.mjs" "$server" "$place/case.schema.json" "$here/questions.txt"
