# What `cmake --install` brings and where. Everything lies relative to the program, which finds its modules, the SDK and
# the verification cases from its own path: an installed folder may be moved as a whole. lib is lib on every system for
# that reason, never lib64.
if(NOT "${MPI_C_LIBRARIES};${HDF5_C_LIBRARIES}" MATCHES "^/usr/lib[^;]*(;/usr/lib[^;]*)*$") # a cluster's own, in its own place
  set_target_properties(${BULLA_PROGRAMS} module-eos-table PROPERTIES INSTALL_RPATH_USE_LINK_PATH ON)
endif()
install(TARGETS ${BULLA_PROGRAMS} RUNTIME DESTINATION bin)

# Programs have HDF5 inside (packaging/libraries.cmake): its licence asks whoever hands them on for its notice.
set_target_properties(${BULLA_PROGRAMS} PROPERTIES BULLA_HDF5_INSIDE ON)
file(GLOB notice /usr/share/doc/libhdf5*-dev/copyright)
if(HDF5_ARCHIVE MATCHES "\\.a;" AND notice)
  list(GET notice 0 notice)
  install(FILES ${notice} DESTINATION share/doc/bulla RENAME copyright.hdf5)
endif()

# The SDK: headers and skeletons, for CMake and for pkg-config.
install(DIRECTORY core/include/bulla/skeleton DESTINATION include/bulla)
install(DIRECTORY core/include/bulla DESTINATION include FILES_MATCHING PATTERN "*.h" PATTERN skeleton EXCLUDE)
install(DIRECTORY core/include/bulla/ DESTINATION lib/cmake/bulla FILES_MATCHING PATTERN "*.cmake" PATTERN skeleton EXCLUDE)
configure_file(packaging/bulla.pc.in packaging/bulla.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/packaging/bulla.pc DESTINATION share/pkgconfig)

# Cases and schema; the pages link to the cases beside them.
install(DIRECTORY cases schemas DESTINATION share/bulla)
install(DIRECTORY docs DESTINATION share/doc/bulla PATTERN site EXCLUDE)
install(FILES packaging/python/bulla.py packaging/python/bulla_yt.py DESTINATION share/bulla/python)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION share/doc/bulla)
foreach(folder cases schemas)
  file(CREATE_LINK ../../bulla/${folder} ${CMAKE_BINARY_DIR}/packaging/${folder} SYMBOLIC)
  install(FILES ${CMAKE_BINARY_DIR}/packaging/${folder} DESTINATION share/doc/bulla)
endforeach()

# Completions of the shells and the manual page, from the option tables by way of the program's help.
set(words ${CMAKE_BINARY_DIR}/packaging/words)
add_custom_command(OUTPUT ${words}/bulla.1 DEPENDS ${BULLA_PROGRAMS} packaging/words.sh
                   COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0
                           sh ${CMAKE_SOURCE_DIR}/packaging/words.sh $<TARGET_FILE:bulla> ${words})
add_custom_target(words ALL DEPENDS ${words}/bulla.1)
add_dependencies(program words)
install(FILES ${words}/bulla.1 DESTINATION share/man/man1)
install(FILES ${words}/bulla.bash DESTINATION share/bash-completion/completions RENAME bulla)
install(FILES ${words}/_bulla DESTINATION share/zsh/vendor-completions)
install(FILES ${words}/bulla.fish DESTINATION share/fish/vendor_completions.d)
