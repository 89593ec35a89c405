# package.py - bulla for Spack: `spack repo add packaging/spack`, `spack dev-build bulla@0.1.0` in the tree.
from spack.package import *


class Bulla(CMakePackage):
    """Simulates bubbles, shocks and ultrasound in liquids, gases and soft solids: compressible multi-material flow with
    a diffuse interface, adaptive meshes, cases in YAML and Lua, laws as modules that are loaded at run time."""

    license("BSD-3-Clause")

    version("0.1.0")

    depends_on("c", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    depends_on("hdf5~mpi")
    depends_on("libyaml")
    depends_on("lua@5.4")
    depends_on("jansson")
    depends_on("xxhash")
    depends_on("zlib-api")
    depends_on("cairo+png")
    depends_on("libpng")
    depends_on("libmicrohttpd@0.9.71:")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("BULLA_TESTS", False),
            self.define("MPI_C_COMPILER", self.spec["mpi"].mpicc),
            self.define("BULLA_MPIRUN", join_path(self.spec["mpi"].prefix.bin, "mpirun")),
            self.define("HDF5_ROOT", self.spec["hdf5"].prefix),
        ]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        bulla = Executable(self.prefix.bin.bulla)
        case = join_path(self.prefix.share, "bulla/cases/tour/tube.yaml")
        bulla("run", case, "-o", join_path(self.stage.path, "tube"), "--quiet")
