#!/usr/bin/env bash
# One job of Slurm whose tasks share a run among them, then end it.
#
#   sbatch --ntasks=8 Utilities/Cluster/slurm_srun.sh scenes -o dataset --layers color,depth,objects
#SBATCH --job-name=dgtk
#SBATCH --cpus-per-task=4
#SBATCH --output=dgtk-%j.log
set -eu
dgtk=${DGTK:-dgtk}
folder=''
for ((i = 1; i < $#; ++i)); do
  [ "${!i}" != -o ] || { next=$((i + 1)) && folder=${!next}; }
done
[ -n "$folder" ] || { echo "slurm_srun.sh: say -o DIR" >&2 && exit 2; }
srun --cpus-per-task="${SLURM_CPUS_PER_TASK:-1}" "$dgtk" "${DGTK_COMMAND:-render}" "$@" --shard auto --threads "${SLURM_CPUS_PER_TASK:-1}" --quiet
exec "$dgtk" merge "$folder"
