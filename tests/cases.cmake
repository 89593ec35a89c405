# cases/*/NAME.yaml: every scene runs its quick variant, which must show what it expects. Adding a case file adds a test.
file(GLOB case_files CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/cases ${CMAKE_SOURCE_DIR}/cases/*/*.yaml)
foreach(file ${case_files})
  file(STRINGS ${CMAKE_SOURCE_DIR}/cases/${file} is_scene REGEX "^(domain|extends):" LIMIT_COUNT 1)
  if(is_scene)
    string(REGEX REPLACE "[/_]" "-" name case-${file})
    string(REGEX REPLACE "\\.yaml$" "" name ${name})
    add_test(NAME ${name} COMMAND bulla run ${CMAKE_SOURCE_DIR}/cases/${file} --variant quick --quiet --overwrite
             -o ${CMAKE_BINARY_DIR}/tests/runs/${name})
    set_tests_properties(${name} PROPERTIES ENVIRONMENT "${BULLA_TEST_ENV}" TIMEOUT 600)
  endif()
endforeach()
