# SPDX-License-Identifier: BSD-2-Clause
# Tests in Python: the commands of scripts/, the Python package, the report, the documentation, and
# the packages.

# python_test(NAME FILE arguments... [LABELS label...] [TIMEOUT seconds] [PROCESSORS number]
#   [MPIRUN])
# Registers the Python file FILE with its arguments. MPIRUN: the test starts mpirun by itself, which
# needs the session directories that single ranks do without.
function(python_test NAME FILE)
  cmake_parse_arguments(PARSE_ARGV 2 test "MPIRUN" "TIMEOUT;PROCESSORS" "LABELS")
  if(NOT test_TIMEOUT)
    set(test_TIMEOUT 300)
  endif()
  if(NOT test_PROCESSORS)
    set(test_PROCESSORS 1)
  endif()
  set(environment ${mpi_environment})
  if(NOT test_MPIRUN)
    list(APPEND environment ${single_environment})
  endif()
  add_test(NAME ${NAME}
    COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/${FILE} ${test_UNPARSED_ARGUMENTS})
  set_tests_properties(${NAME} PROPERTIES LABELS "${test_LABELS}" TIMEOUT ${test_TIMEOUT}
    PROCESSORS ${test_PROCESSORS} ENVIRONMENT "${environment}")
endfunction()
set(program $<TARGET_FILE:squeal>)

# The commands of scripts/, the Python package, and the report in a browser.
python_test(scripts/dev scripts/test_dev.py LABELS scripts)
python_test(scripts/eigenvalues scripts/test_eigenvalues.py LABELS scripts)
python_test(scripts/convert_matrix scripts/test_convert_matrix.py LABELS scripts)
python_test(scripts/plot_regime scripts/test_plot_regime.py LABELS scripts)
python_test(scripts/results scripts/test_results.py LABELS scripts)
python_test(scripts/run_signals scripts/test_run_signals.py ${program} LABELS scripts
  PROCESSORS 2 MPIRUN)
python_test(scripts/run_deck scripts/test_run_deck.py LABELS scripts MPIRUN)
python_test(scripts/what_if scripts/test_what_if.py LABELS scripts MPIRUN)
python_test(scripts/options scripts/test_options.py ${program} LABELS scripts)
foreach(name IN ITEMS language dialects case joints contact reach assembly faults squeal values
        mutated)
  python_test(python/deck_${name} python/test_deck_${name}.py LABELS scripts)
endforeach()
foreach(name IN ITEMS language case joints contact mutated)
  python_test(python/bdf_${name} python/test_bdf_${name}.py LABELS scripts)
endforeach()
foreach(name IN ITEMS formats checks mutated)
  python_test(python/matrices_${name} python/test_matrices_${name}.py LABELS scripts)
endforeach()
foreach(name IN ITEMS results notebook)
  python_test(python/${name} python/test_${name}.py ${program} LABELS scripts)
endforeach()

# The same runs for both tests of the merge.
set(grid_parts ${output_directory}/grid_parts)
python_test(results/grid_parts support/run/grid_parts.py ${program} ${grid_parts} LABELS scripts)
foreach(name IN ITEMS merge merge_refusals)
  python_test(python/${name} python/test_${name}.py ${program} ${grid_parts} LABELS scripts)
  set_tests_properties(python/${name} PROPERTIES FIXTURES_REQUIRED grid_parts)
endforeach()
set_tests_properties(results/grid_parts PROPERTIES FIXTURES_SETUP grid_parts)

# One run for the tests of the report.
set(coarse_brake ${output_directory}/coarse_brake)
python_test(results/coarse_brake support/run/coarse_brake.py ${program} ${coarse_brake}
  LABELS scripts)
foreach(name IN ITEMS report view figures shares)
  python_test(web/${name} web/test_${name}.py ${program} ${coarse_brake} LABELS scripts)
  set_tests_properties(web/${name} PROPERTIES FIXTURES_REQUIRED coarse_brake)
endforeach()
set_tests_properties(results/coarse_brake PROPERTIES FIXTURES_SETUP coarse_brake)
foreach(name IN ITEMS mode_pairs variants)
  python_test(python/${name} python/test_${name}.py LABELS scripts)
endforeach()
python_test(web/compare web/test_compare.py ${program} LABELS scripts)

# The same runs for the tests of tables, and one run for them and for the report of the regime.
set(all_tables ${output_directory}/all_tables)
set(after_flutter ${output_directory}/after_flutter)
python_test(results/all_tables support/run/all_tables.py ${program} ${all_tables} LABELS scripts)
python_test(results/after_flutter support/run/after_flutter.py ${program} ${after_flutter}
  LABELS scripts)
foreach(name IN ITEMS schema damaged_tables)
  python_test(python/${name} python/test_${name}.py ${program} ${all_tables} ${after_flutter}
    LABELS scripts)
  set_tests_properties(python/${name} PROPERTIES FIXTURES_REQUIRED "all_tables;after_flutter")
endforeach()
python_test(web/regime web/test_regime.py ${program} ${after_flutter} LABELS scripts)
set_tests_properties(web/regime PROPERTIES FIXTURES_REQUIRED after_flutter)
set_tests_properties(results/all_tables PROPERTIES FIXTURES_SETUP all_tables)
set_tests_properties(results/after_flutter PROPERTIES FIXTURES_SETUP after_flutter)

# Runs that are cut off and continued; `long`: at random moments.
python_test(regression/resume scripts/test_resume.py ${program} ${mpiexec_script}
  LABELS regression)
add_test(NAME regression/resume_anywhere COMMAND ${CMAKE_COMMAND} -E env SQUEAL_LONG=1
  /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/scripts/test_resume.py ${program} ${mpiexec_script}
  Resumed.test_random_moments)
set_tests_properties(regression/resume_anywhere PROPERTIES LABELS long TIMEOUT 3600 PROCESSORS 2)

# The proof that the lists of eigenvalues are complete.
python_test(regression/proof scripts/test_proof.py ${program} ${mpiexec_script} LABELS regression)

# Folders of results that a run refuses.
python_test(regression/folders scripts/test_folders.py ${program} ${mpiexec_script}
  LABELS regression)

# The documentation site, and the statements of README and pages on the program and the repository.
python_test(docs/site docs/test_site.py ${program} LABELS docs)

# The installation and the packages.
python_test(packaging/install packaging/test_install.py ${CMAKE_COMMAND} ${PROJECT_BINARY_DIR}
  LABELS packaging MPIRUN)
python_test(packaging/recipes packaging/test_recipes.py ${PROJECT_BINARY_DIR} LABELS packaging)
add_test(NAME packaging/debian
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/packaging/debian ${PROJECT_BINARY_DIR})
set_tests_properties(packaging/debian PROPERTIES LABELS "packaging;long" TIMEOUT 3600 PROCESSORS 2
  ENVIRONMENT "${mpi_environment}")
