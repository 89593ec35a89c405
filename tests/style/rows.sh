# The table of rows in docs/verification.md is what docs/rows.txt and the tables of the scenes make.
set -eu
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
python3 "$BULLA_SOURCE/tests/study/rows.py" --check
