# How everything of ours is compiled: standard, warnings, floating point, output folders, instruction sets.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(MESOGEN_PLUGIN_FOLDER lib/mesogen/plugins)
set(CMAKE_INSTALL_LIBDIR lib)

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

add_library(mesogen_options INTERFACE)
target_compile_options(mesogen_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
                            -Woverloaded-virtual -Wdouble-promotion -Werror -fno-math-errno -fno-trapping-math
                            -ffp-contract=fast>
  # GCC 12 sees overlapping copies in "text" + std::string (its bug 105651).
  $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
if(MESOGEN_SANITIZE)
  target_compile_options(mesogen_options INTERFACE -fsanitize=${MESOGEN_SANITIZE} -fno-omit-frame-pointer -g)
  target_link_options(mesogen_options INTERFACE -fsanitize=${MESOGEN_SANITIZE})
endif()
if(MESOGEN_TIDY)
  find_program(CLANG_TIDY clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${CLANG_TIDY})
endif()

# nvcc, where there is one that works and knows C++20: used, never required.
set(MESOGEN_HAVE_CUDA OFF)
if(MESOGEN_CUDA)
  find_program(MESOGEN_NVCC nvcc HINTS /usr/local/cuda/bin)
  if(MESOGEN_NVCC)
    execute_process(COMMAND ${MESOGEN_NVCC} --version OUTPUT_VARIABLE nvcc_text ERROR_QUIET)
    string(REGEX MATCH "release ([0-9.]+)" nvcc_version "${nvcc_text}")
    if(CMAKE_MATCH_1 AND CMAKE_MATCH_1 VERSION_GREATER_EQUAL 12.0)
      if(NOT CMAKE_CUDA_ARCHITECTURES)
        set(CMAKE_CUDA_ARCHITECTURES 80-real 90)
      endif()
      if(NOT CMAKE_CUDA_COMPILER)
        set(ENV{CUDACXX} ${MESOGEN_NVCC})
      endif()
      include(CheckLanguage)
      check_language(CUDA)
      if(CMAKE_CUDA_COMPILER)
        enable_language(CUDA)
        set(CMAKE_CUDA_STANDARD 20)
        if(NOT CMAKE_CUDA20_STANDARD_COMPILE_OPTION)
          # CMake 3.25 does not know that nvcc knows it.
          set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
          set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
        endif()
        set(MESOGEN_HAVE_CUDA ON)
      endif()
    endif()
  endif()
endif()
message(STATUS "Passes are compiled for CUDA: ${MESOGEN_HAVE_CUDA}")

# mesogen_add_device_objects(NAME sources...): the same sources compiled by nvcc, as proof that every functor can run on
# a device. Each is included by a .cu file: a source's language holds for all targets of its folder.
function(mesogen_add_device_objects name)
  set(device_sources)
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
    cmake_path(GET source STEM stem)
    set(device_source ${CMAKE_CURRENT_BINARY_DIR}/${name}/${stem}.cu)
    file(CONFIGURE OUTPUT ${device_source} CONTENT "#include \"${path}\"\n" @ONLY)
    list(APPEND device_sources ${device_source})
  endforeach()
  add_library(${name} OBJECT ${device_sources})
endfunction()
