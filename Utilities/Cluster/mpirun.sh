#!/usr/bin/env bash
# The processes of Open MPI share a run among them, then one ends it. No message passes between them.
#
#   Utilities/Cluster/mpirun.sh 8 scenes -o dataset --layers color,depth,objects        further words for mpirun: DGTK_MPI
#
# Open MPI binds each process to one core when there are few: its threads would share that core, hence --bind-to none. It ends all
# processes when one fails; what is finished is kept, so the same command goes on.
set -eu
dgtk=${DGTK:-dgtk}
processes=$1
shift
folder=''
for ((i = 1; i < $#; ++i)); do
  [ "${!i}" != -o ] || { next=$((i + 1)) && folder=${!next}; }
done
[ -n "$folder" ] || { echo "mpirun.sh: say -o DIR" >&2 && exit 2; }
threads=$(($(nproc) / processes))
# shellcheck disable=SC2086  # words, not one word
mpirun --bind-to none --oversubscribe ${DGTK_MPI:-} -n "$processes" "$dgtk" "${DGTK_COMMAND:-render}" "$@" --shard auto --threads "$((threads > 0 ? threads : 1))" --quiet
exec "$dgtk" merge "$folder"
