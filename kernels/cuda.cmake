# The device of NVIDIA's cards: TREAD_CUDA chooses between device/cuda.cu and device/no_gpu.cpp. Where there is nvcc,
# the target nvcc_check compiles what a card will run, for one architecture, without linking it.
set(cuda_source ${CMAKE_CURRENT_SOURCE_DIR}/device/cuda.cu)
set(cuda_flags -std=c++20 --expt-relaxed-constexpr -Werror all-warnings -I ${PROJECT_SOURCE_DIR})
set(nvcc ${PROJECT_SOURCE_DIR}/scripts/nvcc_whole.sh)
set(architectures ${TREAD_CUDA_ARCHITECTURES})
include(device/card_architectures.cmake)

set(cards "")
if(NOT TREAD_CUDA STREQUAL "OFF")
  find_package(CUDAToolkit 12 QUIET) # the first one that knows C++20
  file(GLOB cards /dev/nvidia[0-9]*)
endif()
if(NOT CUDAToolkit_FOUND) # the place of an older nvcc would be kept, too
  unset(CUDAToolkit_NVCC_EXECUTABLE CACHE)
  unset(CUDAToolkit_BIN_DIR CACHE)
  set(CUDAToolkit_NVCC_EXECUTABLE "")
endif()
set(fault "")
if(NOT CUDAToolkit_NVCC_EXECUTABLE)
  set(fault "there is no nvcc of CUDA 12 or later; install it")
elseif(cards AND NOT architectures)
  find_card_architectures(architectures fault ${CUDAToolkit_NVCC_EXECUTABLE})
endif()

set(with_cuda OFF)
set(unused_card "")
if(TREAD_CUDA STREQUAL "ON" AND fault)
  message(FATAL_ERROR "TREAD_CUDA=ON: ${fault}, or leave TREAD_CUDA=AUTO")
elseif(TREAD_CUDA STREQUAL "ON" OR (cards AND NOT fault))
  set(with_cuda ON)
elseif(cards)
  set(unused_card "The card of this machine is not used: ${fault}, and configure anew (cmake --preset release).")
  message(STATUS "${unused_card}")
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/unused_card.txt CONTENT "${unused_card}") # ./run shows it
if(NOT architectures)
  set(architectures 90)
endif()
set(TREAD_WITH_CUDA ${with_cuda} PARENT_SCOPE) # for those who link the installed engine [tread-config.cmake.in]
set(targets "")
foreach(architecture ${architectures})
  list(APPEND targets -gencode arch=compute_${architecture},code=[sm_${architecture},compute_${architecture}])
endforeach()

if(with_cuda)
  set(cuda_object ${CMAKE_CURRENT_BINARY_DIR}/cuda.o)
  add_custom_command(OUTPUT ${cuda_object} VERBATIM DEPENDS ${cuda_source} ${nvcc} DEPFILE ${cuda_object}.d
    COMMENT "Building CUDA object ${cuda_object}"
    COMMAND ${nvcc} ${CUDAToolkit_NVCC_EXECUTABLE} ${cuda_flags} -O3 ${targets} -Xcompiler -fPIE,-Wno-psabi -MD -MF ${cuda_object}.d
      -c -o ${cuda_object} ${cuda_source})
  set_source_files_properties(${cuda_object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  get_target_property(sources tread_kernels SOURCES)
  list(FILTER sources EXCLUDE REGEX "/no_gpu\\.cpp$")
  set_target_properties(tread_kernels PROPERTIES SOURCES "${sources}")
  target_sources(tread_kernels PRIVATE ${cuda_object})
  target_link_libraries(tread_kernels PUBLIC CUDA::cudart_static)
  message(STATUS "steps on NVIDIA's cards: ${architectures}")
endif()

if(CUDAToolkit_NVCC_EXECUTABLE)
  add_custom_target(nvcc_check VERBATIM)
  add_custom_command(TARGET nvcc_check VERBATIM COMMAND ${nvcc} ${CUDAToolkit_NVCC_EXECUTABLE} ${cuda_flags}
    -arch=sm_90 -cubin -o ${CMAKE_CURRENT_BINARY_DIR}/cuda.cubin ${cuda_source})
endif()
