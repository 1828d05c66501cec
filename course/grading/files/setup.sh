#!/usr/bin/env bash
# Gradescope runs this once, when it builds the image.
set -euo pipefail
apt-get update
apt-get install -y python3 python3-venv bubblewrap
python3 -m venv /opt/grader
/opt/grader/bin/pip install --no-cache-dir numpy scipy pytest rich pillow matplotlib
