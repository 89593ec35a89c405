# The schema accepts and refuses the same cases as the program; what it cannot know is listed by name.
set -eu
python3=/usr/bin/python3
"$python3" -c 'import yaml, jsonschema' 2>/dev/null || {
    echo "skipped: no python3-yaml or python3-jsonschema; ./bulla setup installs them"
    exit 77
}
"$python3" "$BULLA_SOURCE/tests/editor/judge.py" "$BULLA" "$BULLA_SOURCE"
