# Modules with one flaw each, for unit/registry.c: none but the first may load.
set(hostile_flaws none bad_magic old_abi new_abi short_size no_table short_table null_slot new_flags null_edges unknown_kind bad_name
    no_doc param_twice param_upper param_reserved param_range param_fallback param_unit param_choices preset_range duplicate
    no_symbol small_symbol missing_function flush_to_zero fast_math open_fails aborts)
foreach(flaw ${hostile_flaws})
  add_library(hostile-${flaw} MODULE hostile/hostile.c)
  set_target_properties(hostile-${flaw} PROPERTIES PREFIX "" OUTPUT_NAME ${flaw}
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/hostile)
  target_compile_definitions(hostile-${flaw} PRIVATE FLAW=${flaw})
  target_link_libraries(hostile-${flaw} PRIVATE bulla_flags)
endforeach()
target_compile_definitions(hostile-no_symbol PRIVATE FLAW_NAMELESS)
target_compile_definitions(hostile-small_symbol PRIVATE FLAW_SMALL)
target_compile_definitions(hostile-missing_function PRIVATE FLAW_MISSING)
target_compile_definitions(hostile-flush_to_zero PRIVATE FLAW_FLUSH)
target_compile_definitions(hostile-aborts PRIVATE FLAW_ABORTS)
target_link_options(hostile-fast_math PRIVATE -ffast-math)

# Modules that load and then give NaN, for program/hostile.sh.
foreach(kind CONSTITUTIVE EOS LIMITER RECONSTRUCTION RIEMANN)
  string(TOLOWER nan_${kind} name)
  add_library(hostile-${name} MODULE hostile/nan.c)
  set_target_properties(hostile-${name} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/hostile/nan)
  target_compile_definitions(hostile-${name} PRIVATE NAN_${kind})
  target_link_libraries(hostile-${name} PRIVATE bulla_flags)
endforeach()
