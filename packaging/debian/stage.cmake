# SPDX-License-Identifier: BSD-2-Clause
# Run by cpack when the files are installed in its staging folder, before they are packed: what
# Debian's policy asks for beyond them.
cmake_minimum_required(VERSION 3.25)

set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr)
set(doc ${usr}/share/doc/squeal)
if(NOT IS_DIRECTORY ${doc})
  message(FATAL_ERROR "stage.cmake: the staged files are not below ${usr}: the package needs the "
    "default folders of GNUInstallDirs")
endif()

# The version of the package is that of the head of its changelog.
file(STRINGS ${CPACK_SQUEAL_DEBIAN_DIR}/changelog head LIMIT_COUNT 1)
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
if(NOT head MATCHES "^squeal \\(([^)]*)\\)" OR NOT CMAKE_MATCH_1 STREQUAL version)
  message(FATAL_ERROR "stage.cmake: packaging/debian/changelog begins with '${head}', and the "
    "version of the package is ${version}")
endif()

file(COPY_FILE ${CPACK_SQUEAL_DEBIAN_DIR}/changelog ${doc}/changelog.Debian)
file(COPY_FILE ${CPACK_SQUEAL_DEBIAN_DIR}/copyright ${doc}/copyright)
file(REMOVE ${doc}/LICENSE)  # copyright contains its text
# The policy gives this name to the changes of the program itself.
file(RENAME ${doc}/CHANGELOG.md ${doc}/changelog)
file(GLOB compressed ${usr}/share/man/man1/*.1 ${doc}/changelog.Debian ${doc}/changelog)
execute_process(COMMAND gzip -9n ${compressed} COMMAND_ERROR_IS_FATAL ANY)
file(CREATE_LINK changelog.gz ${doc}/CHANGELOG.md.gz SYMBOLIC)

# Where Debian's Python looks for modules; the package itself stays beside web/, which it reads.
file(MAKE_DIRECTORY ${usr}/lib/python3/dist-packages)
file(CREATE_LINK ../../../share/squeal/python/squeal ${usr}/lib/python3/dist-packages/squeal
  SYMBOLIC)

# Folders that cpack has made have the umask of who called it.
file(GLOB_RECURSE paths LIST_DIRECTORIES true ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*)
foreach(path IN LISTS paths ITEMS ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
  if(IS_DIRECTORY ${path} AND NOT IS_SYMLINK ${path})
    file(CHMOD ${path} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
      GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  endif()
endforeach()
