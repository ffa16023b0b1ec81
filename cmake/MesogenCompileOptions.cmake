# How pair loops are compiled, here and in plugins elsewhere: warnings, floating point, instruction sets.

# Wider instruction sets that pair loops are built for beside the baseline: `auto` is the one of this machine, for each
# takes its time to compile. The folder names are those of glibc-hwcaps: the dynamic linker itself picks the library that
# fits the processor, and the plugin loader does the same for plugins.
set(MESOGEN_INSTRUCTION_SETS auto CACHE STRING
    "Instruction sets that pair loops are built for beside the baseline: auto, or a list of x86-64-v3 and x86-64-v4")
if(MESOGEN_INSTRUCTION_SETS STREQUAL auto)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -dM -E -x c++ /dev/null
                  OUTPUT_VARIABLE features ERROR_QUIET)
  set(MESOGEN_INSTRUCTION_SETS "")
  if(MESOGEN_SANITIZE)
    # one library for all, by the flags given
  elseif(features MATCHES "__AVX512VL__" AND features MATCHES "__AVX512DQ__")
    set(MESOGEN_INSTRUCTION_SETS x86-64-v4)
  elseif(features MATCHES "__AVX2__" AND features MATCHES "__FMA__")
    set(MESOGEN_INSTRUCTION_SETS x86-64-v3)
  endif()
endif()
foreach(set IN LISTS MESOGEN_INSTRUCTION_SETS)
  if(NOT set MATCHES "^x86-64-v[34]$")
    message(FATAL_ERROR "MESOGEN_INSTRUCTION_SETS: '${set}' is none; take auto, or a list of x86-64-v3 and x86-64-v4")
  endif()
endforeach()
set(MESOGEN_INSTRUCTION_SET_OPTIONS "")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # GCC 12 takes its own AVX-512 intrinsics for uninitialised (its bug 105593); the baseline build still warns.
  set(MESOGEN_INSTRUCTION_SET_OPTIONS -Wno-maybe-uninitialized -Wno-uninitialized)
endif()

if(NOT TARGET mesogen_options)
  add_library(mesogen_options INTERFACE)
  target_compile_options(mesogen_options INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
                              -Woverloaded-virtual -Wdouble-promotion $<$<BOOL:${MESOGEN_WARNINGS_ARE_ERRORS}>:-Werror>
                              -fno-math-errno -fno-trapping-math -ffp-contract=fast>
    # GCC 12 sees overlapping, endless or misplaced copies in "text" + std::string (its bug 105651).
    $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict
                              -Wno-stringop-overflow -Wno-array-bounds>)
endif()
