# mesogen_add_plugin(NAME name KIND kernel|boundary|shape|initial|physics|observer SOURCES ... [VECTORISED] [HOST_ONLY]
#                    [TEST source...] [CONTRACT --set KEY=VALUE ...])
#
# Builds one plugin library into <build>/plugins and installs it into MESOGEN_PLUGIN_FOLDER: the plugin folder of the
# Mesogen that was found, whatever CMAKE_INSTALL_PREFIX is, so that `cmake --install` is all it takes. With
# -DMESOGEN_PLUGIN_FOLDER=lib/mesogen/plugins, or another folder, it goes there, beneath the prefix if it is relative.
# Where tests are enabled, adds
#   <name>.contract  what every plugin of its kind must hold: `mesogen plugin check`
#   <name>.*         the GoogleTest cases of TEST, with mesogen/testing/plugin_harness.hpp at hand
#
#   VECTORISED  it has pair sums or other long loops of its own: build it for the wider instruction sets too; the loader picks one
#   HOST_ONLY   it has loops of its own that a device cannot run: no library for CUDA is built from it
#   CONTRACT    arguments of `mesogen plugin check`, where the values that it chooses by itself will not do
function(mesogen_add_plugin)
  cmake_parse_arguments(PLUGIN "VECTORISED;HOST_ONLY" "NAME;KIND" "SOURCES;TEST;CONTRACT" ${ARGN})
  if(NOT PLUGIN_NAME OR NOT PLUGIN_SOURCES)
    message(FATAL_ERROR "mesogen_add_plugin: NAME and SOURCES are needed")
  endif()
  if(NOT PLUGIN_KIND MATCHES "^(kernel|boundary|shape|initial|physics|observer)$")
    message(FATAL_ERROR "mesogen_add_plugin(${PLUGIN_NAME}): KIND is kernel, boundary, shape, initial, physics or observer, not '${PLUGIN_KIND}'")
  endif()
  if(PLUGIN_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "mesogen_add_plugin(${PLUGIN_NAME}): unknown argument '${PLUGIN_UNPARSED_ARGUMENTS}'")
  endif()
  set(sets baseline)
  if(PLUGIN_VECTORISED)
    list(APPEND sets ${MESOGEN_INSTRUCTION_SETS})
  endif()
  foreach(set IN LISTS sets)
    if(set STREQUAL baseline)
      set(target ${PLUGIN_NAME})
      set(subfolder "")
    else()
      set(target ${PLUGIN_NAME}_${set})
      set(subfolder /${set})
    endif()
    add_library(${target} MODULE ${PLUGIN_SOURCES})
    set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${PLUGIN_NAME}
                          LIBRARY_OUTPUT_DIRECTORY ${MESOGEN_PLUGIN_OUTPUT}${subfolder}
                          CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_link_libraries(${target} PRIVATE Mesogen::nematics Mesogen::mesogen mesogen_options)
    target_compile_options(${target} PRIVATE ${MESOGEN_PAIR_LOOP_OPTIONS})
    if(set STREQUAL baseline AND TARGET mesogen)  # not in a plugin's own project
      target_precompile_headers(${target} REUSE_FROM mesogen_nematics)
    endif()
    if(NOT set STREQUAL baseline)
      target_compile_options(${target} PRIVATE -march=${set} ${MESOGEN_INSTRUCTION_SET_OPTIONS})
      add_dependencies(${PLUGIN_NAME} ${target})
    endif()
    install(TARGETS ${target} LIBRARY DESTINATION ${MESOGEN_PLUGIN_FOLDER}${subfolder})
  endforeach()
  if(TARGET programs)
    add_dependencies(programs ${PLUGIN_NAME})
  endif()
  if(MESOGEN_HAVE_CUDA AND PLUGIN_KIND STREQUAL physics AND NOT PLUGIN_HOST_ONLY)
    # From <prefix>/lib/mesogen/plugins/cuda to <prefix>/lib.
    mesogen_add_cuda_library(${PLUGIN_NAME}_cuda MODULE "$ORIGIN/../../.." ${PLUGIN_SOURCES})
    target_link_libraries(${PLUGIN_NAME}_cuda PRIVATE Mesogen::nematics)
    set_target_properties(${PLUGIN_NAME}_cuda PROPERTIES PREFIX "" OUTPUT_NAME ${PLUGIN_NAME}
                          LIBRARY_OUTPUT_DIRECTORY ${MESOGEN_PLUGIN_OUTPUT}/cuda)
    add_dependencies(${PLUGIN_NAME} ${PLUGIN_NAME}_cuda)
    install(TARGETS ${PLUGIN_NAME}_cuda LIBRARY DESTINATION ${MESOGEN_PLUGIN_FOLDER}/cuda)
  endif()
  if(CMAKE_TESTING_ENABLED)
    mesogen_add_plugin_tests()
  endif()
endfunction()

# The tests of mesogen_add_plugin, whose variables it reads.
macro(mesogen_add_plugin_tests)
  add_test(NAME ${PLUGIN_NAME}.contract
           COMMAND $<TARGET_FILE:Mesogen::command> plugin check $<TARGET_FILE:${PLUGIN_NAME}> ${PLUGIN_CONTRACT})
  set_tests_properties(${PLUGIN_NAME}.contract PROPERTIES TIMEOUT 300 ENVIRONMENT OMP_NUM_THREADS=1)
  if(PLUGIN_TEST)
    find_package(GTest REQUIRED)
    include(GoogleTest)
    add_executable(test_${PLUGIN_NAME} ${PLUGIN_TEST})
    set_target_properties(test_${PLUGIN_NAME} PROPERTIES CXX_EXTENSIONS OFF)
    target_compile_definitions(test_${PLUGIN_NAME} PRIVATE MESOGEN_TESTED_PLUGINS="${MESOGEN_PLUGIN_OUTPUT}")
    target_link_libraries(test_${PLUGIN_NAME} PRIVATE Mesogen::testing mesogen_options GTest::gtest_main
                          ${MESOGEN_PLUGIN_TEST_LIBRARIES})
    add_dependencies(test_${PLUGIN_NAME} ${PLUGIN_NAME})
    if(TARGET mesogen)
      target_compile_options(test_${PLUGIN_NAME} PRIVATE ${MESOGEN_COLD_OPTIONS})
      target_precompile_headers(test_${PLUGIN_NAME} REUSE_FROM mesogen_test_support)
    endif()
    gtest_discover_tests(test_${PLUGIN_NAME} TEST_PREFIX ${PLUGIN_NAME}. DISCOVERY_TIMEOUT 60
                         PROPERTIES ENVIRONMENT OMP_NUM_THREADS=1)
  endif()
endmacro()
