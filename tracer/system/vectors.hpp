// Finds which of our instruction sets this processor has. Highway's own dispatch lies in a shared library
// that measures a clock for 4 ms at every start of the program. Highway's headers alone cost nothing.
#pragma once

#include <string>

namespace plumb {

/// The widths of vectors that code is compiled for; every processor of this architecture has `any`.
enum class Vectors { any, avx2, avx512 };

/// Returns the widest vectors that this processor has.
inline Vectors widest_vectors() {
  static const Vectors found = [] {
    const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                          __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                          __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
    const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") &&
                            __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
                            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    return has_avx512 ? Vectors::avx512 : has_avx2 ? Vectors::avx2 : Vectors::any;
  }();
  return found;
}

/// Returns the one of three compilations of a function that fits this processor.
template <class Function>
Function* chosen(Function* any, Function* avx2, Function* avx512) {
  if (widest_vectors() == Vectors::avx512) return avx512;
  return widest_vectors() == Vectors::avx2 ? avx2 : any;
}

inline std::string name_of(Vectors vectors) {
  return vectors == Vectors::avx512 ? "AVX-512" : vectors == Vectors::avx2 ? "AVX2" : "SSE2";
}

}  // namespace plumb
