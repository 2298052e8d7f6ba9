// Which of the instruction sets that Highway compiled for this processor has. Highway's own dispatch is in a
// shared library that measures a clock for 4 ms at every start of the program; its headers alone cost
// nothing.
#pragma once

namespace plumb::references {

enum class Processor { any, avx2, avx512 };

inline Processor processor() {
  static const Processor found = [] {
    const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                          __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                          __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
    const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") &&
                            __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
                            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    return has_avx512 ? Processor::avx512 : has_avx2 ? Processor::avx2 : Processor::any;
  }();
  return found;
}

/// One function as it was compiled three times.
template <class Function>
Function* chosen(Function* any, Function* avx2, Function* avx512) {
  if (processor() == Processor::avx512) return avx512;
  return processor() == Processor::avx2 ? avx2 : any;
}

}  // namespace plumb::references
