# The device of NVIDIA's cards: TREAD_CUDA chooses between device/cuda.cu and device/no_gpu.cpp. Where there is nvcc,
# the target nvcc_check compiles what a card will run, for one architecture, without linking it.
set(cuda_source ${CMAKE_CURRENT_SOURCE_DIR}/device/cuda.cu)
set(cuda_flags -std=c++20 --expt-relaxed-constexpr -Werror all-warnings -I ${PROJECT_SOURCE_DIR})
set(nvcc ${PROJECT_SOURCE_DIR}/scripts/nvcc_whole.sh)
set(architectures ${TREAD_CUDA_ARCHITECTURES})

if(NOT TREAD_CUDA STREQUAL "OFF")
  find_package(CUDAToolkit 12 QUIET) # the first one that knows C++20
endif()
if(TREAD_CUDA STREQUAL "ON" AND NOT CUDAToolkit_NVCC_EXECUTABLE)
  message(FATAL_ERROR "TREAD_CUDA=ON: there is no nvcc of CUDA 12 or later; install it, or leave TREAD_CUDA=AUTO")
endif()

file(GLOB cards /dev/nvidia[0-9]*)
set(with_cuda OFF)
if(CUDAToolkit_NVCC_EXECUTABLE AND (TREAD_CUDA STREQUAL "ON" OR cards))
  set(with_cuda ON)
endif()
if(NOT architectures)
  set(architectures 90)
  if(cards)
    set(architectures native)
  endif()
endif()
set(targets "")
foreach(architecture ${architectures})
  if(architecture STREQUAL "native")
    list(APPEND targets -arch=native)
  else()
    list(APPEND targets -gencode arch=compute_${architecture},code=[sm_${architecture},compute_${architecture}])
  endif()
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
  target_link_libraries(tread_kernels PUBLIC $<BUILD_INTERFACE:CUDA::cudart_static>)
  message(STATUS "steps on NVIDIA's cards: ${architectures}")
elseif(cards AND NOT TREAD_CUDA STREQUAL "OFF")
  message(STATUS "this machine has a card, but no nvcc: with CUDA 12 or later, configure anew with -D TREAD_CUDA=ON")
endif()

if(CUDAToolkit_NVCC_EXECUTABLE)
  add_custom_target(nvcc_check VERBATIM)
  add_custom_command(TARGET nvcc_check VERBATIM COMMAND ${nvcc} ${CUDAToolkit_NVCC_EXECUTABLE} ${cuda_flags}
    -arch=sm_90 -cubin -o ${CMAKE_CURRENT_BINARY_DIR}/cuda.cubin ${cuda_source})
endif()
