# The partition study: a program for docs/scaling.md; the suite runs its tiny size.
add_executable(partition-study study/partition_study.c study/study.c study/sets.c study/traffic.c study/pieces.c study/moves.c)
target_link_libraries(partition-study PRIVATE bulla_core)
set_target_properties(partition-study PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
add_test(NAME study-partition COMMAND partition-study tiny)
set_tests_properties(study-partition PROPERTIES ENVIRONMENT
                     "${BULLA_TEST_ENV};ASAN_OPTIONS=detect_leaks=0" TIMEOUT 900)
