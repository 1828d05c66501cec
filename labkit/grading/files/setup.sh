#!/usr/bin/env bash
# Installs bubblewrap, and a Python with requirements.txt in /opt/grader.
# Gradescope runs this once, when it builds the image; the Dockerfiles here run it as well.
set -euo pipefail
cd "$(dirname "$0")"  # requirements.txt lies beside this file
grader=${GRADER:-/opt/grader}
export DEBIAN_FRONTEND=noninteractive
apt-get update
apt-get install -y --no-install-recommends bubblewrap ca-certificates
for python in python3.14 python3.13 python3.12 python3.11; do  # Ubuntu 22.04's python3 is too old
    apt-get install -y --no-install-recommends "$python-venv" && break
done
"$python" -m venv "$grader"
"$grader/bin/pip" install --no-cache-dir -r requirements.txt
