# Completion of the options of squeal for bash, made by scripts/dev/generate_options.
_squeal() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  case $before in
    -options_file | *_file) mapfile -t COMPREPLY < <(compgen -f -- "$word") && return ;;
    -help) mapfile -t COMPREPLY < <(compgen -W "general mesh matrices elasticity constraint load motion contact tie steady modes flutter regime report" -- "$word") && return ;;
    -dry_run | -checkpoint | -resume | -quiet | -elasticity_prestress | -load_centrifugal | -motion_convective | -steady_full | -steady_uniqueness | -modes_benchmark | -modes_sturm | -flutter_direct_confirm | -flutter_friction_damping | -flutter_sensitivities | -flutter_track | -flutter_critical | -regime_cycle | -report_fields) mapfile -t COMPREPLY < <(compgen -W "on off" -- "$word") && return ;;
    -progress) mapfile -t COMPREPLY < <(compgen -W "auto line plain" -- "$word") && return ;;
    -mesh_straighten) mapfile -t COMPREPLY < <(compgen -W "none bad all" -- "$word") && return ;;
    -elasticity_mass) mapfile -t COMPREPLY < <(compgen -W "consistent higher_order" -- "$word") && return ;;
    -elasticity_plane) mapfile -t COMPREPLY < <(compgen -W "strain stress" -- "$word") && return ;;
    -friction_law) mapfile -t COMPREPLY < <(compgen -W "constant exponential table" -- "$word") && return ;;
    -modes_solver) mapfile -t COMPREPLY < <(compgen -W "auto block_lanczos eps" -- "$word") && return ;;
    -flutter_method) mapfile -t COMPREPLY < <(compgen -W "reduced direct" -- "$word") && return ;;
    -reduction_basis) mapfile -t COMPREPLY < <(compgen -W "corrected modal pod" -- "$word") && return ;;
    -regime_starts) mapfile -t COMPREPLY < <(compgen -W "fastest each all" -- "$word") && return ;;
    -regime_boundary) mapfile -t COMPREPLY < <(compgen -W "massless mass" -- "$word") && return ;;
    -report_matrices_format) mapfile -t COMPREPLY < <(compgen -W "petsc matrix_market" -- "$word") && return ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "-options_file -dry_run -help -help_json -version -checkpoint -checkpoint_interval -resume -log_json -progress -quiet -mesh_straighten -mesh_size -mesh_order -mesh_file -mesh_scale -mesh_set -elasticity_mass -elasticity_incompatible_modes -elasticity_prestress -elasticity_plane -load_centrifugal -motion_convective -friction_law -friction_static_ratio -friction_decay_speed -friction_table_speed -friction_table_factor -steady_full -steady_path -steady_uniqueness -steady_uniqueness_dense -steady_uniqueness_pmatrix -modes_benchmark -modes_count -modes_solver -modes_block_size -modes_tolerance -modes_sturm -reduction_released -flutter_method -flutter_direct_count -flutter_direct_band -flutter_direct_limit -flutter_direct_confirm -flutter_friction_damping -flutter_modal_damping -flutter_band -flutter_band_damping -flutter_accuracy -flutter_unstable_tolerance -flutter_shapes -flutter_shapes_below -reduction_basis -flutter_tolerance -flutter_rounds -flutter_growth -flutter_sensitivities -flutter_track -flutter_critical -flutter_critical_tolerance -flutter_track_halvings -flutter_friction -flutter_speed -flutter_pressure -flutter_damping -regime_cycle -regime_cycle_steps -regime_cycle_tolerance -regime_cycle_range -regime_cycle_motions -regime_friction -regime_time -regime_step -regime_start_factor -regime_starts -regime_boundary -regime_cycles_kept -regime_frames -regime_air_impedance -regime_spectrum_points -report_matrices -report_matrices_format -report_animated -report_pieces -report_frames -report_dir -report_fields -report_modes" -- "$word")
}
complete -o default -F _squeal squeal
