#!/usr/bin/env bash
# An array job of Slurm: each task makes its share of a run, with the threads of the cores that it was given.
#
#   sbatch --array=0-15 Utilities/Cluster/slurm_array.sh scenes -o dataset --layers color,depth,objects
#   dgtk merge dataset          names what is missing, and an --array= that makes it, to submit again; else ends the run
#
# Tasks that are stopped (a time limit, a node that goes down) end with status 75 within seconds and are put back into the queue; what is
# finished is kept. Arrays have at most 1001 tasks on many clusters: take as many as there are cores to keep busy, not one a picture.
#SBATCH --job-name=dgtk
#SBATCH --cpus-per-task=4
#SBATCH --requeue
#SBATCH --signal=B:USR1@60
#SBATCH --output=dgtk-%A_%a.log
set -u
dgtk=${DGTK:-dgtk}
"$dgtk" "${DGTK_COMMAND:-render}" "$@" --shard auto --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet &
worker=$!
trap 'kill -USR1 "$worker" 2> /dev/null' USR1 TERM INT
wait "$worker"
status=$?
while kill -0 "$worker" 2> /dev/null; do # the signal has ended the waiting, not the work
  wait "$worker"
  status=$?
done
if [ "$status" -eq 75 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 20 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID:-$SLURM_JOB_ID}${SLURM_ARRAY_TASK_ID:+_$SLURM_ARRAY_TASK_ID}"
fi
exit "$status"
