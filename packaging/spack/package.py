# SPDX-License-Identifier: BSD-2-Clause
# Copyright (c) The squeal developers
"""Recipe of squeal for Spack. Copy it to the folder packages/squeal of a Spack repository;
packaging/README.md says how."""

from spack.package import *


class Squeal(CMakePackage):
    """Brake squeal: flutter instability of the steady sliding of brake pads on a disc, with
    unilateral contact and Coulomb friction, by the finite element method in parallel."""

    # There is no archive to fetch: the recipe builds a folder of sources (spack dev-build, spack
    # develop).
    license("BSD-2-Clause")
    version("0.1.0")

    variant("int64", default=False, description="Indices of 64 bits in PETSc, SLEPc and MUMPS")
    variant("report", default=True, description="Python for squeal-report and squeal-plot")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")

    depends_on("mpi")
    depends_on("petsc@3.18:+mpi+mumps+metis~complex")
    depends_on("petsc+int64", when="+int64")
    depends_on("petsc~int64", when="~int64")
    depends_on("slepc@3.18:")
    depends_on("mumps@5.5:+mpi+double+shared")
    depends_on("hdf5+mpi")
    depends_on("fftw@3.3:")
    depends_on("lapack")
    depends_on("gmsh@4.8:+shared+opencascade")
    depends_on("vtk@9.1:")
    depends_on("metis@5:")
    depends_on("boost@1.74:")  # headers alone
    depends_on("nlohmann-json@3.9:")
    depends_on("libyaml")
    depends_on("zlib-api")
    depends_on("googletest", type="test")
    depends_on("matio", type="test")

    with when("+report"):
        depends_on("vtk+python")
        depends_on("python@3.10:", type=("build", "run"))
        depends_on("py-h5py", type="run")
        depends_on("py-matplotlib", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-pandas", type="run")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("BUILD_TESTING", self.run_tests),
            self.define_from_variant("SQUEAL_64BIT_INDICES", "int64"),
        ]

    @run_after("install")
    def use_python_of_spack(self):
        """The commands name Debian's Python in their first line."""
        if "+report" not in self.spec:
            return
        scripts = join_path(self.prefix.share, "squeal", "scripts")
        commands = ("report", "plot", "merge", "compare", "import")
        for name in (*(f"squeal-{command}" for command in commands), "convert_matrix"):
            filter_file(
                r"^#!/usr/bin/python3",
                "#!" + self.spec["python"].command.path,
                join_path(scripts, name),
            )

    def setup_run_environment(self, env):
        if "+report" in self.spec:
            env.prepend_path("PYTHONPATH", join_path(self.prefix.share, "squeal", "python"))
