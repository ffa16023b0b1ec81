# How libraries for CUDA devices are built, here and of plugins elsewhere: where the project has CUDA among its languages.
get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if("CUDA" IN_LIST languages)
  set(MESOGEN_HAVE_CUDA ON)
  find_package(CUDAToolkit REQUIRED)
  set(CMAKE_CUDA_STANDARD 20)
  if(NOT CMAKE_CUDA20_STANDARD_COMPILE_OPTION)
    # CMake 3.25 does not know that nvcc knows it.
    set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
    set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
  endif()
else()
  set(MESOGEN_HAVE_CUDA OFF)
endif()

# mesogen_add_cuda_library(NAME KIND PATH_TO_LIBRARIES sources...): C++ sources compiled by nvcc into a library (SHARED or
# MODULE) whose passes run on a device. Each is included by a .cu file: a source's language holds for all targets of its
# folder. No relocatable device code: every library launches its own kernels, and all share one CUDA runtime, which is
# looked for where it was found and on the system.
function(mesogen_add_cuda_library name kind libraries)
  set(device_sources)
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
    list(LENGTH device_sources number)
    cmake_path(GET source STEM LAST_ONLY stem)
    set(device_source ${CMAKE_CURRENT_BINARY_DIR}/${name}/${number}_${stem}.cu)
    file(CONFIGURE OUTPUT ${device_source} CONTENT "#include \"${path}\"\n" @ONLY)
    list(APPEND device_sources ${device_source})
  endforeach()
  add_library(${name} ${kind} ${device_sources})
  set_target_properties(${name} PROPERTIES CUDA_RUNTIME_LIBRARY None CUDA_VISIBILITY_PRESET hidden
                        CUDA_SEPARABLE_COMPILATION OFF BUILD_RPATH "${CUDAToolkit_LIBRARY_DIR}"
                        INSTALL_RPATH "${libraries};${CUDAToolkit_LIBRARY_DIR}")
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  # std::array on a device, and no call from there to what is on the host alone; loops on the host as in the other
  # libraries.
  target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CUDA>:--expt-relaxed-constexpr
                         --Werror=cross-execution-space-call -Xcompiler=-fopenmp>)
  # Of the libraries of this project a test reads what the compiler says of their kernels.
  if(MESOGEN_KERNEL_REPORT)
    target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CUDA>:-Xptxas=-v>)
    set_property(TARGET ${name} PROPERTY RULE_LAUNCH_COMPILE "${MESOGEN_KERNEL_REPORT} <OBJECT>")
  endif()
  # Its own copy of what libmesogen_sph and libmesogen hold as well is the one that it must call.
  target_link_options(${name} PRIVATE -Wl,-Bsymbolic)
  target_link_libraries(${name} PRIVATE Mesogen::mesogen OpenMP::OpenMP_CXX CUDA::cudart)
endfunction()
