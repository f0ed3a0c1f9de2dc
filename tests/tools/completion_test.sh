#!/usr/bin/env bash
# What bash offers after some words. Usage: completion_test.sh COMPLETIONS_FILE
set -uo pipefail
source "$1"
COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
compopt() { :; }  # there is no line to complete
failed=0
offers() {  # WHAT WANTED WORD...: the last word is being typed
  local what=$1 wanted=$2
  COMP_WORDS=("${@:3}")
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _nanson
  [[ ${COMPREPLY[*]} == "$wanted" ]] || { echo "$what: offers '${COMPREPLY[*]}', not '$wanted'"; failed=1; }
}
offers "a verb" "keys" nanson k
offers "options of keys" "--study --settings" nanson keys --s
offers "a key for --set" "material.poissons_ratio=" nanson run a.toml --set material.po
offers "a key with words" "time.step=dual time.step=edge time.step=paper" nanson run a.toml --set time.st
offers "the words behind =" "dual edge paper" nanson run a.toml --set time.step =
offers "one of them" "edge" nanson run a.toml --set time.step = e
exit $failed
