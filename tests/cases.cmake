# cases/matrix.yaml says which scenes of cases/*/NAME.yaml run in which variant, on how many ranks, with which settings;
# its first entry runs all of them, so adding a case file adds a test. The file is read by test-cases, which is built
# like everything else: tests are listed at build time, and ctest reads the list when it starts.
file(GLOB case_files CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/cases ${CMAKE_SOURCE_DIR}/cases/*/*.yaml)
set(scenes)
foreach(file ${case_files})
  file(STRINGS ${CMAKE_SOURCE_DIR}/cases/${file} is_scene REGEX "^(domain|extends):" LIMIT_COUNT 1)
  if(is_scene)
    list(APPEND scenes ${file})
  endif()
endforeach()

add_executable(test-cases cases.c)
target_link_libraries(test-cases PRIVATE bulla_core)
set_target_properties(test-cases PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
set(case_tests ${CMAKE_CURRENT_BINARY_DIR}/case_tests.cmake)
set(case_matrix ${CMAKE_SOURCE_DIR}/cases/matrix.yaml)
# A list that could not be made must not stay behind half-written.
add_custom_command(OUTPUT ${case_tests}
                   COMMAND test-cases ${case_matrix} $<TARGET_FILE:bulla> ${CMAKE_BINARY_DIR}/tests/runs
                           "${BULLA_TEST_ENV}" ${CMAKE_SOURCE_DIR}/cases ${scenes} > ${case_tests}.new
                   COMMAND ${CMAKE_COMMAND} -E rename ${case_tests}.new ${case_tests}
                   DEPENDS test-cases ${case_matrix}
                   COMMENT "Listing the tests of cases/matrix.yaml" VERBATIM)
add_custom_target(case-tests ALL DEPENDS ${case_tests})
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/case_list.cmake
     "if(EXISTS \"${case_tests}\")\n  include(\"${case_tests}\")\nelse()\n"
     "  add_test(cases-not-built \"cases-not-built\")\nendif()\n")
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/case_list.cmake)
