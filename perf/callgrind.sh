#!/bin/bash
# Shared by the scripts that count instructions with callgrind; they source this file.

# need_callgrind PROGRAM: ends the script with exit code 4 unless valgrind and the program are there.
need_callgrind() {
  command -v valgrind >/dev/null || {
    echo "There is no valgrind on this machine; install it (package valgrind) to count instructions." >&2
    exit 4
  }
  [[ -x $1 ]] || {
    echo "There is no program $1; build it, or name it as the first argument." >&2
    exit 4
  }
}

# under_callgrind LOG FUNCTION OPTION...: counts the instructions within one function, named exactly, of the command that
# ends the options. Ends the script with exit code 3, and the log, where the command fails.
under_callgrind() {
  local log=$1
  valgrind --tool=callgrind --toggle-collect="$2" "${@:3}" 2>"$log" || {
    cat "$log" >&2
    exit 3
  }
}
