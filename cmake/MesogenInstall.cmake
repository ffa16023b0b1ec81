install(TARGETS mesogen_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY python/mesogen DESTINATION lib/mesogen/python PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE README.md ARCHITECTURE.md CHANGELOG.md DESTINATION share/doc/mesogen)
install(FILES docs/quickstart.png DESTINATION share/doc/mesogen/docs)
