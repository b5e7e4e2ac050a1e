# Cross-compiles for 64-bit Windows with MinGW-w64; tests run under Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
find_program(CMAKE_CXX_COMPILER NAMES x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-g++ REQUIRED)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static) # no libraries of the compiler's beside a program
find_program(CMAKE_CROSSCOMPILING_EMULATOR NAMES wine wine64)
# By name, so that -static has its way; FindOpenMP would name the import libraries.
set(OpenMP_gomp_LIBRARY -lgomp CACHE STRING "")
