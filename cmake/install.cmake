# Installs the program, and the engine as a library: `find_package(tread)`, `target_link_libraries(x tread::engine)`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tread)
set(header_folder ${CMAKE_INSTALL_INCLUDEDIR}/tread)
foreach(floor core kernels engine)
  set_target_properties(tread_${floor} PROPERTIES EXPORT_NAME ${floor})
  target_include_directories(tread_${floor} INTERFACE $<INSTALL_INTERFACE:${header_folder}>)
  add_library(tread::${floor} ALIAS tread_${floor})
endforeach()
target_compile_features(tread_core INTERFACE cxx_std_20)
target_compile_options(tread_core INTERFACE $<INSTALL_INTERFACE:-Wno-psabi>)

install(TARGETS tread RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
# Data files that the program finds beside itself or, while it is not installed, in the source tree.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR}/tread COMPONENT program
  PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/tread COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/README.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program RENAME copyright)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# Man pages and completion, which the program writes itself from its table of commands.
set(manual_folder ${PROJECT_BINARY_DIR}/manual)
install(CODE "
  file(REMOVE_RECURSE \"${manual_folder}\")
  execute_process(COMMAND \"$<TARGET_FILE:tread>\" manual -o \"${manual_folder}\" COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT program)
install(DIRECTORY ${manual_folder}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(DIRECTORY ${manual_folder}/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT program)
install(DIRECTORY ${manual_folder}/zsh/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(DIRECTORY ${manual_folder}/fish/ DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  COMPONENT program)

# The reader of results where Debian's python3 looks for modules: in the package alone.
install(FILES ${PROJECT_SOURCE_DIR}/share/python/tread_results.py DESTINATION lib/python3/dist-packages
  COMPONENT python EXCLUDE_FROM_ALL)
# One path to the libraries, built and installed.
set_target_properties(tread PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH_USE_LINK_PATH ON)

install(TARGETS tread_core tread_kernels tread_engine EXPORT tread ARCHIVE
  DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT engine)
# Headers keep the paths by which they include one another.
foreach(folder core kernels drivers/engine)
  get_filename_component(parent ${folder} DIRECTORY)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${header_folder}/${parent}
    COMPONENT engine FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(EXPORT tread FILE tread-targets.cmake NAMESPACE tread:: DESTINATION ${package_folder} COMPONENT engine)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tread-config.cmake.in
  ${PROJECT_BINARY_DIR}/tread-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tread-config-version.cmake COMPATIBILITY ExactVersion)
install(FILES ${PROJECT_BINARY_DIR}/tread-config.cmake ${PROJECT_BINARY_DIR}/tread-config-version.cmake
  DESTINATION ${package_folder} COMPONENT engine)
