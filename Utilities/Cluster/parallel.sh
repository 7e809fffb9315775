#!/usr/bin/env bash
# GNU parallel shares a run among the cores of this machine, or of others that see the same folder (--sshlogin in DGTK_PARALLEL).
#
#   Utilities/Cluster/parallel.sh 16 scenes -o dataset --layers color,depth,objects     in 16 shares
#
# A share that is interrupted or fails is tried again; all ends when a fifth of them have failed for good.
set -eu
dgtk=${DGTK:-dgtk}
shares=$1
shift
folder=''
for ((i = 1; i < $#; ++i)); do
  [ "${!i}" != -o ] || { next=$((i + 1)) && folder=${!next}; }
done
[ -n "$folder" ] || { echo "parallel.sh: say -o DIR" >&2 && exit 2; }
# shellcheck disable=SC2086  # words, not one word
seq 0 $((shares - 1)) |
  parallel --will-cite --retries 3 --halt soon,fail=20% ${DGTK_PARALLEL:-} "$dgtk" "${DGTK_COMMAND:-render}" "$(printf '%q ' "$@")" --shard "{}/$shares" --threads 1 --quiet
exec "$dgtk" merge "$folder"
