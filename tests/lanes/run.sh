#!/bin/sh
# tests/lanes/run.sh INSTRUCTION_SET PROGRAM
# Runs a program that was compiled for an instruction set; exit code 77 where the processor has not got it.
v3="avx avx2 bmi1 bmi2 f16c fma abm movbe"
case $1 in
  baseline) needed="" ;;
  x86-64-v3) needed="$v3" ;;
  x86-64-v4) needed="$v3 avx512f avx512dq avx512cd avx512bw avx512vl" ;;
  *) echo "$0: no instruction set '$1'" >&2; exit 2 ;;
esac
for flag in $needed; do
  grep -qw "$flag" /proc/cpuinfo || { echo "skipped: this processor has no $flag"; exit 77; }
done
exec "$2"
