# Writes OUTPUT, a header that states the commit of the working tree SOURCE: empty where SOURCE is no clone.
# The file stays as it is while the commit does.
set(commit "")
find_program(git git)
if(git AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${git} -C ${SOURCE} describe --always --dirty --exclude=* --abbrev=12
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "inline constexpr const char* kCommit = \"${commit}\";\n")
