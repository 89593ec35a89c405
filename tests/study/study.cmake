# The partition study: a program for docs/scaling.md; the suite runs its tiny size. And the unit test of tile sets
# once more on three ranks, which join their wishes.
add_executable(partition-study study/partition_study.c study/study.c study/sets.c study/traffic.c)
target_link_libraries(partition-study PRIVATE bulla_core)
set_target_properties(partition-study PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
add_test(NAME study-partition COMMAND partition-study tiny)
add_test(NAME study-nest-ranks COMMAND mpirun -n 3 --oversubscribe --allow-run-as-root --mca mpi_yield_when_idle 1
         --bind-to none $<TARGET_FILE:test-unit-nest>)
set_tests_properties(study-partition study-nest-ranks PROPERTIES ENVIRONMENT
                     "${BULLA_TEST_ENV};ASAN_OPTIONS=detect_leaks=0" TIMEOUT 900)
