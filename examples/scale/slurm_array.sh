#!/usr/bin/env bash
#SBATCH --job-name=postform
#SBATCH --array=0-15
# Run `sbatch --array=0-15 slurm_array.sh FORM JOBS OUT`: each task prints every 16th job. Without Slurm, a loop can set the variables of Slurm:
#   for i in $(seq 0 15); do SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_COUNT=16 bash slurm_array.sh FORM JOBS OUT; done
set -euo pipefail
form=$1 jobs=$2 out=$3
task=${SLURM_ARRAY_TASK_ID:?the number of this task} tasks=${SLURM_ARRAY_TASK_COUNT:?how many tasks there are}
mkdir -p "$out"
mapfile -t all < <(printf '%s\n' "$jobs"/*.json)
mine=()
for ((i = task; i < ${#all[@]}; i += tasks)); do mine+=("${all[i]}"); done
# a task that is started again skips the programs that are up to date
postform render "${mine[@]}" --form "$form" --out-dir "$out" --changed --jobs "${SLURM_CPUS_PER_TASK:-1}" --quiet
