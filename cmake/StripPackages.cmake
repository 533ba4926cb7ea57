# cpack calls this between installing and packing: programs and static libraries without the sections that nothing needs.
file(GLOB_RECURSE archives "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*.a")
foreach(archive ${archives})
  execute_process(COMMAND strip --strip-unneeded --enable-deterministic-archives --remove-section=.comment --remove-section=.note "${archive}"
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB programs "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr/bin/*")
execute_process(COMMAND strip --remove-section=.comment --remove-section=.note ${programs} COMMAND_ERROR_IS_FATAL ANY)
