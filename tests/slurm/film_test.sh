#!/usr/bin/env bash
# usage: film_test.sh VASA FOLDER
# A Slurm cluster of this one machine, without touching one that may be installed: a film in four tasks, one of which is killed, then
# submitted again. The pictures must be those of one undivided run, and the video must show them.
set -euo pipefail
vasa=$(realpath "$1")
folder=$(realpath -m "$2")
script=$(realpath "$(dirname "$0")/../../scripts/slurm/film.sh")
rm -rf "$folder"
mkdir -p "$folder/slurm"/{spool,state}
cd "$folder/slurm"

# Slurm lets only those in who share a key; munged wants it private.
stop() {
  for name in slurmd ctld munge; do
    [ ! -e "$folder/slurm/$name.pid" ] || kill "$(cat "$folder/slurm/$name.pid")" 2> /dev/null || true
  done
}
trap stop EXIT
(umask 077; head -c 1024 /dev/urandom > munge.key)
munged --force --key-file="$PWD/munge.key" --socket="$PWD/munge.socket" --pid-file="$PWD/munge.pid" --log-file="$PWD/munge.log" --seed-file="$PWD/munge.seed"
host=$(hostname -s)
# Ports beside the usual 6817 and 6818.
cat > slurm.conf <<END
ClusterName=vasa
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
AuthInfo=socket=$PWD/munge.socket
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPidFile=$PWD/ctld.pid
SlurmdPidFile=$PWD/slurmd.pid
SlurmctldLogFile=$PWD/ctld.log
SlurmdLogFile=$PWD/slurmd.log
SlurmdSpoolDir=$PWD/spool
StateSaveLocation=$PWD/state
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=$host NodeAddr=127.0.0.1 CPUs=4
PartitionName=films Nodes=$host Default=YES MaxTime=INFINITE State=UP
SlurmdParameters=config_overrides
END
export SLURM_CONF=$PWD/slurm.conf VASA=$vasa
slurmctld
slurmd -N "$host"
for _ in $(seq 60); do [ "$(sinfo --noheader -o %T 2> /dev/null)" = idle ] && break; sleep 0.5; done
sinfo

# waitFor JOB...: waits until Slurm has nothing of them to do.
waitFor() {
  local jobs
  jobs=$(IFS=,; echo "$*")
  for _ in $(seq 600); do
    [ -n "$(squeue --noheader --jobs "$jobs" 2> /dev/null)" ] || return 0
    sleep 0.5
  done
  squeue
  echo "film_test.sh: the jobs do not end" >&2
  return 1
}
pictures() { find "$1" -name '*.png' -printf '%f\n' | sort; }
hashes() { (cd "$1" && sha256sum ./*.png); }

film=(--clip walk --size 256x192 --samples 1 --quads 4x2 --frames 0:23)
"$vasa" --quiet render "${film[@]}" -o "$folder/whole/{frame:05}.png"

echo "a task is killed"
read -r _ frames video <<< "$("$script" -n 4 "$folder/film" "${film[@]}")"
for _ in $(seq 1200); do [ -n "$(pictures "$folder/film")" ] && break; sleep 0.05; done
scancel --signal=KILL --full "${frames}_2"
waitFor "$frames" "$video"
before=$(pictures "$folder/film" | wc -l)
[ ! -e "$folder/film/film.mp4" ] || { echo "film_test.sh: there is a video of a film that is not complete" >&2; exit 1; }
[ "$before" -lt 24 ] || { echo "film_test.sh: the task was killed too late to tell anything" >&2; exit 1; }
echo "$before of 24 pictures are there; submitted again"
read -r -a jobs <<< "$("$script" -n 4 "$folder/film" "${film[@]}")"
waitFor "${jobs[@]}"
diff <(hashes "$folder/whole") <(hashes "$folder/film")
[ "$(ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames -of csv=p=0 "$folder/film/film.mp4")" = 24 ]
leftover=$(find "$folder/film" -name '*.part*')
[ -z "$leftover" ] || { echo "film_test.sh: left behind: $leftover" >&2; exit 1; }
echo "slurm: 24 pictures of four tasks, one killed and submitted again, are those of one run"
