#pragma once

/// Compiler and standard library that a plugin was built with: objects cross the boundary, so these must agree.
#define MESOGEN_STRINGIFY_(x) #x
#define MESOGEN_STRINGIFY(x) MESOGEN_STRINGIFY_(x)
#if defined(__clang__)
#define MESOGEN_COMPILER "clang"
#else
#define MESOGEN_COMPILER "gcc"
#endif
#define MESOGEN_BUILD_TAG \
  MESOGEN_COMPILER "-itanium" MESOGEN_STRINGIFY(__GXX_ABI_VERSION) "-cxx11abi" MESOGEN_STRINGIFY(_GLIBCXX_USE_CXX11_ABI)
