# SPDX-License-Identifier: BSD-2-Clause
# Completion of the options of squeal for bash, made by scripts/dev/generate_options.
_squeal_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "${COMP_WORDS[COMP_CWORD]}"); }
_squeal() {
  case ${COMP_WORDS[COMP_CWORD - 1]} in
    -options_file | *_file)
      mapfile -t COMPREPLY < <(compgen -f -- "${COMP_WORDS[COMP_CWORD]}")
      return
      ;;
    -help)
      _squeal_words "general mesh frame matrices material elasticity reference ground spring
        bushing mass coupling equation bolt constraint load motion friction contact
        tie steady modes flutter regime referee report"
      return
      ;;
    -checkpoint | -resume | -quiet | -dry_run | -audit | -elasticity_prestress | \
    -bolt_under_pressure | -load_centrifugal | -motion_convective | -steady_full \
    | -steady_uniqueness | -modes_sturm | -flutter_proof | \
    -flutter_direct_confirm | -flutter_shapes_stable | -flutter_sensitivities | \
    -flutter_track | -flutter_critical | -flutter_friction_damping | \
    -regime_cycle | -report_fields)
      _squeal_words "on off"
      return
      ;;
    -progress)
      _squeal_words "auto line plain"
      return
      ;;
    -mesh_straighten)
      _squeal_words "none bad all"
      return
      ;;
    -elasticity_mass)
      _squeal_words "consistent higher_order"
      return
      ;;
    -elasticity_plane)
      _squeal_words "strain stress"
      return
      ;;
    -friction_law)
      _squeal_words "constant exponential table"
      return
      ;;
    -modes_solver)
      _squeal_words "auto block_lanczos eps"
      return
      ;;
    -flutter_method)
      _squeal_words "reduced direct"
      return
      ;;
    -flutter_basis)
      _squeal_words "corrected modal pod"
      return
      ;;
    -regime_starts)
      _squeal_words "fastest each all"
      return
      ;;
    -regime_boundary)
      _squeal_words "massless mass"
      return
      ;;
    -referee_format)
      _squeal_words "auto columns abaqus calculix nastran ansys"
      return
      ;;
    -referee_unit)
      _squeal_words "auto rad Hz"
      return
      ;;
    -report_matrices_format)
      _squeal_words "petsc matrix_market"
      return
      ;;
  esac
  _squeal_words "-options_file -dry_run -help -help_json -version -checkpoint
    -checkpoint_interval -resume -quiet -log_json -progress -audit
    -mesh_straighten -mesh_file -mesh_scale -mesh_set -mesh_size -mesh_order
    -elasticity_mass -elasticity_incompatible_modes -elasticity_prestress
    -elasticity_plane -bolt_under_pressure -load_centrifugal -load_gravity
    -motion_convective -friction_law -friction_static_ratio
    -friction_decay_speed -friction_table_speed -friction_table_factor
    -steady_full -steady_path -steady_uniqueness -steady_uniqueness_dense
    -steady_uniqueness_pmatrix -modes_count -modes_solver -modes_block_size
    -modes_tolerance -modes_sturm -flutter_proof -flutter_proof_discs
    -flutter_direct_count -flutter_direct_band -flutter_direct_limit
    -flutter_direct_confirm -flutter_method -flutter_modal_damping -flutter_band
    -flutter_band_damping -flutter_accuracy -flutter_unstable_tolerance
    -flutter_shapes -flutter_shapes_stable -flutter_shapes_below -flutter_basis
    -flutter_tolerance -flutter_rounds -flutter_growth -flutter_sensitivities
    -flutter_track -flutter_critical -flutter_critical_tolerance
    -flutter_track_halvings -flutter_friction -flutter_speed -flutter_pressure
    -flutter_damping -flutter_friction_damping -flutter_released
    -regime_friction -regime_time -regime_step -regime_start_factor
    -regime_starts -regime_boundary -regime_cycle -regime_cycle_steps
    -regime_cycle_tolerance -regime_cycle_range -regime_cycle_motions
    -regime_cycles_kept -regime_frames -regime_air_impedance
    -regime_spectrum_points -referee_top -referee_left -referee_tolerance
    -referee_discs -referee_list -referee_format -referee_unit -report_matrices
    -report_matrices_format -report_component_modes -report_dir -report_note
    -report_fields -report_modes -report_animated -report_pieces -report_frames"
}
complete -o default -F _squeal squeal
