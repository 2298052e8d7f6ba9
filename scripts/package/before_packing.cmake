# A package that leaves out what it depends on, or that nobody else may read, is none.
find_program(shlibdeps dpkg-shlibdeps)
find_program(file file)
if(NOT shlibdeps OR NOT file)
  message(FATAL_ERROR "dpkg-shlibdeps or file is missing, which say what the package depends on: apt install dpkg-dev file")
endif()
file(CHMOD_RECURSE "${CPACK_TEMPORARY_INSTALL_DIRECTORY}" DIRECTORY_PERMISSIONS
     OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
