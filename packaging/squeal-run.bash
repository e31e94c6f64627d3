# SPDX-License-Identifier: BSD-2-Clause
# Completion of squeal-run for bash: names of cases and files first, then the options of squeal,
# whose completion stands beside this file.
# shellcheck source=packaging/squeal.bash
. "${BASH_SOURCE[0]%-run}"
_squeal_run() {
  local word=${COMP_WORDS[COMP_CWORD]}
  if [ "$COMP_CWORD" -eq 1 ] && [[ $word != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("${COMP_WORDS[0]}" --cases 2>/dev/null)" -- "$word")
    return
  fi
  _squeal
  if [[ -n $word && "-what_if" == "$word"* ]]; then COMPREPLY+=(-what_if); fi
}
complete -o default -F _squeal_run squeal-run
