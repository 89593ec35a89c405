# MPI and HDF5, whoever made them: bulla_mpi, bulla_hdf5. HDF5 files are written by one rank, so that serial HDF5 is enough
# and preferred: it goes with any MPI. A parallel one does if it was made with the same MPI.
# BULLA_MPIRUN and BULLA_OPEN_MPI say how `bulla -n` starts ranks (core/run/launch.c).
include(CheckCSourceCompiles)
find_package(MPI REQUIRED COMPONENTS C)
find_package(HDF5 QUIET COMPONENTS C)
if(NOT HDF5_FOUND) # installed without the compiler wrapper that CMake asks
  pkg_search_module(HDF5_PC REQUIRED hdf5-serial hdf5 hdf5-openmpi hdf5-mpich)
  set(HDF5_C_INCLUDE_DIRS ${HDF5_PC_INCLUDE_DIRS})
  set(HDF5_C_LIBRARIES ${HDF5_PC_LINK_LIBRARIES})
endif()
list(FILTER HDF5_C_LIBRARIES INCLUDE REGEX "hdf5") # not what the wrapper names for static linking
add_library(bulla_mpi INTERFACE)
target_link_libraries(bulla_mpi INTERFACE MPI::MPI_C)
add_library(bulla_hdf5 INTERFACE)
target_include_directories(bulla_hdf5 SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
if(NOT HDF5_FOUND OR HDF5_IS_PARALLEL) # its header has mpi.h
  target_link_libraries(bulla_hdf5 INTERFACE MPI::MPI_C)
endif()

set(CMAKE_REQUIRED_LIBRARIES MPI::MPI_C)
set(CMAKE_REQUIRED_QUIET ON)
check_c_source_compiles("#include <mpi.h>
#ifndef OPEN_MPI
#error another MPI
#endif
int main(void) { return 0; }" BULLA_IS_OPEN_MPI)
set(CMAKE_REQUIRED_LIBRARIES)
set(BULLA_OPEN_MPI 0)
if(BULLA_IS_OPEN_MPI)
  set(BULLA_OPEN_MPI 1)
elseif(CMAKE_C_COMPILER_ID STREQUAL GNU) # takes MPICH's MPI_STATUSES_IGNORE, the address 1, for an array
  target_compile_options(bulla_mpi INTERFACE -Wno-stringop-overflow)
endif()

foreach(library ${HDF5_C_LIBRARIES}) # two MPIs in one program end in a crash: say so now
  file(STRINGS ${library} of_open_mpi REGEX "ompi_mpi_" LIMIT_COUNT 1)
  file(STRINGS ${library} of_any_mpi REGEX "MPI_Comm_dup" LIMIT_COUNT 1)
  if((of_open_mpi AND NOT BULLA_OPEN_MPI) OR (of_any_mpi AND NOT of_open_mpi AND BULLA_OPEN_MPI))
    message(FATAL_ERROR "${library} was built with another MPI than ${MPI_C_COMPILER}: install serial HDF5 (Debian: "
                        "libhdf5-dev), or set HDF5_ROOT to one that fits")
  endif()
endforeach()

# Programs have HDF5 inside (their property BULLA_HDF5_INSIDE) where its archive lies beside the library and asks for no
# more than what packs: Debian's library opens 30 others before a program begins, to read files on the web
# (docs/scaling.md). Modules and tests share the library.
option(BULLA_HDF5_ARCHIVE "Link the archive of HDF5 into the programs, where there is one" ON)
list(TRANSFORM HDF5_C_LIBRARIES REPLACE "\\.so$" ".a" OUTPUT_VARIABLE HDF5_ARCHIVE)
list(APPEND HDF5_ARCHIVE sz z m dl)
set(CMAKE_REQUIRED_LIBRARIES ${HDF5_ARCHIVE} MPI::MPI_C)
set(CMAKE_REQUIRED_INCLUDES ${HDF5_C_INCLUDE_DIRS})
check_c_source_compiles("#include <hdf5.h>
int main(void) { return H5open(); }" BULLA_HDF5_ARCHIVE_LINKS)
set(CMAKE_REQUIRED_LIBRARIES)
set(CMAKE_REQUIRED_INCLUDES)
if(NOT BULLA_HDF5_ARCHIVE OR NOT BULLA_HDF5_ARCHIVE_LINKS)
  set(HDF5_ARCHIVE ${HDF5_C_LIBRARIES})
endif()
target_link_libraries(bulla_hdf5 INTERFACE
                      $<IF:$<BOOL:$<TARGET_PROPERTY:BULLA_HDF5_INSIDE>>,${HDF5_ARCHIVE},${HDF5_C_LIBRARIES}>)

# mpicc.mpich belongs to mpirun.mpich, mpicc to mpirun: a name, found where the program runs.
get_filename_component(mpirun "${MPI_C_COMPILER}" NAME)
string(REGEX REPLACE "^mpi[a-z]+" "mpirun" mpirun "${mpirun}")
if(NOT mpirun MATCHES "^mpirun([.-][a-z0-9.-]+)?$")
  set(mpirun mpirun)
endif()
set(BULLA_MPIRUN ${mpirun} CACHE STRING "What starts ranks: a name in PATH, or a path")
set(BULLA_LAUNCH BULLA_MPIRUN="${BULLA_MPIRUN}" BULLA_OPEN_MPI=${BULLA_OPEN_MPI})
set_property(SOURCE core/run/launch.c APPEND PROPERTY COMPILE_DEFINITIONS ${BULLA_LAUNCH})
message(STATUS "MPI: ${MPI_C_COMPILER}, ranks by ${BULLA_MPIRUN}; HDF5: ${HDF5_C_LIBRARIES}")
