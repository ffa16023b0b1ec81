# How pair loops are compiled, here and in plugins elsewhere: warnings, floating point, instruction sets.

# Wider instruction sets that pair loops are built for beside the baseline. The folder names are those of glibc-hwcaps:
# the dynamic linker itself picks the library that fits the processor, and the plugin loader does the same for plugins.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT MESOGEN_SANITIZE)
  set(MESOGEN_INSTRUCTION_SETS x86-64-v3 x86-64-v4)
else()
  set(MESOGEN_INSTRUCTION_SETS "")
endif()
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
    # GCC 12 sees overlapping copies in "text" + std::string (its bug 105651).
    $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
endif()
