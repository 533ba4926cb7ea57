# Completion of the command line client for bash: source this file, or install it as
# share/bash-completion/completions/rollgait.
_rollgait() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= word
  local commands="solve watch get list cancel delete models export report reproduce-paper simulate poincare server-info health help"
  local global="--server --tls-ca --tls-cert --tls-key --token-file --insecure --json --quiet --timeout --version --help"
  local body="--sex --stature --mass --segment --feet --ranges --toes --sagittal --drop-arms --rigid-trunk --lock
    --semi-axes"
  local request="--spec --model --speed --step-length --step-duration --free-speed --cycle --friction --clearance
    --touch-down --touch-down-point --lift-off-point --allow-overlap
    --from --to --duration --duty-factor
    --preset --cost --normalize --starts --warm-start --scheme --intervals --double-intervals --accuracy --bound --tolerance --max-refinements
    --max-iterations --time-limit --output"
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if [[ " $commands " == *" $word "* ]]; then command=$word; break; fi
  done
  case $previous in
    --sex) COMPREPLY=($(compgen -W "female male" -- "$current")); return ;;
    --scheme) COMPREPLY=($(compgen -W "radau2 radau3 hermite-simpson" -- "$current")); return ;;
    --cycle) COMPREPLY=($(compgen -W "half full" -- "$current")); return ;;
    --accuracy) COMPREPLY=($(compgen -W "draft standard fine" -- "$current")); return ;;
    --bound) COMPREPLY=($(compgen -S = -W "max_gap_m max_slip_m_s max_penetration_m max_overlap_m max_position_defect max_velocity_defect
      max_range_excess max_velocity_excess max_effort_excess max_pull_bw max_friction_excess max_separation_speed_m_s max_periodicity_error
      max_energy_error max_momentum_error_m_s" -- "$current")); compopt -o nospace 2> /dev/null; return ;;
    --cost) COMPREPLY=($(compgen -W "torque torque-rate force-rate work time effort muscle-work passive-load acceleration" -- "$current")); return ;;
    --feet) COMPREPLY=($(compgen -W "one two" -- "$current")); return ;;
    --touch-down) COMPREPLY=($(compgen -W "smooth plastic" -- "$current")); return ;;
    --model) COMPREPLY=($(compgen -W "$(rollgait --timeout 1 models 2> /dev/null | awk 'NR > 1 { print $1 }')" -- "$current")); return ;;
    --ranges) COMPREPLY=($(compgen -W "anatomical walking" -- "$current")); return ;;
    --preset) COMPREPLY=($(compgen -W "torque transport human" -- "$current")); return ;;
    --normalize) COMPREPLY=($(compgen -W "distance time none" -- "$current")); return ;;
    --format) COMPREPLY=($(compgen -W "json csv sto stride mjcf urdf opensim osim mot grf trc bvh gltf glb mcap" -- "$current")); return ;;
    --state) COMPREPLY=($(compgen -W "queued running succeeded failed cancelled" -- "$current")); return ;;
    --output | -o | --spec | --scene | --tls-ca | --tls-cert | --tls-key | --token-file) COMPREPLY=($(compgen -f -- "$current")); return ;;
  esac
  if [[ $current == -* ]]; then
    local options=$global
    case $command in
      solve) options+=" $body $request --slope --request-id --validate-only --detach --reconnect" ;;
      reproduce-paper) options+=" $body $request" ;;
      watch) options+=" --after-sequence --output --reconnect" ;;
      get) options+=" --output" ;;
      list) options+=" --state --limit" ;;
      models) options+=" $body --format --output --slope" ;;
      export) options+=" --format --output" ;;
      report) options+=" --output --title --no-normative" ;;
      simulate) options+=" --scene --duration --tolerance --output-step --output --validate-only --max-wall-time" ;;
      poincare) options+=" --scene --duration --tolerance --residual --max-iterations --max-wall-time" ;;
    esac
    COMPREPLY=($(compgen -W "$options" -- "$current"))
    return
  fi
  case $command in
    "") COMPREPLY=($(compgen -W "$commands" -- "$current")) ;;
    help) COMPREPLY=($(compgen -W "$commands" -- "$current")) ;;
    watch | get | cancel | delete | report | export)
      local names
      names=$(rollgait --timeout 1 list --limit 100 2> /dev/null | awk 'NR > 1 { print $1 }')
      COMPREPLY=($(compgen -W "$names" -- "$current") $( [[ $command == report || $command == export ]] && compgen -f -X '!*.json' -- "$current")) ;;
    models)
      COMPREPLY=($(compgen -W "$(rollgait --timeout 1 models 2> /dev/null | awk 'NR > 1 { print $1 }')" -- "$current")) ;;
  esac
}
complete -F _rollgait rollgait
