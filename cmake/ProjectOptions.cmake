# What every target of this project is compiled with: mixcontact_options carries warnings and sanitizers.

add_library(mixcontact_options INTERFACE)
target_compile_features(mixcontact_options INTERFACE cxx_std_17)

if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(
    mixcontact_options
    INTERFACE -Wall
              -Wextra
              -Wpedantic
              -Wconversion
              -Wsign-conversion
              -Wshadow
              -Wold-style-cast
              -Wcast-align
              -Wcast-qual
              -Wnon-virtual-dtor
              -Wdouble-promotion
              -Wformat=2
              -Wimplicit-fallthrough
              -Wundef
              -Wunused)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(mixcontact_options INTERFACE -Wduplicated-cond -Wduplicated-branches -Wlogical-op)
    # kB of memory from which on GCC collects garbage: with 512 MB the largest files compile in nine tenths of the time.
    target_compile_options(mixcontact_options INTERFACE --param=ggc-min-heapsize=524288)
  endif()
  if(MIXCONTACT_WERROR)
    target_compile_options(mixcontact_options INTERFACE -Werror)
  endif()
endif()

if(MIXCONTACT_SANITIZE)
  target_compile_options(
    mixcontact_options INTERFACE -fsanitize=${MIXCONTACT_SANITIZE} -fno-sanitize-recover=all
                                 -fno-omit-frame-pointer)
  # A null pointer ends in the address sanitizer's report, and Eigen asserts alignment: to check both at each access, too,
  # takes two fifths of the time that the largest files take to compile.
  target_compile_options(mixcontact_options INTERFACE -fno-sanitize=null,alignment)
  target_link_options(mixcontact_options INTERFACE -fsanitize=${MIXCONTACT_SANITIZE})
  # GCC's flow analysis is confused by the instrumentation and warns of impossible paths.
  target_compile_options(mixcontact_options INTERFACE -Wno-maybe-uninitialized -Wno-null-dereference)
endif()
