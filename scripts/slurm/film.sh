#!/usr/bin/env bash
# A film on a Slurm cluster: the motion is solved once, tasks of a job array draw every n-th frame, one more job makes the video.
#   film.sh [-n TASKS] [-c CPUS] FOLDER RENDER-ARGUMENTS...
#   film.sh -n 16 -c 4 /shared/walk --body body.glb --network body.vasa --clip walk --size 1920x1080
# FOLDER, on a file system that all nodes share, receives the pictures, motion.track, film.mp4 and a log for each task.
# The same line again draws what is missing: pictures that are there are kept (vasa render --resume). What else Slurm should know
# comes from its own variables, e.g. SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT; VASA names the program.
# Prints the numbers of the jobs: track, frames, video.
set -euo pipefail
usage() { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
tasks=4 cpus=1
while getopts n:c: option; do
  case $option in
    n) tasks=$OPTARG ;;
    c) cpus=$OPTARG ;;
    *) usage ;;
  esac
done
shift $((OPTIND - 1))
[ $# -ge 2 ] || usage
for number in "$tasks" "$cpus"; do
  [[ $number =~ ^[1-9][0-9]*$ ]] || { echo "film.sh: $number: tasks and processors are whole numbers from 1 on" >&2; exit 2; }
done
command -v sbatch > /dev/null || { echo "film.sh: sbatch is missing; run this where Slurm's commands are installed" >&2; exit 2; }
folder=$(realpath -m "$1")
shift
mkdir -p "$folder/log"

# A motion that is not solved has no track.
keep=(--track "$folder/motion.track")
for argument in "$@"; do
  [ "$argument" != --no-avoid ] || keep=()
done
render=("${VASA:-vasa}" --quiet --threads "$cpus" render "$@" ${keep[@]+"${keep[@]}"})
draw=(-o "$folder/{frame:05}.png" --resume)

# submit NAME AFTER EXTRA-OF-SBATCH... -- COMMAND...; a CPU driver draws with as many threads as the task has processors.
submit() {
  local name=$1 after=$2 extra=()
  shift 2
  [ -z "$after" ] || extra=("--dependency=afterok:$after" --kill-on-invalid-dep=yes)
  while [ "$1" != -- ]; do extra+=("$1"); shift; done
  shift
  sbatch --parsable --requeue --open-mode=append --job-name="vasa-$name" --cpus-per-task="$cpus" -o "$folder/log/$name.%a" \
    ${extra[@]+"${extra[@]}"} --wrap "export LP_NUM_THREADS=$cpus; exec $*" | cut -d';' -f1
}
quoted() { printf '%q ' "$@"; }

track=
[ ${#keep[@]} -eq 0 ] || track=$(submit track "" -- "$(quoted "${render[@]}")")
frames=$(submit frames "$track" "--array=0-$((tasks - 1))" -- "$(quoted "${render[@]}" "${draw[@]}") --shard \$SLURM_ARRAY_TASK_ID/$tasks")
video=$(submit video "$frames" -- "$(quoted "${render[@]}" "${draw[@]}" --video "$folder/film.mp4")")
echo "${track:-none} $frames $video"
