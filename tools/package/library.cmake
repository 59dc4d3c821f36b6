# What `cmake --install` runs for the component `library`: the solver as libslosh.a, and its headers. The caller has set
# SOURCES, ARCHIVE, WORK, NM, LINKER, OBJCOPY, AR, INCLUDES and LIBRARIES (CMakeLists.txt).
cmake_policy(VERSION 3.25)

# Public are the headers sim/*.h: each includes the others alone.
file(GLOB headers ${SOURCES}/sim/*.h)
set(text)
foreach(header ${headers})
  file(READ ${header} content)
  string(APPEND text "${content}")
endforeach()
file(INSTALL ${headers} DESTINATION "${INCLUDES}")

# Names that only the solver itself uses would meet those of a user's program: they
# are made local. What a public header names stays.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
execute_process(COMMAND ${NM} --defined-only --extern-only --format=just-symbols ${ARCHIVE} OUTPUT_VARIABLE symbols
                COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[A-Za-z_][A-Za-z_0-9]*" words "${text}")
list(REMOVE_DUPLICATES words)
string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
set(kept)
foreach(symbol ${symbols})
  if(symbol IN_LIST words)
    string(APPEND kept "${symbol}\n")
  endif()
endforeach()
file(REMOVE_RECURSE ${WORK})
file(WRITE ${WORK}/public_symbols "${kept}")
run(${LINKER} -r -o ${WORK}/slosh.o --whole-archive ${ARCHIVE})
run(${OBJCOPY} --strip-debug --keep-global-symbols=${WORK}/public_symbols ${WORK}/slosh.o)
run(${AR} rcs ${WORK}/libslosh.a ${WORK}/slosh.o)
file(INSTALL ${WORK}/libslosh.a DESTINATION "${LIBRARIES}")
file(REMOVE_RECURSE ${WORK}) # root may have made it, and another user builds here
