# bullaConfig.cmake - find_package(bulla) for authors of modules: the target bulla::sdk (headers and
# flags) and bulla_add_module. It works where it lies, in a source tree beside the headers
# (-Dbulla_DIR=.../core/include/bulla) or installed in lib/cmake/bulla.
get_filename_component(bulla_INCLUDE_DIR "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)
if(NOT EXISTS "${bulla_INCLUDE_DIR}/bulla/module.h")
  get_filename_component(bulla_INCLUDE_DIR "${CMAKE_CURRENT_LIST_DIR}/../../../include" ABSOLUTE)
endif()

# Values never depend on the optimiser: no contraction, nothing of fast-math; errno and traps off,
# because they alone keep loops from becoming vectors.
if(NOT TARGET bulla::sdk)
  add_library(bulla::sdk INTERFACE IMPORTED)
  set_target_properties(bulla::sdk PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${bulla_INCLUDE_DIR}"
    INTERFACE_COMPILE_OPTIONS "-fvisibility=hidden;-fno-math-errno;-fno-trapping-math;-fopenmp-simd;-ffp-contract=off"
    INTERFACE_LINK_OPTIONS "-Wl,-z,defs")
endif()

# bulla_add_module(TARGET KIND kind NAME name SOURCES file...): builds KIND-NAME.so, optimised
# unless the project says otherwise.
function(bulla_add_module target)
  cmake_parse_arguments(module "" "KIND;NAME" "SOURCES" ${ARGN})
  add_library(${target} MODULE ${module_SOURCES})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME "${module_KIND}-${module_NAME}" C_STANDARD 11)
  target_link_libraries(${target} PRIVATE bulla::sdk m)
  if(NOT CMAKE_BUILD_TYPE)
    target_compile_options(${target} PRIVATE -O3)
  endif()
endfunction()
