#!/usr/bin/env bash
# On a processor without the vectors it was built for, a program says so; on one with them it runs.
# usage: processor_test.sh PROGRAM NEEDS_AVX2; exit code 77: skipped.
set -u
program=$1 needs_avx2=$2
# Emulated, AddressSanitizer's shadow memory takes minutes and all there is.
if grep -q __asan_init "$program"; then echo "skipped: built with AddressSanitizer"; exit 77; fi
command -v qemu-x86_64 >/dev/null || { echo "skipped: qemu-x86_64 (package qemu-user) is not installed"; exit 77; }
on() {  # PROCESSOR: what the program prints there, and its exit code
  qemu-x86_64 -cpu "$1" "$program" --help 2>&1
  echo "exit code $?"
}
failed=0
[[ $(on max) == *"exit code 0" ]] || { failed=1; echo "FAILED: it does not run on a processor with everything"; }
if [ "$needs_avx2" = ON ]; then
  expected=$'This build needs a processor with AVX2 and FMA, and this one has not both.*\nexit code 1'
  # shellcheck disable=SC2053  (a pattern)
  [[ $(on Nehalem) == $expected ]] || { failed=1; echo "FAILED: on a Nehalem it prints: $(on Nehalem)"; }
else
  [[ $(on Nehalem) == *"exit code 0" ]] || { failed=1; echo "FAILED: the baseline does not run on a Nehalem"; }
fi
exit $failed
